#include "passo/carve/level_picture.hpp"

#include <algorithm>
#include <csetjmp>
#include <cstring>

#include "jpeg_picture.hpp"
#include "pixel_level.hpp"
#include "tiff_file.hpp"
#include "tiff_picture.hpp"
#include <fmt/format.h>
#include <png.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

// What libpng's callbacks share with the reader. libpng leaves a broken file by longjmp: what is to be freed then lives
// here, and not in a function that libpng leaves.
struct PngReading {
  std::string_view bytes;
  PixelLevel level = PixelLevel::luminance;
  LevelPicture picture;
  std::vector<png_byte> pixels;       // of a row, or of all rows of an interlaced file
  std::vector<png_bytep> row_starts;  // for libpng
  char fault[160] = {};
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~PngReading() { png_destroy_read_struct(&png, &info, nullptr); }
};

void on_error(png_structp png, png_const_charp message) {
  auto* const reading = static_cast<PngReading*>(png_get_error_ptr(png));
  std::strncpy(reading->fault, message, sizeof(reading->fault) - 1);
  png_longjmp(png, 1);
}
void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep to, png_size_t count) {
  auto* const reading = static_cast<PngReading*>(png_get_io_ptr(png));
  if (count > reading->bytes.size()) png_error(png, "the file ends too early");
  std::memcpy(to, reading->bytes.data(), count);
  reading->bytes.remove_prefix(count);
}

std::uint32_t sample(const png_byte* at) {
  return static_cast<std::uint32_t>(at[0]) << 8U | at[1];
}

// The level of a pixel of 16 bit samples.
std::uint16_t level_of(const png_byte* pixel, unsigned channels, PixelLevel level) {
  const bool has_alpha = channels == 2 || channels == 4;
  const std::uint64_t alpha = has_alpha ? sample(pixel + 2 * (channels - 1)) : 65535;
  if (level == PixelLevel::alpha) return static_cast<std::uint16_t>(alpha);
  std::uint64_t luminance = sample(pixel);
  if (channels >= 3) {
    luminance = luminance_of(luminance, sample(pixel + 2), sample(pixel + 4));
  }
  return faded(luminance, alpha);
}

std::string kind_of(unsigned bits, unsigned colour_type) {
  return fmt::format("{} bit {}{}", bits, (colour_type & PNG_COLOR_MASK_COLOR) != 0U ? "colour" : "grey",
                     (colour_type & PNG_COLOR_MASK_ALPHA) != 0U ? " with alpha" : "");
}

void take_row(PngReading& reading, const png_byte* pixels, unsigned channels) {
  for (std::size_t x = 0; x < reading.picture.columns; ++x) {
    reading.picture.levels.push_back(level_of(pixels + x * channels * 2, channels, reading.level));
  }
}

// Has no objects of its own that need a destructor: libpng leaves it by longjmp.
void read_rows(PngReading& reading) {
  png_structp png = reading.png;
  png_infop info = reading.info;
  png_read_info(png, info);
  const unsigned columns = png_get_image_width(png, info);
  const unsigned rows = png_get_image_height(png, info);
  const unsigned bits = png_get_bit_depth(png, info);
  if (columns > most_pixels_a_side || rows > most_pixels_a_side || std::size_t{columns} * rows > most_pixels) {
    png_error(png, "it has more than 64 million pixels, or more than 65,535 per side");
  }
  if (columns < 2 || rows < 2) png_error(png, "it has fewer than two rows or columns");
  const bool is_interlaced = png_get_interlace_type(png, info) != PNG_INTERLACE_NONE;
  png_set_expand(png);  // palettes become colours, 1 to 4 bits become 8, a transparent colour becomes alpha
  png_set_expand_16(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const unsigned channels = png_get_channels(png, info);
  reading.picture.kind = kind_of(bits, png_get_color_type(png, info));
  reading.picture.columns = columns;
  reading.picture.rows = rows;
  if (reading.level == PixelLevel::alpha && channels != 2 && channels != 4) png_error(png, "it has no alpha channel");
  const std::size_t row_bytes = png_get_rowbytes(png, info);
  constexpr std::size_t most_interlaced = 400'000'000;
  if (is_interlaced && row_bytes * rows > most_interlaced) png_error(png, "it is too large for an interlaced picture");
  reading.pixels.resize(is_interlaced ? row_bytes * rows : row_bytes);
  if (is_interlaced) {
    for (unsigned y = 0; y < rows; ++y) reading.row_starts.push_back(&reading.pixels[row_bytes * y]);
    png_read_image(png, reading.row_starts.data());
    for (unsigned y = 0; y < rows; ++y) take_row(reading, reading.row_starts[y], channels);
    return;
  }
  // Memory grows with what is really there.
  for (unsigned y = 0; y < rows; ++y) {
    png_read_row(png, reading.pixels.data(), nullptr);
    take_row(reading, reading.pixels.data(), channels);
  }
}

bool read_png(PngReading& reading) {
  reading.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, on_error, on_warning);
  if (reading.png == nullptr) return false;
  reading.info = png_create_info_struct(reading.png);
  if (reading.info == nullptr) return false;
  if (setjmp(png_jmpbuf(reading.png)) != 0) return false;
  png_set_user_limits(reading.png, most_pixels_a_side * 4, most_pixels_a_side * 4);
  png_set_chunk_malloc_max(reading.png, 8'000'000);
  png_set_chunk_cache_max(reading.png, 100);
  png_set_read_fn(reading.png, &reading, on_read);
  read_rows(reading);
  return true;
}

