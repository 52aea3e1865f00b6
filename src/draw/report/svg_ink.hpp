// SvgInk: writes a picture as SVG while it is drawn: without a library, and without memory beyond the file's buffer.
// Private to report/.
#pragma once

#include <memory>

#include "canvas.hpp"

namespace passo {

// `file` must outlive the ink.
std::unique_ptr<Ink> svg_ink(const PictureOptions& options, OutputFile& file);

}  // namespace passo
