// Proposals: what would make a program run on this machine that does not run on it as it is.
//
// Each proposal is verified before it is made: the program was checked once more, by the same code, with that change.
//
//   beyond the travel     another work zero, or which axis is too short, and by how much
//   tools are missing     the numbers for the tool table
//   a thread is too fast  a slower spindle
//   S above the limit     the spindle's highest speed, with feeds that leave each tooth its chip
//   steps are lost        slower feeds or rapids, as an override
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/judge/judgement.hpp"

namespace passo {

namespace proposal {

// Other work zeros, with which the program fits the travel.
struct WorkZeros {
  struct Zero {
    int system = 1;  // 1: G54
    Axis axis = Axis::x;
    double zero = 0;  // machine coordinates, mm or degrees
  };
  std::vector<Zero> zeros;  // by their systems, each in the order of the machine's axes
};
// No zero helps: the program needs more of this axis than its travel has.
struct AxisTooShort {
  Axis axis = Axis::x;
  double needed = 0;  // mm or degrees
  double travel = 0;
};
// With these in the tool table, with a length and a diameter of 0, the program has no error.
struct Tools {
  std::vector<std::int32_t> numbers;
};
// With this spindle speed at most, the axes can follow the spindle.
struct SpindleForThread {
  double revolutions_per_minute = 0;
};
// With the spindle's highest speed and these feeds no tooth cuts more than the program asks for.
struct SpindleAndFeed {
  double revolutions_per_minute = 0;
  int feed_percent = 100;
  Seconds motion{0};  // then: the time in motion
};
// With these overrides the motors keep their steps. 100: no override is needed.
struct SlowerMotion {
  int feed_percent = 100;
  int rapid_percent = 100;
};

}  // namespace proposal

using Proposal = std::variant<proposal::WorkZeros, proposal::AxisTooShort, proposal::Tools, proposal::SpindleForThread,
                              proposal::SpindleAndFeed, proposal::SlowerMotion>;

struct Unfit {
  const ProgramReader& program;
  const MachineDescription& machine;
  const InterpreterOptions& options;
};

// `judged`: what judge() has found of a good program. Null: the motors are not asked. Up to six times the time of a
// check.
std::vector<Proposal> proposals_of(const Unfit& unfit, const ProgramCheck& check, const Diagnostics& findings,
                                   const Judgement* judged);

}  // namespace passo
