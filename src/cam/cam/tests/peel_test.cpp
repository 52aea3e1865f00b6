// Pockets by constant engagement: what is cut, and how much of the cutter is in the stock, cell by cell.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "closed_lines.hpp"
#include <gmock/gmock.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/edge_loops.hpp"
#include "passo/cam/pocket.hpp"

namespace passo {
namespace {

using test::box;
using test::circle;
using test::corner;
using test::PathPoints;

struct Peeled {
  PocketPlan plan;
  Region area;
  Diagnostics findings;
};
Peeled peeled(const std::vector<PathPoints>& loops, double cutter, double degrees, bool climb = true) {
  Peeled result;
  result.area = enclosed_by(loops);
  result.plan = plan_pocket(result.area,
                            {.cutter = to_nanometres(Mm(cutter)),
                             .depth = to_nanometres(Mm(-2)),
                             .step = to_nanometres(Mm(2)),
                             .most_engagement = degrees,
                             .climb = climb},
                            result.findings);
  return result;
}

// The stock as small squares, seen from above. Shares no code with the plan.
class StockSquares {
 public:
  StockSquares(double width, double height, double cutter)
      : columns_(static_cast<std::size_t>(width / side)),
        rows_(static_cast<std::size_t>(height / side)),
        radius_(cutter / 2),
        is_stock_(columns_ * rows_, 1) {}

  // The cutter's middle goes to x, y. Returns the angle of its edge that lies in the stock. A square counts from its
  // middle, so only what is more than a square within the edge counts.
  double go_to(double x, double y) {
    int in_stock = 0;
    constexpr int parts = 180;
    for (int i = 0; i < parts; ++i) {
      const double angle = 2 * std::numbers::pi * i / parts;
      const double reach = radius_ - side;
      in_stock += is_stock(x + reach * std::cos(angle), y + reach * std::sin(angle)) ? 1 : 0;
    }
    for (double v = y - radius_; v <= y + radius_; v += side) {
      const double half = std::sqrt(std::max(0.0, radius_ * radius_ - (v - y) * (v - y)));
      for (double u = x - half; u <= x + half; u += side) {
        if (u >= 0 && v >= 0 && u < width() && v < height()) is_stock_[index(u, v)] = 0;
      }
    }
    return in_stock * 360.0 / parts;
  }

 private:
  static constexpr double side = 0.05;  // mm
  double width() const { return static_cast<double>(columns_) * side; }
  double height() const { return static_cast<double>(rows_) * side; }
  std::size_t index(double x, double y) const {
    return static_cast<std::size_t>(y / side) * columns_ + static_cast<std::size_t>(x / side);
  }
  bool is_stock(double x, double y) const {
    return x >= 0 && y >= 0 && x < width() && y < height() && is_stock_[index(x, y)] != 0;
  }

  std::size_t columns_;
  std::size_t rows_;
  double radius_;
  std::vector<char> is_stock_;
};

// The greatest engagement once the cutter is down, by squares.
double engagement_by_squares(const PocketPlan& plan, double width, double height, double cutter) {
  StockSquares stock(width, height, cutter);
  double most = 0;
  bool is_down = false;
  for (const MillRun& run : plan.mill.tools.at(0).runs) {
    double lap = 0;
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const double way = way_nm(run[i].at, run[i + 1].at, run[i].bulge) / 1e6;
      const bool is_level = run[i].z == run[i + 1].z;
      // The helix has a lap at its lower end, no wider than the cutter.
      if (is_level) lap += way;
      is_down = is_down || lap > cutter * std::numbers::pi;
      const double parts = std::ceil(way / 0.12);
      for (double k = 1; k <= parts; ++k) {
        const DrawnPoint at = point_along(run[i].at, run[i + 1].at, run[i].bulge, k / parts);
        const double degrees =
            stock.go_to(static_cast<double>(at.x.count) / 1e6, static_cast<double>(at.y.count) / 1e6);
        if (is_down) most = std::max(most, degrees);
      }
    }
  }
  return most;
}

TEST(Peel, never_has_more_of_the_cutter_in_the_stock_than_asked) {
  const std::vector<std::vector<PathPoints>> shapes = {
      {box(2, 2, 30, 22), circle(13, 12, 4), box(21, 8, 5, 8)},
      {{corner(2, 2), corner(30, 2), corner(30, 9), corner(16, 9), corner(22, 22), corner(2, 16, 0.4)}}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const double degrees = i == 0 ? 60 : 100;
    const Peeled result = peeled(shapes[i], 3, degrees, i == 0);
    ASSERT_FALSE(result.findings.any_error()) << render(result.findings, false);
    EXPECT_LE(result.plan.engagement, degrees);
    EXPECT_GT(result.plan.engagement, 0.8 * degrees) << "the angle is used";
    // Squares tell an angle to some degrees.
    EXPECT_LE(engagement_by_squares(result.plan, 34, 26, 3), degrees + 4);
    EXPECT_LT(result.plan.lost_mm2, 1e-3);
  }
}

TEST(Peel, loops_have_more_engagement_than_that) {
  const Peeled loops = peeled({box(2, 2, 26, 16)}, 3, 0);
  EXPECT_GT(engagement_by_squares(loops.plan, 34, 26, 3), 110);
}

TEST(Peel, leaves_nothing_but_corners) {
  const Peeled result = peeled({box(0, 0, 30, 20), circle(15, 10, 3)}, 4, 60);
  // Four corners with a radius 1.1 times the cutter's.
  EXPECT_NEAR(result.plan.unreached_mm2, 4 * (1 - std::numbers::pi / 4) * 2.2 * 2.2, 0.1);
  EXPECT_EQ(render(result.findings, false), "");
}

// A channel from one wide place to another.
TEST(Peel, leaves_a_slot_and_tells_it) {
  const auto dumbbell = [](double width) {
    return PathPoints{corner(0, 0),
                      corner(12, 0),
                      corner(12, 6 - width / 2),
                      corner(20, 6 - width / 2),
                      corner(20, 0),
                      corner(32, 0),
                      corner(32, 12),
                      corner(20, 12),
                      corner(20, 6 + width / 2),
                      corner(12, 6 + width / 2),
                      corner(12, 12),
                      corner(0, 12)};
  };
  const Peeled narrow = peeled({dumbbell(3.2)}, 3, 60);
  EXPECT_EQ(narrow.plan.pockets, 2U);
  EXPECT_GT(narrow.plan.unreached_mm2, 15) << "the channel stays, and is told";
  const Peeled wide = peeled({dumbbell(3.6)}, 3, 60);
  EXPECT_EQ(wide.plan.pockets, 1U);
  EXPECT_LT(wide.plan.unreached_mm2, 5) << "only corners stay";
  const Peeled slot = peeled({box(0, 0, 20, 3.2)}, 3, 60);

  EXPECT_THAT(render(slot.findings, false), testing::HasSubstr("[pocket.narrow]"));
}

TEST(Peel, goes_down_once_for_each_layer_of_a_simple_pocket) {
  const Peeled result = peeled({circle(15, 15, 10)}, 4, 60);
  ASSERT_EQ(result.plan.mill.tools.at(0).runs.size(), 1U);
  const MillRun& run = result.plan.mill.tools[0].runs[0];
  EXPECT_EQ(run.front().z.count, 0) << "a helix from the face";
  EXPECT_EQ(run.back().z.count, -2'000'000);
  EXPECT_LT(result.plan.unreached_mm2, 1e-3);
}

}  // namespace
}  // namespace passo
