// LevelPicture: a picture whose brightness is a height, and its reader.
//
// Levels are 0 (black) to 65535 (white). A level of 16 bits is kept as it is in the file; one of 8 bits is multiplied
// by 257, so that white is white. The gamma and colour profile of a file are not applied: a level is a number, no
// colour. Rows go downwards, as in the file. Of a TIFF file the first picture is read; heights that it holds as numbers
// with a sign or with a point are stretched from black to white. Errors are diagnostics "picture.…".
//
// Sources: Portable Network Graphics, W3C, 3rd edition (read by libpng); TIFF, Revision 6.0.
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

// What of a pixel is its level. The luminance of a colour is 0.2126 R + 0.7152 G + 0.0722 B; what is transparent counts
// as black, in proportion.
enum class PixelLevel : std::uint8_t { luminance, alpha };

struct LevelPicture {
  std::size_t columns = 0;  // 0: nothing was read
  std::size_t rows = 0;
  std::vector<std::uint16_t> levels = {};
  std::string kind = {};  // "16 bit grey", "8 bit colour with alpha", "floating-point heights from 12.5 to 230"
};

// Errors are in `diagnostics`; the picture then has no columns.
LevelPicture read_level_picture(const std::string& name, std::string_view bytes, PixelLevel level,
                                Diagnostics& diagnostics);

// Whether these are the first bytes of a kind of picture that is read: PNG or TIFF.
bool is_level_picture(std::string_view bytes);

// A PNG of bytes R, G, B of each pixel, row by row downwards. Empty: it could not be made.
std::string write_colour_picture(std::size_t columns, std::size_t rows, const std::vector<std::uint8_t>& colours);

}  // namespace passo
