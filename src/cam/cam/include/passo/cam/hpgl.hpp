// read_hpgl: HPGL plots into paths and circles, as a pen plotter would draw them.
//
// Read are moves (PU PD PA PR), arcs and circles (AA AR AT RT CI), Bézier curves (BZ BR), edges of rectangles, wedges
// and polygons (EA ER EW PM EP), packed polylines (PE), line types (LT), labels (LB with SI SR DI DR SL ES LO CP DT),
// ticks (XT YT TL), scaling (IP SC RO) and pens (SP). Fills (RA RR WG FP) are drawn as their edges. Ignored items are
// counted in Drawing::notes: clipping windows, other alphabets, unknown commands.
//
// Each pen is a layer: "pen 1". A plotter unit is 0.025 mm. P1 and P2 are those of the HP 7475A with a sheet of A4,
// until the plot places them. Labels are written in the letters of built_in_stroke_font(), each in a cell of one width,
// as a plotter writes them. Where the pen comes back to its start, a path is closed.
//
// Time and memory are proportional to the text and to what it expands to, which is bounded by `most_drawn`. A hostile
// text gives diagnostics "hpgl.…" with a line and a column.
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
  double scale = 1;                      // of all lengths
  std::vector<std::string> layers = {};  // the pens to read, as "pen 1"; empty: all
  Mm tolerance{0.005};                   // of chords on Bézier curves, and on arcs that the scaling stretches
};

// Errors are in `diagnostics`; the drawing then holds what was read so far.
Drawing read_hpgl(const std::string& name, std::string_view text, const HpglOptions& options, Diagnostics& diagnostics);

// Whether the text begins like an HPGL plot: with a command that only plots have, or an escape for plotters.
bool looks_like_hpgl(std::string_view text);

}  // namespace passo
