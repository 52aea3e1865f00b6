// read_hpgl: reads HPGL plots into paths and circles, as a pen plotter would draw them.
//
// Supports moves (PU PD PA PR), arcs and circles (AA AR AT RT CI), Bézier curves (BZ BR), edges of rectangles, wedges
// and polygons (EA ER EW PM EP), packed polylines (PE), line types (LT), labels (LB with SI SR DI DR SL ES LO CP DT),
// ticks (XT YT TL), scaling (IP SC RO) and pens (SP). Fills (RA RR WG FP) are drawn as outlines. Ignored items are
// counted in Drawing::notes: clipping windows, other character sets, unknown commands.
//
// Each pen is a layer: "pen 1". A plotter unit is 0.025 mm. P1 and P2 default to those of the HP 7475A with A4 paper.
// Labels are drawn with the letters of built_in_stroke_font(), in character cells of equal width, as a plotter draws
// them. A path is closed if the pen returns to its start.
//
// Time and memory are proportional to the text and to its expansion, which is bounded by `most_drawn`. Invalid input
// produces diagnostics "hpgl.…" with line and column.
//
// Sources: Hewlett-Packard, HP 7475A Interfacing and Programming Manual (1983); The HP-GL/2 and HP RTL Reference Guide
// (1997).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct HpglOptions {
  double scale = 1;                      // scale factor of all lengths
  std::vector<std::string> layers = {};  // the pens to read, e.g. "pen 1"; empty: all
  Mm tolerance{0.005};                   // chord tolerance for Bézier curves, and for arcs that become ellipses by
                                         // scaling
};

// Reports errors in `diagnostics`; the drawing then contains what was read before the error.
Drawing read_hpgl(const std::string& name, std::string_view text, const HpglOptions& options, Diagnostics& diagnostics);

// Returns whether the text looks like an HPGL plot: it begins with a command that only plots have, or with a plotter
// escape sequence.
bool looks_like_hpgl(std::string_view text);

}  // namespace passo
