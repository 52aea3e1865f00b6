// LevelPicture: a picture whose brightness represents height, and its reader.
//
// Levels range from 0 (black) to 65535 (white). A 16-bit level is kept as in the file; an 8-bit level is multiplied by
// 257, so that white stays white. The gamma and colour profile of a file are not applied: a level is a number, not a
// colour. Rows are in file order, from top to bottom. For a TIFF file, the first picture is read; signed or
// floating-point heights are scaled so that they range from black to white. Errors are diagnostics "picture.…".
//
// Sources: Portable Network Graphics, W3C, 3rd edition (read by libpng); ITU-T T.81, JPEG (read by
// libjpeg-turbo); TIFF, Revision 6.0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

inline constexpr std::size_t most_pixels = std::size_t{64} * 1024 * 1024;
inline constexpr std::size_t most_pixels_a_side = 65'535;

// The property of a pixel that is its level. The luminance of a colour is 0.2126 R + 0.7152 G + 0.0722 B; transparency
// darkens it in proportion.
enum class PixelLevel : std::uint8_t { luminance, alpha };

struct LevelPicture {
  std::size_t columns = 0;  // 0: nothing was read
  std::size_t rows = 0;
  std::vector<std::uint16_t> levels = {};
  std::string kind = {};  // "16 bit grey", "8 bit colour with alpha", "floating-point heights from 12.5 to 230"
};

// Reports errors in `diagnostics`; the picture then has no columns.
LevelPicture read_level_picture(const std::string& name, std::string_view bytes, PixelLevel level,
                                Diagnostics& diagnostics);

// Reads the luminance; what is transparent lets a white background through.
LevelPicture read_picture_on_white(const std::string& name, std::string_view bytes, Diagnostics& diagnostics);

// Returns whether these are the first bytes of a supported picture format: PNG, JPEG or TIFF.
bool is_level_picture(std::string_view bytes);

// Encodes R, G, B bytes per pixel, row by row from the top, as a PNG. Empty on failure.
std::string write_colour_picture(std::size_t columns, std::size_t rows, const std::vector<std::uint8_t>& colours);

}  // namespace passo
