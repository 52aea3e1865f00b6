// RunSummary: what a run came to, in numbers. Filled by SummaryBuilder (the motion) and by whoever drives the board.
//
// Two renderings: text for a person, JSON for a program. Keys of the JSON are a promise: they are added to, not
// changed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

// Of one axis, in millimetres or degrees.
struct Range {
  double low = 0;
  double high = 0;
};

struct AxisSummary {
  Axis axis = Axis::x;
  // Where the path goes, rapids included; none where nothing moved.
  std::optional<Range> machine_extents;
  std::optional<Range> work_extents;
  MmPerSecond peak_speed{0};
  MmPerSecond2 peak_acceleration{0};
  // Of the board:
  Steps net_steps;
  Steps total_steps;
  double position = 0;  // machine coordinates at the end, from the steps that were counted
};

struct BoardSummary {
  Seconds end{0};            // when the last event was played
  std::uint64_t pulses = 0;  // steps of all motors
  std::uint64_t events = 0;
  std::uint64_t frames = 0;  // sent down the wire
  std::uint64_t bytes = 0;
  std::uint64_t busiest_second = 0;  // bytes; 0: it did not take one
  // Over a line, where what it holds always ends at rest.
  int held_items = 0;  // places in its list; 0: no line
  int rests = 0;       // because nothing more had come in time
};

// A hold in mid-run. Times of the board.
struct HoldSummary {
  Seconds asked{0};
  Seconds reaction{0};                  // from then on until the machine got slower: what was committed
  Seconds rest{0};                      // when it stood
  std::vector<double> place = {};       // of each axis, machine coordinates, from the steps that were counted
  std::optional<Seconds> resumed = {};  // none: the run ended there
};

// What probe moves found. Places on each axis, machine coordinates.
struct ProbeSummary {
  std::uint64_t moves = 0;
  std::uint64_t touched = 0;
  bool last_touched = false;
  std::vector<double> last_contact = {};  // to the step; without contact, the end of the move
  std::vector<double> last_rest = {};     // where the machine came to rest after it
  Mm farthest_overrun{0};                 // of all: from contact to rest
};

// A rest at the end of a braking tail, because nothing more had come from the computer. Times of the board.
struct TailSummary {
  Seconds rest{0};                 // when it stood
  std::vector<double> place = {};  // as of a hold
  Seconds resumed{0};
};

struct RunSummary {
  std::string program;
  std::string machine;

  // By the phases of the motion; cutting is everything at feed.
  Seconds cutting_time{0};
  Seconds rapid_time{0};
  Seconds dwell_time{0};
  Mm cutting_distance{0};
  Mm rapid_distance{0};
  std::uint64_t moves = 0;  // rapids and arcs included
  std::uint64_t rapids = 0;
  std::uint64_t arcs = 0;
  std::uint64_t dwells = 0;

  std::vector<AxisSummary> axes;
  std::optional<BoardSummary> board;  // none: nothing was sent to a board
  std::vector<HoldSummary> holds;
  std::optional<ProbeSummary> probes;  // none: no probe move
  std::vector<TailSummary> tails;

  Seconds time() const { return cutting_time + rapid_time + dwell_time; }
};

std::string to_text(const RunSummary& summary, bool colour);
// Pretty-printed, keys always in the same order, with a line end.
std::string to_json(const RunSummary& summary);

}  // namespace passo
