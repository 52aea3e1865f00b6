// read_svg: reads SVG drawings into paths and circles.
//
// Supports path, rect, circle, ellipse, line, polyline and polygon, with transforms, nested svg, groups, symbols and
// uses. Circles are holes, as in DXF drawings; circular arcs, including those of paths and rounded corners, stay arcs
// unless a transform distorts them. Bézier curves and ellipses become chords within the tolerance. Y points up: the
// lower left corner of the page is X0 Y0. Only the geometry counts: fill and stroke width are ignored. Inkscape layers
// are the layers of the drawing. The colour of a shape is that of its stroke or, without a stroke, of its fill.
//
// Style sheets are applied where they hide, place or size shapes (svg_style.hpp). Clip paths are applied, and nested
// views clip their contents: of closed lines the clipped area is drawn, of open lines the pieces inside. Texts,
// pictures, hidden elements, masks, markers and unsupported clip paths and style rules are omitted and counted in
// Drawing::notes.
//
// `width` and `viewBox` determine the user unit; without them it is a pixel, 1/96 inch, or 1/90 inch if the file
// names a version of Inkscape before 0.92. Time and memory are
// proportional to the text and to the expansion of its uses, which is bounded by `most_drawn`. Invalid input produces
// diagnostics "svg.…" with a line number.
//
// Sources: Scalable Vector Graphics (SVG) 2, W3C, 2018; CSS Masking Module Level 1, W3C, 2021.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct SvgOptions {
  double scale = 1;                      // scale factor of all lengths
  std::vector<std::string> layers = {};  // the layers to read; empty: all
  std::vector<std::string> colors = {};  // colours of the shapes to read, e.g. "red", "#f00"; empty: all
  std::vector<std::string> names = {};   // ids or Inkscape labels of the shapes or groups to read; empty: all
  Mm tolerance{0.005};                   // chord tolerance for curves
  // Drawing::layers then has an entry for each combination of layer, colour and names of shapes: the layer's name, the
  // colour as "#rrggbb", and the ids and labels of the shape and its groups, each on a line.
  bool tells_shapes = false;
};

// Reports errors in `diagnostics`; the drawing then contains what was read before the error.
Drawing read_svg(const std::string& name, std::string_view text, const SvgOptions& options, Diagnostics& diagnostics);

// Returns whether the beginning of the text looks like an SVG drawing.
bool looks_like_svg(std::string_view text);

}  // namespace passo
