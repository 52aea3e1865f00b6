// Switches: all that closes the inputs of a board: axes at the ends of their travel, a probe that touches, people.
//
// Several may close one input; it is open when all of them are.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/plant/motor_steps.hpp"
#include "passo/plant/touch_body.hpp"
#include "passo/plant/travel_switch.hpp"

namespace passo {

class Switches {
 public:
  void add(const TravelSwitch& added);
  // For the probe to touch.
  void add(const TouchBody& body) { bodies_.push_back(body); }
  // By hand: bits of BoardInput.
  void set(std::uint16_t which, bool closed);
  // The motors are there now. A position where a switch would close or open may not be left out.
  void follow(const MotorPositions& positions);

  // Bits of BoardInput: what is closed.
  std::uint16_t closed() const { return by_motors_ | by_hand_; }
  // How many steps of any motor it takes from there, where they were told to be last, until follow() may change
  // something; 1 or more, INT64_MAX where nothing hangs on the motors.
  std::int64_t steps_to_next_change(const MotorPositions& positions) const;

 private:
  struct Limit {
    TravelSwitch place;
    bool closed = false;
  };

  std::vector<Limit> limits_;
  std::vector<TouchBody> bodies_;
  std::uint16_t by_motors_ = 0;
  std::uint16_t by_hand_ = 0;
};

}  // namespace passo