struct PngWriting {
  std::string bytes;
  png_structp png = nullptr;
  png_infop info = nullptr;

  ~PngWriting() { png_destroy_write_struct(&png, &info); }
};

void on_write(png_structp png, png_bytep from, png_size_t count) {
  static_cast<PngWriting*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(from), count);
}
void on_flush(png_structp) {}

bool write_png(PngWriting& writing, std::size_t columns, std::size_t rows, const std::uint8_t* colours) {
  writing.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, on_warning);
  if (writing.png == nullptr) return false;
  writing.info = png_create_info_struct(writing.png);
  if (writing.info == nullptr) return false;
  if (setjmp(png_jmpbuf(writing.png)) != 0) return false;
  png_set_write_fn(writing.png, &writing, on_write, on_flush);
  png_set_IHDR(writing.png, writing.info, static_cast<png_uint_32>(columns), static_cast<png_uint_32>(rows), 8,
               PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(writing.png, writing.info);
  for (std::size_t y = 0; y < rows; ++y) png_write_row(writing.png, colours + y * columns * 3);
  png_write_end(writing.png, writing.info);
  return true;
}

bool is_png(std::string_view bytes) {
  return bytes.size() >= 8 && std::memcmp(bytes.data(), "\x89PNG\r\n\x1a\n", 8) == 0;
}

}  // namespace

bool is_level_picture(std::string_view bytes) {
  return is_png(bytes) || is_jpeg(bytes) || TiffFile::is_one(bytes);
}

LevelPicture read_level_picture(const std::string& name, std::string_view bytes, PixelLevel level,
                                Diagnostics& diagnostics) {
  if (!is_level_picture(bytes)) {
    diagnostics.add(
        of_file("picture.unknown-kind", name, "this picture format is not supported", "a PNG, JPEG or TIFF picture"));
    return {};
  }
  const auto refuse = [&](std::string_view fault) {
    diagnostics.add(of_file("picture.broken", name, fmt::format("the picture cannot be read: {}", fault),
                            fmt::format("a complete {} picture", is_png(bytes)    ? "PNG"
                                                                 : is_jpeg(bytes) ? "JPEG"
                                                                                  : "TIFF")));
    return LevelPicture{};
  };
  if (!is_png(bytes)) {
    std::string fault;
    LevelPicture picture = is_jpeg(bytes) ? read_jpeg(bytes, level, fault) : read_tiff(bytes, level, fault);
    return fault.empty() ? std::move(picture) : refuse(fault);
  }
  PngReading reading;
  reading.bytes = bytes;
  reading.level = level;
  if (!read_png(reading))
    return refuse(reading.fault[0] == 0 ? "out of memory" : static_cast<const char*>(reading.fault));
  return std::move(reading.picture);
}

LevelPicture read_picture_on_white(const std::string& name, std::string_view bytes, Diagnostics& diagnostics) {
  LevelPicture picture = read_level_picture(name, bytes, PixelLevel::luminance, diagnostics);
  if (picture.columns == 0 || picture.kind.find("alpha") == std::string::npos) return picture;
  const LevelPicture opaque = read_level_picture(name, bytes, PixelLevel::alpha, diagnostics);
  if (opaque.levels.size() != picture.levels.size()) return picture;
  // The luminance is darkened in proportion to the transparency.
  constexpr int white = 65'535;
  for (std::size_t i = 0; i < picture.levels.size(); ++i) {
    picture.levels[i] = static_cast<std::uint16_t>(std::min(white, picture.levels[i] + white - opaque.levels[i]));
  }
  return picture;
}

std::string write_colour_picture(std::size_t columns, std::size_t rows, const std::vector<std::uint8_t>& colours) {
  PngWriting writing;
  const bool done = write_png(writing, columns, rows, colours.data());
  return done ? std::move(writing.bytes) : std::string();
}

}  // namespace passo
