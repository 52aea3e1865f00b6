// ToolShape: the solid shape of a milling tool that rotates about Z: its cutter, and the part above the cutting edges.
//
// The cutter has no upper end; the holder is a wider cylinder above it.
#pragma once

#include <string>

#include "passo/geometry/cutter.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct ToolShape {
  Cutter cutter = {};
  // Of a cutter whose teeth are wider than its neck: feeds cut a groove under the surface, which a height field cannot
  // show, so in the stock only the neck cuts. 0: there is no neck.
  Mm neck_radius{0};
  Mm flute_length{0};   // height of the cutting edges above the tip; 0: unknown
  Mm holder_radius{0};  // 0: unknown
  Mm holder_from{0};    // the height above the tip where the holder starts
};

// Returns the reason why a tool is invalid as the expected value in words. Empty: it is valid.
inline std::string flaw_of(const ToolShape& tool) {
  if (std::string flaw = flaw_of(tool.cutter); !flaw.empty()) return flaw;
  if (tool.neck_radius < Mm(0) || (tool.neck_radius > Mm(0) && !(tool.neck_radius < tool.cutter.radius))) {
    return "a neck that is narrower than the teeth";
  }
  if (tool.holder_radius > Mm(0) && !(tool.holder_from > Mm(0))) return "a holder that begins above the tip";
  return "";
}

}  // namespace passo
