// CairoInk: draws a picture as PNG with cairo, which is loaded with the first PNG picture (decision 0120). Private to
// report/.
#pragma once

#include <memory>
#include <string>

#include "canvas.hpp"

#include "passo/base/result.hpp"

namespace passo {

// `file` must outlive the ink. Without cairo on the computer, finish() returns an error.
std::unique_ptr<Ink> cairo_ink(const PictureOptions& options, OutputFile& file);

// Encodes the pixels as a PNG file.
Result<std::string, OutputError> png_of(PixelMap map);

}  // namespace passo
