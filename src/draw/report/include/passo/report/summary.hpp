// RunSummary: the results of a run, in numbers. SummaryBuilder fills in the motion; the program that drives the board
// adds the rest.
//
// to_text() is for people, to_json() for programs. New keys may be added to the JSON, but existing keys never change.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/saved_offsets.hpp"
#include "passo/units/units.hpp"

namespace passo {

// A range of one axis, in millimetres or degrees.
struct Range {
  double low = 0;
  double high = 0;
};

struct AxisSummary {
  Axis axis = Axis::x;
  // The extents of the path, including rapids. Empty if nothing moved.
  std::optional<Range> machine_extents;
  std::optional<Range> work_extents;          // along the machine's axes, too, but relative to the work zero
  std::optional<Range> cutting_extents = {};  // machine coordinates, feed moves only
  MmPerSecond peak_speed{0};
  MmPerSecond2 peak_acceleration{0};
  // Counted by the board, in steps:
  Steps net_steps;
  Steps total_steps;
  double position = 0;  // machine coordinates at the end, from the counted steps
};

// The range of the program in one work coordinate system, along its axes, as programmed. Probe moves are not included,
// because they end at the contact. The ranges are in the summary's order of axes.
struct WorkSummary {
  std::uint8_t system = 1;  // 1 = G54 … 9 = G59.3
  std::vector<std::optional<Range>> extents = {};
  std::vector<std::optional<Range>> cutting = {};
};

// The use of one tool.
struct ToolSummary {
  std::int32_t tool = 0;  // 0: no tool was called
  Seconds cutting_time{0};
  Seconds rapid_time{0};
  Mm cutting_distance{0};
  double cutting_turn = 0;              // degrees, of the moves of A, B or C only
  std::optional<Range> feed = {};       // mm/s, as programmed: minimum and maximum
  std::optional<Range> turn_feed = {};  // degrees/s, for the rotary moves
  std::optional<double> depth = {};     // mm, minimum Z of the feed moves in work coordinates
};

// A message to the operator: (MSG,…) and (DEBUG,…), or (PRINT,…).
struct ProgramMessage {
  std::uint32_t line = 0;
  bool print = false;
  std::string text;
};

// The steps of a machine behind a parallel port and the PIC of the first control board. Net steps are steps up minus
// steps down of the axis.
struct PortSummary {
  struct Motor {
    Axis axis = Axis::x;
    std::int64_t commanded = 0;  // steps up and down
    std::int64_t sampled = 0;    // by the PIC
    std::int64_t commanded_net = 0;
    std::int64_t sampled_net = 0;
    double true_net = 0;  // of the rotor
    double true_end = 0;  // machine coordinates
  };
  struct LostPulse {
    Seconds time{0};
    Axis axis = Axis::x;
    std::uint32_t line = 0;  // program line; 0: unknown
  };
  std::vector<Motor> motors;
  std::vector<LostPulse> lost;  // the first ones, in order of time
  std::int64_t register_writes = 0;
  int relay_closings = 0;
  bool relay_is_closed = false;  // at the end
  std::int64_t lost_pulses() const;
  // Whether the rotors ended within half a step of the commanded positions.
  bool is_true() const;
};

struct BoardSummary {
  Seconds end{0};            // time of the last event
  std::uint64_t pulses = 0;  // number of steps of all motors
  std::uint64_t events = 0;
  std::uint64_t frames = 0;  // number of frames sent to the board
  std::uint64_t bytes = 0;
  std::uint64_t busiest_second = 0;  // maximum number of bytes in a second; 0: the run took less than a second
  // For a board on a serial link only. The queue of such a board always ends in a stop.
  int held_items = 0;                        // queue capacity; 0: no link
  int rests = 0;                             // number of stops because no further motion had arrived in time
  bool stood_still = false;                  // the motors stopped during motion because events were late: the run
                                             // failed
  std::uint32_t stood_still_line = 0;        // program line; 0: unknown
  std::optional<Seconds> without_line = {};  // planned duration; empty: unknown, or the run was changed while running
  std::optional<PortSummary> port = {};      // empty: the run did not go through a parallel port
  Seconds cost_of_line() const { return end > *without_line ? end - *without_line : Seconds(0); }
};

// A feed hold during the run. Times are the board's.
struct HoldSummary {
  Seconds asked{0};
  Seconds reaction{0};                  // from `asked` until the machine slowed down: the duration of the committed
                                        // motion
  Seconds rest{0};                      // time at which the machine had stopped
  std::vector<double> place = {};       // position of each axis, machine coordinates, from the counted steps
  std::optional<Seconds> resumed = {};  // empty: the run ended with the hold
};

// The results of probe moves. Positions have a value for each axis, in machine coordinates.
struct ProbeSummary {
  std::uint64_t moves = 0;
  std::uint64_t touched = 0;
  bool last_touched = false;
  std::vector<double> last_contact = {};  // exact to the step; without contact, the end of the move
  std::vector<double> last_rest = {};     // position of the stop after the contact
  Mm farthest_overrun{0};                 // maximum distance from contact to stop
};

// A stop at the end of a stop ramp, because no more motion had arrived from the host. Times are the board's.
struct StopRampSummary {
  Seconds rest{0};                 // time at which the machine had stopped
  std::vector<double> place = {};  // position, as in HoldSummary
  Seconds resumed{0};
};

// The actual motion of the motors, from the simulated physics.
struct PhysicsSummary {
  std::uint32_t fault_line = 0;  // where the following error of an axis exceeded its limit; 0: nowhere
  struct Motor {
    Axis axis = Axis::x;
    std::int64_t lost_steps = 0;  // driver steps; positive: the axis position is too low
    double lost = 0;              // lost steps in millimetres or degrees
    double following_error = 0;   // maximum distance of the axis from its commanded position
    double least_margin = 1;      // minimum fraction of the motor's pull-out torque that remained
    std::uint32_t line = 0;       // program line at that moment; 0: none
    Seconds least_margin_at{0};
    double position = 0;  // machine coordinates at the end: the actual position
  };
  struct Loss {
    Seconds time{0};
    Axis axis = Axis::x;
    std::int64_t steps = 0;
    std::uint32_t line = 0;
  };
  std::vector<Motor> motors;
  std::vector<Loss> losses;  // the first ones, in order of time
  bool lost() const;
};

struct RunSummary {
  std::string program;
  std::string machine;

