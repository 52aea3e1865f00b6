#include "passo/trajectory/motion_text.hpp"

#include <fmt/format.h>

#include "passo/path/path_text.hpp"

namespace passo {

std::string to_text(const PlannedMove& move) {
  std::string text = to_text(move.segment);
  for (const Phase& phase : move) {
    text += fmt::format("  t {:.6f} s {:.6f} v {:.6f} a {:.6f} j {:.6f}\n", phase.duration.value(), phase.start.value(),
                        phase.velocity.value(), phase.acceleration.value(), phase.jerk.value());
  }
  return text;
}

std::string to_text(const MotionItem& item) {
  return std::visit([](const auto& what) { return to_text(what); }, item);
}

}  // namespace passo
