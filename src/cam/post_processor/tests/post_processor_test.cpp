// The post-processor on single lines, and on random arcs: splitting and rounding leave the path unchanged.
#include "passo/post_processor/post_processor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "kit/seed.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace passo {
namespace {

using testing::HasSubstr;

std::string written(const std::string& controller, const std::string& program, PostProcessorOptions options = {}) {
  std::string text;
  PostProcessor processor(*find_controller(controller), std::move(options),
                          [&](std::string_view piece) { text += piece; });
  processor.add(program);
  if (const auto why = processor.finish()) return "refused: " + *why;
  return text;
}

TEST(PostProcessor, takes_pieces_that_end_within_a_line) {
  std::string text;
  PostProcessor processor(*find_controller("grbl"), {}, [&](std::string_view piece) { text += piece; });
  for (const char c : std::string("G17 G21 G40 G80 G90 G94\nG0 X1.5 Y-2\nM2\n")) processor.add(std::string(1, c));
  EXPECT_EQ(processor.finish(), std::nullopt);
  EXPECT_EQ(text, "G17 G21 G40 G80 G90 G91.1 G94\nG0 X1.5 Y-2\nM2\n");
}

TEST(PostProcessor, gives_each_controller_its_form) {
  const std::string program = "(MSG, tool 1: mill)\nT1 M6\nG0 Z30\nG4 P1.5\nG1 X10 F200\nM2\n";
  EXPECT_EQ(written("linuxcnc", program), "(MSG, tool 1: mill)\nT1 M6\nG0 G43 H1 Z30\nG4 P1.5\nG1 X10 F200\nM2\n");
  EXPECT_EQ(written("grbl", program), "(tool 1: mill)\nT1\nM0\nG0 Z30\nG4 P1.5\nG1 X10 F200\nM2\n");
  EXPECT_EQ(written("grblhal", program), "(MSG, tool 1: mill)\nT1 M6\nG0 Z30\nG4 P1.5\nG1 X10 F200\nM2\n");
  EXPECT_EQ(written("fanuc-like", program, {.program = "part 7"}),
            "%\nO0001 (PART 7)\nN10 (TOOL 1  MILL)\nN20 T1 M6\nN30 G0 G43 H1 Z30.\nN40 G4 P1500\nN50 G1 X10. "
            "F200.\nN60 M30\n%\n");
}

TEST(PostProcessor, keeps_commands_out_of_comments) {
  EXPECT_EQ(written("grbl", "(what? go! é)\n"), "(what_ go_ _)\n");
  EXPECT_EQ(written("linuxcnc", "(what? go! é)\n"), "(what? go! é)\n");
  const std::string text = written("grbl", "(" + std::string(60, 'a') + " " + std::string(60, 'b') + ")\n");
  EXPECT_EQ(text, "(" + std::string(60, 'a') + ")\n(" + std::string(60, 'b') + ")\n");
}

TEST(PostProcessor, writes_nothing_for_an_empty_message) {
  EXPECT_EQ(written("grbl", "(MSG,)\n(MSG,  )\nG0 X1\n"), "G0 X1\n");
}

TEST(PostProcessor, refuses_numbers_that_no_controller_reads) {
  EXPECT_EQ(written("grbl", "G0 X1e9\n").substr(0, 8), "refused:");
  EXPECT_EQ(written("grbl", "G0 X99999999\n"), "refused: line 1: X99999999 is too large");
  EXPECT_EQ(written("grbl", "T-1 M6\n"), "refused: line 1: expected T with a tool number");
}

TEST(PostProcessor, refuses_what_the_controller_does_not_know) {
  EXPECT_EQ(written("grbl", "G81 X1 Y1 Z-1 R1\n"), "refused: line 1: Grbl 1.1 does not know G81");
  EXPECT_EQ(written("mach3", "G1 X1 U2 F100\n"), "refused: line 1: Mach3 has no U");
  EXPECT_EQ(written("fanuc-like", "G93\n"), "refused: line 1: Fanuc-like does not know G93");
}

TEST(PostProcessor, converts_lengths_but_no_times) {
  const PostProcessorOptions inch{.written_unit = LengthUnit::inch};
  EXPECT_EQ(written("linuxcnc", "G17 G21 G40 G80 G90 G94\nG1 X25.4 F254\nG93\nG1 X50.8 F2\nG4 P3\n", inch),
            "G17 G20 G40 G80 G90 G91.1 G94\nG64 P0.00039\nG1 X1 F10\nG93\nG1 X2 F2\nG4 P3\n");
}

// Follows a program without Passo's code: every position, and points on arcs.
using Place = std::array<double, 3>;
std::vector<Place> places_of(const std::string& program) {
  std::vector<Place> places{{0, 0, 0}};
  std::istringstream lines(program);
  std::string line;
  int motion = 0;
  int plane = 17;
  while (std::getline(lines, line)) {
    std::istringstream words(line);
    std::string word;
    Place to = places.back();
    Place centre = to;
    bool moves = false;
    while (words >> word) {
      const double value = std::strtod(word.c_str() + 1, nullptr);
      if (word[0] == 'G' && value <= 3) motion = static_cast<int>(value);
      if (word[0] == 'G' && value >= 17 && value <= 19) plane = static_cast<int>(value);
      if (word[0] >= 'X' && word[0] <= 'Z') to[static_cast<std::size_t>(word[0] - 'X')] = value, moves = true;
      if (word[0] >= 'I' && word[0] <= 'K') centre[static_cast<std::size_t>(word[0] - 'I')] += value;
    }
    if (!moves) continue;
    const Place from = places.back();
    if (motion >= 2) {
      const std::size_t a = plane == 17 ? 0 : plane == 18 ? 2 : 1;
      const std::size_t b = plane == 17 ? 1 : plane == 18 ? 0 : 2;
      const double begin = std::atan2(from[b] - centre[b], from[a] - centre[a]);
      const double sign = motion == 3 ? 1 : -1;
      double sweep = sign * (std::atan2(to[b] - centre[b], to[a] - centre[a]) - begin);
      while (sweep <= 1e-9) sweep += 2 * std::numbers::pi;
      const double radius = std::hypot(from[a] - centre[a], from[b] - centre[b]);
      for (int i = 1; i < 32; ++i) {
        Place at = from;
        for (std::size_t axis = 0; axis < 3; ++axis) at[axis] += (to[axis] - from[axis]) * i / 32;
        at[a] = centre[a] + radius * std::cos(begin + sign * sweep * i / 32);
        at[b] = centre[b] + radius * std::sin(begin + sign * sweep * i / 32);
        places.push_back(at);
      }
    }
    places.push_back(to);
  }
  return places;
}

double from_chord(const Place& place, const Place& a, const Place& b) {
  double along = 0;
  double length = 0;
  for (std::size_t i = 0; i < 3; ++i)
    along += (place[i] - a[i]) * (b[i] - a[i]), length += (b[i] - a[i]) * (b[i] - a[i]);
  const double share = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  double off = 0;
  for (std::size_t i = 0; i < 3; ++i) off = std::hypot(off, place[i] - std::lerp(a[i], b[i], share));
  return off;
}

double farthest(const std::vector<Place>& places, const std::vector<Place>& path) {
  double most = 0;
  for (const Place& place : places) {
    double least = 1e9;
    for (std::size_t i = 0; i + 1 < path.size(); ++i) least = std::min(least, from_chord(place, path[i], path[i + 1]));
    most = std::max(most, least);
  }
  return most;
}

TEST(PostProcessor, leaves_the_path_of_random_arcs_as_it_was) {
  const std::uint64_t seed = test::first_seed(48);
  SCOPED_TRACE(test::command_again(seed));
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0, 1);
  const std::uint64_t runs = test::number_of("PASSO_RUNS", 10);
  for (std::uint64_t run = 0; run < runs; ++run) {
    std::string program = "G17 G21 G40 G80 G90 G94\nG1 F100\n";
    Place at{0, 0, 0};
    for (int i = 0; i < 4; ++i) {
      const int plane = 17 + static_cast<int>(share(random) * 3);
      const std::size_t a = plane == 17 ? 0 : plane == 18 ? 2 : 1;
      const std::size_t b = plane == 17 ? 1 : plane == 18 ? 0 : 2;
      const double radius = std::pow(10.0, share(random) * 6 - 2.5);
      const double begin = share(random) * 6.2;
      const double longest = std::min(6.2, 100 / radius);
      const double sweep = (share(random) < 0.5 ? -1 : 1) * longest * (0.01 + 0.99 * share(random));
      Place to = at;
      to[3 - a - b] += share(random);
      Place offset{};
      offset[a] = -radius * std::cos(begin);
      offset[b] = -radius * std::sin(begin);
      to[a] += offset[a] + radius * std::cos(begin + sweep);
      to[b] += offset[b] + radius * std::sin(begin + sweep);
      program += fmt::format("G{} G{} X{:.7f} Y{:.7f} Z{:.7f}", plane, sweep > 0 ? 3 : 2, to[0], to[1], to[2]);
      program += fmt::format(" {}{:.7f} {}{:.7f}\n", "IJK"[a], offset[a], "IJK"[b], offset[b]);
      at = to;
    }
    program += "M2\n";
    const std::vector<Place> before = places_of(program);
    for (const ControllerWords& controller : controllers()) {
      std::string text = written(std::string(controller.name), program);
      ASSERT_EQ(text.find("refused"), std::string::npos) << text;
      const std::vector<Place> after = places_of(text);
      // Chords within 2 um, numbers to 1 um, and the chords of this test.
      const double chords = farthest(before, before) + 100 * (1 - std::cos(6.2 / 64));
      EXPECT_LT(farthest(after, before), 0.006 + chords) << controller.name << "\n" << program << text;
      EXPECT_LT(farthest(before, after), 0.006 + chords) << controller.name << "\n" << program << text;
    }
  }
}

