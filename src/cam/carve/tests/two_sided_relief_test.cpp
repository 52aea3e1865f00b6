// Parts that are carved from both sides: no side cuts into the body, and what is left is the part, held by its tabs.
#include "passo/carve/two_sided_relief.hpp"

#include <cmath>
#include <numbers>

#include "body_faces.hpp"
#include "contact_oracle.hpp"
#include <gmock/gmock.h>

#include "passo/carve/relief_surface.hpp"

namespace passo {
namespace {

using namespace test;

constexpr double wide = 16;
constexpr double deep = 12;
constexpr double high = 6;

// A body between two surfaces over an ellipse: `top` and `bottom` give heights for 0 (middle) to 1 (edge).
template <class Top, class Bottom>
Faces lens(const Top& top, const Bottom& bottom) {
  constexpr int around = 32;
  constexpr int rings = 6;
  Faces faces;
  const auto at = [&](int ring, int i, bool is_top) {
    const double share = static_cast<double>(ring) / rings;
    const double angle = 2 * std::numbers::pi * i / around;
    return SurfacePoint{wide / 2 * (1 + share * std::cos(angle)), deep / 2 * (1 + share * std::sin(angle)),
                        is_top ? top(share) : bottom(share)};
  };
  for (int i = 0; i < around; ++i) {
    for (const bool is_top : {true, false}) {
      for (int ring = 0; ring < rings; ++ring) {
        faces.push_back({at(ring, i, is_top), at(ring + 1, i, is_top), at(ring + 1, i + 1, is_top)});
        faces.push_back({at(ring, i, is_top), at(ring + 1, i + 1, is_top), at(ring, i + 1, is_top)});
      }
    }
    faces.push_back({at(rings, i, true), at(rings, i, false), at(rings, i + 1, false)});
    faces.push_back({at(rings, i, true), at(rings, i + 1, false), at(rings, i + 1, true)});
  }
  return faces;
}

Faces pebble() {
  return lens([](double share) { return high - 2 * share * share; }, [](double share) { return 2 * share * share; });
}
// Its edge is near the bottom.
Faces hat() {
  return lens([](double share) { return share < 0.65 ? high - share : 1.5; }, [](double) { return 0.0; });
}

// Its edge is as thin as a knife, halfway up.
Faces egg() {
  const auto high_at = [](double share) { return std::sqrt(1 - share * share) * high / 2; };
  return lens([&](double share) { return high / 2 + high_at(share); },
              [&](double share) { return high / 2 - high_at(share); });
}
// Its edge is at the bottom.
Faces cone() {
  return lens([](double share) { return high * (1 - share); }, [](double) { return 0.0; });
}

Faces flipped(Faces faces, StockFlip flip) {
  for (SurfaceTriangle& face : faces) {
    for (SurfacePoint& p : face) {
      p = flip == StockFlip::left_to_right ? SurfacePoint{wide - p.x, p.y, high - p.z}
                                           : SurfacePoint{p.x, deep - p.y, high - p.z};
    }
  }
  return faces;
}

SplitRelief split(const Faces& body, const SplitOptions& options) {
  Diagnostics diagnostics;
  const ReliefShape shape{.pitch = Mm(0.12)};
  const HeightGrid top = relief_of({.faces = body}, shape, "it", diagnostics);
  const HeightGrid bottom = relief_of({.faces = flipped(body, options.flip)}, shape, "it", diagnostics);
  return split_relief(top, bottom, Mm(high), options);
}

ReliefProgramOptions side_options(const SplitRelief& split) {
  ReliefProgramOptions options = options_of("ball:3");
  options.roughing =
      ReliefRoughing{.tool = {.cutter = *parse_cutter("flat:2.3")}, .step_down = Mm(1.5), .stock = Mm(0.2)};
  options.beside = BesideGrid::nothing;
  options.overrun = Mm(0);
  options.x0 = split.beside_x * -1;
  options.y0 = split.beside_y * -1;
  return options;
}

const std::vector<OracleCutter>& side_tools() {
  static const std::vector<OracleCutter> tools = {oracle_of("flat:2.3"), oracle_of("ball:3")};
  return tools;
}

// The deepest that a program cuts into the body, whose top is at Z0.
double deepest(Faces body, const std::string& program) {
  for (SurfaceTriangle& face : body) {
    for (SurfacePoint& p : face) p.z -= high;
  }
  ContactOracle oracle(body);
  double most = 0;
  int places = 0;
  for (const ReadMove& move : moves_of(program)) {
    if (move.is_rapid) continue;
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / 0.4)));
    for (int i = 0; i <= parts; ++i, ++places) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      most = std::max(most, oracle.depth(side_tools()[move.tool - 1], at(0), at(1), at(2)));
    }
  }
  EXPECT_GT(places, 2000);
  return most;
}

OracleStock stock_of(const std::string& program) {
  OracleStock stock(wide, deep, 0.2);
  for (const ReadMove& move : moves_of(program)) {
    if (move.is_rapid) continue;
    const double length = std::hypot(move.to[0] - move.from[0], move.to[1] - move.from[1], move.to[2] - move.from[2]);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / 0.2)));
    for (int i = 0; i <= parts; ++i) {
      const double share = static_cast<double>(i) / parts;
      const auto at = [&](int axis) { return move.from[axis] + (move.to[axis] - move.from[axis]) * share; };
      stock.cut(side_tools()[move.tool - 1], at(0), at(1), at(2));
    }
  }
  return stock;
}

// The stock after both programs, neither of which cuts into the body.
struct CutStock {
  OracleStock top;
  OracleStock bottom;
  StockFlip flip;

