#include "passo/surface_file/surface_file.hpp"

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "passo/levelling/height_map.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

struct Read {
  Surface surface;
  std::string words;
};
Read read(std::string_view bytes) {
  Diagnostics diagnostics;
  Surface surface = read_surface("it", bytes, diagnostics);
  return {.surface = std::move(surface), .words = render(diagnostics, false)};
}

TEST(HeightMap, four_points_are_a_plane) {
  const Read plane = read("x,y,z\n0,0,1\n10,0,2\n0,20,-1\n10,20,0  # the far corner\n");
  EXPECT_EQ(plane.words, "");
  EXPECT_NEAR(plane.surface.top(5, 10), 0.5, 1e-12);
  EXPECT_NEAR(plane.surface.top(2, 15), -0.3, 1e-12);
  EXPECT_EQ(plane.surface.top(10.1, 10), Surface::nothing);
}

TEST(HeightMap, is_the_surface_that_programs_are_levelled_by) {
  const std::string text = "0,0,0\n10,0,1\n0,20,0.5\n10,20,-1\n25,0,0.3\n25,20,2\n";
  const Read twisted = read(text);
  EXPECT_EQ(twisted.words, "");
  EXPECT_NEAR(twisted.surface.top(5, 10), 0.125, 1e-12);
  Diagnostics diagnostics;
  const std::optional<HeightMap> map = read_height_map("it", text, diagnostics);
  ASSERT_TRUE(map);
  for (double x = 0; x <= 25; x += 0.5) {
    for (double y = 0; y <= 20; y += 0.5) {
      EXPECT_EQ(twisted.surface.top(x, y), map->height(x, y));
      EXPECT_EQ(twisted.surface.clearance({x, y, map->height(x, y)}), 0);
    }
  }
}

TEST(HeightMap, points_may_stand_in_any_order_with_blanks_or_semicolons) {
  const Read map = read("10;0;0\r\n0 0 0\n0\t5,3\n10 5 3\n0,9,0\n\n10,9,0\n");
  EXPECT_EQ(map.words, "");
  EXPECT_NEAR(map.surface.top(3, 5), 3, 1e-12);
  EXPECT_NEAR(map.surface.top(3, 7), 1.5, 1e-12);
}

TEST(HeightMap, tells_what_is_wrong_and_where) {
  EXPECT_THAT(read("0,0,1\n0,1e9,1\n").words, HasSubstr("it:2:3: error: '1e9' is not a valid length"));
  EXPECT_THAT(read("0,0,1\n0,1\n").words, HasSubstr("it:2:4: error: a number is missing"));
  EXPECT_THAT(read("0,0,1\n0,1,nan\n").words, HasSubstr("it:2:5: error: 'nan'"));
  EXPECT_THAT(read("0,0,1,2\n").words, HasSubstr("it:1:7: error: there is more than one point"));
  EXPECT_THAT(read("0,0,1\n1,0,1\n0,1,1\n").words, HasSubstr("3 points in 2 columns and 2 rows do not fill a grid"));
  EXPECT_THAT(read("0,0,1\n1,0,1\n0,1,1\n0,1,1\n").words, HasSubstr("it:4:1: error: X0 Y1 has two heights"));
  EXPECT_THAT(read("0,0,1\n1,0,1\n").words, HasSubstr("are not enough for a surface"));
  EXPECT_THAT(read("").words, HasSubstr("0 points"));
  EXPECT_THAT(read("hello\nthere\n").words, HasSubstr("'there' is not a valid length"));
  for (const char* text : {"0,0,1\n0,1e9,1\n", "0,0,1\n1,0,1\n", ""}) EXPECT_EQ(read(text).surface.triangles(), 0U);
}

constexpr const char* text_stl =
    "solid wedge\n"
    " facet normal 0 0 1\n  outer loop\n   vertex 0 0 1\n   vertex 10 0 2\n   vertex 0 10 1\n  endloop\n endfacet\n"
    "endsolid wedge\n";

std::string binary_stl(float height, std::uint32_t said, std::uint32_t there) {
  std::string bytes(80, ' ');
  const auto add = [&](const auto& value) {
    char raw[sizeof(value)];
    std::memcpy(raw, &value, sizeof(value));
    bytes.append(raw, sizeof(value));
  };
  add(said);
  for (std::uint32_t i = 0; i < there; ++i) {
    for (const float value : {0.F, 0.F, 1.F, 0.F, 0.F, height, 4.F, 0.F, height, 0.F, 4.F, height}) add(value);
    add(std::uint16_t{0});
  }
  return bytes;
}

