#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <jpeglib.h>

#include "passo/carve/level_picture.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

// `channels`: 1 is grey, 3 is colour.
std::string jpeg_of(int columns, int rows, int channels, const std::vector<unsigned char>& samples,
                    bool is_progressive = false) {
  jpeg_compress_struct file{};
  jpeg_error_mgr errors{};
  file.err = jpeg_std_error(&errors);
  jpeg_create_compress(&file);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&file, &bytes, &size);
  file.image_width = static_cast<JDIMENSION>(columns);
  file.image_height = static_cast<JDIMENSION>(rows);
  file.input_components = channels;
  file.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&file);
  jpeg_set_quality(&file, 100, TRUE);
  if (is_progressive) jpeg_simple_progression(&file);
  jpeg_start_compress(&file, TRUE);
  while (file.next_scanline < file.image_height) {
    std::vector<unsigned char> row(
        samples.begin() + static_cast<std::ptrdiff_t>(file.next_scanline) * columns * channels,
        samples.begin() + static_cast<std::ptrdiff_t>(file.next_scanline + 1) * columns * channels);
    JSAMPROW pointer = row.data();
    jpeg_write_scanlines(&file, &pointer, 1);
  }
  jpeg_finish_compress(&file);
  std::string made(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  jpeg_destroy_compress(&file);
  return made;
}

struct ReadJpeg {
  LevelPicture picture;
  std::string words;
};
ReadJpeg read_it(std::string_view bytes, PixelLevel level = PixelLevel::luminance) {
  Diagnostics diagnostics;
  LevelPicture picture = read_level_picture("it.jpg", bytes, level, diagnostics);
  return {.picture = std::move(picture), .words = render(diagnostics, false)};
}

std::string ramp(bool is_progressive = false) {
  std::vector<unsigned char> samples;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 64; ++x) samples.push_back(static_cast<unsigned char>(4 * x));
  }
  return jpeg_of(64, 20, 1, samples, is_progressive);
}

TEST(JpegPicture, has_the_levels_of_its_samples) {
  for (const bool is_progressive : {false, true}) {
    const ReadJpeg read = read_it(ramp(is_progressive));
    EXPECT_EQ(read.words, "");
    EXPECT_EQ(read.picture.kind, "8 bit grey, JPEG");
    ASSERT_EQ(read.picture.columns, 64U);
    ASSERT_EQ(read.picture.levels.size(), 64U * 20U);
    for (std::size_t i = 0; i < read.picture.levels.size(); ++i) {
      ASSERT_NEAR(read.picture.levels[i], static_cast<double>(i % 64) * 4 * 257, 2 * 257) << i;
    }
  }
}

TEST(JpegPicture, of_colours_has_their_luminance) {
  std::vector<unsigned char> samples;
  for (int i = 0; i < 16 * 16; ++i) samples.insert(samples.end(), {200, 100, 50});
  const ReadJpeg read = read_it(jpeg_of(16, 16, 3, samples));
  EXPECT_EQ(read.picture.kind, "8 bit colour, JPEG");
  const double luminance = (0.2126 * 200 + 0.7152 * 100 + 0.0722 * 50) * 257;
  ASSERT_EQ(read.picture.levels.size(), 256U);
  for (const std::uint16_t level : read.picture.levels) ASSERT_NEAR(level, luminance, 2 * 257);
}

TEST(JpegPicture, that_is_cut_off_or_changed_anywhere_is_refused_or_read) {
  const std::string whole = ramp();
  for (std::size_t size = 3; size + 2 < whole.size(); size += 1 + whole.size() / 150) {
    const ReadJpeg read = read_it(std::string_view(whole).substr(0, size));
    EXPECT_EQ(read.picture.columns, 0U) << size;
    EXPECT_THAT(read.words, HasSubstr("[picture.broken]")) << size;
    EXPECT_THAT(read.words, HasSubstr("a complete JPEG picture")) << size;
  }
  for (std::size_t at = 3; at < whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x15);
    const ReadJpeg read = read_it(changed);
    EXPECT_EQ(read.picture.columns == 0, !read.words.empty()) << at;
  }
}

// The header of a file of a few bytes may declare a huge picture.
TEST(JpegPicture, that_is_too_large_is_refused_before_memory_is_taken) {
  std::string huge = ramp();
  const std::size_t frame = huge.find("\xFF\xC0");
  ASSERT_NE(frame, std::string::npos);
  for (std::size_t i = 5; i < 9; ++i) huge[frame + i] = '\xFF';  // height and width
  const ReadJpeg read = read_it(huge);
  EXPECT_EQ(read.picture.columns, 0U);
  EXPECT_THAT(read.words, HasSubstr("[picture.broken]"));
  EXPECT_THAT(read_it(ramp(), PixelLevel::alpha).words, HasSubstr("no alpha channel"));
}

}  // namespace
}  // namespace passo
