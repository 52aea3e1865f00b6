// Programs of bodies, judged by exact contact with the triangles at places 0.05 mm apart: no feed move cuts into the
// body.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "body_faces.hpp"
#include "contact_oracle.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

using namespace test;

Faces cone(double x, double y, double z0, double z1, double r0, double r1, int parts) {
  Faces faces;
  for (int i = 0; i < parts; ++i) {
    const double a = 2 * M_PI * i / parts;
    const double b = 2 * M_PI * (i + 1) / parts;
    const auto at = [&](double angle, double r, double z) {
      return SurfacePoint{x + r * std::cos(angle), y + r * std::sin(angle), z};
    };
    faces.push_back({at(a, r0, z0), at(b, r0, z0), at(b, r1, z1)});
    faces.push_back({at(a, r0, z0), at(b, r1, z1), at(a, r1, z1)});
    faces.push_back({SurfacePoint{x, y, z1}, at(a, r1, z1), at(b, r1, z1)});
  }
  return faces;
}

struct Body {
  const char* name;
  Faces faces;
};

std::vector<Body> bodies(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  const Faces base = box(0, 0, -1, 20, 15, 0);
  std::vector<Body> all;
  all.push_back({"walls between nodes", base});
  add(all.back().faces, turned(box(4.013, 3.217, 0, 12.3, 11.1, 4), 17.3, 8, 7));
  add(all.back().faces, box(15.007, 2.003, 0, 18.111, 12.777, 3));
  all.push_back({"thin ribs", base});
  for (int i = 0; i < 5; ++i) {
    const double x = 2 + 4 * i + share(random) * 0.3;
    add(all.back().faces, turned(box(x, 2, 0, x + 0.002 + 0.01 * i, 12, 4), 90 * share(random), x, 7));
  }
  all.push_back({"tips and cylinders", base});
  for (int i = 0; i < 4; ++i) {
    add(all.back().faces, cone(3 + 4.5 * i + share(random), 4 + share(random), 0, 4, 1.5, 0.001, 12));
    add(all.back().faces, cone(3 + 4.5 * i + share(random), 10 + share(random), 0, 3, 1.2, 1.2, 40));
  }
  all.push_back({"an undercut", base});
  add(all.back().faces, cone(7, 7, 0, 4, 0.5, 3.3, 30));
  add(all.back().faces, cone(14, 8, 2, 3, 2.7, 2.5, 30));
  all.push_back({"a noisy scan", terrain(20, 15, 60, 45, [&](double x, double y) {
                   return 1.5 * std::sin(x * 0.7) * std::cos(y * 0.5) + 0.1 * share(random);
                 })});
  all.push_back({"cliffs", terrain(20, 15, 40, 30, [](double x, double y) {
                   return 4 * std::round(0.5 + 0.5 * std::sin(x * 0.9 + std::sin(y)));
                 })});
  return all;
}

// The body where the program carves it: its lower left corner at X0 Y0, its top at Z0.
Faces placed(Faces faces) {
  SurfacePoint low = faces[0][0];
  double top = low.z;
  for (const SurfaceTriangle& face : faces) {
    for (const SurfacePoint& p : face) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), 0};
      top = std::max(top, p.z);
    }
  }
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& p : face) p = {p.x - low.x, p.y - low.y, p.z - top};
  }
  return faces;
}

struct Depth {
  double deepest = 0;
  std::string where = {};
  std::size_t places = 0;
};

Depth depth_of(ContactOracle body, const std::string& program, const std::vector<OracleCutter>& tools) {
  Depth found;
  for (const ReadMove& move : moves_of(program)) {
    if (move.is_rapid) continue;
    const OracleCutter& cutter = tools[tools.size() > 1 ? move.tool - 1 : 0];
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / 0.05)));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      const double depth = body.depth(cutter, at(0), at(1), at(2));
      ++found.places;
      if (depth <= found.deepest) continue;
      found.deepest = depth;
      found.where = "line " + std::to_string(move.line) + ", X" + std::to_string(at(0)) + " Y" + std::to_string(at(1));
    }
  }
  return found;
}

constexpr double most_depth = 0.001;  // mm; the program is rounded to 0.1 um, the heights to 0.015 um

