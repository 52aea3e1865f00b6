// Segment: one geometric piece of the path in machine coordinates, with the programmed speed. Action: an event between
// segments while the machine is stopped. PathItem: a segment or an action, in program order.
#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "passo/geometry/curve.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

// Which overrides and holds are enabled for a part of the program (M48 to M53).
struct OverridePermissions {
  bool feed_override = true;
  bool spindle_override = true;
  bool adaptive_feed = false;  // the machine's own factor on the feed
  bool feed_hold = true;
  friend bool operator==(const OverridePermissions&, const OverridePermissions&) = default;
};

// How a feed follows the spindle: its speed (G95), or its angle from an index pulse on (G33).
enum class SpindleLock : std::uint8_t { none, speed, place };

// The distance from the tool to the position of its motor on one axis, which changes along a segment as a cubic: its
// values and its derivatives by s at both ends.
struct MotorLead {
  Axis axis = Axis::x;
  double start = 0;
  double start_slope = 0;
  double end = 0;
  double end_slope = 0;

  double at(double s, double length) const;
  double slope_at(double s, double length) const;
  // The lead on a part of the segment.
  MotorLead part(double from, double to, double length) const;
};

// The outputs that the path switches in motion, without a stop.
struct PathOutputs {
  double power = 0;  // of the laser, as a fraction of its full power
  // The digital outputs that are on, as bits of the board's outputs. Empty: they stay as they are.
  std::optional<std::uint8_t> switches = {};
  bool follows_speed = false;  // `power` is that at the programmed speed; it changes in proportion to the speed
  friend bool operator==(const PathOutputs&, const PathOutputs&) = default;
};

struct Segment {
  Curve curve;
  MmPerSecond speed{0};  // programmed, along s; infinite for a rapid, which only the axes' limits restrict
  bool rapid = false;
  PathMode mode = PathMode::continuous;  // at the junction to the next segment
  Mm tolerance{0};                       // maximum deviation from the path at the junction to the next segment
  Mm merge{0};                           // tolerance for merging lines; a part of the tolerance
  // Maximum deviation of A, B and C there, in degrees. 0: they share the tolerance, and a degree counts as a
  // millimetre.
  double turn_tolerance = 0;
  SurfaceScale surface{};  // the axes that turn and count for s. Its unit is 1 outside PathSmoother
  Point work_zero{};       // zero of the work coordinate system in machine coordinates
  OverridePermissions heeds{};
  SpindleLock lock = SpindleLock::none;
  Mm pitch{0};  // for a lock: the distance per revolution; `speed` follows from the commanded spindle speed
  // For tapping down: the point at which the spindle is reversed. The remainder of the segment leaves room for the
  // spindle to stop.
  Mm reverse_at{0};
  // On machines with backlash compensation: the axes whose backlash is taken up for motion in the negative direction.
  AxisSet downs{};
  // True: the segment takes up the backlash of an axis that reverses. The motor moves along the curve, while the tool
  // stays at the curve's end.
  bool takes_up_backlash = false;
  // Set: the axis takes up its backlash while the path continues. The motors move along the curve, and the path of the
  // tool is the curve minus this lead.
  std::optional<MotorLead> lead{};
  PathOutputs outputs{};  // during the segment
  OperationSource source{};

  Point tool_at(Mm s) const;
  // The path of the tool. If the segment takes up backlash at a stop: the curve of the motor.
  Curve tool_curve() const;
  // Removes the part before s.
  void drop_before(Mm s);
};

constexpr SpindleDirection reversed(SpindleDirection direction) {
  switch (direction) {
    case SpindleDirection::clockwise: return SpindleDirection::counterclockwise;
    case SpindleDirection::counterclockwise: return SpindleDirection::clockwise;
    case SpindleDirection::off: break;
  }
  return SpindleDirection::off;
}

// The commanded state of all outputs of the board.
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
    probe_begin,  // probe_begin, then the probe move, then probe_end
    probe_end,    // no stage reads further before the machine has stopped here
    await_index,
    await_speed,  // motion continues when the spindle has reached its speed; only for a spindle that reports it
    await_line,   // the next line has not arrived yet; no stage reads further before the machine has stopped here
    tap_turns,    // after tapping down; no stage reads further before the spindle reverses
  };
  Kind kind = Kind::dwell;
  Seconds dwell{0};
  OutputState outputs{};  // for every kind: the state after the action
  // The digital outputs that the path switches in motion, from this stop on. The laser is off in every stop.
  std::optional<std::uint8_t> switches = {};
  std::int32_t tool = 0;
  bool by_machine = false;   // a tool change that waits for nobody
  bool probe_toward = true;  // for a probe move: until the probe is triggered, otherwise until it is open
  std::uint8_t limit = 0;    // for homing: the bit of the limit switch that acts as the probe
  Point place{};             // for a probe move: its start or its end, in machine coordinates
  OverridePermissions heeds{};
  OperationSource source{};
};

using PathItem = std::variant<Segment, Action>;

}  // namespace passo
