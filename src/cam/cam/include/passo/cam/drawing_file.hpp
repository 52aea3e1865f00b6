// read_drawing: a drawing from a file of any kind that cam/ knows. The contents determine the format; the file may be
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
  DxfOptions dxf = {};  // its layers choose those of a KiCad board, too
  ExcellonOptions excellon = {};
  SvgOptions svg = {};
  HpglOptions hpgl = {};
  bool is_edge = false;  // of a KiCad board: the edge is wanted, if no layer is chosen
};

// Of a KiCad board: its holes. Errors are in `diagnostics`: "drawing.…", "dxf.…", "svg.…", "hpgl.…", "excellon.…" and
// "kicad.…".
Drawing read_drawing(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics);

}  // namespace passo