  // Computed from the phases of the motion. All feed moves count as cutting.
  Seconds cutting_time{0};
  Seconds rapid_time{0};
  Seconds dwell_time{0};
  Mm cutting_distance{0};
  Mm rapid_distance{0};
  // Degrees, of the moves of A, B or C only; not included in the distances.
  double cutting_turn = 0;
  double rapid_turn = 0;
  // Counted as programmed, before corners are rounded and lines are joined.
  std::uint64_t moves = 0;  // number of moves, including rapids and arcs
  std::uint64_t rapids = 0;
  std::uint64_t arcs = 0;
  std::uint64_t dwells = 0;

  LengthUnits units = LengthUnits::mm;  // units of the program's first move, used by to_text()

  std::vector<AxisSummary> axes;
  std::vector<WorkSummary> work;         // the work coordinate systems in use, in ascending order
  std::vector<ToolSummary> tools;        // in order of first use
  std::vector<ProgramMessage> messages;  // the first most_messages
  static constexpr std::size_t most_messages = 1000;
  std::optional<BoardSummary> board;  // empty: nothing was sent to a board
  std::vector<HoldSummary> holds;
  std::optional<ProbeSummary> probes;  // empty: no probe move
  std::vector<StopRampSummary> tails;
  std::optional<PhysicsSummary> physics;  // empty: no physics; the motors followed their steps exactly

  Seconds time() const { return cutting_time + rapid_time + dwell_time; }
};

std::string to_text(const RunSummary& summary, bool colour);
// Pretty-printed, with the keys always in the same order, and a final newline.
std::string to_json(const RunSummary& summary);

}  // namespace passo
