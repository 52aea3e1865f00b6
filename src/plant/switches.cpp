#include "passo/plant/switches.hpp"

#include <algorithm>
#include <cmath>

#include "passo/wire/message.hpp"

namespace passo {
namespace {

// In steps: no machine goes beyond this.
constexpr double far_away = 1e18;

}  // namespace

void Switches::add(const TravelSwitch& added) {
  limits_.push_back({.place = added});
}

void Switches::set(std::uint16_t which, bool closed) {
  by_hand_ = static_cast<std::uint16_t>(closed ? by_hand_ | which : by_hand_ & ~which);
}

void Switches::follow(const MotorPositions& positions) {
  unsigned now = 0;
  if (std::ranges::any_of(bodies_, [&](const TouchBody& body) { return body.contains(positions); })) now |= input_probe;
  for (Limit& limit : limits_) {
    limit.closed = limit.place.closed(positions[limit.place.motor], limit.closed);
    if (limit.closed) now |= limit.place.input;
  }
  by_motors_ = static_cast<std::uint16_t>(now);
}

std::int64_t Switches::steps_to_next_change(const MotorPositions& positions) const {
  if (limits_.empty() && bodies_.empty()) return INT64_MAX;
  double least = far_away;
  for (const Limit& limit : limits_) {
    const auto turns_at = static_cast<double>(limit.closed ? limit.place.opens_at : limit.place.closes_at);
    least = std::min(least, std::abs(positions[limit.place.motor] - turns_at));
  }
  for (const TouchBody& body : bodies_) least = std::min(least, body.steps_to_border(positions));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(least));
}

}  // namespace passo
