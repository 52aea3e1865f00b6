// read_tiff: the levels of a TIFF picture. Private to carve/.
//
// Grey, palette and colour, with or without alpha, in strips or tiles, of 1, 2, 4, 8, 16 or 32 bits. Numbers with a
// sign and floating-point numbers are measured heights: the least becomes black, the greatest white.
#pragma once

#include <string>
#include <string_view>

#include "passo/carve/level_picture.hpp"

namespace passo {

// If the picture cannot be read, it has no columns, and `fault` has the reason.
LevelPicture read_tiff(std::string_view bytes, PixelLevel level, std::string& fault);

}  // namespace passo
