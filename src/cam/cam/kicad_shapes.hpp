// The shapes of a KiCad board: what its lines, arcs and pads are as paths and rings. Private to cam/.
//
// Y is up here: it changes its sign when it is read. Angles are degrees, counterclockwise.
#pragma once

#include <optional>
#include <vector>

#include "gerber_shapes.hpp"
#include "kicad_text.hpp"

namespace passo {

// Where a footprint or a pad is.
struct KicadFrame {
  DrawnPoint at = {};
  double degrees = 0;
  DrawnPoint placed(DrawnPoint local) const;
  DrawnRing placed(DrawnRing ring) const;
};

DrawnPoint kicad_point(KicadText& text, KicadItem list);
// (at X Y ANGLE), in a frame whose angle is not in ANGLE.
KicadFrame kicad_frame(KicadText& text, KicadItem item, const KicadFrame& around);
// The points of (pts ...), which may have arcs among them.
std::vector<PathPoint> kicad_points(KicadText& text, KicadItem pts);

struct KicadGraphic {
  DrawnPath path = {};  // with its width
  bool is_filled = false;
};
// A line, arc, circle, rectangle, polygon or curve: gr_line, fp_line, segment and so on. Empty: it is none of these.
// `fills`: a polygon that does not say whether it is filled, is.
std::optional<KicadGraphic> kicad_graphic(KicadText& text, KicadItem item, const KicadFrame& frame, bool fills);

// What a path of this width covers, ring by ring. The rings overlap.
std::vector<DrawnRing> kicad_stroke(const DrawnPath& path);
// How many points they have, about.
std::size_t kicad_stroke_points(const DrawnPath& path);

// A pad on one layer, about its hole, not yet turned.
struct KicadPad {
  std::vector<DrawnRing> rings = {};          // overlap
  std::vector<KicadGraphic> primitives = {};  // of a pad of its own shape
  Nanometres across = {};
  Nanometres up = {};
  bool is_round = false;  // a circle or an oval
};
// `layer`: of which the shape is asked.
KicadPad kicad_pad(KicadText& text, KicadItem pad, std::string_view layer);
// The list of a pad's or a via's padstack that says what it is on this layer. Empty: the layer has nothing of its own.
KicadItem kicad_layer_of_padstack(KicadItem item, std::string_view layer);

struct KicadDrill {
  Nanometres across = {};  // 0: no hole
  Nanometres up = {};
  DrawnPoint offset = {};  // of the pad's shape from the hole
};
KicadDrill kicad_drill(KicadText& text, KicadItem pad);

}  // namespace passo
