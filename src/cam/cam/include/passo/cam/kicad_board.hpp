// read_kicad_board: the board of a KiCad file (.kicad_pcb), as KiCad's own Gerber and drill files would tell it.
//
// Reads the files of KiCad 4 to 9: tracks, also round ones; vias; pads of all shapes, with their own shapes and with
// other shapes on other layers; zones as KiCad has filled them; lines, arcs, circles, rectangles, polygons and curves
// of the board and of its footprints; holes and slots; the edge. Y is up: a place at Y100 of KiCad is at Y-100, as in
// its Gerber files. Texts on copper are left out, since their font is KiCad's own, and noted; so is a zone that is not
// filled.
//
// Arcs are chords within 0.5 um, never outside. Time and memory are proportional to the text; lines that cross too
// often to be united are refused. A hostile text gives diagnostics "kicad.…" with line and column.
//
// Source: KiCad, Board File Format (dev-docs.kicad.org, 2024).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "passo/cam/gerber.hpp"

namespace passo {

struct KicadLayer {
  std::string name;        // "F.Cu", whatever the user calls it
  GerberLayer layer = {};  // its notes are in strokes.notes
};

struct KicadBoard {
  std::vector<KicadLayer> copper = {};  // from the top down
  GerberLayer edge = {};                // Edge.Cuts; the strokes are the edge
  Drawing drills = {};                  // layer 0: plated, 1: not plated
};

// Errors are in `diagnostics`.
KicadBoard read_kicad_board(const std::string& name, std::string_view text, Diagnostics& diagnostics);

// Whether the text begins like a board of KiCad.
bool looks_like_kicad_board(std::string_view text);

}  // namespace passo
