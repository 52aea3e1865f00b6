// read_drawing: a drawing from a file of any kind that cam/ knows. The kind is told by what is in the file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "passo/cam/dxf.hpp"
#include "passo/cam/excellon.hpp"
#include "passo/cam/svg.hpp"

namespace passo {

struct DrawingFileOptions {
  DxfOptions dxf = {};
  ExcellonOptions excellon = {};
  SvgOptions svg = {};
};

// Errors are in `diagnostics`: "drawing.…", "dxf.…", "svg.…" and "excellon.…".
Drawing read_drawing(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics);

}  // namespace passo
