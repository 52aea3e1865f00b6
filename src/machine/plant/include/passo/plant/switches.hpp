// Switches: everything that closes the inputs of a board: axes at the ends of their travel, a probe contact, the
// operator.
//
// Several switches may close one input. The input is open when all of its switches are open.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "passo/plant/motor_steps.hpp"
#include "passo/plant/touch_body.hpp"
#include "passo/plant/touch_surface.hpp"
#include "passo/plant/travel_switch.hpp"

namespace passo {

class Switches {
 public:
  void add(const TravelSwitch& added);
  // Adds an object that the probe can touch.
  void add(const TouchBody& body) { bodies_.push_back(body); }
  void add(TouchSurface surface) { surfaces_.push_back(std::move(surface)); }
  // Closes or opens switches by hand. `which`: bits of BoardInput.
  void set(std::uint16_t which, bool closed);
  // Sets the motor positions at `time`. The caller must not skip a position where a switch would close or open. A board
  // sees contact bounce only at the times at which it reads.
  void follow(Seconds time, const MotorPositions& positions);

  // The closed inputs at the time last given to follow(), as bits of BoardInput.
  std::uint16_t closed() const { return by_motors_ | by_hand_; }
  // Whether a contact is bouncing: the closed inputs change with time.
  bool bounces() const { return bounces_; }
  // Returns how many steps any motor may move from `positions`, the positions last passed to follow(), until follow()
  // may change something. 1 or more, and 1 during a bounce; INT64_MAX if nothing depends on the motors.
  std::int64_t steps_to_next_change(const MotorPositions& positions) const;

 private:
  struct Limit {
    TravelSwitch place;
    bool closed = false;
    Seconds changed{-std::numeric_limits<double>::infinity()};
  };

  std::vector<Limit> limits_;
  std::vector<TouchBody> bodies_;
  std::vector<TouchSurface> surfaces_;
  std::uint16_t by_motors_ = 0;
  std::uint16_t by_hand_ = 0;
  bool bounces_ = false;
};

}  // namespace passo
