#include "even_motion.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {

EvenMotion::EvenMotion(const Derivatives& slopes, const Phase& phase)
    : slopes_(slopes),
      velocity_(phase.velocity.value()),
      acceleration_(phase.acceleration.value()),
      duration_(phase.duration.value()),
      way_(std::max(velocity_ + acceleration_ * duration_ / 2, 0.0) * duration_),
      even_(slopes.first * acceleration_ + slopes.second * velocity_ * velocity_),
      rise_(3 * acceleration_ * slopes.second + slopes.third * velocity_ * velocity_),
      bend_(2.5 * acceleration_ * slopes.third) {}

double EvenMotion::square_at(double way) const {
  return std::max(velocity_ * velocity_ + 2 * acceleration_ * way, 0.0);
}

double EvenMotion::time_at(double way) const {
  const double twice_mean = velocity_ + std::sqrt(square_at(way));
  return twice_mean > 0 ? std::min(2 * way / twice_mean, duration_) : 0;
}

double EvenMotion::value(double way, Order order) const {
  const auto& [first, second, third] = slopes_;
  switch (order) {
    case Order::velocity: return (first + way * (second + way * third / 2)) * std::sqrt(square_at(way));
    case Order::acceleration: return even_ + way * (rise_ + way * bend_);
    case Order::jerk: break;
  }
  const double square = square_at(way);
  return std::sqrt(square) * (third * square + 3 * (second + third * way) * acceleration_);
}

// Places outside of the phase count as its start.
EvenMotion::Places EvenMotion::places_of_peaks(Order order) const {
  const auto inside = [&](double way) { return way > 0 && way < way_ ? way : 0.0; };
  switch (order) {
    case Order::velocity: {  // where the acceleration is 0
      if (bend_ == 0) return {.first = rise_ != 0 ? inside(-even_ / rise_) : 0};
      const double root = rise_ * rise_ - 4 * bend_ * even_;
      if (root < 0) return {};
      const double sum = -(rise_ + std::copysign(std::sqrt(root), rise_)) / 2;
      return {.first = inside(sum / bend_), .second = sum != 0 ? inside(even_ / sum) : 0};
    }
    case Order::acceleration: return {.first = bend_ != 0 ? inside(-rise_ / (2 * bend_)) : 0};
    case Order::jerk: break;
  }
  const double slope = 15 * acceleration_ * slopes_.third;
  const double start = 6 * slopes_.third * velocity_ * velocity_ + 3 * slopes_.second * acceleration_;
  return {.first = slope != 0 ? inside(-start / slope) : 0};
}

std::optional<EvenMotion::Peak> EvenMotion::peak_above(double least, Order order) const {
  double best = least;
  double where = -1;
  const auto see = [&](double way) {
    const double here = std::abs(value(way, order));
    if (!(here > best)) return;
    best = here;
    where = way;
  };
  see(0);
  see(way_);
  const Places places = places_of_peaks(order);
  if (places.first > 0) see(places.first);
  if (places.second > 0) see(places.second);
  if (where < 0) return {};
  return Peak{.value = best, .time = time_at(where)};
}

double EvenMotion::highest(Order order, double from, double to) const {
  const Places places = places_of_peaks(order);
  double most = std::max(std::abs(value(from, order)), std::abs(value(to, order)));
  for (const double place : {places.first, places.second}) {
    if (place > from && place < to) most = std::max(most, std::abs(value(place, order)));
  }
  return most;
}

}  // namespace passo::proof
