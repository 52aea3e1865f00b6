// read_jpeg: reads a JPEG picture as levels. Private to carve/.
//
// Baseline and progressive files, grey or colour (also CMYK). Memory for the pixels is bounded before it is requested;
// a file that ends too early, or is damaged, is rejected. An orientation stored by a camera (EXIF) is not applied.
//
// Source: ITU-T T.81; read by libjpeg-turbo.
#pragma once

#include <string>
#include <string_view>

#include "passo/carve/level_picture.hpp"

namespace passo {

bool is_jpeg(std::string_view bytes);

// If the picture cannot be read, it has no columns, and `fault` has the reason.
LevelPicture read_jpeg(std::string_view bytes, PixelLevel level, std::string& fault);

}  // namespace passo
