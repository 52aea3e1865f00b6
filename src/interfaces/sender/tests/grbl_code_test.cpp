#include "passo/sender/grbl_code.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace passo {
namespace {

Point at(double x, double y, double z) {
  Point place;
  place[Axis::x] = x;
  place[Axis::y] = y;
  place[Axis::z] = z;
  return place;
}

Segment feed(const Curve& curve, double mm_per_minute) {
  return {.curve = curve, .speed = MmPerSecond(mm_per_minute / 60)};
}

std::vector<std::string> lines_of(const std::vector<PathItem>& items, const Point& zero = {}) {
  GrblCode code(zero);
  std::vector<std::string> lines;
  for (const PathItem& item : items) EXPECT_TRUE(code.write(item, lines).has_value());
  return lines;
}

using Lines = std::vector<std::string>;

TEST(GrblCode, writes_what_changes_and_no_more) {
  Segment rapid = feed(Curve::line(at(0, 0, 0), at(10, -5, 2)), 0);
  rapid.rapid = true;
  EXPECT_EQ(lines_of({rapid, feed(Curve::line(at(10, -5, 2), at(10, -5, -1.25)), 300),
                      feed(Curve::line(at(10, -5, -1.25), at(12.00004, -5, -1.25)), 300),
                      feed(Curve::line(at(12.00004, -5, -1.25), at(12.00004, 0.5, -1.25)), 1200.5)},
                     at(1, 0, 0)),
            (Lines{"G0X9Y-5Z2", "G1F300Z-1.25", "X11", "F1200.5Y0.5"}));
}

TEST(GrblCode, writes_a_full_circle_as_two_halves_that_return) {
  const Curve circle = Curve::arc(at(5, 0, 0), at(5, 0, 0), Axis::x, Axis::y, 0, 0, 2 * std::numbers::pi);
  EXPECT_EQ(lines_of({feed(circle, 600)}), (Lines{"G3F600X-5Y0Z0I-5J0", "X5Y0Z0I5J0"}));
}

TEST(GrblCode, writes_arcs_of_other_planes_and_helices) {
  const Curve helix = Curve::arc(at(0, 2, 3), at(4, 2, 7), Axis::z, Axis::x, 7, 0, -std::numbers::pi / 2);
  // From Z3 X0 about Z7 X0: a radius of 4. Its end is at Z7 X-4 or X4 by its direction; the words are what is tested.
  const Lines lines = lines_of({feed(helix, 600)});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0], "G18G2F600X4Y2Z7K4I0");
}

// Grbl takes an arc whose rounded ends are the same for a full circle.
TEST(GrblCode, never_lets_a_tiny_arc_become_a_circle) {
  const double r = 10;
  for (const double sweep : {1e-6, -1e-6, 1e-4, -3e-3}) {
    const Curve arc =
        Curve::arc(at(r, 0, 0), at(r * std::cos(sweep), r * std::sin(sweep), 0), Axis::x, Axis::y, 0, 0, sweep);
    for (const std::string& line : lines_of({feed(arc, 100)})) EXPECT_EQ(line.find('I'), std::string::npos) << line;
  }
}

TEST(GrblCode, writes_splines_as_chords_within_their_tolerance) {
  Point along;
  along[Axis::x] = 1;
  Point up;
  up[Axis::y] = 1;
  const Curve curve = Curve::cubic(at(0, 0, 0), along, at(10, 10, 0), up, Mm(16));
  const Lines lines = lines_of({feed(curve, 100)});
  EXPECT_GT(lines.size(), 20U);
  EXPECT_LT(lines.size(), 200U);
  EXPECT_EQ(lines.back().substr(0, 1), "X");
}

TEST(GrblCode, switches_outputs_and_waits) {
  Action on{.kind = Action::Kind::outputs};
  on.outputs = {.spindle = SpindleDirection::clockwise, .revolutions_per_minute = 12000, .mist = true, .flood = true};
  Action dwell{.kind = Action::Kind::dwell, .dwell = Seconds(1.5), .outputs = on.outputs};
  Action less = on;
  less.outputs.mist = false;
  less.outputs.revolutions_per_minute = 8000;
  EXPECT_EQ(lines_of({on, dwell, less, Action{.kind = Action::Kind::program_end}}),
            (Lines{"M3S12000", "M7", "M8", "G4P1.5", "M3S8000", "M9", "M8", "M5", "M9"}));
}

TEST(GrblCode, stops_exactly_where_the_program_says_so) {
  Segment segment = feed(Curve::line(at(0, 0, 0), at(1, 0, 0)), 60);
  segment.mode = PathMode::exact_stop;
  EXPECT_EQ(lines_of({segment}), (Lines{"G1F60X1Y0Z0", "G4P0"}));
}

TEST(GrblCode, refuses_what_grbl_cannot_do) {
  GrblCode code;
  Lines lines;
  Point turned;
  turned[Axis::a] = 90;
  const auto rotary = code.write(feed(Curve::line(Point(), turned), 60), lines);
  ASSERT_FALSE(rotary.has_value());
  EXPECT_EQ(rotary.error(), "it has no axis A");
  Segment thread = feed(Curve::line(at(0, 0, 0), at(0, 0, -5)), 60);
  thread.lock = SpindleLock::place;
  EXPECT_FALSE(code.write(thread, lines).has_value());
  EXPECT_FALSE(code.write(Action{.kind = Action::Kind::probe_begin}, lines).has_value());
  EXPECT_TRUE(lines.empty());
}

}  // namespace
}  // namespace passo
