// Board items as text, one line each. Golden files use this form. Board items are the input of the wire protocol.
//
//   segment 200 events, 250.5 ticks, change 0.125, X +1 Y -0.40002 Z 0
//   outputs spindle clockwise 1000 rpm, flood
#pragma once

#include <string>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/wire/segment_parts.hpp"

namespace passo {
namespace text {

inline double in_steps(const BoardSegment& segment, unsigned motor) {
  const bool down = (segment.directions >> motor & 1U) != 0;
  const bool flip = (segment.flips >> motor & 1U) != 0;
  const double fraction = segment.increments[motor] / 65536.0;
  if (!flip) return fraction;
  return down ? fraction - 1 : 1;
}

// Of the axes that the motor turns.
inline std::string letters_of(const AxisRow& row) {
  std::string letters;
  for (const AxisRow::Share& share : row.shares()) letters += letter_of(share.axis);
  return letters;
}

inline std::string text_of(const BoardSegment& segment, const StepOptions& options) {
  std::string text =
      fmt::format("segment {}, {:.8g} ticks, ", counted(segment.events, "event"), segment.interval / 65536.0);
  text += is_root(segment.form)
              ? fmt::format("root of growth {:.8g} in {}", segment.change / 2147483648.0, part_length(segment.form))
              : fmt::format("change {:.8g}", segment.change / 65536.0);
  for (unsigned m = 0; m < options.kinematics.motor_count(); ++m) {
    const double increment = in_steps(segment, m);
    text += fmt::format("{} {} ", m == 0 ? "," : "", letters_of(options.kinematics.rows()[m].steps));
    text += increment == 0 ? "0" : fmt::format("{:+.6g}", increment);
  }
  return text + "\n";
}

inline std::string text_of(const Action& action) {
  switch (action.kind) {
    case Action::Kind::dwell: return fmt::format("dwelt {:.6g} s\n", action.dwell.value());
    case Action::Kind::program_stop: return "program stop\n";
    case Action::Kind::optional_stop: return "optional stop\n";
    case Action::Kind::tool_change: return fmt::format("tool change {}\n", action.tool);
    case Action::Kind::program_end: return "program end\n";
    case Action::Kind::feed_hold: return "feed hold\n";
    case Action::Kind::probe_begin: return action.probe_toward ? "probe until touched\n" : "probe until free\n";
    case Action::Kind::probe_end: return "probe move ends\n";
    case Action::Kind::await_speed: return "await the spindle's speed\n";
    case Action::Kind::await_index: return "await the spindle's index\n";
    case Action::Kind::await_line: return "await a line\n";
    case Action::Kind::tap_turns: return "tap and spindle turn round\n";
    case Action::Kind::outputs: break;
  }
  const OutputState& outputs = action.outputs;
  std::string text = "outputs spindle off";
  if (outputs.spindle != SpindleDirection::off) {
    text = fmt::format("outputs spindle {} {:.6g} rpm",
                       outputs.spindle == SpindleDirection::clockwise ? "clockwise" : "counterclockwise",
                       outputs.revolutions_per_minute);
  }
  if (outputs.mist) text += ", mist";
  if (outputs.flood) text += ", flood";
  return text + "\n";
}

}  // namespace text

inline std::string to_text(const BoardItem& item, const StepOptions& options) {
  const auto* segment = std::get_if<BoardSegment>(&item);
  return segment != nullptr ? text::text_of(*segment, options) : text::text_of(std::get<Action>(item));
}

}  // namespace passo
