// ToolShape: a milling tool as a body that turns about Z: its cutter, and what is above the cutting edges.
//
// Above its radius the cutter goes up without end; the holder is a wider cylinder above it.
#pragma once

#include <string>

#include "passo/geometry/cutter.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct ToolShape {
  Cutter cutter = {};
  Mm flute_length{0};   // how high above the tip it cuts; 0: not known
  Mm holder_radius{0};  // 0: not known
  Mm holder_from{0};    // the height above the tip where the holder begins
};

// Why a tool is invalid: the expected value in words. Empty: there is.
inline std::string flaw_of(const ToolShape& tool) {
  if (std::string flaw = flaw_of(tool.cutter); !flaw.empty()) return flaw;
  if (tool.holder_radius > Mm(0) && !(tool.holder_from > Mm(0))) return "a holder that begins above the tip";
  return "";
}

}  // namespace passo
