// The shapes of a KiCad board: converts its lines, arcs and pads to paths and rings. Private to cam/.
//
// Y points up: its sign is inverted on reading. Angles are degrees, counterclockwise.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gerber_shapes.hpp"
#include "kicad_text.hpp"

namespace passo {

// The position and angle of a footprint or a pad.
struct KicadFrame {
  DrawnPoint at = {};
  double degrees = 0;
  DrawnPoint placed(DrawnPoint local) const;
  DrawnRing placed(DrawnRing ring) const;
};

DrawnPoint kicad_point(KicadText& text, KicadItem list);
// Reads (at X Y ANGLE) relative to `around`. ANGLE is absolute in KiCad files: it includes the angle of `around`.
KicadFrame kicad_frame(KicadText& text, KicadItem item, const KicadFrame& around);
// Returns the points of (pts ...), which may include arcs.
std::vector<PathPoint> kicad_points(KicadText& text, KicadItem pts);

struct KicadGraphic {
  DrawnPath path = {};  // the path, including its width
  bool is_filled = false;
};
// Reads a line, arc, circle, rectangle, polygon or curve: gr_line, fp_line, segment and so on. Empty if it is none of
// these. `fills`: whether a polygon is filled if the file does not specify it.
std::optional<KicadGraphic> kicad_graphic(KicadText& text, KicadItem item, const KicadFrame& frame, bool fills);

// Returns the area that a path of this width covers, as overlapping rings.
std::vector<DrawnRing> kicad_stroke(const DrawnPath& path);
// Returns the same of all paths, each ring as a region of its own, to be united.
std::vector<Region> kicad_stroke_regions(std::span<const DrawnPath> paths);
// Returns the approximate number of points of these rings.
std::size_t kicad_stroke_points(const DrawnPath& path);

// A pad on one layer, relative to its hole, not yet rotated.
struct KicadPad {
  std::vector<DrawnRing> rings = {};          // the pad's outline; the rings may overlap
  std::vector<KicadGraphic> primitives = {};  // primitives of a custom shape
  Nanometres across = {};
  Nanometres up = {};
  bool is_round = false;  // whether it is a circle or an oval
};
// Returns the shape of the pad on `layer`.
KicadPad kicad_pad(KicadText& text, KicadItem pad, std::string_view layer);
// Returns the entry of a pad's or via's padstack for this layer. Empty if the layer has no entry of its own.
KicadItem kicad_layer_of_padstack(KicadItem item, std::string_view layer);

struct KicadDrill {
  Nanometres across = {};  // 0: no hole
  Nanometres up = {};
  DrawnPoint offset = {};  // offset of the pad's shape from the hole
};
KicadDrill kicad_drill(KicadText& text, KicadItem pad);

}  // namespace passo
