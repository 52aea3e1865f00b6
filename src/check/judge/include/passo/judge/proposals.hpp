// Proposals: changes that would let a program run on a machine on which it cannot run as it is.
//
// Each proposal has been verified: the program was checked again, by the same code, with that change.
//
//   beyond the travel     another work zero, or which axis is too short, and by how much
//   tools are missing     the numbers for the tool table
//   a thread is too fast  a slower spindle
//   S above the limit     the spindle's maximum speed, with feeds that keep the chip load
//   steps are lost        slower feeds or rapids, as an override
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/judge/judgement.hpp"

namespace passo {

namespace proposal {

// Other work zeros with which the program fits the travel.
struct WorkZeros {
  struct Zero {
    int system = 1;  // 1: G54
    Axis axis = Axis::x;
    double zero = 0;  // position of the zero in machine coordinates, mm or degrees
  };
  std::vector<Zero> zeros;  // sorted by work coordinate system, each in the order of the machine's axes
};
// No work zero helps: the program needs more of this axis than its travel.
struct AxisTooShort {
  Axis axis = Axis::x;
  double needed = 0;  // travel needed, mm or degrees
  double travel = 0;
};
// With these tools in the tool table, with a length and a diameter of 0, the program has no error.
struct Tools {
  std::vector<std::int32_t> numbers;
};
// With this maximum spindle speed the axes can follow the spindle.
struct SpindleForThread {
  double revolutions_per_minute = 0;
};
// With the spindle's maximum speed and these feeds, the chip load does not exceed the programmed one.
struct SpindleAndFeed {
  double revolutions_per_minute = 0;
  int feed_percent = 100;
  Seconds motion{0};  // time in motion with these values
};
// With these overrides the motors lose no steps. 100: no override is needed.
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

// `judged`: the result of judge() for an error-free program. Null: the motors are not analysed. Takes up to six times
// as long as a check.
std::vector<Proposal> proposals_of(const Unfit& unfit, const ProgramCheck& check, const Diagnostics& findings,
                                   const Judgement* judged);

}  // namespace passo
