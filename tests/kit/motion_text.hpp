// Motion as text: one line for the segment of a move, and one line for each phase. Golden files use this form.
//
//   line 4: feed (X0.000000) to (X10.000000) length 10.000000 speed 20.000000 continuous 0.010000
//     t 0.040000 s 0.000000 v 0.000000 a 500.000000 j 0.000000
#pragma once

#include <string>

#include "path_text.hpp"
#include <fmt/format.h>

#include "passo/trajectory/phase.hpp"

namespace passo {

inline std::string to_text(const PlannedMove& move) {
  std::string text = to_text(move.segment);
  for (const Phase& phase : move) {
    text += fmt::format("  t {:.6f} s {:.6f} v {:.6f} a {:.6f} j {:.6f}\n", phase.duration.value(), phase.start.value(),
                        phase.velocity.value(), phase.acceleration.value(), phase.jerk.value());
  }
  return text;
}

inline std::string to_text(const MotionItem& item) {
  return std::visit([](const auto& what) { return to_text(what); }, item);
}

}  // namespace passo
