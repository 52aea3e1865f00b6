// Hot wire: kerf by speed, corners, towers, times, airfoils, and the program.
#include "passo/cam/wire_cut.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "passo/cam/airfoil.hpp"
#include "passo/cam/wire_core.hpp"
#include "passo/cam/wire_program.hpp"

namespace passo {
namespace {

WireProfile box_profile(double width, double height, double x = 0, double y = 0) {
  const auto at = [&](double px, double py) {
    return PathPoint{{to_nanometres(Mm(x + px)), to_nanometres(Mm(y + py))}, 0};
  };
  return {{at(0, 0), at(width, 0), at(width, height), at(0, height)}, true};
}

WireOptions wire_options(double kerf) {
  WireOptions options;
  options.kerf = {{200, kerf}};
  return options;
}

double distance_mm(DrawnPoint a, DrawnPoint b) {
  return distance_nm(a, b) / nanometres_per_mm;
}

TEST(WireCut, keeps_half_a_kerf_off_on_the_side_that_falls_away) {
  Diagnostics findings;
  for (const WireKeeps keeps : {WireKeeps::inside, WireKeeps::outside, WireKeeps::line}) {
    WireOptions options = wire_options(1);
    options.keeps = keeps;
    const WirePlan plan = plan_wire_cut(box_profile(40, 20), box_profile(40, 20), options, findings);
    double least = 1e9;
    double most = -1e9;
    for (const WirePlace& at : plan.faces) {
      EXPECT_EQ(at.left, at.right);
      least = std::min(least, to_mm(at.left.x).value());
      most = std::max(most, to_mm(at.left.y).value());
    }
    const double off = keeps == WireKeeps::inside ? 0.5 : keeps == WireKeeps::outside ? -0.5 : 0;
    EXPECT_NEAR(least, -off, 1e-6);
    EXPECT_NEAR(most, 20 + off, 1e-6);
    EXPECT_NEAR(plan.left.lost_mm2, 0, 1e-6);
  }
  EXPECT_TRUE(findings.all().empty());
}

TEST(WireCut, the_slower_end_keeps_the_feed_and_has_the_wider_kerf) {
  WireOptions options = wire_options(1.2);
  options.left_face = Nanometres{100'000'000};
  options.right_face = Nanometres{300'000'000};
  options.span = Nanometres{500'000'000};
  Diagnostics findings;
  const WirePlan plan = plan_wire_cut(box_profile(100, 50), box_profile(50, 25), options, findings);
  EXPECT_EQ(plan.sections, 4U);
  EXPECT_NEAR(plan.right.most_kerf, 1.2, 1e-9);
  EXPECT_NEAR(plan.left.least_kerf, 0.6, 1e-9);  // twice as fast
  for (std::size_t i = 1; i < plan.faces.size(); ++i) {
    const double left = distance_mm(plan.faces[i - 1].left, plan.faces[i].left) / plan.minutes[i];
    const double right = distance_mm(plan.faces[i - 1].right, plan.faces[i].right) / plan.minutes[i];
    EXPECT_LT(std::max(left, right), 600.001);
    if (std::max(left, right) < 599.9) {
      EXPECT_NEAR(std::min(left, right), 200, 1e-3);
    }
  }
  // The wire is straight: at both faces it is where the plan says.
  for (std::size_t i = 0; i < plan.faces.size(); ++i) {
    const WirePlace& ends = plan.towers[i];
    const auto between = [&](double share) {
      return DrawnPoint{{std::llround(static_cast<double>(ends.left.x.count) * (1 - share) +
                                      static_cast<double>(ends.right.x.count) * share)},
                        {std::llround(static_cast<double>(ends.left.y.count) * (1 - share) +
                                      static_cast<double>(ends.right.y.count) * share)}};
    };
    EXPECT_LT(distance_nm(between(0.2), plan.faces[i].left), 3);
    EXPECT_LT(distance_nm(between(0.6), plan.faces[i].right), 3);
  }
  EXPECT_NEAR(plan.left.lost_mm2 + plan.right.lost_mm2, 0, 1e-6);
}

TEST(WireCut, kerfs_between_measured_speeds_are_a_line_over_time) {
  EXPECT_DOUBLE_EQ(kerf_at({{200, 1}}, 400), 0.5);
  const std::vector<WireKerf> measured = {{100, 1.6}, {200, 1.0}, {400, 0.8}};
  EXPECT_DOUBLE_EQ(kerf_at(measured, 200), 1.0);
  EXPECT_DOUBLE_EQ(kerf_at(measured, 400 / 3.0), 1.3);
  EXPECT_NEAR(kerf_at(measured, 1e9), 0.6, 1e-6);
  EXPECT_DOUBLE_EQ(kerf_at({{100, 2}, {200, 0.5}}, 1000), 0);
}

TEST(WireCut, an_inner_corner_tighter_than_the_kerf_is_told_and_nothing_turns_back) {
  // A slot of 1 mm into which a kerf of 2 mm does not fit.
  WireProfile slot = box_profile(40, 20);
  const auto at = [](double x, double y) { return PathPoint{{to_nanometres(Mm(x)), to_nanometres(Mm(y))}, 0}; };
  slot.points = {at(0, 0), at(40, 0), at(40, 20), at(20.5, 20), at(20.5, 10), at(19.5, 10), at(19.5, 20), at(0, 20)};
  Diagnostics findings;
  const WirePlan plan = plan_wire_cut(slot, slot, wire_options(2), findings);
  EXPECT_THAT(render(findings, false), testing::HasSubstr("[wire.narrow]"));
  // What is lost is known, and beside the slot little.
  EXPECT_LT(plan.left.lost_mm2, 25);
  // Small inner arcs are no fault of the drawing that loses anything.
  WireProfile notch = box_profile(40, 20);
  notch.points = {at(0, 0),   at(40, 0),       at(40, 20), at(22, 20), at(20.2, 10.05),
                  at(20, 10), at(19.8, 10.05), at(18, 20), at(0, 20)};
  Diagnostics few;
  EXPECT_LT(plan_wire_cut(notch, notch, wire_options(1), few).left.lost_mm2, 0.05);
}

TEST(WireCut, a_circle_beside_a_square_is_matched_at_its_ends) {
  const PathPoint east{{Nanometres{30'000'000}, Nanometres{0}}, 1};
  const PathPoint west{{Nanometres{-30'000'000}, Nanometres{0}}, 1};
  WireOptions options = wire_options(1);
  options.right_face = options.span = Nanometres{100'000'000};
  Diagnostics findings;
  const WirePlan plan = plan_wire_cut({{east, west}, true}, box_profile(60, 60, -30, -30), options, findings);
  EXPECT_EQ(plan.sections, 2U);
  EXPECT_NEAR(plan.left.way, std::numbers::pi * 60, 25);  // and leads
  EXPECT_NEAR(plan.left.lost_mm2 + plan.right.lost_mm2, 0, 0.01);
  EXPECT_NEAR(to_mm(plan.faces.front().left.x).value(), 40, 0.6);
}

TEST(WireCut, has_an_error_where_there_is_no_way) {
  Diagnostics findings;
  EXPECT_TRUE(
      plan_wire_cut({{PathPoint{}, PathPoint{}}, true}, box_profile(1, 1), wire_options(1), findings).faces.empty());
  EXPECT_THAT(render(findings, false), testing::HasSubstr("[wire.no-line]"));
}

TEST(WireProgram, has_a_time_for_each_move_of_four_axes_and_arcs_of_two) {
  Diagnostics findings;
  WireOptions options = wire_options(0);
  options.keeps = WireKeeps::line;
  options.right_face = options.span = Nanometres{100'000'000};
  const WirePlan plan = plan_wire_cut(box_profile(100, 50), box_profile(50, 25), options, findings);
  const std::string four = write_wire_program(plan, {.name = "wing"});
  EXPECT_THAT(four, testing::HasSubstr("G0 X110 Y0 U110 V0\nG93\nG1 X100 Y0 U50 V0 F10\nG1 X100 Y50 U50 V25 F8\n"));
  EXPECT_TRUE(four.ends_with("G94\nM2\n"));
  const std::string two = write_wire_program(plan, {.name = "wing", .has_four_axes = false, .heat = 80});
  EXPECT_THAT(two,
              testing::HasSubstr("G0 X110 Y0\nM3 S80\nG4 P3 (the wire gets hot)\nF200\nG1 X100 Y0\nG1 X100 Y50\n"));
  EXPECT_TRUE(two.ends_with("M5\nM2\n"));
}

Drawing read_section(std::string_view text, std::string& words) {
  Diagnostics findings;
  Drawing drawing = read_airfoil("wing.dat", text, Mm(100), findings, AirfoilCurve::lines);
  words = findings.all().empty() ? "" : render(findings, false);
  return drawing;
}

TEST(Airfoils, of_both_forms_are_the_same_section) {
  std::string words;
  const Drawing selig = read_section("NACA\n1.0 0.001\n0.5 0.06\n0 0\n0.5 -0.04\n1.0 -0.001\n", words);
  EXPECT_EQ(words, "");
  const Drawing lednicer =
      read_section("NACA\n 3. 3.\n\n0 0\n0.5 0.06\n1.0 0.001\n\n0 0\n0.5 -0.04\n1.0 -0.001\n", words);
  EXPECT_EQ(words, "");
  ASSERT_EQ(selig.paths.size(), 1U);
  ASSERT_EQ(lednicer.paths.size(), 1U);
  ASSERT_EQ(selig.paths[0].points.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(selig.paths[0].points[i].at, lednicer.paths[0].points[i].at);
  EXPECT_EQ(selig.paths[0].points[1].at.x.count, 50'000'000);
}

TEST(Airfoils, what_is_wrong_is_told) {
  std::string words;
  read_section("NACA\n1 0\n0.5 up\n", words);
  EXPECT_THAT(words, testing::HasSubstr("wing.dat:3:1: error: this is not a point of an airfoil"));
  read_section("NACA\n 3. 4.\n\n0 0\n0.5 0.06\n1.0 0.001\n\n0 0\n0.5 -0.04\n1.0 -0.001\n", words);
  EXPECT_THAT(words, testing::HasSubstr("6 points, but declares 3 and 4"));
  read_section("NACA\n1 0\n0 0\n", words);
  EXPECT_THAT(words, testing::HasSubstr("an airfoil of 2 points"));
  read_section("NACA\n1 0\n1 1\n1 2\n1 3\n1 4\n", words);
  EXPECT_THAT(words, testing::HasSubstr("have the same X"));
  EXPECT_TRUE(looks_like_airfoil("EPPLER 387\n1.0 0.0\n0.9 0.01\n0.8,0.02\n"));
  EXPECT_FALSE(looks_like_airfoil("G1 X1 Y2\nG1 X2 Y2\n"));
  EXPECT_FALSE(looks_like_airfoil("0\nSECTION\n2\nENTITIES\n"));
}

// NACA 0012 from its formula, and from a few of its points.
double naca_half(double x) {
  return 0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
}

TEST(Airfoils, a_spline_goes_through_sparse_points) {
  std::string text = "NACA 0012\n";
  const std::vector<double> stations = {1, 0.9, 0.75, 0.55, 0.35, 0.2, 0.1, 0.04, 0.01};
  for (const double x : stations) text += std::to_string(x) + " " + std::to_string(naca_half(x)) + "\n";
  text += "0 0\n";
  for (auto x = stations.rbegin(); x != stations.rend(); ++x)
    text += std::to_string(*x) + " " + std::to_string(-naca_half(*x)) + "\n";
  Diagnostics findings;
  double worst[2] = {0, 0};
  for (const AirfoilCurve curve : {AirfoilCurve::spline, AirfoilCurve::lines}) {
    const Drawing wing = read_airfoil("a.dat", text, Mm(200), findings, curve);
    EXPECT_TRUE(findings.all().empty());
    ASSERT_EQ(wing.paths.size(), 1U);
    const auto& points = wing.paths[0].points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const double x = (to_mm(points[i].at.x) + to_mm(points[i + 1].at.x)).value() / 400;
      const double y = (to_mm(points[i].at.y) + to_mm(points[i + 1].at.y)).value() / 400;
      if (x < 0.02) continue;
      double& off = worst[curve == AirfoilCurve::spline ? 0 : 1];
      off = std::max(off, 200 * std::abs(std::abs(y) - naca_half(x)));
    }
    EXPECT_EQ(points.front().at.x, to_nanometres(Mm(200)));  // the trailing edge stays a corner
  }
  EXPECT_LT(worst[0], 0.12);
  EXPECT_GT(worst[1], 0.25);
}

TEST(WireCore, is_smaller_by_the_skin_and_has_slots_for_spars) {
  Diagnostics findings;
  const WireCore core{
      .skin = to_nanometres(Mm(2)),
      .spars = {{.at = to_nanometres(Mm(30)), .width = to_nanometres(Mm(6)), .depth = to_nanometres(Mm(4))},
                {.at = to_nanometres(Mm(60)),
                 .width = to_nanometres(Mm(5)),
                 .depth = to_nanometres(Mm(3)),
                 .is_below = true}}};
  const auto foam = wire_core(box_profile(100, 20), core, findings);
  ASSERT_TRUE(foam);
  DrawnRing ring;
  for (const PathPoint& point : foam->points) ring.push_back(point.at);
  EXPECT_NEAR(area_mm2(ring), 96 * 16 - 6 * 4 - 5 * 3, 1e-6);
  const auto at = [](double x, double y) { return DrawnPoint{to_nanometres(Mm(x)), to_nanometres(Mm(y))}; };
  const Region inside = filled({ring});
  EXPECT_FALSE(contains(inside, at(30, 14.1)));
  EXPECT_TRUE(contains(inside, at(30, 13.9)));
  EXPECT_FALSE(contains(inside, at(57.6, 4.9)));
  EXPECT_TRUE(contains(inside, at(57.4, 4.9)));
  // The wire enters the slots, and the volume that it sweeps leaves the core intact.
  WireOptions options = wire_options(1);
  const WirePlan plan = plan_wire_cut(*foam, *foam, options, findings);
  EXPECT_NEAR(plan.left.lost_mm2, 0, 1e-3);
  EXPECT_TRUE(findings.all().empty());
  double lowest = 100;
  for (const WirePlace& place : plan.faces) {
    const bool is_in_slot = std::abs(to_mm(place.left.x).value() - 30) < 2.6 && to_mm(place.left.y).value() > 10;
    if (is_in_slot) lowest = std::min(lowest, to_mm(place.left.y).value());
  }
  EXPECT_NEAR(lowest, 14.5, 0.01);
}

TEST(WireCore, says_what_does_not_fit) {
  Diagnostics findings;
  EXPECT_FALSE(wire_core(box_profile(100, 20), {.skin = to_nanometres(Mm(10))}, findings));
  EXPECT_THAT(render(findings, false), testing::HasSubstr("[wire.thick-skin]"));
  for (const double x : {500.0, 50.0}) {
    Diagnostics spar;
    const WireSpar deep{.at = to_nanometres(Mm(x)), .width = to_nanometres(Mm(5)), .depth = to_nanometres(Mm(21))};
    EXPECT_FALSE(wire_core(box_profile(100, 20), {.spars = {deep}}, spar));
    EXPECT_THAT(render(spar, false), testing::HasSubstr("[wire.no-spar]"));
  }
}

}  // namespace
}  // namespace passo