  // How thick the stock is at a place: the second side is seen from below.
  double left(double x, double y) const {
    const bool is_x = flip == StockFlip::left_to_right;
    return high + top.at(x, y) + bottom.at(is_x ? wide - x : x, is_x ? y : deep - y);
  }
};
CutStock cut_from_both_sides(const Faces& body, const SplitRelief& sides, StockFlip flip) {
  const std::string top = written(sides.top, side_options(sides)).text;
  const std::string bottom = written(sides.bottom, side_options(sides)).text;
  EXPECT_LE(deepest(body, top), 1e-3);
  EXPECT_LE(deepest(flipped(body, flip), bottom), 1e-3);
  return {stock_of(top), stock_of(bottom), flip};
}

TEST(TwoSidedRelief, cuts_the_part_free_except_at_its_tabs) {
  constexpr double trench = 3.2;
  for (const StockFlip flip : {StockFlip::left_to_right, StockFlip::front_to_back}) {
    const Faces body = flip == StockFlip::left_to_right ? pebble() : hat();
    const SplitRelief sides =
        split(body, {.flip = flip, .trench = Mm(trench), .tab_height = Mm(1), .tab_width = Mm(3)});
    EXPECT_EQ(sides.tabs, 4U);
    EXPECT_LE(sides.hidden, 0.02);
    const CutStock stock = cut_from_both_sides(body, sides, flip);
    const auto left = [&](double x, double y) { return stock.left(x, y); };
    // In the middle of the trench, all around.
    int tabs = 0;
    bool was_tab = left(wide + trench / 2, deep / 2 - 4) > 0;
    for (double y = deep / 2 - 4; y <= deep / 2 + 4; y += 0.1) {
      const double here = left(wide + trench / 2, y);
      if ((here > 0) != was_tab) ++tabs;
      was_tab = here > 0;
      EXPECT_LE(here, 1.05);
    }
    EXPECT_EQ(tabs, 2) << "one tab begins and ends here";
    EXPECT_NEAR(left(wide + trench / 2, deep / 2), 1, 0.1);
    EXPECT_LE(left(0.2, 0.2), 0);
    EXPECT_LE(left(wide - 0.2, deep - 0.2), 0);
    EXPECT_NEAR(left(wide / 2, deep / 2), high, 0.1);
  }
}

// How much material is left above the body at a place, after the program of the side that is up, mm.
double left_above(const Faces& body, const OracleStock& stock, double x, double y) {
  return high + stock.at(x, y) - Surface(body).top(x, y);
}

TEST(TwoSidedRelief, holds_parts_whose_edge_is_thinner_than_the_tabs) {
  for (const StockFlip flip : {StockFlip::left_to_right, StockFlip::front_to_back}) {
    const Faces body = flip == StockFlip::left_to_right ? egg() : cone();
    const SplitRelief sides = split(body, {.flip = flip, .trench = Mm(3.2), .tab_height = Mm(1), .tab_width = Mm(2)});
    EXPECT_EQ(sides.tabs, 4U);
    EXPECT_GT(sides.on_part, Mm(0));
    EXPECT_LT(sides.on_part, Mm(2.5));
    const CutStock stock = cut_from_both_sides(body, sides, flip);
    const auto left = [&](double x, double y) { return stock.left(x, y); };
    // The tab is as thick from the frame to where the part is.
    for (double x = wide + 1.6; x >= wide - 1; x -= 0.1) EXPECT_GE(left(x, deep / 2), 0.9) << x;
    EXPECT_LE(left(wide + 1.6, deep / 2 + 3), 0) << "beside the tab, the part is free";
    // Away from the tabs both sides are carved to the edge. The heights are those of cells on a slope.
    for (double share = 0; share < 0.96; share += 0.05) {
      const double x = wide / 2 * (1 + share * std::sqrt(0.5));
      const double y = deep / 2 * (1 + share * std::sqrt(0.5));
      EXPECT_LE(left_above(body, stock.top, x, y), 0.45) << share;
      EXPECT_LE(left_above(flipped(body, flip), stock.bottom, x, y), 0.45) << share;
    }
  }
}

TEST(TwoSidedRelief, puts_the_tabs_of_a_thin_edge_where_they_hide_nothing_of_the_top) {
  const SplitOptions options{.trench = Mm(3), .tab_height = Mm(1), .tab_width = Mm(2)};
  const SplitRelief of_egg = split(egg(), options);
  EXPECT_TRUE(of_egg.has_web);
  EXPECT_NEAR(of_egg.parting.value(), high / 2 + 0.5, 0.4) << "below the edge";
  const SplitRelief of_cone = split(cone(), options);
  EXPECT_FALSE(of_cone.has_web) << "there is no room below the edge";
  EXPECT_NEAR(of_cone.parting.value(), high - 0.5, 0.1);
  const SplitRelief of_funnel = split(flipped(cone(), StockFlip::left_to_right), options);
  EXPECT_TRUE(of_funnel.has_web);
  EXPECT_EQ(of_funnel.tabs, 4U);
  EXPECT_NEAR(of_funnel.parting.value(), 0.6, 0.1) << "a little below the top, so that the bottom is cut through it";
}

TEST(TwoSidedRelief, puts_the_web_where_the_edge_is) {
  const SplitOptions options{.trench = Mm(3), .tab_height = Mm(1), .tab_width = Mm(3)};
  EXPECT_NEAR(split(pebble(), options).parting.value(), high / 2, 0.1);
  const double low = split(hat(), options).parting.value();
  EXPECT_GE(low, high - 1);
  EXPECT_LE(low, high - 0.5);
  SplitOptions given = options;
  given.parting = Mm(1);
  EXPECT_GT(split(hat(), given).hidden, 0.9);
}

}  // namespace
}  // namespace passo