TEST(Stl, is_read_as_text_and_as_bytes) {
  const Read text = read(text_stl);
  EXPECT_EQ(text.words, "");
  EXPECT_NEAR(text.surface.top(5, 1), 1.5, 1e-6);
  const Read binary = read(binary_stl(-2.5F, 1, 1));
  EXPECT_EQ(binary.words, "");
  EXPECT_NEAR(binary.surface.top(1, 1), -2.5, 1e-6);
  EXPECT_EQ(read(binary_stl(-2.5F, 1, 1) + std::string(49, '\0')).surface.triangles(), 1U) << "some bytes more";
}

TEST(Stl, text_may_be_in_capitals_on_one_line_and_of_several_bodies) {
  const Read text = read(
      "SOLID a b c\r\nFACET NORMAL 0 0 1 OUTER LOOP VERTEX 0 0 +1 VERTEX 1e1 0 2.0 VERTEX 0 10 1 ENDLOOP ENDFACET\r\n"
      "ENDSOLID a b c\r\nsolid\nfacet normal 0 0 0\nouter loop vertex 20 0 3 vertex 30 0 3 vertex 20 9 3\nendloop "
      "endfacet");
  EXPECT_EQ(text.words, "");
  EXPECT_EQ(text.surface.triangles(), 2U);
  EXPECT_NEAR(text.surface.top(5, 1), 1.5, 1e-12);
  EXPECT_NEAR(text.surface.top(22, 1), 3, 1e-12);
}

TEST(Stl, that_is_broken_is_refused_with_its_place) {
  EXPECT_THAT(read("solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 zero 1\n").words,
              HasSubstr("it:4:13: error: 'zero' is not expected here"));
  EXPECT_THAT(read("solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 1\n").words,
              HasSubstr("the file ends inside a solid"));
  EXPECT_THAT(read("solid a\n facet normal 0 0 1\n  inner loop\n").words, HasSubstr("it:3:3: error: 'inner'"));
  // Cut off anywhere, a text is read or refused.
  const std::string whole = text_stl;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Read cut = read(whole.substr(0, size));
    EXPECT_EQ(cut.surface.triangles() == 0, !cut.words.empty()) << size;
  }
}

TEST(Stl, that_is_broken_is_refused) {
  EXPECT_THAT(read(binary_stl(-2.5F, 2'000'000'000, 1)).words, HasSubstr("[surface."));
  EXPECT_THAT(read(binary_stl(1e9F, 1, 1)).words, HasSubstr("triangle 1 is too far away"));
  EXPECT_THAT(read(binary_stl(std::numeric_limits<float>::quiet_NaN(), 1, 1)).words, HasSubstr("[surface.stl]"));
  EXPECT_THAT(read("solid nothing\nfacet\nendsolid nothing\n").words, HasSubstr("[surface.stl]"));
  EXPECT_THAT(read(std::string("\x7f"
                               "ELF\0\0\0\0",
                               8))
                  .words,
              HasSubstr("surface.unknown-kind"));
}

TEST(SurfaceFile, open_edges_are_counted) {
  const SurfacePoint a{0, 0, 0};
  const SurfacePoint b{1, 0, 0};
  const SurfacePoint c{0, 1, 0};
  const SurfacePoint d{0, 0, 1};
  EXPECT_EQ(open_edges({{a, b, c}, {a, b, d}, {b, c, d}, {a, c, d}}), 0U);
  EXPECT_EQ(open_edges({{a, b, c}, {a, b, d}, {b, c, d}}), 3U);
  EXPECT_EQ(open_edges({{a, b, c}, {d, d, d}}), 3U) << "a point is no edge";
}

TEST(SurfaceFile, that_is_not_there_is_told) {
  Diagnostics diagnostics;
  EXPECT_EQ(read_surface("/no/such/file.stl", diagnostics).triangles(), 0U);
  EXPECT_THAT(render(diagnostics, false), HasSubstr("surface.unreadable"));
}

}  // namespace
}  // namespace passo
