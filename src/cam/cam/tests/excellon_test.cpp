#include "passo/cam/excellon.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

struct ReadDrill {
  Drawing drawing;
  Diagnostics found;
};
ReadDrill read_drill(const std::string& text, const ExcellonOptions& options = {}) {
  ReadDrill result;
  result.drawing = read_excellon("board.drl", text, options, result.found);
  return result;
}
DrawnPoint nm(std::int64_t x, std::int64_t y) {
  return {Nanometres{x}, Nanometres{y}};
}
std::string first_code(const ReadDrill& read) {
  return read.found.all().empty() ? "" : read.found.all().front().code;
}

TEST(Excellon, a_metric_file_with_decimal_points_is_exact) {
  const ReadDrill read =
      read_drill("M48\nMETRIC\nT1C0.800\nT2C1.000\n%\nG90\nG05\nT1\nX109.22Y-161.1\nT2\nX97.865\nT0\nM30\n");
  EXPECT_FALSE(read.found.any_error());
  ASSERT_EQ(read.drawing.holes.size(), 2U);
  EXPECT_EQ(read.drawing.holes[0].at, nm(109'220'000, -161'100'000));
  EXPECT_EQ(read.drawing.holes[0].diameter, Nanometres{800'000});
  EXPECT_EQ(read.drawing.holes[0].line, 9U);
  EXPECT_EQ(read.drawing.holes[1].at, nm(97'865'000, -161'100'000)) << "Y stays as it was";
  EXPECT_EQ(read.drawing.layers[read.drawing.holes[1].layer], "T2");
  EXPECT_TRUE(read.drawing.notes.empty());
}

TEST(Excellon, zeros_are_left_out_as_the_header_says) {
  const std::string body = "T1C0.0157\n%\nT1\nX009Y-0045\nM30\n";
  EXPECT_EQ(read_drill("M48\nINCH,LZ\n" + body).drawing.holes.at(0).at, nm(22'860'000, -11'430'000));
  EXPECT_EQ(read_drill("M48\nINCH,TZ\n" + body).drawing.holes.at(0).at, nm(22'860, -114'300));
  EXPECT_EQ(read_drill("M48\nMETRIC,LZ,000.000\nT1C0.8\n%\nT01\nX+039751Y+01778\nM30\n").drawing.holes.at(0).at,
            nm(39'751'000, 17'780'000));
  EXPECT_EQ(read_drill("M48\nMETRIC,TZ,000.000\nT1C0.8\n%\nT01\nX39751Y17780\nM30\n").drawing.holes.at(0).at,
            nm(39'751'000, 17'780'000));
}

TEST(Excellon, what_the_header_does_not_say_is_guessed_and_said) {
  const ReadDrill leading = read_drill("M48\nINCH\nT1C0.03\n%\nT1\nX12500Y9000\nX1250Y300\nM30\n");
  EXPECT_EQ(leading.drawing.holes.at(0).at, nm(31'750'000, 22'860'000));
  EXPECT_THAT(leading.drawing.notes, testing::ElementsAre(testing::HasSubstr("'leading zeros' is assumed")));
  const ReadDrill trailing = read_drill("M48\nINCH\nT1C0.03\n%\nT1\nX0125Y009\nX01255Y003\nM30\n");
  EXPECT_EQ(trailing.drawing.holes.at(0).at, nm(31'750'000, 22'860'000));
  EXPECT_THAT(trailing.drawing.notes, testing::ElementsAre(testing::HasSubstr("'trailing zeros' is assumed")));
  const ReadDrill inch = read_drill("%\nT1C0.03\nT1\nX1.5Y1.0\nM30\n");
  EXPECT_EQ(inch.drawing.holes.at(0).at, nm(38'100'000, 25'400'000));
  EXPECT_THAT(inch.drawing.notes, testing::ElementsAre(testing::HasSubstr("inch is assumed")));
  const ReadDrill told = read_drill("%\nT1C0.03\nT1\nX1.5Y1.0\nM30\n", {.inch = false, .zeros = {}});
  EXPECT_EQ(told.drawing.holes.at(0).at, nm(1'500'000, 1'000'000));
  EXPECT_TRUE(told.drawing.notes.empty());
}

TEST(Excellon, formats_stated_in_comments_are_used) {
  const ReadDrill kicad = read_drill(
      "M48\n;FORMAT={2:4/ absolute / inch / suppress leading "
      "zeros}\nFMAT,2\nINCH\nT1C0.0157\n%\nT1\nX10000Y5000\nM30\n");
  EXPECT_EQ(kicad.drawing.holes.at(0).at, nm(25'400'000, 12'700'000));
  const ReadDrill altium = read_drill("M48\n;FILE_FORMAT=4:4\nMETRIC,LZ\nT1C0.8\n%\nT01\nX0010Y0020125\nM30\n");
  EXPECT_EQ(altium.drawing.holes.at(0).at, nm(10'000'000, 20'125'000));
}

TEST(Excellon, sizes_and_the_unit_in_comments_of_allegro_are_used) {
  const ReadDrill read = read_drill(
      ";T01 Holesize 1. = 12.000000 Tolerance = +0.0/-0.0 PLATED MILS Quantity = 2\n"
      ";   Holesize 2. = 35.000000 Tolerance = +0.0/-0.0 PLATED MILS Quantity = 1\n"
      "%\nT01\nX004450Y000200\nX009874Y002026\nT02\nX006159Y004159\nM30\n");
  EXPECT_FALSE(read.found.any_error());
  ASSERT_EQ(read.drawing.holes.size(), 3U);
  EXPECT_EQ(read.drawing.holes[0].at, nm(11'303'000, 508'000));
  EXPECT_EQ(read.drawing.holes[0].diameter, Nanometres{304'800});
  EXPECT_EQ(read.drawing.holes[2].diameter, Nanometres{889'000});
  for (const std::string& words : read.drawing.notes) EXPECT_THAT(words, testing::Not(testing::HasSubstr("unit")));
  const ReadDrill metric = read_drill(";drill sizes in millimeters\n%\nT1C0.2\nT1\nX1.5Y1.0\nM30\n");
  EXPECT_EQ(metric.drawing.holes.at(0).at, nm(1'500'000, 1'000'000)) << "not guessed from the drill";
}

TEST(Excellon, m71_and_m72_may_have_the_words_of_metric_and_inch) {
  const std::string body = "T1C0.8\n%\nT1\nX10000Y2000\nM30\n";
  EXPECT_EQ(read_drill("M48\nM71,TZ\n" + body).drawing.holes.at(0).at, nm(10'000'000, 2'000'000));
  EXPECT_EQ(read_drill("M48\nM71,LZ\n" + body).drawing.holes.at(0).at, nm(100'000'000, 200'000'000));
  EXPECT_EQ(read_drill("M48\nM72,TZ\n" + body).drawing.holes.at(0).at, nm(25'400'000, 5'080'000));
}

TEST(Excellon, a_header_may_have_no_end_and_sizes_may_come_last) {
  const ReadDrill open = read_drill("M48\nMETRIC\nT1C0.8\nT2C1.0\nT1\nX1.0Y1.0\nT2\nX2.0Y1.0\nM30\n");
  ASSERT_EQ(open.drawing.holes.size(), 2U);
  EXPECT_EQ(open.drawing.holes[0].diameter, Nanometres{800'000});
  EXPECT_EQ(open.drawing.holes[1].diameter, Nanometres{1'000'000});
  const ReadDrill late = read_drill("M48\nMETRIC\n%\nT1\nX1.0Y1.0\nG80\nT2\nX2.0Y1.0\nT1C0.8\nM30\n");
  EXPECT_FALSE(late.found.any_error());
  ASSERT_EQ(late.drawing.holes.size(), 2U);
  EXPECT_EQ(late.drawing.holes[0].diameter, Nanometres{800'000});
  EXPECT_THAT(late.drawing.notes, testing::ElementsAre(testing::HasSubstr("diameter of T2")));
}

TEST(Excellon, a_route_without_m15_is_cut_from_its_first_g01) {
  const ReadDrill read = read_drill("M48\nMETRIC\nT1C1.0\n%\nT1\nG00X10.0Y10.0\nG01X15.0Y10.0\nG05\nX20.0Y10.0\nM30\n");
  ASSERT_EQ(read.drawing.paths.size(), 1U);
  EXPECT_EQ(read.drawing.paths[0].points.front().at, nm(10'000'000, 10'000'000));
  EXPECT_EQ(read.drawing.paths[0].points.back().at, nm(15'000'000, 10'000'000));
  ASSERT_EQ(read.drawing.holes.size(), 1U);
  EXPECT_EQ(read.drawing.holes[0].at, nm(20'000'000, 10'000'000));
}

TEST(Excellon, slots_and_routes_become_paths_as_wide_as_their_tool) {
  const ReadDrill read = read_drill(
      "M48\nMETRIC\nT1C1.0\n%\nT1\nX1.0Y2.0G85X3.0\nG00X5.0Y5.0\nM15\nG01X7.0\nG03X7.0Y7.0A1.0\nM16\nG05\nX9.0Y9."
      "0\nM30\n");
  EXPECT_FALSE(read.found.any_error());
  ASSERT_EQ(read.drawing.paths.size(), 2U);
  const DrawnPath& slot = read.drawing.paths[0];
  EXPECT_EQ(slot.points.at(0).at, nm(1'000'000, 2'000'000));
  EXPECT_EQ(slot.points.at(1).at, nm(3'000'000, 2'000'000));
  EXPECT_EQ(slot.width, Nanometres{1'000'000});
  const DrawnPath& route = read.drawing.paths[1];
  ASSERT_EQ(route.points.size(), 3U);
  EXPECT_EQ(route.points[2].at, nm(7'000'000, 7'000'000));
  EXPECT_NEAR(route.points[1].bulge, 1, 1e-9) << "half a circle, counterclockwise";
  ASSERT_EQ(read.drawing.holes.size(), 1U);
}

TEST(Excellon, t0_is_a_tool_where_the_header_defines_it) {
  const ReadDrill read = read_drill("M48\nMETRIC\nT0C0.3\nT1C1.0\n%\nT0\nX1.0Y1.0\nT1\nX2.0\nM30\n");
  EXPECT_FALSE(read.found.any_error());
  ASSERT_EQ(read.drawing.holes.size(), 2U);
  EXPECT_EQ(read.drawing.holes[0].diameter, Nanometres{300'000});
}

TEST(Excellon, repeats_increments_and_a_shifted_zero) {
  const ReadDrill read = read_drill(
      "M48\nMETRIC\nT1C1.0\n%\nT1\nX1.0Y1.0\nR3X2.54\nG91\nX1.0\nG90\nX0.0Y0.0\nG93X10.0Y20.0\nX1.0Y1.0\nM30\n");
  EXPECT_FALSE(read.found.any_error());
  ASSERT_EQ(read.drawing.holes.size(), 7U);
  EXPECT_EQ(read.drawing.holes[3].at, nm(8'620'000, 1'000'000));
  EXPECT_EQ(read.drawing.holes[4].at, nm(9'620'000, 1'000'000));
  EXPECT_EQ(read.drawing.holes[6].at, nm(11'000'000, 21'000'000));
}

TEST(Excellon, what_is_wrong_is_told_with_its_place) {
  const ReadDrill early = read_drill("M48\nMETRIC\nT1C1.0\n%\nX1.0Y1.0\nM30\n");
  EXPECT_EQ(first_code(early), "excellon.no-tool");
  EXPECT_EQ(early.found.all().front().place.line, 5U);
  const ReadDrill digits = read_drill("M48\nMETRIC\nT1C1.0\n%\nT1\nX1.0Y1.0.0\nM30\n");
  EXPECT_EQ(first_code(digits), "excellon.bad-number");
  EXPECT_EQ(digits.found.all().front().place, (SourceLocation{6, 5, 6}));
  EXPECT_EQ(first_code(read_drill("M48\nMETRIC\nT1C1.0\n%\nT1\nhello\nM30\n")), "excellon.unknown-command");
  EXPECT_EQ(first_code(read_drill("M48\nMETRIC\nT1C1.0\n%\nT1\nX1.0\nM02X5.0Y5.0\nM30\n")), "excellon.unsupported");
  EXPECT_EQ(first_code(read_drill("M48\nMETRIC\nT1C1.0\n%\nT1\nX99999999.0\nM30\n")), "drawing.too-far");
  EXPECT_EQ(first_code(read_drill("M48\nMETRIC\nT1C1.0\n%\nT1\nG00X0.0Y0.0\nM15\nG02X9.0A1.0\nM30\n")),
            "excellon.bad-arc");
  EXPECT_EQ(first_code(read_drill("T1C1\nT1\n" + std::string(5000, 'X') + "\n")), "excellon.long-line");
}

TEST(Excellon, a_bomb_of_repeats_ends_at_the_limit) {
  const ReadDrill read = read_drill("M48\nMETRIC\nT1C1.0\n%\nT1\nX1.0Y1.0\nR999999999999X0.0\nM30\n");
  EXPECT_EQ(first_code(read), "drawing.too-large");
  EXPECT_LE(read.drawing.holes.size(), most_drawn);
}

// Boards of other projects. The numbers are counts of their lines.
TEST(Excellon, reads_drill_files_of_other_projects) {
  const std::filesystem::path boards = std::filesystem::path(PASSO_SOURCE_DIR) / "../shared/peers/boards";
  if (!std::filesystem::exists(boards)) GTEST_SKIP() << "no " << boards;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(boards)) {
    const std::string kind = entry.path().extension().string();
    if (kind != ".drl" && kind != ".DRL") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(looks_like_excellon(text)) << entry.path();
    const ReadDrill read = read_drill(text);
    EXPECT_FALSE(read.found.any_error()) << entry.path() << "\n" << render(read.found, false);
    // An independent count: lines that begin with X and have no G85 are holes.
    std::size_t holes = 0;
    std::size_t slots = 0;
    std::size_t at = 0;
    while (at < text.size()) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string line = text.substr(at, end - at);
      if (line.starts_with("X")) (line.find("G85") == std::string::npos ? holes : slots)++;
      at = end + 1;
    }
    EXPECT_EQ(read.drawing.holes.size(), holes) << entry.path();
    EXPECT_GE(read.drawing.paths.size(), slots) << entry.path();
    for (const DrawnHole& hole : read.drawing.holes) EXPECT_LT(std::abs(to_mm(hole.at.x).value()), 300);
    ++files;
  }
  EXPECT_GE(files, 6U);
}

}  // namespace
}  // namespace passo
