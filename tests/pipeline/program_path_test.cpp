#include "passo/api/program_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "passo/api/program_store.hpp"
#include "passo/geometry/vector3.hpp"

namespace passo {
namespace {

Point at(double x, double y, double z) {
  Point point;
  point[Axis::x] = x;
  point[Axis::y] = y;
  point[Axis::z] = z;
  return point;
}

Segment line(const Point& from, const Point& to, std::uint32_t number, bool rapid = false) {
  Segment segment;
  segment.curve = Curve::line(from, to);
  segment.rapid = rapid;
  segment.source.line = number;
  return segment;
}

struct Read {
  std::vector<std::array<double, 3>> places;
  std::vector<std::uint16_t> flags;
  std::vector<std::uint32_t> lines;
};

Read read_chunk(const std::string& bytes) {
  std::uint32_t head[4];
  float origin[3];
  float step[3];
  std::memcpy(head, bytes.data(), sizeof head);
  std::memcpy(origin, bytes.data() + 16, sizeof origin);
  std::memcpy(step, bytes.data() + 28, sizeof step);
  EXPECT_EQ(bytes.size(), 40 + std::size_t{head[1]} * 12);
  Read read;
  for (std::uint32_t i = 0; i < head[1]; ++i) {
    std::uint16_t packed[4];
    std::memcpy(packed, bytes.data() + 40 + std::size_t{i} * 8, sizeof packed);
    read.places.push_back({origin[0] + double(step[0]) * packed[0], origin[1] + double(step[1]) * packed[1],
                           origin[2] + double(step[2]) * packed[2]});
    read.flags.push_back(packed[3]);
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + 40 + std::size_t{head[1]} * 8 + std::size_t{i} * 4, sizeof number);
    read.lines.push_back(number);
  }
  return read;
}

TEST(ProgramPath, has_a_point_for_each_end_of_a_motion) {
  ProgramPath path;
  path.add(line(at(0, 0, 0), at(10, 0, 5), 3, true));
  path.add(line(at(10, 0, 5), at(10, 20, -1), 4));
  path.finish();
  ASSERT_EQ(path.chunks(), 1U);
  const Read read = read_chunk(path.chunk(0, 0));
  ASSERT_EQ(read.places.size(), 3U);
  EXPECT_EQ(read.lines, (std::vector<std::uint32_t>{3, 3, 4}));
  EXPECT_EQ(read.flags, (std::vector<std::uint16_t>{1, 1, 0}));
  EXPECT_NEAR(read.places[1][0], 10, 1e-3);
  EXPECT_NEAR(read.places[2][1], 20, 1e-3);
  EXPECT_NEAR(read.places[2][2], -1, 1e-3);
  EXPECT_EQ(path.all().low[0], 0);
  EXPECT_EQ(path.cuts().low[0], 10) << "the rapid is no cut";
}

// A square of 40 by 20 whose axes lie at 30 degrees on the machine.
TEST(ProgramPath, tells_the_box_along_the_axes_of_a_turned_work) {
  ProgramStore store;
  store.set_offsets({{5220, 1}, {5221, 7}, {5230, 30}}, {});
  const std::uint64_t id = store.add("turned", Dialect::linuxcnc, "G1 X0 Y0 F600\nX40\nY20\nX0\nY0\nM2\n")->id;
  store.check(id, MachineDescription(), Point());
  for (int i = 0; i < 100; ++i) store.poll();
  const ProgramPath& path = store.find(id)->path_points;
  ASSERT_TRUE(path.complete());
  EXPECT_NEAR(path.work().high[0], 40, 1e-9);
  EXPECT_NEAR(path.work().low[1], 0, 1e-9);
  EXPECT_NEAR(path.work().high[1], 20, 1e-9);
  EXPECT_NEAR(path.cuts().high[1], 40 * std::sin(std::numbers::pi / 6) + 20 * std::cos(std::numbers::pi / 6), 1e-9)
      << "the box on the machine is larger";
}

TEST(ProgramPath, tells_how_far_all_moves_reach_rapids_and_g53_too) {
  ProgramStore store;
  store.set_offsets({{5220, 1}, {5221, 7}}, {});
  const std::string text = "G0 X100 Y-50\nG53 G0 Z30\nG1 X0 Y0 F600\nX5\nG0 A90\nM2\n";
  const std::uint64_t id = store.add("far", Dialect::linuxcnc, text)->id;
  store.check(id, MachineDescription(), Point());
  for (int i = 0; i < 100; ++i) store.poll();
  const ProgramPath& path = store.find(id)->path_points;
  ASSERT_TRUE(path.complete() && path.reach());
  EXPECT_NEAR(path.reach()->work.high[Axis::x], 100, 1e-9) << "a rapid is a move";
  EXPECT_NEAR(path.reach()->machine.high[Axis::x], 107, 1e-9);
  EXPECT_NEAR(path.reach()->work.low[Axis::x], -7, 1e-9) << "the first one begins where the machine stands";
  EXPECT_NEAR(path.reach()->machine.low[Axis::y], -50, 1e-9);
  EXPECT_NEAR(path.reach()->machine.high[Axis::z], 30, 1e-9);
  EXPECT_NEAR(path.reach()->machine.high[Axis::a], 90, 1e-9);
}

TEST(ProgramPath, tells_how_far_an_arc_bulges_along_the_axes_of_a_turned_work) {
  ProgramStore store;
  store.set_offsets({{5220, 1}, {5221, 7}, {5230, 30}}, {});
  const std::uint64_t id = store.add("turned", Dialect::linuxcnc, "G1 X40 Y0 F600\nG3 X0 Y0 I-20\nM2\n")->id;
  store.check(id, MachineDescription(), Point());
  for (int i = 0; i < 100; ++i) store.poll();
  EXPECT_NEAR(store.find(id)->path_points.work().high[1], 20, 1e-9) << "not the highest of its chords";
}

TEST(ProgramPath, tells_the_programmed_speed_of_each_feed) {
  ProgramPath path;
  for (const double speed : {0.01, 1.0, 25.0, 5000.0}) {
    Segment segment = line(at(0, 0, 0), at(10, 0, 0), 1);
    segment.speed = MmPerSecond(speed);
    path.add(segment);
  }
  path.finish();
  const Read read = read_chunk(path.chunk(0, 0));
  ASSERT_EQ(read.flags.size(), 5U);
  EXPECT_EQ(read.flags[1] >> 8U, 1U) << "slower ones look like this";
  EXPECT_EQ(read.flags[2] >> 8U, 96U);
  EXPECT_NEAR(std::exp2((read.flags[3] >> 8U) / 16.0 - 6), 25, 0.6);
  EXPECT_EQ(read.flags[4] >> 8U, 255U) << "faster ones look like this";
  EXPECT_EQ(path.speeds().low, MmPerSecond(0.01));
  EXPECT_EQ(path.speeds().high, MmPerSecond(5000));
}

TEST(ProgramPath, keeps_chords_near_their_arc) {
  ProgramPath path;
  Segment segment;
  segment.curve = Curve::arc(at(50, 0, 0), at(50, 0, -3), Axis::x, Axis::y, 0, 0, 2 * std::numbers::pi);
  path.add(segment);
  path.finish();
  const Read read = read_chunk(path.chunk(0, 0));
  EXPECT_GT(read.places.size(), 100U);
  for (std::size_t i = 1; i < read.places.size(); ++i) {
    const auto& a = read.places[i - 1];
    const auto& b = read.places[i];
    EXPECT_NEAR(std::hypot((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), 50, 0.01);
  }
  EXPECT_NEAR(path.all().low[0], -50, 0.01);
}

// How far a point of the fine level is from the coarse one, at most. Both are of the same chunk.
double farthest_off(const Read& coarse, const Read& fine) {
  const auto vector = [](const auto& place) { return Vector3{place[0], place[1], place[2]}; };
  double most = 0;
  std::size_t next = 1;
  for (std::size_t i = 0; i < fine.places.size(); ++i) {
    while (next + 1 < coarse.places.size() && coarse.lines[next] < fine.lines[i]) ++next;
    const Vector3 place = vector(fine.places[i]);
    const Vector3 nearest = nearest_of(vector(coarse.places[next - 1]), vector(coarse.places[next]), place);
    most = std::max(most, length(place - nearest));
  }
  return most;
}

// A way there and back, a corner, a wave and a standstill: a coarse level is nowhere farther off than it may be.
TEST(ProgramPath, is_near_at_every_level) {
  ProgramPath path;
  std::vector<Point> places;
  for (int i = 0; i <= 200; ++i) places.push_back(at(i * 0.5, 0, 0));
  for (int i = 0; i <= 200; ++i) places.push_back(at(100 - i * 0.5, 0.001, 0));
  for (int i = 0; i <= 400; ++i) places.push_back(at(i * 0.25, 20 + 0.4 * std::sin(i * 0.7), std::cos(i * 0.05)));
  for (int i = 0; i <= 50; ++i) places.push_back(at(100, 20, 1 + i * 1e-6));
  for (std::size_t i = 1; i < places.size(); ++i) {
    path.add(line(places[i - 1], places[i], static_cast<std::uint32_t>(i), false));
  }
  path.finish();
  const Read fine = read_chunk(path.chunk(0, 0));
  const double diagonal = path.all().diagonal();
  EXPECT_LE(farthest_off(read_chunk(path.chunk(0, 1)), fine), diagonal / 4000 + 0.003);
  EXPECT_LE(farthest_off(read_chunk(path.chunk(0, 2)), fine), diagonal / 800 + 0.003);
  EXPECT_LT(read_chunk(path.chunk(0, 2)).places.size(), 120U);
}

// A long program: chunks go on where the one before has ended, and a coarse level loses no more than it may.
TEST(ProgramPath, divides_a_long_program_and_thins_it) {
  ProgramPath path;
  const auto place = [](int i) { return at(100 * std::cos(i * 0.001), 100 * std::sin(i * 0.001), i * 1e-4); };
  constexpr int moves = 40'000;
  for (int i = 0; i < moves; ++i)
    path.add(line(place(i), place(i + 1), static_cast<std::uint32_t>(i + 1), i % 10'000 == 0));
  path.finish();
  ASSERT_EQ(path.chunks(), 3U);
  EXPECT_EQ(path.points(), std::size_t{moves + 1});
  std::size_t whole = 0;
  Read before;
  for (std::size_t c = 0; c < path.chunks(); ++c) {
    const Read fine = read_chunk(path.chunk(c, 0));
    whole += fine.places.size() - 1;
    for (std::size_t i = 0; i < fine.places.size(); ++i) {
      const Point right = place(static_cast<int>(fine.lines[i]) - (c == 0 && i == 0 ? 1 : 0));
      EXPECT_NEAR(fine.places[i][0], right[Axis::x], 200.0 / 65'535);
      EXPECT_NEAR(fine.places[i][2], right[Axis::z], 200.0 / 65'535);
    }
    if (c > 0) {
      EXPECT_EQ(fine.lines.front(), before.lines.back());
    }
    before = fine;
    const Read coarse = read_chunk(path.chunk(c, 2));
    EXPECT_LT(coarse.places.size() * 100, fine.places.size());
    EXPECT_LE(farthest_off(coarse, fine), std::hypot(200, 200, 4) / 800 + 0.005);
    EXPECT_EQ(coarse.lines.front(), fine.lines.front());
    EXPECT_EQ(coarse.lines.back(), fine.lines.back());
    const auto rapids = [](const Read& read) { return std::count(read.flags.begin() + 1, read.flags.end(), 1); };
    EXPECT_EQ(rapids(coarse), rapids(fine)) << "a rapid is never left out";
  }
  EXPECT_EQ(whole, std::size_t{moves});
}

TEST(ProgramPath, of_a_program_without_motion_is_empty) {
  ProgramPath path;
  path.finish();
  EXPECT_TRUE(path.complete());
  EXPECT_EQ(path.chunks(), 0U);
  EXPECT_TRUE(path.all().empty());
}

TEST(ProgramStore, gives_windows_of_a_text) {
  ProgramStore store;
  std::string text;
  for (int i = 1; i <= 1000; ++i) text += "N" + std::to_string(i) + "\n";
  const StoredProgram* const program = store.add("long", Dialect::linuxcnc, text + "N1001");
  EXPECT_EQ(program->lines, 1001U);
  EXPECT_EQ(program->lines_from(1, 2), "N1\nN2\n");
  EXPECT_EQ(program->lines_from(0, 1), "N1\n");
  EXPECT_EQ(program->lines_from(257, 1), "N257\n");
  EXPECT_EQ(program->lines_from(600, 2), "N600\nN601\n");
  EXPECT_EQ(program->lines_from(1001, 5), "N1001");
  EXPECT_EQ(program->lines_from(1002, 5), "");
  EXPECT_EQ(store.add("empty", Dialect::linuxcnc, "")->lines, 0U);
  EXPECT_EQ(store.add("end", Dialect::linuxcnc, "\n\n")->lines_from(2, 9), "\n");
}

TEST(ProgramPath, tells_which_tool_makes_each_motion) {
  ProgramPath path;
  const auto change_to = [&](std::int32_t tool) { path.add(Action{.kind = Action::Kind::tool_change, .tool = tool}); };
  path.add(line(at(0, 0, 0), at(1, 0, 0), 1));
  change_to(7);
  Segment segment = line(at(1, 0, 0), at(2, 0, 0), 2);
  segment.work_zero = at(0, 0, 30);
  path.add(segment);
  change_to(2);
  path.add(line(at(2, 0, 0), at(3, 0, 0), 3, true));
  change_to(7);
  path.add(line(at(3, 0, 0), at(4, 0, 0), 4));
  path.finish();
  ASSERT_EQ(path.tools().size(), 3U);
  EXPECT_EQ(path.tools()[1].number, 7);
  EXPECT_EQ(path.tools()[1].zero_z, 30);
  EXPECT_TRUE(path.tools()[0].feeds && path.tools()[1].feeds);
  EXPECT_FALSE(path.tools()[2].feeds);
  const Read read = read_chunk(path.chunk(0, 0));
  EXPECT_EQ(read.flags, (std::vector<std::uint16_t>{0, 0, 2, 5, 2}));
  // A coarser level keeps each change, though the points lie on one line.
  EXPECT_EQ(read_chunk(path.chunk(0, 2)).flags, read.flags);
}

}  // namespace
}  // namespace passo