TEST(PostProcessor, writes_no_full_circle_where_an_arc_is_very_short) {
  const std::string text =
      written("fanuc-like", "G17 G21 G40 G80 G90 G94\nG1 X10 Y0 F100\nG3 X10 Y0.0002 I-10 J0\nM2\n");
  EXPECT_EQ(text.find("G3"), std::string::npos) << text;
  const std::string circle = written("fanuc-like", "G17 G21 G40 G80 G90 G94\nG1 X10 Y0 F100\nG3 X10 Y0 I-10 J0\nM2\n");
  EXPECT_THAT(circle, HasSubstr("G3 X-10. Y0. I-10. J0.\n"));
  EXPECT_THAT(circle, HasSubstr(" G3 X10. Y0. I10. J0.\n"));
}

// The table of docs/manual/cam.md.
TEST(ControllerRows, are_those_of_the_manual) {
  std::ifstream file(PASSO_SOURCE_DIR "/docs/manual/cam.md");
  const std::string manual((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  for (const ControllerWords& row : controllers()) {
    const char* const call = row.tool_call == ToolCall::m6      ? "`T2 M6`"
                             : row.tool_call == ToolCall::pause ? "`T2`, `M0`"
                                                                : "`T2 M6`, `G43 H2`";
    const std::string arcs = row.knows_all()
                                 ? "any"
                                 : fmt::format("{:g} to {:g} mm{}", row.arcs.least_radius, row.arcs.most_radius,
                                               row.arcs.most_degrees < 360 ? ", half circles" : "");
    const std::string line =
        fmt::format("| `{}` | {} | {} | {} | {}{} | {} | `{}` |\n", row.name,
                    row.knows_g("81") ? "G81, G83" : "written as moves", call, arcs, row.numbers.mm_decimals,
                    row.numbers.has_point ? ", `X10.`" : "", row.form.dwells_in_ms ? "ms" : "s", row.form.end);
    EXPECT_THAT(manual, HasSubstr(line)) << "expected in docs/manual/cam.md:\n" << line;
  }
}

}  // namespace
}  // namespace passo
