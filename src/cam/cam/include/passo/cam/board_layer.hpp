// read_board_layer: reads a layer of a board as an area and as lines, from a Gerber file, a KiCad board or a drawing.
//
// In a drawing (DXF) closed paths and circles are filled, and open paths with a width are drawn in that width. An open
// path without a width covers nothing, but is still one of the lines from which edge_loops() makes an outline.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/cam/drawing_file.hpp"
#include "passo/cam/edge_loops.hpp"
#include "passo/cam/gerber.hpp"
#include "passo/cam/region.hpp"

namespace passo {

// A place on copper that belongs to a net: a pad, a hole, or a line with a name.
struct NetPlace {
  DrawnPoint at = {};
  std::string net = {};  // empty: it has no name
  Nanometres reach{};    // the copper may begin so far away, around a hole
};

struct BoardLayer {
  Region face = {};                 // the area that the layer covers
  Drawing lines = {};               // centre lines of its strokes, with the notes of the file
  std::optional<Region> bare = {};  // for a negative layer: what the file draws; the layer covers the rest of the board
  std::vector<NetPlace> nets = {};  // empty: unknown
};

// Returns the pads of a layer and the places that have a name. None for a negative layer, which draws the areas
// without copper.
std::vector<NetPlace> net_places_of(const GerberLayer& layer);

// Reports the errors of the readers, and "kicad.which-layer" and "kicad.no-layer" for a KiCad board.
BoardLayer read_board_layer(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics);

// Returns the part of the board that the layer covers. Reports "isolation.negative" for a negative layer if the board's
// outline is unknown.
Region covered_by(const BoardLayer& layer, const Region& board, Diagnostics& diagnostics);

// Returns the area that a drawing covers.
Region face_of(const Drawing& drawing);

struct BoardEdge {
  EdgeLoops loops = {};  // its open lines are slots
  Region board = {};     // the board inside the loops
};

// Returns the board inside an edge layer: the inside of its stroke centre lines, or the area that it fills. Reports the
// errors of edge_loops().
BoardEdge board_edge(const BoardLayer& layer, Nanometres join, Diagnostics& diagnostics);

}  // namespace passo
