// RunSummary: the results of a run, in numbers. SummaryBuilder fills in the motion. The program that drives the board
// adds the rest.
//
// to_text() is for people, to_json() for programs. New keys may be added to the JSON, but a key never changes.
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
  // The extents of the path, rapids included. Empty if nothing moved.
  std::optional<Range> machine_extents;
  std::optional<Range> work_extents;          // along the machine's axes too, but from the work's zero
  std::optional<Range> cutting_extents = {};  // machine coordinates, of the moves at feed alone
  MmPerSecond peak_speed{0};
  MmPerSecond2 peak_acceleration{0};
  // Counted by the board:
  Steps net_steps;
  Steps total_steps;
  double position = 0;  // machine coordinates at the end, from the counted steps
};

// How far the program goes in one work system, along the axes of the work, as programmed. Probe moves do not count,
// because they end where they touch. The ranges come in the summary's order of axes.
struct WorkSummary {
  std::uint8_t system = 1;  // 1 = G54 … 9 = G59.3
  std::vector<std::optional<Range>> extents = {};
  std::vector<std::optional<Range>> cutting = {};
};

// What is done with one tool.
struct ToolSummary {
  std::int32_t tool = 0;  // 0: no tool was called
  Seconds cutting_time{0};
  Seconds rapid_time{0};
  Mm cutting_distance{0};
  double cutting_turn = 0;              // degrees, of the moves that only turn A, B or C
  std::optional<Range> feed = {};       // mm/s, as programmed: the slowest and the fastest
  std::optional<Range> turn_feed = {};  // degrees/s, of the moves that only turn
  std::optional<double> depth = {};     // mm, the lowest Z at feed in work coordinates
};

// A text for the operator: (MSG,…) and (DEBUG,…), or (PRINT,…).
struct ProgramMessage {
  std::uint32_t line = 0;
  bool print = false;
  std::string text;
};

struct BoardSummary {
  Seconds end{0};            // when the last event was played
  std::uint64_t pulses = 0;  // steps of all motors
  std::uint64_t events = 0;
  std::uint64_t frames = 0;  // sent down the wire
  std::uint64_t bytes = 0;
  std::uint64_t busiest_second = 0;  // bytes; 0: the run took less than a second
  // Only for a board on a line. The queue of such a board always ends in a stop.
  int held_items = 0;                        // places in its list; 0: no line
  int rests = 0;                             // how often the board came to rest because no more motion had come in time
  bool stood_still = false;                  // amid motion, because its events came too late: the run failed
  std::uint32_t stood_still_line = 0;        // of the program; 0: not known
  std::optional<Seconds> without_line = {};  // the planned time; empty: not known, or the run was changed on the way
  Seconds cost_of_line() const { return end > *without_line ? end - *without_line : Seconds(0); }
};

// A hold in mid-run. Times are the board's.
struct HoldSummary {
  Seconds asked{0};
  Seconds reaction{0};                  // from `asked` until the machine slowed down: the committed motion
  Seconds rest{0};                      // when the machine stood still
  std::vector<double> place = {};       // of each axis, machine coordinates, from the counted steps
  std::optional<Seconds> resumed = {};  // empty: the run ended in the hold
};

// Results of probe moves. Places have a value for each axis, in machine coordinates.
struct ProbeSummary {
  std::uint64_t moves = 0;
  std::uint64_t touched = 0;
  bool last_touched = false;
  std::vector<double> last_contact = {};  // exact to the step; without contact, the end of the move
  std::vector<double> last_rest = {};     // the position of the stop after that
  Mm farthest_overrun{0};                 // the longest way from contact to rest
};

// A stop at the end of a stop ramp, because no more motion had come from the computer. Times are the board's.
struct TailSummary {
  Seconds rest{0};                 // when the machine stood still
  std::vector<double> place = {};  // as in HoldSummary
  Seconds resumed{0};
};

// The true motion of the motors, with simulated physics.
struct PhysicsSummary {
  std::uint32_t fault_line = 0;  // where an axis was too far from its commanded place; 0: nowhere
  struct Motor {
    Axis axis = Axis::x;
    std::int64_t lost_steps = 0;  // of the driver; positive: the axis stands too low
    double lost = 0;              // the same in millimetres or degrees
    double following_error = 0;   // largest distance of the axis from its commanded position
    double least_margin = 1;      // the share of the motor's pull-out torque that was left at the worst moment
    std::uint32_t line = 0;       // of the program, then; 0: none
    Seconds least_margin_at{0};
    double position = 0;  // machine coordinates at the end: the true place
  };
  struct Loss {
    Seconds time{0};
    Axis axis = Axis::x;
    std::int64_t steps = 0;
    std::uint32_t line = 0;
  };
  std::vector<Motor> motors;
  std::vector<Loss> losses;  // the first of them, in the order of time
  bool lost() const;
};

struct RunSummary {
  std::string program;
  std::string machine;

  // Computed from the phases of the motion. Everything at feed counts as cutting.
  Seconds cutting_time{0};
  Seconds rapid_time{0};
  Seconds dwell_time{0};
  Mm cutting_distance{0};
  Mm rapid_distance{0};
  // Degrees, of the moves that only turn A, B or C. They are no part of the distances.
  double cutting_turn = 0;
  double rapid_turn = 0;
  // Counted as the program writes them, before corners are rounded and lines are joined.
  std::uint64_t moves = 0;  // including rapids and arcs
  std::uint64_t rapids = 0;
  std::uint64_t arcs = 0;
  std::uint64_t dwells = 0;

  LengthUnits units = LengthUnits::mm;  // of the program's first move; to_text() uses them

  std::vector<AxisSummary> axes;
  std::vector<WorkSummary> work;         // the work systems in use, in their order
  std::vector<ToolSummary> tools;        // in the order of their first use
  std::vector<ProgramMessage> messages;  // the first most_messages
  static constexpr std::size_t most_messages = 1000;
  std::optional<BoardSummary> board;  // empty: nothing was sent to a board
  std::vector<HoldSummary> holds;
  std::optional<ProbeSummary> probes;  // empty: no probe move
  std::vector<TailSummary> tails;
  std::optional<PhysicsSummary> physics;  // empty: the motors did what they were told

  Seconds time() const { return cutting_time + rapid_time + dwell_time; }
};

std::string to_text(const RunSummary& summary, bool colour);
// Pretty-printed, keys always in the same order, with a line end.
std::string to_json(const RunSummary& summary);

}  // namespace passo
