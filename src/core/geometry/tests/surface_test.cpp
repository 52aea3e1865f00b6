#include "passo/geometry/surface.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "kit/seed.hpp"

namespace passo {
namespace {

// A ball of radius 10 around 0, with upright triangles too.
Surface ball() {
  std::vector<SurfaceTriangle> triangles;
  constexpr int parts = 24;
  const auto at = [](int around, int up) {
    const double a = around * 2 * std::numbers::pi / parts;
    const double b = up * std::numbers::pi / parts;
    return SurfacePoint{10 * std::sin(b) * std::cos(a), 10 * std::sin(b) * std::sin(a), 10 * std::cos(b)};
  };
  for (int around = 0; around < parts; ++around) {
    for (int up = 0; up < parts; ++up) {
      triangles.push_back({at(around, up), at(around + 1, up), at(around, up + 1)});
      triangles.push_back({at(around + 1, up), at(around + 1, up + 1), at(around, up + 1)});
    }
  }
  return Surface(triangles);
}

// Two steps, the wall between them at X5, and a hole in the low one.
Surface steps() {
  const auto square = [](double x, double y, double size, double z) {
    const SurfacePoint a{x, y, z};
    const SurfacePoint b{x + size, y, z};
    const SurfacePoint c{x + size, y + size, z};
    const SurfacePoint d{x, y + size, z};
    return std::vector<SurfaceTriangle>{{a, b, c}, {a, c, d}};
  };
  std::vector<SurfaceTriangle> triangles = square(0, 0, 5, 2);
  for (const SurfaceTriangle& one : square(5, 0, 5, -3)) triangles.push_back(one);
  triangles.push_back({SurfacePoint{5, 0, 2}, SurfacePoint{5, 0, -3}, SurfacePoint{5, 5, 2}});
  return Surface(triangles);
}

TEST(Surface, has_the_height_of_its_highest_triangle) {
  const Surface surface = steps();
  EXPECT_EQ(surface.top(2, 3), 2);
  EXPECT_EQ(surface.top(5, 3), 2) << "the wall belongs to the higher step";
  EXPECT_EQ(surface.top(5 + 1e-6, 3), -3);
  EXPECT_EQ(surface.top(10, 5), -3);
  EXPECT_EQ(surface.top(10.001, 5), Surface::nothing);
  EXPECT_EQ(surface.top(2, -0.001), Surface::nothing);
  const Surface round = ball();
  EXPECT_NEAR(round.top(0, 0), 10, 1e-9);
  EXPECT_NEAR(round.top(6, 0), 8, 0.1);
  EXPECT_EQ(Surface().top(0, 0), Surface::nothing);
}

TEST(Surface, a_point_within_its_clearance_touches_nothing) {
  std::mt19937_64 engine(test::seed());
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  for (const Surface& surface : {ball(), steps()}) {
    int far = 0;
    for (int i = 0; i < 20'000; ++i) {
      const SurfacePoint from{between(-15, 15), between(-15, 15), between(-5, 14)};
      const double way = surface.clearance(from);
      ASSERT_GE(way, 0);
      const auto moved = [&](double at) { return at + between(-way, way) * (1 - 1e-12); };
      if (way > 0) {
        ASSERT_LT(surface.top(moved(from.x), moved(from.y)), from.z - way * (1 - 1e-12) + 1e-12);
      }
      far += way > 0.5 ? 1 : 0;
      if (surface.top(from.x, from.y) >= from.z) {
        ASSERT_EQ(way, 0);
      }
    }
    EXPECT_GT(far, 8'000) << "it is of use";
  }
}

TEST(Surface, one_upright_triangle_is_no_surface) {
  const Surface surface({{SurfacePoint{1, 1, 0}, SurfacePoint{1, 1, 5}, SurfacePoint{1, 1, 7}}});
  EXPECT_EQ(surface.top(1, 1), Surface::nothing);
  EXPECT_EQ(surface.clearance({1, 1, 8}), 1);
}

}  // namespace
}  // namespace passo
