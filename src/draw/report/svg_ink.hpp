// SvgInk: a picture as SVG, written as it is drawn: no library, and no more memory than the file's buffer. Private to
// report/.
#pragma once

#include <memory>

#include "canvas.hpp"

namespace passo {

// `file` outlives the ink.
std::unique_ptr<Ink> svg_ink(const PictureOptions& options, OutputFile& file);

}  // namespace passo
