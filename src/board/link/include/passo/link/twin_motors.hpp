// TwinMotors: pairs of motors that drive one axis together, e.g. of a gantry.
//
// The host plans one motor for each axis. Its steps are sent to both motors of a pair. The counts of the pair that the
// board reports are converted to those of one motor.
//
// For squaring, one motor of a pair turns alone, depending on the watched limit switches. If both or neither of the
// pair's two switches are watched, both motors turn. If only one is watched, that switch's motor turns. For the host,
// the planned motor continues from its last count. The difference from the first motor's own count is the shift.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/wire/board_segment.hpp"

namespace passo {

struct MotorPair {
  std::uint8_t first = 0;          // the motor that the host plans
  std::uint8_t second = 0;         // a motor number above all those that the host plans
  bool opposite = false;           // the second motor turns in the opposite direction
  std::uint8_t first_switch = 0;   // bits of limit switches
  std::uint8_t second_switch = 0;  // 0 for both switches: the pair is not squared
};

class TwinMotors {
 public:
  void set(const std::vector<MotorPair>& pairs);

  // Call while stopped, before other limit switches are watched. From then on, steps go to the motors selected by these
  // switches.
  void watch(std::uint8_t limits);
  // Call with the board's own counts during the same stop. From then on, counts are those of the motors that turn.
  void settle(const std::int32_t* counts);
  // Restores the first motors' own counts, and changes the host's counts accordingly. Returns true if some differed.
  bool forget_shifts(std::int32_t* counts);

  BoardSegment for_board(BoardSegment segment) const;
  // Converts the board's own counts to the host's.
  void for_host(std::int32_t* counts) const;

 private:
  enum class Turns : std::uint8_t { both, first, second };
  struct Twin {
    MotorPair pair;
    Turns turns = Turns::both;   // motors to which steps are sent
    Turns counts = Turns::both;  // motors whose steps are counted
    std::int32_t shift = 0;
  };
  static Turns turns_with(const MotorPair& pair, std::uint8_t limits);
  static std::int32_t count_of(const Twin& twin, const std::int32_t* counts);

  std::vector<Twin> twins_;
};

}  // namespace passo
