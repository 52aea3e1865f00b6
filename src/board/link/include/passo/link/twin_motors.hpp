// TwinMotors: pairs of motors that turn one axis together, as at a gantry.
//
// The host plans one motor for each axis. On the way to the board its steps go to both motors of a pair. On the way
// back the counts of the pair become those of one motor.
//
// For squaring, one motor of a pair turns alone. Which one follows from the limit switches that are watched: both, or
// none, of a pair's two switches: both motors turn. Only one: that switch's motor turns. For the host, the one motor
// then goes on from where it was. By how much that differs from the first motor's own count is the shift.
#pragma once

#include <cstdint>
#include <vector>

#include "passo/wire/board_segment.hpp"

namespace passo {

struct MotorPair {
  std::uint8_t first = 0;          // the motor that the host plans
  std::uint8_t second = 0;         // a motor above all that the host plans
  bool opposite = false;           // the second motor turns the other way
  std::uint8_t first_switch = 0;   // bits of limit switches
  std::uint8_t second_switch = 0;  // 0, for both: the pair is not squared
};

class TwinMotors {
 public:
  void set(const std::vector<MotorPair>& pairs);

  // Call at rest, when other limit switches are to be watched. What is sent from now on goes to the motors that they
  // say.
  void watch(std::uint8_t limits);
  // Call with the board's own counts at that rest. From now on counts are those of the motors that turn.
  void settle(const std::int32_t* counts);
  // Makes the first motors' counts the host's again, and changes the host's counts accordingly. True: some were not.
  bool forget_shifts(std::int32_t* counts);

  BoardSegment for_board(BoardSegment segment) const;
  // Turns the board's own counts into the host's.
  void for_host(std::int32_t* counts) const;

 private:
  enum class Turns : std::uint8_t { both, first, second };
  struct Twin {
    MotorPair pair;
    Turns turns = Turns::both;   // what is sent
    Turns counts = Turns::both;  // what is counted
    std::int32_t shift = 0;
  };
  static Turns turns_with(const MotorPair& pair, std::uint8_t limits);
  static std::int32_t count_of(const Twin& twin, const std::int32_t* counts);

  std::vector<Twin> twins_;
};

}  // namespace passo
