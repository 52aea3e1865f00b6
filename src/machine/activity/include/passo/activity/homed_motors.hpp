// HomedMotors: where the motors of an axis are while the axis is homed, and where each of them was when its switch
// closed. With one motor, both are the axis.
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

  // Both stand at `place`. Nothing is known of their switches.
  void begin_at(double place) { is_at_ = found_ = {place, place}; }
  // The motor has gone this way. `to_switch`: how far on the way its switch closed, if it did.
  void go(std::size_t motor, double way, std::optional<double> to_switch) {
    if (to_switch) found_[motor] = is_at_[motor] + *to_switch;
    is_at_[motor] += way;
  }

  double is_at(std::size_t motor) const { return is_at_[motor]; }
  double found(std::size_t motor) const { return found_[motor]; }
  // How far the first motor is ahead of the second one.
  double apart() const { return is_at_[first] - is_at_[second]; }
  // By how much the second motor has to move to be as far from its switch as the first one, as far as that is known.
  double apart_from_switches() const { return (is_at_[first] - found_[first]) - (is_at_[second] - found_[second]); }
  // How far the motors have gone on after their switches closed, the farther of the two. `direction`: 1 or -1, of the
  // axis toward its switches.
  double farthest_beyond(double direction) const {
    return std::max({direction * (is_at_[first] - found_[first]), direction * (is_at_[second] - found_[second]), 0.0});
  }

 private:
  std::array<double, 2> is_at_{};
  std::array<double, 2> found_{};
};

}  // namespace passo
