// read_svg: SVG drawings into paths and circles.
//
// path, rect, circle, ellipse, line, polyline and polygon are read, with transforms, nested svg, groups, symbols and
// uses. Circles are holes, as in DXF drawings; their arcs, those of paths and of rounded corners stay arcs, unless a
// transform stretches them. Bézier curves and ellipses become chords within the tolerance. Y goes up: the lower left
// corner of the page is X0 Y0. Only the lines count: what is filled and how wide a stroke is does not matter. Groups
// that Inkscape calls layers are the drawing's layers.
//
// Texts, pictures and foreign objects are left out, and counted in Drawing::notes; so are elements that are not
// displayed (`display: none`), clips, masks, markers and patterns. Style sheets are not applied.
//
// A 1 of the page is what `width` and `viewBox` make of it; without them a pixel, of which an inch has 96. Time and
// memory are proportional to the text and to what its uses expand to, which is bounded by `most_drawn`. A hostile text
// gives diagnostics "svg.…" with a line.
//
// Source: Scalable Vector Graphics (SVG) 2, W3C, 2018.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct SvgOptions {
  double scale = 1;                      // of all lengths
  std::vector<std::string> layers = {};  // the layers to read; empty: all
  Mm tolerance{0.005};                   // of chords on curves
};

// Errors are in `diagnostics`; the drawing then holds what was read so far.
Drawing read_svg(const std::string& name, std::string_view text, const SvgOptions& options, Diagnostics& diagnostics);

// Whether the text begins like an SVG drawing.
bool looks_like_svg(std::string_view text);

}  // namespace passo
