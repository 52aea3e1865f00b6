// read_drawing: reads a drawing file of any supported format. The format is detected from the contents; the file may be
// compressed with gzip (SVGZ).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/cam/dxf.hpp"
#include "passo/cam/excellon.hpp"
#include "passo/cam/hpgl.hpp"
#include "passo/cam/svg.hpp"

namespace passo {

struct DrawingFileOptions {
  DxfOptions dxf = {};  // its layers also select those of a KiCad board
  ExcellonOptions excellon = {};
  SvgOptions svg = {};
  HpglOptions hpgl = {};
  bool is_edge = false;  // for a KiCad board: reads the edge if no layer is selected
};

// Reads a drawing; of a KiCad board, its holes. Reports errors in `diagnostics`: "drawing.…", "dxf.…", "svg.…",
// "hpgl.…", "excellon.…" and "kicad.…".
Drawing read_drawing(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics);

}  // namespace passo
