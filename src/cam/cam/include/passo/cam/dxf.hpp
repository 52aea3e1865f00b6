// read_dxf: DXF drawings, from R12 to 2018, as text or binary, into holes and paths.
//
// CIRCLE and POINT are holes, a point without a diameter. LINE, ARC, LWPOLYLINE and POLYLINE with bulges are paths of
// lines and arcs; ELLIPSE and SPLINE become chords within the tolerance. A closed path that is a circle (DONUT) is a
// hole. INSERTs of blocks are expanded: scaled, turned, mirrored, in rows and columns, one in another. What the drawing
// has besides (texts, hatches, dimensions), what is on layers that are off, and paper space are left out, and counted
// in Drawing::notes.
//
// Numbers are in the unit of $INSUNITS, unless the options say otherwise; without either they are millimetres, and a
// note says so. Another note says where a drawing of holes seems ten times too large or too small.
//
// Time and memory are proportional to the text and to what it expands to, which is bounded by `most_drawn`. A hostile
// text gives diagnostics "dxf.…" with a line, in a binary file with an offset.
//
// Source: Autodesk, DXF Reference (R12 to 2018).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct DxfOptions {
  std::optional<Mm> unit = {};           // what a 1 of the file is; it wins over $INSUNITS
  std::vector<std::string> layers = {};  // the layers to read; empty: all that are on
  Mm tolerance{0.005};                   // of chords on ellipses and splines
};

// Errors are in `diagnostics`; the drawing then holds what was read so far.
Drawing read_dxf(const std::string& name, std::string_view text, const DxfOptions& options, Diagnostics& diagnostics);

// Whether the text begins like a DXF drawing.
bool looks_like_dxf(std::string_view text);

}  // namespace passo
