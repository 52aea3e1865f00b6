// Each cell after one straight move, against the lowest underside of the tool found by trying places along the way.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>

#include "cut_stock.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::CutBlock;
using test::point_at;

// The underside of a tool, written once more: what a cutter is, without the roots that are solved for its sweep.
double underside(const ToolShape& tool, double d) {
  const double radius = tool.radius.value();
  const double tip = tool.tip_radius.value();
  const auto ball = [](double r, double away) { return r - std::sqrt(std::max(0.0, r * r - away * away)); };
  switch (tool.kind) {
    case ToolShape::Kind::flat: return 0;
    case ToolShape::Kind::ball: return ball(radius, d);
    case ToolShape::Kind::v: return d <= tip ? 0 : (d - tip) / std::tan(tool.half_angle);
    case ToolShape::Kind::bull_nose: return d <= radius - tip ? 0 : ball(tip, d - radius + tip);
    case ToolShape::Kind::tapered_ball: {
      const double meets = tip * std::cos(tool.half_angle);
      return d <= meets ? ball(tip, d) : ball(tip, meets) + (d - meets) / std::tan(tool.half_angle);
    }
  }
  return 0;
}

struct Way {
  Vector3 from;
  Vector3 to;
};

double at(const ToolShape& tool, const Way& way, double x, double y, double share) {
  const Vector3 tip = way.from + (way.to - way.from) * share;
  const double d = std::hypot(x - tip.x, y - tip.y);
  return d > tool.radius.value() ? std::numeric_limits<double>::infinity() : tip.z + underside(tool, d);
}

// Tries many places of the part of the way from where the tool reaches the place, and then closer and closer ones
// around the best.
double lowest(const ToolShape& tool, const Way& way, double x, double y) {
  const double way_x = way.to.x - way.from.x;
  const double way_y = way.to.y - way.from.y;
  const double level = std::hypot(way_x, way_y);
  double from = 0;
  double to = 1;
  if (level > 0) {
    const double nearest = ((x - way.from.x) * way_x + (y - way.from.y) * way_y) / (level * level);
    const double around = (tool.radius.value() + 0.01) / level;
    from = std::clamp(nearest - around, 0.0, 1.0);
    to = std::clamp(nearest + around, 0.0, 1.0);
  }
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 7; ++round) {
    constexpr int places = 60;
    double where = 0;
    double here = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= places; ++i) {
      const double share = from + (to - from) * i / places;
      const double z = at(tool, way, x, y, share);
      if (z < here) {
        here = z;
        where = share;
      }
    }
    best = std::min(best, here);
    const double step = (to - from) / places;
    from = std::max(0.0, where - step);
    to = std::min(1.0, where + step);
  }
  return best;
}

// How far a place is from the edge of what the tool sweeps, seen from above.
double from_edge(const ToolShape& tool, const Way& way, double x, double y) {
  const Vector3 place{x, y, 0};
  const Vector3 near = nearest_of({way.from.x, way.from.y, 0}, {way.to.x, way.to.y, 0}, place);
  return std::abs(length(near - place) - tool.radius.value());
}

class SweepOracle : public testing::TestWithParam<ToolShape::Kind> {
 protected:
  double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  ToolShape tool() {
    ToolShape tool{.kind = GetParam(), .radius = Mm(random(0.4, 4))};
    const double radius = tool.radius.value();
    tool.half_angle = random(0.1, 1.4);
    switch (tool.kind) {
      case ToolShape::Kind::v: tool.tip_radius = Mm(random(0, 1) < 0.3 ? 0 : random(0, 0.8) * radius); break;
      case ToolShape::Kind::bull_nose: tool.tip_radius = Mm(random(0.05, 0.95) * radius); break;
      case ToolShape::Kind::tapered_ball: tool.tip_radius = Mm(random(0.1, 0.9) * radius); break;
      default: break;
    }
    return tool;
  }

  Way way() {
    const Vector3 from{random(-3, 18), random(-3, 13), random(-6, 1)};
    const double kind = random(0, 1);
    if (kind < 0.1) return {from, {from.x, from.y, random(-6, 1)}};                                     // a plunge
    if (kind < 0.25) return {from, {random(-3, 18), random(-3, 13), from.z}};                           // on the level
    if (kind < 0.35) return {from, {random(-3, 18), from.y, random(-6, 1)}};                            // along X
    if (kind < 0.55) return {from, from + Vector3{random(-.2, .2), random(-.2, .2), random(-.2, .2)}};  // short
    if (kind < 0.65) return {from, from + Vector3{random(-.01, .01), random(-.01, .01), random(-4, 4)}};  // steep
    if (kind < 0.75) return {from, from + Vector3{random(-9, 9), random(-9, 9), random(-.1, .1)}};  // nearly level
    if (kind < 0.8) return {from * 20, from * -20};                                                 // long
    return {from, {random(-3, 18), random(-3, 13), random(-6, 1)}};
  }

  std::mt19937_64 random_{test::seed()};
};

TEST_P(SweepOracle, finds_no_lower_and_no_higher_underside_than_the_closed_form) {
  const StockBlock block{{0, 0, -5}, {15, 10, 0}};
  constexpr double cell = 0.25;
  const char* const given = std::getenv("PASSO_RUNS");
  const int runs = given != nullptr ? std::atoi(given) : 12;
  // What docs/manual/simulate.md promises: for round corners, on ways that are next to level, 0.3 um a mm of radius.
  const double most = GetParam() == ToolShape::Kind::bull_nose ? 1.2e-3 : 5e-4;
  double worst = 0;
  for (int i = 0; i < runs; ++i) {
    const ToolShape cutter = tool();
    const Way way_of_tip = way();
    CutBlock stock(block, cell, {.tools = {cutter}});
    const auto place = [](const Vector3& v) { return point_at(v.x, v.y, v.z); };
    stock.line(place(way_of_tip.from), place(way_of_tip.to));
    stock.cutter.finish();
    for (std::size_t row = 0; row < stock.field.rows(); ++row) {
      for (std::size_t column = 0; column < stock.field.columns(); ++column) {
        const double x = stock.field.x_of(column);
        const double y = stock.field.y_of(row);
        if (from_edge(cutter, way_of_tip, x, y) < 2e-3) continue;
        const double expected = std::clamp(lowest(cutter, way_of_tip, x, y), -5.0, 0.0);
        worst = std::max(worst, std::abs(stock.field.height(column, row) - expected));
        ASSERT_NEAR(stock.field.height(column, row), expected, most)
            << "move " << i << " at " << x << ", " << y << " radius " << cutter.radius.value() << " tip "
            << cutter.tip_radius.value() << " angle " << cutter.half_angle << " from " << way_of_tip.from.x << ", "
            << way_of_tip.from.y << ", " << way_of_tip.from.z << " to " << way_of_tip.to.x << ", " << way_of_tip.to.y
            << ", " << way_of_tip.to.z;
      }
    }
  }
  std::printf("worst: %.3f um in %d moves\n", worst * 1000, runs);
}

std::string name_of_parameter(const testing::TestParamInfo<ToolShape::Kind>& info) {
  const std::string name(name_of(info.param));
  return name.substr(0, name.find('-'));
}

INSTANTIATE_TEST_SUITE_P(Tools, SweepOracle,
                         testing::Values(ToolShape::Kind::flat, ToolShape::Kind::ball, ToolShape::Kind::v,
                                         ToolShape::Kind::bull_nose, ToolShape::Kind::tapered_ball),
                         name_of_parameter);

}  // namespace
}  // namespace passo
