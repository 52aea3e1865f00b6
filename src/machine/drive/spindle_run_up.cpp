#include "passo/drive/spindle_run_up.hpp"

#include <cmath>

namespace passo {
namespace {

constexpr double near_speed = 0.1;
constexpr double steady = 0.02;
constexpr int most_turns = 1000;

}  // namespace

void SpindleRunUp::begin(double revolutions_per_minute) {
  *this = {};
  wanted_ = seconds_per_minute / revolutions_per_minute;
}

void SpindleRunUp::read(const SpindleReading& now) {
  const double turned = std::abs(now.turns - turn_begun_.turns);
  if (turned < 1) return;
  const double turn = (now.time - turn_begun_.time).value() / turned;
  at_speed_ = at_speed_ || std::abs(turn - wanted_) < near_speed * wanted_ ||
              std::abs(turn - turn_before_) < steady * turn || ++turns_ == most_turns;
  turn_before_ = turn;
  turn_begun_ = now;
}

}  // namespace passo
