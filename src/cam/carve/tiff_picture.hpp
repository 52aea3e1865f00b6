// read_tiff: reads the levels of a TIFF picture. Private to carve/.
//
// Supports greyscale, palette and colour, with or without alpha, in strips or tiles, with 1, 2, 4, 8, 16 or 32 bits.
// Signed and floating-point numbers are measured heights: the minimum becomes black, the maximum white.
#pragma once

#include <string>
#include <string_view>

#include "passo/carve/level_picture.hpp"

namespace passo {

// On failure, returns a picture without columns and sets `fault` to the reason.
LevelPicture read_tiff(std::string_view bytes, PixelLevel level, std::string& fault);

}  // namespace passo
