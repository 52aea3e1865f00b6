// The path as text, one item per line. Golden files use this form.
//
//   line 7: feed (X10.000000 Y2.000000) to (X20.000000 Y2.000000) length 10.000000 speed 20.000000 continuous 0.010000
//   line 8: dwell 0.500000; spindle clockwise 1000.000 mist on flood off
//
// An axis is shown if it moves or is not at 0. A rapid has no speed. Overrides that are disabled for the item (M48 to
// M53) are named at the end.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "passo/path/segment.hpp"

namespace passo {
namespace text {

// Six digits, and no minus before a zero.
inline std::string number(double value) {
  std::string text = fmt::format("{:.6f}", value);
  return text == "-0.000000" ? text.substr(1) : text;
}

// The axes that move, and those that are not at zero.
inline std::string place(const Point& point, const Curve& curve) {
  std::string text;
  for (const Axis axis : all_axes) {
    if (!curve.moves(axis) && point[axis] == 0) continue;
    text += fmt::format("{}{}{}", text.empty() ? "" : " ", letter_of(axis), number(point[axis]));
  }
  return "(" + text + ")";
}

inline const char* name_of(PathMode mode) {
  switch (mode) {
    case PathMode::exact_path: return "exact path";
    case PathMode::exact_stop: return "exact stop";
    case PathMode::continuous: break;
  }
  return "continuous";
}

inline const char* name_of(SpindleDirection direction) {
  switch (direction) {
    case SpindleDirection::clockwise: return "clockwise";
    case SpindleDirection::counterclockwise: return "counterclockwise";
    case SpindleDirection::off: break;
  }
  return "off";
}

inline std::string name_of(const Action& action) {
  switch (action.kind) {
    case Action::Kind::dwell: return "dwell " + number(action.dwell.value());
    case Action::Kind::outputs: return "outputs";
    case Action::Kind::program_stop: return "program stop";
    case Action::Kind::optional_stop: return "optional stop";
    case Action::Kind::tool_change: return fmt::format("tool change {}", action.tool);
    case Action::Kind::feed_hold: return "feed hold";
    case Action::Kind::probe_begin: return action.probe_toward ? "probe until touched" : "probe until free";
    case Action::Kind::probe_end: return "probe move ends";
    case Action::Kind::await_speed: return "await the spindle's speed";
    case Action::Kind::await_index: return "await the spindle's index";
    case Action::Kind::await_line: return "await a line";
    case Action::Kind::tap_turns: return "tap and spindle turn round";
    case Action::Kind::program_end: break;
  }
  return "program end";
}

// The settings that differ from those at the start of a program.
inline std::string permissions(const OverridePermissions& heeds) {
  std::string text;
  if (!heeds.feed_override) text += " no feed override";
  if (!heeds.spindle_override) text += " no spindle override";
  if (heeds.adaptive_feed) text += " adaptive feed";
  if (!heeds.feed_hold) text += " no feed hold";
  return text;
}

}  // namespace text

inline std::string to_text(const Segment& segment) {
  const Curve& curve = segment.curve;
  std::string line = fmt::format("line {}: {} {} to {}", segment.source.line, segment.rapid ? "rapid" : "feed",
                                 text::place(curve.start(), curve), text::place(curve.end(), curve));
  if (curve.shape() == Curve::Shape::arc) {
    const Curve::ArcData& arc = curve.arc_data();
    line += fmt::format(" arc {}{} centre {} {} sweep {}", letter_of(arc.first), letter_of(arc.second),
                        text::number(arc.first_center), text::number(arc.second_center),
                        text::number(arc.sweep * 180 / std::numbers::pi));
  }
  if (curve.shape() == Curve::Shape::cubic) line += " cubic";
  line += " length " + text::number(curve.length().value());
  if (std::isfinite(segment.speed.value())) line += " speed " + text::number(segment.speed.value());
  line += fmt::format(" {}", text::name_of(segment.mode));
  if (segment.mode == PathMode::continuous) line += " " + text::number(segment.tolerance.value());
  if (segment.lock == SpindleLock::place) line += " in step, " + text::number(segment.pitch.value()) + " a turn";
  if (segment.lock == SpindleLock::speed)
    line += " with the spindle, " + text::number(segment.pitch.value()) + " a turn";
  return line + text::permissions(segment.heeds) + "\n";
}

inline std::string to_text(const Action& action) {
  const OutputState& outputs = action.outputs;
  return fmt::format("line {}: {}; spindle {} {:.3f} mist {} flood {}\n", action.source.line, text::name_of(action),
                     text::name_of(outputs.spindle), outputs.revolutions_per_minute, outputs.mist ? "on" : "off",
                     outputs.flood ? "on" : "off");
}

inline std::string to_text(const PathItem& item) {
  return std::visit([](const auto& what) { return to_text(what); }, item);
}

}  // namespace passo
