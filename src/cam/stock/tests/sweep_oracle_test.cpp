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
double underside(const Cutter& cutter, double d) {
  const double radius = cutter.radius.value();
  const double arc = cutter.corner.value();
  const double flat = cutter.flat.value();
  const auto ball = [](double r, double away) { return r - std::sqrt(std::max(0.0, r * r - away * away)); };
  switch (cutter.kind()) {
    case Cutter::Kind::flat: return 0;
    case Cutter::Kind::ball: return ball(radius, d);
    case Cutter::Kind::v: return d <= flat ? 0 : (d - flat) / std::tan(cutter.half_angle.value);
    case Cutter::Kind::bull_nose: return d <= radius - arc ? 0 : ball(arc, d - radius + arc);
    case Cutter::Kind::tapered_ball: {
      const double meets = arc * std::cos(cutter.half_angle.value);
      return d <= meets ? ball(arc, d) : ball(arc, meets) + (d - meets) / std::tan(cutter.half_angle.value);
    }
  }
  return 0;
}

struct Way {
  Vector3 from;
  Vector3 to;
};

double at(const Cutter& cutter, const Way& way, double x, double y, double share) {
  const Vector3 tip = way.from + (way.to - way.from) * share;
  const double d = std::hypot(x - tip.x, y - tip.y);
  return d > cutter.radius.value() ? std::numeric_limits<double>::infinity() : tip.z + underside(cutter, d);
}

// Tries many places of the part of the way from where the tool reaches the place, and then closer and closer ones
// around the best.
double lowest(const Cutter& cutter, const Way& way, double x, double y) {
  const double way_x = way.to.x - way.from.x;
  const double way_y = way.to.y - way.from.y;
  const double level = std::hypot(way_x, way_y);
  double from = 0;
  double to = 1;
  if (level > 0) {
    const double nearest = ((x - way.from.x) * way_x + (y - way.from.y) * way_y) / (level * level);
    const double around = (cutter.radius.value() + 0.01) / level;
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
      const double z = at(cutter, way, x, y, share);
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
double from_edge(const Cutter& cutter, const Way& way, double x, double y) {
  const Vector3 place{x, y, 0};
  const Vector3 near = nearest_of({way.from.x, way.from.y, 0}, {way.to.x, way.to.y, 0}, place);
  return std::abs(length(near - place) - cutter.radius.value());
}

class SweepOracle : public testing::TestWithParam<Cutter::Kind> {
 protected:
  double random(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  Cutter cutter() {
    const double radius = random(0.4, 4);
    const Mm diameter(2 * radius);
    const double half_angle = random(0.1, 1.4);
    switch (GetParam()) {
      case Cutter::Kind::flat: break;
      case Cutter::Kind::ball: return Cutter::ball(diameter);
      case Cutter::Kind::v:
        return Cutter::vee(diameter, {2 * half_angle}, Mm(random(0, 1) < 0.3 ? 0 : random(0, 1.6) * radius));
      case Cutter::Kind::bull_nose: return Cutter::bull_nose(diameter, Mm(random(0.05, 0.95) * radius));
      case Cutter::Kind::tapered_ball:
        return Cutter::tapered_ball(diameter, Mm(random(0.2, 1.8) * radius), {half_angle});
    }
    return Cutter::flat_end(diameter);
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
  const double most = GetParam() == Cutter::Kind::bull_nose ? 1.2e-3 : 5e-4;
  double worst = 0;
  for (int i = 0; i < runs; ++i) {
    const Cutter used = cutter();
    const Way way_of_tip = way();
    CutBlock stock(block, cell, {.tools = {{.cutter = used}}});
    const auto place = [](const Vector3& v) { return point_at(v.x, v.y, v.z); };
    stock.line(place(way_of_tip.from), place(way_of_tip.to));
    stock.cutter.finish();
    for (std::size_t row = 0; row < stock.field.rows(); ++row) {
      for (std::size_t column = 0; column < stock.field.columns(); ++column) {
        const double x = stock.field.x_of(column);
        const double y = stock.field.y_of(row);
        if (from_edge(used, way_of_tip, x, y) < 2e-3) continue;
        const double expected = std::clamp(lowest(used, way_of_tip, x, y), -5.0, 0.0);
        worst = std::max(worst, std::abs(stock.field.height(column, row) - expected));
        ASSERT_NEAR(stock.field.height(column, row), expected, most)
            << "move " << i << " at " << x << ", " << y << " " << describe(used) << " from " << way_of_tip.from.x
            << ", " << way_of_tip.from.y << ", " << way_of_tip.from.z << " to " << way_of_tip.to.x << ", "
            << way_of_tip.to.y << ", " << way_of_tip.to.z;
      }
    }
  }
  std::printf("worst: %.3f um in %d moves\n", worst * 1000, runs);
}

std::string name_of_parameter(const testing::TestParamInfo<Cutter::Kind>& info) {
  const std::string name(name_of(info.param));
  return name.substr(0, name.find('-'));
}

INSTANTIATE_TEST_SUITE_P(Tools, SweepOracle,
                         testing::Values(Cutter::Kind::flat, Cutter::Kind::ball, Cutter::Kind::v,
                                         Cutter::Kind::bull_nose, Cutter::Kind::tapered_ball),
                         name_of_parameter);

}  // namespace
}  // namespace passo
