// DesignBoard: a board read from the layout program's own file, as if the program had exported Gerber and drill files.
//
// read_design_board() knows KiCad (.kicad_pcb, see kicad_board.hpp), EAGLE (.brd, XML since EAGLE 6) and EasyEDA
// (standard edition, JSON). Y points up. EAGLE and EasyEDA files do not contain the fills of copper pours. The pours
// are filled here: solid, with the file's clearance to other nets, and without islands; a note reports this.
//
// Source: eagle.dtd of EAGLE 9; EasyEDA Standard Edition Document Format (docs.easyeda.com, 2020).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/gerber.hpp"

namespace passo {

struct DesignLayer {
  std::string name;        // KiCad: "F.Cu", independent of the user's layer names; EAGLE: "Top"; EasyEDA: "TopLayer"
  GerberLayer layer = {};  // the layer; its notes are in strokes.notes
};

struct DesignBoard {
  std::vector<DesignLayer> copper = {};  // the copper layers from top to bottom
  GerberLayer edge = {};                 // the outline, as strokes
  Drawing drills = {};                   // drilled holes; layer 0: plated, layer 1: non-plated
  std::string edge_name = "Edge.Cuts";   // its layer
};

// Reports errors "kicad.…", "eagle.…" and "easyeda.…" in `diagnostics`, with the line.
DesignBoard read_design_board(const std::string& name, std::string_view text, Diagnostics& diagnostics);

// Returns whether the text looks like a board of one of these programs.
bool looks_like_design_board(std::string_view text);

}  // namespace passo
