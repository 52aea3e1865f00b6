// read_kicad_board: reads a KiCad board (.kicad_pcb) into the same data as KiCad's own Gerber and drill files.
//
// Supports the files of KiCad 4 to 9: tracks, including arcs; vias; pads of all shapes, including custom shapes and
// padstacks with different shapes per layer; zones as KiCad has filled them; lines, arcs, circles, rectangles, polygons
// and curves of the board and its footprints; holes and slots; the edge. Y points up: KiCad's Y100 becomes Y-100, as in
// its Gerber files. Texts on copper are omitted with a note, since KiCad has its own font; so are unfilled zones.
//
// Arcs become chords within 0.5 um, never outside. Time and memory are proportional to the text; rings with too many
// crossings are refused. Invalid input produces diagnostics "kicad.…" with line and column.
//
// Source: KiCad, Board File Format (dev-docs.kicad.org, 2024).
#pragma once

#include <string>
#include <string_view>

#include "passo/cam/design_board.hpp"

namespace passo {

// Reports errors in `diagnostics`.
DesignBoard read_kicad_board(const std::string& name, std::string_view text, Diagnostics& diagnostics);

// Returns whether the beginning of the text looks like a KiCad board.
bool looks_like_kicad_board(std::string_view text);

}  // namespace passo
