// CairoInk: a picture as PNG, by cairo, which is loaded with the first of them (decision 0120). Private to report/.
#pragma once

#include <memory>
#include <string>

#include "canvas.hpp"

#include "passo/base/result.hpp"

namespace passo {

// `file` outlives the ink. On a computer without cairo finish() says so.
std::unique_ptr<Ink> cairo_ink(const PictureOptions& options, OutputFile& file);

// The pixels as the bytes of a PNG file.
Result<std::string, OutputError> png_of(PixelMap map);

}  // namespace passo