TEST(BodyCarving, never_cuts_into_a_body) {
  std::mt19937_64 random(seed());
  const FinishStrategy ways[] = {FinishStrategy::rows, FinishStrategy::contours, FinishStrategy::columns,
                                 FinishStrategy::spiral};
  std::size_t i = 0;
  for (const Body& body : bodies(random)) {
    const OracleCutter& cutter = oracle_cutters()[i % oracle_cutters().size()];
    ReliefProgramOptions options = options_of(cutter.text);
    options.finish.step_over = Mm(1);
    options.way = ways[i % 4];
    options.ramps = options.way != FinishStrategy::contours;
    options.beside = BesideGrid::nothing;
    ++i;
    Diagnostics diagnostics;
    const HeightGrid grid = relief_of({.faces = body.faces}, {.pitch = Mm(0.11)}, "it", diagnostics);
    const Depth depth = depth_of(ContactOracle(placed(body.faces)), written(grid, options).text, {cutter});
    EXPECT_LE(depth.deepest, most_depth) << body.name << ", " << cutter.text << ", " << depth.where;
    EXPECT_GT(depth.places, 2000U);
  }
}

// Pits between the triangles of a smooth surface may be narrower than the tolerance by which contours are moved.
TEST(BodyCarving, contours_never_cut_into_the_sides_of_narrow_pits) {
  const Faces body = terrain(8, 6, 16, 12, [](double x, double y) {
    return 3 * std::sin(x * 0.7) * std::cos(y * 0.5) + 0.6 * std::sin(x * 1.7 + y);
  });
  ReliefProgramOptions options = options_of("ball:3");
  options.finish.step_over = Mm(0.4);
  options.way = FinishStrategy::contours;
  options.ramps = false;
  options.beside = BesideGrid::nothing;
  Diagnostics diagnostics;
  const HeightGrid grid = relief_of({.faces = body}, {.pitch = Mm(0.03)}, "it", diagnostics);
  const Depth depth = depth_of(ContactOracle(placed(body)), written(grid, options).text, {oracle_of("ball:3")});
  EXPECT_LE(depth.deepest, most_depth) << depth.where;
}

// On a wall that is not along X or Y the grid is a staircase. The path is straight all the same, and near the wall.
TEST(BodyCarving, contours_do_not_copy_the_stairs_of_a_wall) {
  constexpr double pitch = 0.03;
  const Faces body = turned(box(0, 0, -4, 12, 12, 0), 27, 6, 6);
  ReliefProgramOptions options = options_of("flat:3");
  options.finish.step_over = Mm(1);
  options.way = FinishStrategy::contours;
  options.ramps = false;
  options.beside = BesideGrid::nothing;
  Diagnostics diagnostics;
  const HeightGrid grid = relief_of({.faces = body}, {.pitch = Mm(pitch)}, "it", diagnostics);
  const std::string program = written(grid, options).text;
  const Faces where = placed(body);
  const Depth depth = depth_of(ContactOracle(where), program, {oracle_of("flat:3")});
  EXPECT_LE(depth.deepest, most_depth) << depth.where;
  const double middle = 6 * (std::cos(27 * M_PI / 180) + std::sin(27 * M_PI / 180));
  std::size_t moves = 0;
  double farthest = 0;
  for (const ReadMove& move : moves_of(program)) {
    if (move.is_rapid || move.is_arc || move.to[2] != move.from[2]) continue;
    if (move.to[2] > -0.5 || move.to[2] < -3.9) continue;  // rows
    ++moves;
    const double x = move.to[0] - middle;
    const double y = move.to[1] - middle;
    const double along = std::abs(x * std::cos(27 * M_PI / 180) + y * std::sin(27 * M_PI / 180));
    const double across = std::abs(y * std::cos(27 * M_PI / 180) - x * std::sin(27 * M_PI / 180));
    farthest = std::max(farthest, std::hypot(std::max(along - 6, 0.0), std::max(across - 6, 0.0)) - 1.5);
  }
  EXPECT_GT(moves, 16U);
  EXPECT_LT(moves, 400U);          // a line for each cell would be 1,600 a level
  EXPECT_LT(farthest, 4 * pitch);  // as the stairs
}

TEST(BodyCarving, with_three_cutters_never_cuts_into_a_body) {
  std::mt19937_64 random(seed());
  const std::vector<OracleCutter> tools = {oracle_of("flat:2.3"), oracle_of("ball:3"), oracle_of("taper:1:10:3")};
  const Body body = bodies(random)[1];
  ReliefProgramOptions options = three_tools();
  options.finish.step_over = options.rest->tool.step_over = Mm(1);
  options.beside = BesideGrid::nothing;
  options.roughing->way = RoughStrategy::offsets;
  Diagnostics diagnostics;
  const HeightGrid grid = relief_of({.faces = body.faces}, {.pitch = Mm(0.11)}, "it", diagnostics);
  const Depth depth = depth_of(ContactOracle(placed(body.faces)), written(grid, options).text, tools);
  EXPECT_LE(depth.deepest, most_depth) << depth.where;
}

