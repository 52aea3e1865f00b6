// read_board_layer: a layer of a board as a face and as lines, from a Gerber file, a board of KiCad or a drawing.
//
// In a drawing (DXF) closed paths and circles are filled, and open paths with a width are as wide as that. An open path
// without a width covers nothing; it is still among the lines, from which edge_loops() makes an outline.
#pragma once

#include <optional>
#include <string>

#include "passo/cam/drawing_file.hpp"
#include "passo/cam/edge_loops.hpp"
#include "passo/cam/region.hpp"

namespace passo {

struct BoardLayer {
  Region face = {};                 // all that the layer covers
  Drawing lines = {};               // the middles of its strokes; its notes are those of the file
  std::optional<Region> bare = {};  // of a negative layer: what it draws. It covers all else of the board, too
};

// Errors are those of the readers, and of a KiCad board "kicad.which-layer" and "kicad.no-layer".
BoardLayer read_board_layer(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics);

// What the layer covers of the board. "isolation.negative": a negative layer, and nobody knows the board.
Region covered_by(const BoardLayer& layer, const Region& board, Diagnostics& diagnostics);

// What a drawing covers.
Region face_of(const Drawing& drawing);

struct BoardEdge {
  EdgeLoops loops = {};
  Region board = {};  // inside the loops
};

// The board inside an edge layer: inside the middles of its strokes, or the face that it fills. Errors as those of
// edge_loops().
BoardEdge board_edge(const BoardLayer& layer, Nanometres join, Diagnostics& diagnostics);

}  // namespace passo
