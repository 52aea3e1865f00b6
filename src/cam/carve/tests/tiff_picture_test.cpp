// TIFF files: small ones that are made here, field by field, and some that libtiff has written (ImageMagick).
#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "passo/carve/level_picture.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

struct ReadTiff {
  LevelPicture picture;
  std::string words;
};
ReadTiff read_tiff_bytes(std::string_view bytes, PixelLevel level = PixelLevel::luminance) {
  Diagnostics diagnostics;
  LevelPicture picture = read_level_picture("it.tiff", bytes, level, diagnostics);
  return {.picture = std::move(picture), .words = render(diagnostics, false)};
}

// A file of one strip, little-endian.
struct MadeTiff {
  unsigned columns = 2;
  unsigned rows = 2;
  unsigned bits = 8;
  unsigned samples = 1;
  unsigned photometric = 1;
  std::vector<std::pair<unsigned, unsigned>> more = {};  // fields of one short number
  std::string data = {};
  std::vector<std::uint16_t> colours = {};

  std::string bytes() const {
    std::string text("II*\0", 4);
    const auto put = [&](std::uint64_t value, unsigned size) {
      for (unsigned i = 0; i < size; ++i) text += static_cast<char>(value >> 8U * i);
    };
    const auto colours_at = static_cast<unsigned>(8 + data.size());
    put(colours_at + 2 * colours.size(), 4);
    text += data;
    for (const std::uint16_t colour : colours) put(colour, 2);
    std::vector<std::array<unsigned, 4>> fields = {{256, 4, 1, columns},
                                                   {257, 4, 1, rows},
                                                   {258, 3, 1, bits},
                                                   {262, 3, 1, photometric},
                                                   {273, 4, 1, 8},
                                                   {277, 3, 1, samples},
                                                   {279, 4, 1, static_cast<unsigned>(data.size())}};
    for (const auto& [tag, value] : more) fields.push_back({tag, 3, 1, value});
    if (!colours.empty()) fields.push_back({320, 3, static_cast<unsigned>(colours.size()), colours_at});
    put(fields.size(), 2);
    for (const auto& field : fields) {
      put(field[0], 2);
      put(field[1], 2);
      put(field[2], 4);
      put(field[3], 4);
    }
    put(0, 4);
    return text;
  }
};

using Levels = std::vector<std::uint16_t>;

TEST(TiffPicture, has_the_levels_of_its_samples) {
  MadeTiff tiff{.data = {0, 1, 2, char(255)}};
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).words, "");
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.levels, (Levels{0, 257, 514, 65535}));
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.kind, "8 bit grey");
  tiff.photometric = 0;  // white is zero
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.levels, (Levels{65535, 65278, 65021, 0}));
  tiff = {.columns = 3, .rows = 2, .bits = 4, .data = {0x0F, 0x10, char(0x87), char(0xF0)}};
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.levels, (Levels{0, 65535, 4369, 34952, 30583, 65535}));
  tiff = {.bits = 16, .data = {1, 0, 0, 1, 2, 1, char(255), char(255)}};
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.levels, (Levels{1, 256, 258, 65535}));
  tiff = {.bits = 8, .photometric = 3, .data = {0, 1, 1, 0}};
  tiff.colours.assign(768, 0);
  tiff.colours[1] = tiff.colours[257] = tiff.colours[513] = 40000;  // the second of the reds, greens and blues
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.levels, (Levels{0, 40000, 40000, 0}));
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.kind, "8 bit colour");
}

TEST(TiffPicture, of_transparent_pixels_is_dark_there_once) {
  const std::string pixels = {100, 100, 100, char(255), 100, 100, 100, 0, 50, 50, 50, char(128), 0, 0, 0, 0};
  MadeTiff tiff{.samples = 4, .photometric = 2, .more = {{338, 2}}, .data = pixels};
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.kind, "8 bit colour with alpha");
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.levels, (Levels{25700, 0, 6450, 0}));
  EXPECT_EQ(read_tiff_bytes(tiff.bytes(), PixelLevel::alpha).picture.levels, (Levels{65535, 0, 32896, 0}));
  tiff.more = {{338, 1}};  // the colours are multiplied by alpha in the file
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.levels, (Levels{25700, 25700, 12850, 0}));
  tiff.more = {};  // the fourth sample is something else
  EXPECT_THAT(read_tiff_bytes(tiff.bytes(), PixelLevel::alpha).words, HasSubstr("no alpha channel"));
}

TEST(TiffPicture, of_measured_heights_is_stretched_from_black_to_white) {
  MadeTiff tiff{.bits = 32, .more = {{339, 3}}};
  for (const float height : {-10.0F, 30.0F, 10.0F, std::numeric_limits<float>::quiet_NaN()}) {
    const auto number = std::bit_cast<std::uint32_t>(height);
    for (unsigned i = 0; i < 4; ++i) tiff.data += static_cast<char>(number >> 8U * i);
  }
  const ReadTiff read = read_tiff_bytes(tiff.bytes());
  EXPECT_EQ(read.words, "");
  EXPECT_EQ(read.picture.kind, "floating-point heights from -10 to 30");
  EXPECT_EQ(read.picture.levels, (Levels{0, 65535, 32768, 0}));
  const MadeTiff depths{.bits = 16, .more = {{339, 2}}, .data = {char(0xFE), char(0xFF), 0, 0, 2, 0, 1, 0}};
  EXPECT_EQ(read_tiff_bytes(depths.bytes()).picture.levels, (Levels{0, 32768, 65535, 49151}));
  EXPECT_EQ(read_tiff_bytes(depths.bytes()).picture.kind, "16 bit heights from -2 to 2");
}

