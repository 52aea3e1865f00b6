// trace_picture: traces the outlines of the dark areas of a picture with potrace.
//
// potrace is a separate program under the GPL. It runs as a process of its own, with limits and confined to a temporary
// folder; none of its code is linked. If it is not installed, the error "trace.no-potrace" names its package.
//
// Source: P. Selinger, Potrace: a polygon-based tracing algorithm (2003).
#pragma once

#include <string>

#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

inline constexpr std::size_t most_traced_pixels = std::size_t{16} * 1024 * 1024;

struct PictureTraceOptions {
  double threshold = 0.5;      // brightness below which a pixel is dark, from 0 to 1; transparent pixels are white
  bool invert = false;         // traces the bright areas instead
  std::uint32_t turdsize = 2;  // spots of at most so many pixels are ignored
  Mm width{100};               // of the picture
};

// Reads a PNG, JPEG or TIFF file and traces it: closed outlines, with the picture's lower left corner at X0 Y0. Reports
// errors in `diagnostics`: "trace.…", "picture.…" and those of read_svg().
Drawing trace_picture(const std::string& path, const PictureTraceOptions& options, Diagnostics& diagnostics);

}  // namespace passo
