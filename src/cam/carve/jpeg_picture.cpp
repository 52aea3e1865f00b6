#include "jpeg_picture.hpp"

#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>

#include "pixel_level.hpp"
#include <fmt/format.h>
#include <jpeglib.h>

namespace passo {
namespace {

// The data that libjpeg's callbacks share with the reader. On a broken file libjpeg calls longjmp. So memory that must
// then be freed is owned here, not by a function that longjmp leaves.
struct JpegReading {
  jpeg_decompress_struct file = {};
  jpeg_error_mgr errors = {};
  std::jmp_buf out = {};
  std::array<char, JMSG_LENGTH_MAX> fault = {};
  LevelPicture picture;
  std::vector<JSAMPLE> pixels;  // of a row

  ~JpegReading() { jpeg_destroy_decompress(&file); }
};

[[noreturn]] void leave(JpegReading& reading, const char* fault) {
  std::strncpy(reading.fault.data(), fault, reading.fault.size() - 1);
  std::longjmp(reading.out, 1);
}

void on_jpeg_error(j_common_ptr file) {
  auto* const reading = static_cast<JpegReading*>(file->client_data);
  std::array<char, JMSG_LENGTH_MAX> words{};
  file->err->format_message(file, words.data());
  leave(*reading, words.data());
}

// Warnings mean damaged data, such as an early end: the rest would be grey.
void on_jpeg_message(j_common_ptr file, int level) {
  if (level < 0) on_jpeg_error(file);
}

void on_jpeg_output(j_common_ptr) {}

// `is_inverted`: in CMYK, 255 means no ink, as Photoshop writes it.
std::uint16_t level_of_sample(const JSAMPLE* pixel, int channels, bool is_inverted) {
  constexpr std::uint64_t scale = 257;
  if (channels == 1) return static_cast<std::uint16_t>(pixel[0] * scale);
  std::array<std::uint64_t, 3> colour{pixel[0], pixel[1], pixel[2]};
  if (channels == 4) {
    const auto light = [&](std::uint64_t ink) { return is_inverted ? ink : 255 - ink; };
    for (std::uint64_t& part : colour) part = light(part) * light(pixel[3]) / 255;
  }
  return static_cast<std::uint16_t>(luminance_of(colour[0] * scale, colour[1] * scale, colour[2] * scale));
}

// Must have no local objects with destructors, because libjpeg leaves it by longjmp.
void read_jpeg_rows(JpegReading& reading) {
  jpeg_decompress_struct& file = reading.file;
  jpeg_read_header(&file, TRUE);
  if (std::size_t{file.image_width} * file.image_height > most_pixels) {
    leave(reading, "it has more than 64 million pixels");
  }
  if (file.image_width < 2 || file.image_height < 2) leave(reading, "it has fewer than two rows or columns");
  if (file.num_components == 4) {
    file.out_color_space = JCS_CMYK;
  } else if (file.num_components != 1) {
    file.out_color_space = JCS_RGB;
  }
  jpeg_start_decompress(&file);
  const int channels = file.output_components;
  reading.picture.kind = channels == 1 ? "8 bit grey, JPEG" : "8 bit colour, JPEG";
  reading.picture.columns = file.output_width;
  reading.picture.rows = file.output_height;
  reading.pixels.resize(std::size_t{file.output_width} * static_cast<std::size_t>(channels));
  // Memory grows with the data that are actually there.
  while (file.output_scanline < file.output_height) {
    constexpr int most_scans = 200;
    if (file.input_scan_number > most_scans) leave(reading, "it has more than 200 scans");
    JSAMPROW row = reading.pixels.data();
    jpeg_read_scanlines(&file, &row, 1);
    for (std::size_t x = 0; x < reading.picture.columns; ++x) {
      const JSAMPLE* const pixel = row + x * static_cast<std::size_t>(channels);
      reading.picture.levels.push_back(level_of_sample(pixel, channels, file.saw_Adobe_marker != FALSE));
    }
  }
  jpeg_finish_decompress(&file);
}

bool read_jpeg(JpegReading& reading, std::string_view bytes) {
  reading.file.err = jpeg_std_error(&reading.errors);
  reading.errors.error_exit = on_jpeg_error;
  reading.errors.emit_message = on_jpeg_message;
  reading.errors.output_message = on_jpeg_output;
  reading.file.client_data = &reading;
  if (setjmp(reading.out) != 0) return false;
  jpeg_create_decompress(&reading.file);
  reading.file.client_data = &reading;
  constexpr long most_memory = 1'000'000'000;
  reading.file.mem->max_memory_to_use = most_memory;
  jpeg_mem_src(&reading.file, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  read_jpeg_rows(reading);
  return true;
}

}  // namespace

bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with("\xFF\xD8\xFF");
}

LevelPicture read_jpeg(std::string_view bytes, PixelLevel level, std::string& fault) {
  if (level == PixelLevel::alpha) {
    fault = "it has no alpha channel";
    return {};
  }
  JpegReading reading;
  if (read_jpeg(reading, bytes)) return std::move(reading.picture);
  fault = reading.fault[0] == 0 ? "out of memory" : reading.fault.data();
  return {};
}

}  // namespace passo
