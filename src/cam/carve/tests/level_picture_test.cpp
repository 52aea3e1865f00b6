#include "passo/carve/level_picture.hpp"

#include <string>

#include "kit/level_png.hpp"
#include <gmock/gmock.h>

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

struct ReadPicture {
  LevelPicture picture;
  std::string words;
};
ReadPicture read_picture(std::string_view bytes, PixelLevel level = PixelLevel::luminance) {
  Diagnostics diagnostics;
  LevelPicture picture = read_level_picture("it.png", bytes, level, diagnostics);
  return {.picture = std::move(picture), .words = render(diagnostics, false)};
}

LevelPicture all_levels() {
  LevelPicture picture{.columns = 256, .rows = 256};
  for (unsigned i = 0; i < 65536; ++i) picture.levels.push_back(static_cast<std::uint16_t>(i));
  return picture;
}

TEST(LevelPicture, keeps_all_16_bits) {
  const LevelPicture picture = all_levels();
  const ReadPicture read = read_picture(test::png_of_levels(picture));
  EXPECT_EQ(read.words, "");
  EXPECT_EQ(read.picture.kind, "16 bit grey");
  EXPECT_EQ(read.picture.levels, picture.levels);
}

TEST(LevelPicture, of_colours_has_their_luminance) {
  const std::vector<std::uint8_t> colours = {255, 255, 255, 255, 0, 0, 0, 255, 0, 0, 0, 255};
  const ReadPicture read = read_picture(write_colour_picture(2, 2, colours));
  EXPECT_EQ(read.words, "");
  EXPECT_EQ(read.picture.kind, "8 bit colour");
  EXPECT_EQ(read.picture.levels, (std::vector<std::uint16_t>{65535, 13933, 46871, 4732}));
}

TEST(LevelPicture, that_is_cut_off_or_changed_anywhere_is_refused_with_a_reason) {
  const std::string whole = test::png_of_levels(all_levels());
  for (std::size_t size = 0; size + 12 < whole.size(); size += 1 + whole.size() / 200) {
    const ReadPicture read = read_picture(std::string_view(whole).substr(0, size));
    EXPECT_EQ(read.picture.columns, 0U) << size;
    EXPECT_THAT(read.words, HasSubstr(size < 8 ? "[picture.unknown-kind]" : "[picture.broken]")) << size;
  }
  EXPECT_THAT(read_picture(std::string_view(whole).substr(0, whole.size() / 2)).words,
              HasSubstr("the picture cannot be read: the file ends too early"));
  for (std::size_t at = 8; at < whole.size(); at += 1 + whole.size() / 100) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    static_cast<void>(read_picture(changed));  // read or refused
  }
}

// A file of a few bytes may say that it is huge.
TEST(LevelPicture, that_is_too_large_is_refused_before_memory_is_taken) {
  LevelPicture wide{.columns = 65536, .rows = 2};
  wide.levels.assign(2 * 65536, 0);
  EXPECT_THAT(read_picture(test::png_of_levels(wide)).words, HasSubstr("65,535 per side"));
  LevelPicture thin{.columns = 1, .rows = 5};
  thin.levels.assign(5, 0);
  EXPECT_THAT(read_picture(test::png_of_levels(thin)).words, HasSubstr("fewer than two rows or columns"));
  EXPECT_THAT(read_picture(test::png_of_levels(all_levels()), PixelLevel::alpha).words, HasSubstr("no alpha channel"));
}

HeightGrid relief(const ReliefShape& shape) {
  LevelPicture picture{.columns = 3, .rows = 2, .levels = {0, 13107, 65535, 26214, 39321, 52428}};
  Diagnostics diagnostics;
  HeightGrid grid = relief_of(picture, shape, "it.png", diagnostics);
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  return grid;
}

TEST(Relief, of_a_picture_has_its_size_its_depth_and_the_last_row_lowest) {
  const HeightGrid grid = relief({.width = Mm(20), .depth = Mm(5)});
  EXPECT_EQ(grid.width().value(), 20);
  EXPECT_EQ(grid.length().value(), 10);
  EXPECT_EQ(grid.heights, (std::vector<float>{-3, -2, -1, -5, -4, 0}));
}

