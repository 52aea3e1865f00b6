// The two linear programs of a cell: an entry that the backward pass allows must have an exit in the forward pass.
#include "../speed_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "kit/stage_test.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// The largest demand, as a share of its limit.
double largest_share(std::span<const AxisDemand> demands, double entry, double exit) {
  double most = 0;
  for (const AxisDemand& demand : demands) {
    most = std::max({most, std::abs(demand.entry_x * entry + demand.entry_y * exit) / demand.limit,
                     std::abs(demand.exit_x * entry + demand.exit_y * exit) / demand.limit});
  }
  return most;
}

// From a real program: bend and slope of an axis cancel, and its demand at the exit depends on the exit only through
// rounding. So an x that was right to the last digit but one left a single y, which was wrong: 2 % too strong for the
// other axis.
TEST(SpeedWindow, a_demand_that_hardly_depends_on_the_exit_leaves_one) {
  const std::array<AxisDemand, 2> demands{{{.entry_x = 383.58162811294687,
                                            .entry_y = -384.69328519805271,
                                            .exit_x = 385.28051071937625,
                                            .exit_y = -386.5177557195646,
                                            .limit = 1175.933139777263},
                                           {.entry_x = -42.460898389798942,
                                            .entry_y = 26.917793126717637,
                                            .exit_x = -18.425613448757154,
                                            .exit_y = -3.4745539778668899e-12,
                                            .limit = 1473.7190078116223}}};
  constexpr double top = 299.168912;
  const double entry = largest_entry(demands, top, 82.590051);
  EXPECT_NEAR(entry, 79.982086, 1e-6);
  const double exit = largest_exit(demands, entry, 82.590051);
  EXPECT_LE(largest_share(demands, entry, exit), 1 + 1e-8);
}

struct ShapeAtEnd {
  double slope = 0;
  double bend = 0;
};
AxisDemand demand_of(const ShapeAtEnd& in, const ShapeAtEnd& out, double length, double limit) {
  const double per_way = 1 / (2 * length);
  return {.entry_x = in.bend - in.slope * per_way,
          .entry_y = in.slope * per_way,
          .exit_x = -out.slope * per_way,
          .exit_y = out.bend + out.slope * per_way,
          .limit = limit};
}

// Cells of any curve, including every place on it where bend and slope cancel.
TEST(SpeedWindow, what_is_let_in_comes_through) {
  test::Random random;
  for (int run = 0; run < 20'000; ++run) {
    const double length = std::exp(random.between(-7, 1));
    const double per_way = 1 / (2 * length);
    std::vector<AxisDemand> demands;
    for (int axis = 0; axis < 3; ++axis) {
      const double slope_in = random.between(-1, 1);
      const double slope_out = slope_in + random.between(-0.03, 0.03);
      const bool cancels = random.chance(0.2);
      const double rounding = random.between(-1, 1) * std::exp(random.between(-35, -5));
      const double bend_in = (slope_out - slope_in) / length;
      const double bend_out = cancels ? -slope_out * per_way * (1 + rounding) : bend_in;
      demands.push_back(demand_of({slope_in, bend_in}, {slope_out, bend_out}, length, random.between(100, 1000)));
    }
    const double top = std::exp(random.between(0, 12));
    const double exit_most = random.chance(0.2) ? 0 : random.between(0, top);
    const double entry = largest_entry(demands, top, exit_most);
    for (const double share : {1.0, 0.999, 0.5}) {
      const double exit = largest_exit(demands, share * entry, exit_most);
      ASSERT_LE(exit, exit_most);
      ASSERT_LE(largest_share(demands, share * entry, exit), 1 + 1e-8) << "run " << run << ", share " << share;
    }
  }
}

// By all places where two of the region's edges meet.
double farthest_corner(std::span<const AxisDemand> demands, double top, double exit_most) {
  struct Edge {
    double p, q, limit;
  };
  std::vector<Edge> edges{{1, 0, top}, {-1, 0, 0}, {0, 1, exit_most}, {0, -1, 0}};
  for (const AxisDemand& demand : demands) {
    for (const double sign : {1.0, -1.0}) {
      edges.push_back({sign * demand.entry_x, sign * demand.entry_y, demand.limit});
      edges.push_back({sign * demand.exit_x, sign * demand.exit_y, demand.limit});
    }
  }
  double best = 0;
  for (const Edge& a : edges) {
    for (const Edge& b : edges) {
      const double cross = a.p * b.q - b.p * a.q;
      const double x = (a.limit * b.q - b.limit * a.q) / cross;
      const double y = (a.p * b.limit - b.p * a.limit) / cross;
      if (!(std::abs(cross) > 1e-12) || x < best) continue;
      const bool inside = std::ranges::all_of(edges, [&](const Edge& edge) {
        return edge.p * x + edge.q * y <=
               edge.limit + 1e-9 * (std::abs(edge.p * x) + std::abs(edge.q * y) + edge.limit);
      });
      if (inside) best = x;
    }
  }
  return best;
}

TEST(SpeedWindow, the_largest_entry_is_the_farthest_corner_of_the_region) {
  test::Random random;
  int by_corner = 0;
  for (int run = 0; run < 5'000; ++run) {
    const double length = std::exp(random.between(-4, 0));
    std::vector<AxisDemand> demands;
    for (int axis = 0; axis < 3; ++axis) {
      const double slope_in = random.between(-1, 1);
      const double slope_out = slope_in + random.between(-0.1, 0.1);
      const double bend = (slope_out - slope_in) / length;
      demands.push_back(demand_of({slope_in, bend}, {slope_out, bend}, length, random.between(100, 1000)));
    }
    const double top = std::exp(random.between(0, 12));
    const double exit_most = random.between(0, top);
    const double best = farthest_corner(demands, top, exit_most);
    ASSERT_NEAR(largest_entry(demands, top, exit_most) / best, 1, 1e-8) << "run " << run;
    if (best < top && largest_share(demands, best, exit_most) > 1 + 1e-6) ++by_corner;
  }
  EXPECT_GT(by_corner, 500);
}

}  // namespace
}  // namespace passo