TEST(TiffPicture, is_turned_as_it_says) {
  MadeTiff tiff{.columns = 3, .rows = 2, .data = {0, 1, 2, 3, 4, 5}};
  const auto turned = [&](unsigned orientation) {
    tiff.more = {{274, orientation}};
    Levels levels = read_tiff_bytes(tiff.bytes()).picture.levels;
    for (std::uint16_t& level : levels) level /= 257;
    return levels;
  };
  EXPECT_EQ(turned(2), (Levels{2, 1, 0, 5, 4, 3}));
  EXPECT_EQ(turned(3), (Levels{5, 4, 3, 2, 1, 0}));
  EXPECT_EQ(turned(4), (Levels{3, 4, 5, 0, 1, 2}));
  EXPECT_EQ(turned(5), (Levels{0, 3, 1, 4, 2, 5}));
  EXPECT_EQ(turned(6), (Levels{3, 0, 4, 1, 5, 2}));
  EXPECT_EQ(turned(7), (Levels{5, 2, 4, 1, 3, 0}));
  EXPECT_EQ(turned(8), (Levels{2, 5, 1, 4, 0, 3}));
  EXPECT_EQ(read_tiff_bytes(tiff.bytes()).picture.columns, 2U);
}

std::string written_by_libtiff(const std::string& name) {
  std::ifstream file(std::filesystem::path(PASSO_SOURCE_DIR) / "src/cam/carve/tests/pictures" / name, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_GT(text.str().size(), 500U) << name;
  return text.str();
}

TEST(TiffPicture, of_libtiff_is_the_same_however_it_is_packed) {
  const auto levels = [](const std::string& name) {
    const ReadTiff read = read_tiff_bytes(written_by_libtiff(name));
    EXPECT_EQ(read.words, "") << name;
    EXPECT_EQ(read.picture.levels.size(), 48U * 33U) << name;
    return read.picture.levels;
  };
  const Levels grey = levels("plain-grey.tiff");
  EXPECT_GT(*std::max_element(grey.begin(), grey.end()) - *std::min_element(grey.begin(), grey.end()), 10000);
  for (const char* name : {"lzw-grey.tiff", "packed-grey.tiff", "tiles-grey.tiff"})
    EXPECT_EQ(levels(name), grey) << name;
  const Levels colour = levels("plain-colour.tiff");
  for (const char* name : {"planes-colour.tiff", "deflate-colour.tiff"}) EXPECT_EQ(levels(name), colour) << name;
}

TEST(TiffPicture, that_is_cut_off_or_changed_anywhere_is_read_or_refused_with_a_reason) {
  for (const char* name : {"lzw-grey.tiff", "packed-grey.tiff", "tiles-grey.tiff", "deflate-colour.tiff"}) {
    const std::string whole = written_by_libtiff(name);
    for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 60) {
      const ReadTiff read = read_tiff_bytes(std::string_view(whole).substr(0, size));
      EXPECT_EQ(read.picture.columns == 0, !read.words.empty()) << name << " " << size;
    }
    for (std::size_t at = 4; at < whole.size(); at += 1 + whole.size() / 150) {
      std::string changed = whole;
      changed[at] = static_cast<char>(changed[at] ^ 0x11);
      const ReadTiff read = read_tiff_bytes(changed);
      EXPECT_EQ(read.picture.levels.size(), read.picture.columns * read.picture.rows);
    }
  }
}

TEST(TiffPicture, of_another_kind_is_refused_with_its_name) {
  MadeTiff tiff{.more = {{259, 7}}, .data = {0, 1, 2, 3}};
  EXPECT_THAT(read_tiff_bytes(tiff.bytes()).words, HasSubstr("its compression (JPEG) is not supported"));
  tiff = {.bits = 12, .data = std::string(9, 1)};
  EXPECT_THAT(read_tiff_bytes(tiff.bytes()).words, HasSubstr("samples of 12 bits are not supported"));
  tiff = {.photometric = 5, .data = std::string(9, 1)};
  EXPECT_THAT(read_tiff_bytes(tiff.bytes()).words, HasSubstr("not greyscale, RGB or a palette"));
  tiff = {.columns = 65535, .rows = 1000, .data = std::string(9, 1)};  // large, and nothing of it is there
  EXPECT_THAT(read_tiff_bytes(tiff.bytes()).words, HasSubstr("the file ends too early"));
  tiff = {.columns = 65535, .rows = 65535};
  EXPECT_THAT(read_tiff_bytes(tiff.bytes()).words, HasSubstr("more than 64 million pixels"));
  tiff = {.data = std::string(3, 1)};
  EXPECT_THAT(read_tiff_bytes(tiff.bytes()).words, HasSubstr("damaged or truncated"));
}

}  // namespace
}  // namespace passo