// A node of the grid that lies below the body is found: the oracle is no rubber stamp.
TEST(BodyCarving, the_oracle_finds_a_rib_that_is_cut_away) {
  const Faces rib = box(10.04, 2, 0, 10.06, 12, 4);
  Faces body = box(0, 0, -1, 20, 15, 0);
  add(body, rib);
  HeightGrid flat{.columns = 3, .rows = 3, .pitch_x = Mm(10), .pitch_y = Mm(7.5)};
  flat.heights.assign(9, -4.0F);
  const Depth depth =
      depth_of(ContactOracle(placed(body)), written(flat, options_of("ball:3")).text, {oracle_of("ball:3")});
  EXPECT_NEAR(depth.deepest, 4, 1e-3);
}

// The surface lies nowhere below the body, and hardly above it where the body is smooth.
TEST(BodyCarving, covers_a_smooth_body_closely) {
  const auto height = [](double x, double y) { return std::sin(x * 0.7) * std::cos(y * 0.5) + x * 0.3; };
  Faces faces = terrain(20, 15, 200, 150, height);
  Diagnostics diagnostics;
  const HeightGrid grid = relief_of({.faces = faces}, {.pitch = Mm(0.0713)}, "it", diagnostics);
  double top = -100;
  for (const SurfaceTriangle& face : faces) {
    for (const SurfacePoint& p : face) top = std::max(top, p.z);
  }
  double most = 0;
  for (double y = 0.3; y < 14.7; y += 0.37) {
    for (double x = 0.3; x < 19.7; x += 0.31) {
      const double above = surface_at(grid, x, y) - (height(x, y) - top);
      EXPECT_GE(above, -2e-3) << x << ", " << y;  // the triangles are chords of the function
      most = std::max(most, above);
    }
  }
  EXPECT_LE(most, 4e-3);
}

double volume_above(const HeightGrid& grid) {
  double sum = 0;
  for (const float height : grid.heights) sum += static_cast<double>(height);
  return sum / static_cast<double>(grid.heights.size());
}

TEST(BodyCarving, walls_grow_by_less_than_two_cells) {
  Faces body = box(0, 0, -1, 20, 15, 0);
  add(body, box(5.03, 4.04, 0, 14.97, 11.06, 4));
  Diagnostics diagnostics;
  const HeightGrid grid = relief_of({.faces = body}, {.pitch = Mm(0.1)}, "it", diagnostics);
  for (double y = 0; y <= 15; y += 0.05) {
    for (double x = 0; x <= 20; x += 0.05) {
      const double out = std::max({5.03 - x, x - 14.97, 4.04 - y, y - 11.06});
      const double height = surface_at(grid, x, y);
      if (out <= 0) {
        ASSERT_EQ(height, 0) << x << ", " << y;
      } else if (out >= 0.2) {
        ASSERT_EQ(height, -4) << x << ", " << y;
      }
    }
  }
}

// Upside down, a rib becomes a groove, and the walls of what was low must not be cut.
TEST(BodyCarving, an_inverted_or_bent_body_is_covered_too) {
  Faces body = box(0, 0, -1, 20, 15, 0);
  add(body, turned(box(5.03, 4.04, 0, 14.97, 11.06, 4), 10, 10, 7));
  const Surface from_above(body);
  Diagnostics diagnostics;
  for (const bool invert : {false, true}) {
    for (const double gamma : {0.5, 1.0, 2.0}) {
      const HeightGrid grid =
          relief_of({.faces = body}, {.gamma = gamma, .invert = invert, .pitch = Mm(0.1)}, "it", diagnostics);
      for (double y = 0.013; y <= 15; y += 0.0517) {
        for (double x = 0.017; x <= 20; x += 0.0531) {
          double share = (from_above.top(x, y) + 1) / 5;
          if (invert) share = 1 - share;
          ASSERT_GE(surface_at(grid, x, y), 5 * (std::pow(share, gamma) - 1) - 2e-5)
              << x << ", " << y << ", gamma " << gamma << (invert ? ", inverted" : "");
        }
      }
      EXPECT_LT(volume_above(grid), -0.5);
    }
  }
}

}  // namespace
}  // namespace passo
