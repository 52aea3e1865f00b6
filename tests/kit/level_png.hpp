// Encodes a picture's levels as a PNG, 16-bit greyscale.
#pragma once

#include <string>

#include <png.h>

#include "passo/carve/level_picture.hpp"

namespace passo::test {

// Empty on failure.
inline std::string png_of_levels(const LevelPicture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.columns);
  image.height = static_cast<png_uint_32>(picture.rows);
  image.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  const bool done = png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.levels.data(), 0, nullptr) != 0;
  bytes.resize(done ? size : 0);
  return bytes;
}

}  // namespace passo::test
