// read_dxf: reads DXF drawings, from R12 to 2018, as text or binary, into holes and paths.
//
// CIRCLE and POINT are holes; a point has no diameter. LINE, ARC, LWPOLYLINE and POLYLINE with bulges are paths of
// lines and arcs; ELLIPSE and SPLINE become chords within the tolerance, including splines that have only fit points. A
// closed circular path (DONUT) is a hole. Of a polyline with a width, only the centre line is read. Circles and arcs
// that a block stretches in one direction become ellipses. Entities in a plane of their own are projected onto the XY
// plane. Block references (INSERT) are expanded: scaled, rotated, mirrored, in rows and columns, and nested. Other
// entities (texts, hatches, dimensions), layers that are off, and paper space are omitted and counted in
// Drawing::notes.
//
// Numbers are in the unit of $INSUNITS, unless the options specify a unit; without both they are millimetres, with a
// note.
//
// Time and memory are proportional to the text and to its expansion, which is bounded by `most_drawn`. Invalid input
// produces diagnostics "dxf.…" with a line number, in a binary file with an offset.
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
  std::optional<Mm> unit = {};           // length of one drawing unit; overrides $INSUNITS
  std::vector<std::string> layers = {};  // the layers to read; empty: all layers that are on
  std::vector<std::string> colors = {};  // "red", "#f00" or "30", a number of the palette; empty: all
  std::vector<std::string> names = {};   // layers, blocks or handles; empty: all
  Mm tolerance{0.005};                   // chord tolerance for ellipses and splines
  // The circles are holes of a circuit board: the inner circle of a DONUT is read, and a note warns about a drawing
  // that seems to be ten times too large or too small.
  bool is_for_drilling = false;
  // As SvgOptions::tells_shapes. A colour of the palette without a number of its own is its number, e.g. "30"; the
  // names are the handle of the entity, and the handles and blocks of the INSERTs around it.
  bool tells_shapes = false;
};

// Reports errors in `diagnostics`; the drawing then contains what was read before the error.
Drawing read_dxf(const std::string& name, std::string_view text, const DxfOptions& options, Diagnostics& diagnostics);

// Returns whether the beginning of the text looks like a DXF drawing.
bool looks_like_dxf(std::string_view text);

}  // namespace passo
