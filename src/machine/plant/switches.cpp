#include "passo/plant/switches.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

void Switches::follow(Seconds time, const MotorPositions& positions) {
  unsigned now = 0;
  bounces_ = false;
  const auto touches = [&](const auto& body) { return body.contains(positions); };
  if (std::ranges::any_of(bodies_, touches) || std::ranges::any_of(surfaces_, touches)) now |= input_probe;
  for (Limit& limit : limits_) {
    const bool before = std::exchange(limit.closed, limit.place.closed(positions[limit.place.motor], limit.closed));
    if (limit.closed != before) limit.changed = time;
    const Seconds since = time - limit.changed;
    bounces_ |= since < limit.place.bounce;
    if (limit.closed == limit.place.shows_change(since)) now |= limit.place.input;
  }
  by_motors_ = static_cast<std::uint16_t>(now);
}

std::int64_t Switches::steps_to_next_change(const MotorPositions& positions) const {
  if (limits_.empty() && bodies_.empty() && surfaces_.empty()) return INT64_MAX;
  if (bounces_) return 1;
  double least = far_away;
  for (const Limit& limit : limits_) {
    const auto turns_at = static_cast<double>(limit.closed ? limit.place.opens_at : limit.place.closes_at);
    least = std::min(least, std::abs(positions[limit.place.motor] - turns_at));
  }
  for (const TouchBody& body : bodies_) least = std::min(least, body.steps_to_border(positions));
  for (const TouchSurface& surface : surfaces_) least = std::min(least, surface.steps_to_border(positions));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(least));
}

}  // namespace passo
