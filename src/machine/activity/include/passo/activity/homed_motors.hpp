// HomedMotors: the positions of an axis' two motors during homing, and the position of each when its switch closed. For
// an axis with one motor, both entries are the axis position.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace passo {

class HomedMotors {
 public:
  static constexpr std::size_t first = 0;
  static constexpr std::size_t second = 1;

  // Sets both motors to `place`, with unknown switch positions.
  void begin_at(double place) { is_at_ = found_ = {place, place}; }
  // Moves the motor by the distance `way`. `to_switch`: the distance after which its switch closed, if it did.
  void go(std::size_t motor, double way, std::optional<double> to_switch) {
    if (to_switch) found_[motor] = is_at_[motor] + *to_switch;
    is_at_[motor] += way;
  }

  double is_at(std::size_t motor) const { return is_at_[motor]; }
  double found(std::size_t motor) const { return found_[motor]; }
  // Returns how far the first motor is ahead of the second one.
  double apart() const { return is_at_[first] - is_at_[second]; }
  // Returns the distance that the second motor must move to be as far from its switch as the first one. Unknown switch
  // positions count as the start position.
  double apart_from_switches() const { return (is_at_[first] - found_[first]) - (is_at_[second] - found_[second]); }
  // Returns the distance from the motors' switch positions to their current positions, the larger one, and at least 0.
  // `direction`: 1 or -1, of the axis toward its switches.
  double farthest_beyond(double direction) const {
    return std::max({direction * (is_at_[first] - found_[first]), direction * (is_at_[second] - found_[second]), 0.0});
  }

 private:
  std::array<double, 2> is_at_{};
  std::array<double, 2> found_{};
};

}  // namespace passo
