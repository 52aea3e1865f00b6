// Pencil passes: what stands at inner edges without and with one, and that no move cuts into the surface.
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "carved_moves.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

namespace passo {
namespace {

using namespace test;

constexpr double width = 12;
constexpr double length = 10;

template <class Height>
HeightGrid grid_of(const Height& height, double pitch = 0.1) {
  HeightGrid grid{.columns = static_cast<std::size_t>(width / pitch + 1.5),
                  .rows = static_cast<std::size_t>(length / pitch + 1.5),
                  .pitch_x = Mm(pitch),
                  .pitch_y = Mm(pitch)};
  for (std::size_t y = 0; y < grid.rows; ++y) {
    for (std::size_t x = 0; x < grid.columns; ++x) {
      grid.heights.push_back(grid_height(Mm(height(static_cast<double>(x) * pitch, static_cast<double>(y) * pitch))));
    }
  }
  return grid;
}

// A straight line through the middle of the grid.
struct MiddleLine {
  double degrees = 0;

  // Signed distance of a place, positive on the left.
  double across(double x, double y) const {
    const double angle = degrees * std::numbers::pi / 180;
    return (y - length / 2) * std::cos(angle) - (x - width / 2) * std::sin(angle);
  }
  // The place so far along the line, and so far to its left.
  std::pair<double, double> at(double along, double out) const {
    const double angle = degrees * std::numbers::pi / 180;
    return {width / 2 + along * std::cos(angle) - out * std::sin(angle),
            length / 2 + along * std::sin(angle) + out * std::cos(angle)};
  }
};

// How much stands above `bottom` at places along the line, `out` mm to its left, at most.
double most_left(const std::string& program, const OracleCutter& cutter, const MiddleLine& line, double out,
                 double bottom) {
  std::vector<std::pair<double, double>> places;
  for (double along = -3.5; along <= 3.5; along += 0.07) places.push_back(line.at(along, out));
  std::vector<double> left(places.size(), 0);
  for (const ReadMove& move : moves_of(program)) {
    if (move.is_rapid) continue;
    const double way = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(way / 0.05));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double away = std::hypot(places[k].first - at(0), places[k].second - at(1));
        if (away <= cutter.radius) left[k] = std::min(left[k], at(2) + cutter.height(away));
      }
    }
  }
  return *std::max_element(left.begin(), left.end()) - bottom;
}

ReliefProgramOptions pencil_options(bool has_pencil) {
  ReliefProgramOptions options = options_of("ball:3");
  options.tolerance = Mm(0.01);
  options.rows.has_pencil = has_pencil;
  return options;
}

// A groove with flanks of 45 degrees: the ball's tip ends radius * (sqrt(2) - 1) above its bottom.
TEST(ReliefPencil, clears_a_groove_at_any_angle) {
  for (const double degrees : {0.0, 7.0, 45.0, 78.0}) {
    const MiddleLine line{degrees};
    const HeightGrid grid =
        grid_of([&](double x, double y) { return std::min(0.0, -4 + std::abs(line.across(x, y))); });
    const OracleCutter& ball = oracle_of("ball:3");
    const double bottom = -4 + 1.5 * (std::sqrt(2.0) - 1);
    const Written without = written(grid, pencil_options(false));
    const Written with = written(grid, pencil_options(true));
    const double before = most_left(without.text, ball, line, 0, bottom);
    const double after = most_left(with.text, ball, line, 0, bottom);
    EXPECT_LE(after, 0.05) << degrees << " degrees, " << before << " before";
    EXPECT_LE(after, before * 0.75) << degrees << " degrees";
    ASSERT_EQ(with.report.parts.size(), 2U);
    EXPECT_LE(with.report.parts[1].cut.value(), 1.4 * std::hypot(width + 3, length + 3)) << "one way along the groove";
    expect_no_gouge(grid, with.text, {ball}, 41);
  }
}

// The foot of a wall, at its own angle: the ball's axis is a radius away from the wall, and at most a node more.
TEST(ReliefPencil, follows_the_foot_of_a_wall) {
  for (const double degrees : {0.0, 11.0, 52.0}) {
    const MiddleLine line{degrees};
    const HeightGrid grid = grid_of([&](double x, double y) { return line.across(x, y) > 0 ? 0.0 : -4.0; });
    const OracleCutter& ball = oracle_of("ball:3");
    const Written without = written(grid, pencil_options(false));
    const Written with = written(grid, pencil_options(true));
    const double before = most_left(without.text, ball, line, -1.75, -4);
    const double after = most_left(with.text, ball, line, -1.75, -4);
    EXPECT_LE(after, 0.02) << degrees << " degrees, " << before << " before";
    expect_no_gouge(grid, with.text, {ball}, 41);
  }
}

TEST(ReliefPencil, never_cuts_into_a_random_surface) {
  std::mt19937_64 random(seed());
  for (const OracleCutter& cutter : oracle_cutters()) {
    const HeightGrid grid = random_surface(random, 26, 22, Mm(0.2), Mm(0.25));
    ReliefProgramOptions options = options_of(cutter.text);
    options.rows.has_pencil = true;
    expect_no_gouge(grid, written(grid, options).text, {cutter}, 13);
  }
}

// Nothing has an inner edge that a ball of this size can reach: a dome, and waves that are wider than the ball.
TEST(ReliefPencil, leaves_smooth_surfaces_alone) {
  const HeightGrid grid = grid_of([](double x, double y) { return -1 + 0.2 * std::sin(x) * std::cos(y); });
  const Written with = written(grid, pencil_options(true));
  EXPECT_EQ(with.report.parts[1].moves, 0U);
}

TEST(ReliefPencil, uses_the_cutter_of_the_rest_pass) {
  const MiddleLine line{33};
  const HeightGrid grid = grid_of([&](double x, double y) { return std::min(0.0, -4 + std::abs(line.across(x, y))); });
  ReliefProgramOptions options = three_tools();
  options.rows.has_pencil = true;
  const Written program = written(grid, options);
  ASSERT_EQ(program.report.parts.size(), 4U);
  EXPECT_EQ(program.report.parts[3].what, "pencil");
  EXPECT_EQ(program.report.parts[3].tool, program.report.parts[2].tool);
  EXPECT_GT(program.report.parts[3].moves, 1U);
  expect_no_gouge(grid, program.text, {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")}, 17);
}

}  // namespace
}  // namespace passo
