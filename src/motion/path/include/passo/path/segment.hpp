// Segment: one geometric piece of the path in machine coordinates, with the speed the program asks for. Action: what
// happens between segments, at rest. PathItem: a segment or an action, in program order.
#pragma once

#include <cstdint>
#include <variant>

#include "passo/geometry/curve.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

// Which changes in mid-run apply to a part of the program (M48 to M53).
struct Heeds {
  bool feed_override = true;
  bool spindle_override = true;
  bool adaptive_feed = false;  // the machine's own factor on feeds
  bool feed_hold = true;
  friend bool operator==(const Heeds&, const Heeds&) = default;
};

// How a feed follows the spindle: its speed alone (G95), or its place from an index pulse on (G33).
enum class SpindleLock : std::uint8_t { none, speed, place };

struct Segment {
  Curve curve;
  MmPerSecond speed{0};  // programmed, along s; for a rapid: no limit but the axes' own (infinity)
  bool rapid = false;
  PathMode mode = PathMode::continuous;  // at the junction to the next segment
  Mm tolerance{0};                       // how far the junction to the next segment may leave the path
  Mm merge{0};                           // how far lines may leave the path to be one line; a part of the tolerance
  Point work_zero{};                     // where the zero of the work frame lies in machine coordinates
  Heeds heeds{};
  SpindleLock lock = SpindleLock::none;
  Mm pitch{0};  // for a lock: the way for one turn; `speed` fits the commanded spindle speed
  // For a tap's way down: where the spindle is to be reversed. The rest of the segment is room for the spindle to come
  // to rest.
  Mm reverse_at{0};
  // On machines that compensate backlash: the axes whose backlash is taken up for motion down.
  AxisSet downs{};
  // True: the segment takes up the backlash of an axis that has turned back. The motor moves along the curve, and the
  // tool stands where the curve ends.
  bool takes_up_backlash = false;
  OperationSource source{};

  Point tool_at(Mm s) const { return takes_up_backlash ? curve.end() : curve.at(s); }
};

constexpr SpindleDirection reversed(SpindleDirection direction) {
  switch (direction) {
    case SpindleDirection::clockwise: return SpindleDirection::counterclockwise;
    case SpindleDirection::counterclockwise: return SpindleDirection::clockwise;
    case SpindleDirection::off: break;
  }
  return SpindleDirection::off;
}

// The state that all outputs of the board are to have from here on.
struct OutputState {
  SpindleDirection spindle = SpindleDirection::off;
  double revolutions_per_minute = 0;
  bool mist = false;
  bool flood = false;
  friend bool operator==(const OutputState&, const OutputState&) = default;
};

struct Action {
  enum class Kind : std::uint8_t {
    dwell,
    outputs,
    program_stop,
    optional_stop,
    tool_change,
    program_end,
    feed_hold,
    probe_begin,  // the probe move comes after this,
    probe_end,    // then this; no stage reads further before the machine rests here
    await_index,
    await_line,  // the next line of the program has not come yet; no stage reads further before the machine rests here
    tap_turns,   // after a tap's way down; no stage reads further before the spindle reverses
  };
  Kind kind = Kind::dwell;
  Seconds dwell{0};
  OutputState outputs{};  // for every kind: the state after the action
  std::int32_t tool = 0;
  bool probe_toward = true;  // for a probe move: until touched, else until free
  std::uint8_t limit = 0;    // for homing: the bit of the limit switch that takes the probe's place
  Point place{};             // for a probe move: its beginning or its end, in machine coordinates
  Heeds heeds{};
  OperationSource source{};
};

using PathItem = std::variant<Segment, Action>;

}  // namespace passo