TEST(Relief, is_mirrored_inverted_and_bent_by_gamma) {
  EXPECT_EQ(relief({.width = Mm(20), .depth = Mm(5), .mirror = true}).heights,
            (std::vector<float>{-1, -2, -3, 0, -4, -5}));
  EXPECT_EQ(relief({.width = Mm(20), .depth = Mm(5), .invert = true}).heights,
            (std::vector<float>{-2, -3, -4, 0, -1, -5}));
  EXPECT_NEAR(relief({.width = Mm(20), .depth = Mm(5), .gamma = 2}).heights[0], 5 * (0.16 - 1), 1e-4);
}

TEST(Relief, has_a_rim_at_the_level_that_is_wanted) {
  const HeightGrid deep = relief({.width = Mm(20), .depth = Mm(5), .margin = Mm(15)});
  EXPECT_EQ(deep.columns, 7U);
  EXPECT_EQ(deep.rows, 6U);
  EXPECT_EQ(deep.at(0, 0), -5);
  EXPECT_EQ(deep.at(2, 2), -3);
  EXPECT_EQ(relief({.width = Mm(20), .depth = Mm(5), .margin = Mm(15), .margin_at_top = true}).at(1, 1), 0);
}

TEST(Relief, with_finer_nodes_is_the_same_surface) {
  const HeightGrid fine = relief({.width = Mm(20), .depth = Mm(5), .pitch = Mm(2.5)});
  EXPECT_EQ(fine.columns, 9U);
  EXPECT_EQ(fine.rows, 5U);
  EXPECT_EQ(fine.width().value(), 20);
  EXPECT_EQ(fine.at(4, 0), -2);
  EXPECT_EQ(fine.at(6, 2), (-2 - 1 - 4 + 0) / 4.0F);
}

TEST(Relief, becomes_finer_by_itself_as_far_as_memory_should_go) {
  EXPECT_EQ(relief({.width = Mm(20), .depth = Mm(5), .wished_pitch = Mm(2.5)}).columns, 9U);
  const HeightGrid finest = relief({.width = Mm(20), .depth = Mm(5), .wished_pitch = Mm(0.001)});
  EXPECT_LE(finest.heights.size(), most_fine_nodes);
  EXPECT_GT(finest.columns, 1000U);
}

TEST(Relief, of_too_many_nodes_is_refused) {
  Diagnostics diagnostics;
  LevelPicture picture{.columns = 2, .rows = 2, .levels = {0, 1, 2, 3}};
  EXPECT_EQ(relief_of(picture, {.width = Mm(100), .pitch = Mm(0.001)}, "it.png", diagnostics).columns, 0U);
  EXPECT_THAT(render(diagnostics, false), HasSubstr("[relief.too-many-nodes]"));
}

TEST(Relief, of_a_body_has_its_heights) {
  const ReliefBody wedge{.faces = {{{{0, 0, 0}, {10, 0, 5}, {10, 20, 5}}}, {{{0, 0, 0}, {10, 20, 5}, {0, 20, 0}}}}};
  Diagnostics diagnostics;
  const HeightGrid grid = relief_of(wedge, {.pitch = Mm(2)}, "it.stl", diagnostics);
  EXPECT_EQ(grid.columns, 6U);
  EXPECT_EQ(grid.rows, 11U);
  EXPECT_NEAR(grid.at(0, 3), -5, 1e-4);
  EXPECT_NEAR(grid.at(3, 7), -2, 1e-4);
  EXPECT_NEAR(relief_of(wedge, {.width = Mm(20), .pitch = Mm(2)}, "it.stl", diagnostics).at(0, 3), -10, 1e-4);
  EXPECT_EQ(relief_of(ReliefBody(), {}, "it.stl", diagnostics).columns, 0U);
  EXPECT_THAT(render(diagnostics, false), HasSubstr("[relief.bad-body]"));
}

}  // namespace
}  // namespace passo
