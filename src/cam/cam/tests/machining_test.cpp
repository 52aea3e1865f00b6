// Pockets and profiles as a machine would cut them, cell by cell: nothing of the part is cut into, nothing that the
// cutter reaches is left, and links and rapids only go where the ground has been cut before.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "closed_lines.hpp"
#include "random_star.hpp"
#include <gmock/gmock.h>

#include "passo/cam/bulge.hpp"
#include "passo/cam/edge_loops.hpp"
#include "passo/cam/mill_program.hpp"
#include "passo/cam/pocket.hpp"
#include "passo/cam/profile.hpp"

namespace passo {
namespace {

using test::box;
using test::circle;
using test::corner;

Nanometres in_nm(double mm) {
  return to_nanometres(Mm(mm));
}

// The height of the stock in square cells. Shares no code with the plan.
class CutCells {
 public:
  CutCells(double side, double half_width)
      : side_(side),
        half_width_(half_width),
        columns_(static_cast<std::size_t>(2 * half_width / side)),
        heights_(columns_ * columns_, 0) {}

  void cut(const MillPlan& plan) {
    for (const MillTool& tool : plan.tools) {
      const double radius = static_cast<double>(tool.width.count) / 2e6;
      for (const MillRun& run : tool.runs) {
        for (std::size_t i = 0; i + 1 < run.size(); ++i) move(run[i], run[i + 1], radius);
      }
    }
  }

  // Moves of links and rapids that met stock.
  std::size_t collisions() const { return collisions_; }
  // Calls `visit(x, y, height)` for the middle of each cell.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < heights_.size(); ++i) visit(middle(i % columns_), middle(i / columns_), heights_[i]);
  }

 private:
  double middle(std::size_t index) const { return (static_cast<double>(index) + 0.5) * side_ - half_width_; }

  void move(const MillPoint& from, const MillPoint& to, double radius) {
    const double way = way_nm(from.at, to.at, from.bulge) / 1e6;
    const double parts = std::max(1.0, std::ceil(way / (1.5 * side_)));
    const bool is_free = from.pace == MillPace::link || from.pace == MillPace::rapid;
    for (double k = 0; k <= parts; ++k) {
      const DrawnPoint at = point_along(from.at, to.at, from.bulge, k / parts);
      const double z = to_mm(from.z).value() + (to_mm(to.z).value() - to_mm(from.z).value()) * k / parts;
      const double x = static_cast<double>(at.x.count) / 1e6;
      const double y = static_cast<double>(at.y.count) / 1e6;
      const bool met = stamp(x, y, z, is_free ? radius - 1.5 * side_ : radius, !is_free);
      if (is_free && met) ++collisions_;
    }
  }

  // Returns whether any cell was higher than z.
  bool stamp(double x, double y, double z, double radius, bool lowers) {
    bool met = false;
    const auto first = static_cast<std::int64_t>((y - radius + half_width_) / side_);
    const auto last = static_cast<std::int64_t>((y + radius + half_width_) / side_);
    const auto size = static_cast<std::int64_t>(columns_);
    for (std::int64_t row = std::max<std::int64_t>(0, first); row <= std::min(last, size - 1); ++row) {
      const double dy = middle(static_cast<std::size_t>(row)) - y;
      const double half = std::sqrt(std::max(0.0, radius * radius - dy * dy));
      const auto begin = std::max<std::int64_t>(0, std::llround((x - half + half_width_) / side_));
      const auto end = std::min(size, static_cast<std::int64_t>(std::llround((x + half + half_width_) / side_)));
      for (std::int64_t column = begin; column < end; ++column) {
        double& height = heights_[static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column)];
        met = met || height > z + 1e-6;
        if (lowers) height = std::min(height, z);
      }
    }
    return met;
  }

  double side_;
  double half_width_;
  std::size_t columns_;
  std::vector<double> heights_;
  std::size_t collisions_ = 0;
};

struct CutFindings {
  double cut_into_mm2 = 0;  // of what must stay
  double left_mm2 = 0;      // of what must go
  std::size_t collisions = 0;
};

constexpr double cell = 0.15;  // mm
CutFindings cut_findings(const MillPlan& plan, const Region& stays, const Region& goes, double depth) {
  CutCells cells(cell, 27);
  cells.cut(plan);
  // A cell's width of doubt on either side of an edge.
  const Region kept = grown(stays, in_nm(-1.5 * cell), {2'000});
  const Region gone = grown(goes, in_nm(-1.5 * cell), {2'000});
  CutFindings found;
  cells.for_each([&](double x, double y, double height) {
    const DrawnPoint at{in_nm(x), in_nm(y)};
    if (height < -1e-6 && contains(kept, at)) found.cut_into_mm2 += cell * cell;
    if (height > depth + 1e-6 && contains(gone, at)) found.left_mm2 += cell * cell;
  });
  found.collisions = cells.collisions();
  return found;
}

Region everything() {
  return filled({rectangle({{in_nm(-27), in_nm(-27)}, {in_nm(27), in_nm(27)}})});
}

Region opened(const Region& area, double radius) {
  return grown(grown(area, in_nm(-radius - 0.003), {200}), in_nm(radius), {200});
}

Region random_area(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  Region area = enclosed_by({test::random_star({.corners = 5 + static_cast<int>(8 * share(random))}, random)});
  for (int i = 0; i < 3; ++i) {
    const auto island = circle(24 * share(random) - 12, 24 * share(random) - 12, 0.5 + 2.5 * share(random));
    area = subtracted(area, enclosed_by({island}));
  }
  return area;
}

TEST(Machining, random_pockets_with_islands_are_cut_exactly) {
  std::mt19937_64 random(48);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 6; ++trial) {
    const Region area = random_area(random);
    PocketOptions options{.cutter = in_nm(2 + 3 * share(random)),
                          .depth = in_nm(-2),
                          .step = in_nm(1.2),
                          .step_over = 0.2 + 0.6 * share(random),
                          .ramp_degrees = trial % 4 == 0 ? 0 : 5.0,
                          .most_engagement = trial % 3 == 1 ? 70.0 : 0.0};
    options.finishes = trial % 2 == 1;
    options.allowance = options.finishes ? in_nm(0.2) : Nanometres{};
    options.floor_allowance = trial % 4 == 1 ? in_nm(0.3) : Nanometres{};
    options.lead = {options.cutter.count / 4};
    options.spring_passes = trial % 4 == 3 ? 1 : 0;
    Diagnostics findings;
    const PocketPlan plan = plan_pocket(area, options, findings);
    if (findings.any_error()) continue;
    const double radius = static_cast<double>(options.cutter.count) / 2e6;
    const Region reachable = opened(area, options.most_engagement > 0 ? 1.1 * radius : radius);
    const CutFindings found = cut_findings(plan.mill, subtracted(everything(), area), reachable, -2);
    EXPECT_EQ(found.cut_into_mm2, 0) << trial;
    EXPECT_EQ(found.left_mm2, 0) << trial;
    EXPECT_EQ(found.collisions, 0U) << trial;
    EXPECT_LT(plan.lost_mm2, 1e-3) << trial;
  }
}

TEST(Machining, random_profiles_with_finishing_passes_are_cut_exactly) {
  std::mt19937_64 random(49);
  std::uniform_real_distribution<double> share(0, 1);
  for (int trial = 0; trial < 8; ++trial) {
    const auto outside = test::random_star({.corners = 5 + trial, .nearest = 10, .farthest = 20}, random);
    const auto hole = circle(0, 0, 2 + 4 * share(random));
    OutlineOptions cut{.cutter = in_nm(1 + 2 * share(random)), .depth = in_nm(-2), .step = in_nm(1)};
    cut.tabs = trial % 2 == 0 ? 0 : 3;
    cut.ramp_degrees = trial % 3 == 0 ? 0 : 4;
    cut.allowance = in_nm(0.15);
    cut.finishes = trial % 4 != 3;
    Diagnostics findings;
    const ProfilePlan plan = plan_profile({outside, hole}, {}, {.cut = cut}, findings);
    const double diameter = static_cast<double>(cut.cutter.count) / 1e6;
    const double beside = cut.finishes ? 0 : 0.15;
    const Region stays = grown(plan.face, in_nm(beside), {500});
    Region goes = subtracted(grown(plan.face, in_nm(0.7 * diameter), {500}), plan.face);
    goes = cut.tabs > 0 ? Region{} : common(opened(subtracted(everything(), stays), diameter / 2), goes);
    const CutFindings found = cut_findings(plan.outline.mill, stays, goes, -2);
    EXPECT_EQ(found.cut_into_mm2, 0) << trial;
    EXPECT_EQ(found.left_mm2, 0) << trial;
    EXPECT_EQ(found.collisions, 0U) << trial;
    EXPECT_EQ(plan.outline.lost_mm2, 0) << trial;
    EXPECT_EQ(plan.outline.finished > 0, cut.finishes) << trial;
  }
}

const MillRun& only_run(const MillPlan& plan) {
  EXPECT_EQ(plan.tools.at(0).runs.size(), 1U);
  return plan.tools[0].runs[0];
}

TEST(Machining, a_wide_pocket_is_entered_along_a_helix) {
  const Region area = enclosed_by({box(-25, -25, 50, 50)});
  Diagnostics findings;
  const PocketPlan plan = plan_pocket(area, {.cutter = in_nm(6), .depth = in_nm(-3), .step = in_nm(3)}, findings);
  const MillRun& run = only_run(plan.mill);
  double widest = 0;
  double descent = 0;
  for (std::size_t i = 0; i + 1 < run.size() && run[i + 1].z != in_nm(-3); ++i) {
    widest = std::max(widest, distance_nm(run[i].at, run[0].at) / 1e6);
    descent += way_nm(run[i].at, run[i + 1].at, run[i].bulge) / 1e6;
  }
  EXPECT_GE(widest, 0.5 * 6);
  EXPECT_LE(widest, 0.9 * 6);
  EXPECT_LT(descent / (M_PI * widest), 4) << "turns";
}

TEST(Machining, a_loop_is_cut_once_and_its_ramp_again) {
  const Region area = enclosed_by({box(0, 0, 60, 6.2)});
  Diagnostics findings;
  const PocketPlan plan = plan_pocket(area, {.cutter = in_nm(6), .depth = in_nm(-3), .step = in_nm(3)}, findings);
  const double loop = 2 * (54 + 0.2);
  const double ramp = 3 / std::tan(5 * M_PI / 180);
  EXPECT_NEAR(lengths_of(plan.mill.tools.at(0), {}).milled_nm / 1e6, loop + ramp, 0.3);
}

// The wall is on the right of the cutter, whether it is around the pocket or around an island.
TEST(Machining, walls_and_islands_are_cut_by_climb_milling) {
  const Region area = enclosed_by({box(-20, -20, 40, 40), circle(0, 0, 6)});
  for (const bool climb : {true, false}) {
    for (const double engagement : {0.0, 100.0}) {
      PocketOptions options{.cutter = in_nm(6), .depth = in_nm(-1), .most_engagement = engagement, .climb = climb};
      options.finishes = true;
      options.allowance = in_nm(0.2);
      Diagnostics findings;
      const PocketPlan plan = plan_pocket(area, options, findings);
      EXPECT_EQ(plan.finished, 2U);
      double around_island = 0;  // counterclockwise
      double around_wall = 0;
      for (const MillRun& run : plan.mill.tools.at(0).runs) {
        for (std::size_t i = 0; i + 1 < run.size(); ++i) {
          if (run[i].pace != MillPace::finish) continue;
          const DrawnPoint middle = point_along(run[i].at, run[i + 1].at, run[i].bulge, 0.5);
          const double away = distance_nm(middle, {}) / 1e6;
          const double turn = static_cast<double>(run[i].at.x.count) * static_cast<double>(middle.y.count) -
                              static_cast<double>(run[i].at.y.count) * static_cast<double>(middle.x.count);
          if (std::abs(away - 9) < 0.1) around_island += turn;
          if (away > 16.5) around_wall += turn;
        }
      }
      EXPECT_LT(climb ? around_island : -around_island, 0);
      EXPECT_GT(climb ? around_wall : -around_wall, 0);
    }
  }
}

TEST(Machining, finishing_passes_are_led_in_and_out_by_arcs) {
  const Region area = enclosed_by({box(-20, -20, 40, 40)});
  PocketOptions options{.cutter = in_nm(6), .depth = in_nm(-4), .step = in_nm(1)};
  options.finishes = true;
  options.allowance = in_nm(0.3);
  options.lead = in_nm(1.5);
  options.spring_passes = 1;
  Diagnostics findings;
  const PocketPlan plan = plan_pocket(area, options, findings);
  const MillRun& last = plan.mill.tools.at(0).runs.back();
  ASSERT_EQ(last.front().pace, MillPace::rapid) << "down in cleared ground";
  EXPECT_EQ(last[1].z, in_nm(-3.8));
  EXPECT_NE(last[2].bulge, 0);
  EXPECT_NE(last[last.size() - 2].bulge, 0);
  double length = 0;
  for (std::size_t i = 2; i + 1 < last.size(); ++i) {
    EXPECT_EQ(last[i].pace, MillPace::finish);
    EXPECT_EQ(last[i].z, in_nm(-4));
    length += way_nm(last[i].at, last[i + 1].at, last[i].bulge) / 1e6;
  }
  EXPECT_NEAR(length, 2 * 4 * 34 + 2 * 1.5 * M_PI / 2, 0.1) << "two laps and two quarter circles";
  const std::string program = write_mill_program(plan.mill, {.finish_feed = in_nm(123)});
  EXPECT_THAT(program, testing::HasSubstr(" F123\n"));
}

TEST(Machining, gaps_exactly_as_wide_as_the_cutter_are_cut) {
  const std::vector<PathPoint> slot = box(10, 5, 20, 3);
  OutlineOptions cut{.cutter = in_nm(3), .depth = in_nm(-3), .step = in_nm(1)};
  cut.skips_narrow = true;
  Diagnostics findings;
  const ProfilePlan plan =
      plan_profile({box(-40, -30, 80, 60), circle(-10, -10, 1.5), slot}, {}, {.cut = cut}, findings);
  EXPECT_TRUE(findings.all().empty()) << render(findings, false);
  EXPECT_EQ(plan.outline.tight, 2U);
  EXPECT_LT(plan.outline.lost_mm2, 0.05);
  const auto& runs = plan.outline.mill.tools.at(0).runs;
  ASSERT_EQ(runs.size(), 3U);
  const MillRun& along = runs[0].front().at.x.count > 0 ? runs[0] : runs[1];
  const MillRun& down = runs[0].front().at.x.count > 0 ? runs[1] : runs[0];
  for (const MillPoint& point : along) EXPECT_NEAR(static_cast<double>(point.at.y.count), 6.5e6, 15e3);
  for (const MillPoint& point : down) EXPECT_LT(distance_nm(point.at, corner(-10, -10).at), 5e3);
  EXPECT_EQ(down.back().z, in_nm(-3));
  // A neck of a pocket, too; what is 0.03 mm narrower stays.
  for (const double width : {3.0, 2.97}) {
    Region area = united(enclosed_by({box(0, 0, 15, 15)}), enclosed_by({box(14, 5, 20, width)}));
    area = united(area, enclosed_by({box(33, 0, 15, 15)}));
    Diagnostics told;
    const PocketPlan pocket = plan_pocket(area, {.cutter = in_nm(3)}, told);
    EXPECT_EQ(pocket.tight, width == 3.0 ? 1U : 0U);
    EXPECT_EQ(pocket.unreached_mm2 > 50, width != 3.0);
    EXPECT_LT(pocket.lost_mm2, 0.5);
  }
}

// Stock on a wall is no gap as wide as the cutter.
TEST(Machining, an_allowance_that_stays_is_not_cut) {
  const Region with_island = enclosed_by({box(-25, -20, 50, 40), circle(0, 0, 5)});
  for (const Region& area : {enclosed_by({box(-25, -10, 50, 20)}), enclosed_by({circle(0, 0, 15)}), with_island}) {
    for (const double allowance : {0.1, 0.5, 0.75}) {
      PocketOptions options{.cutter = in_nm(3), .depth = in_nm(-3), .allowance = in_nm(allowance)};
      options.climb = allowance != 0.1;
      options.ramp_degrees = allowance == 0.75 ? 0 : 5;
      options.floor_allowance = allowance == 0.5 ? in_nm(0.3) : Nanometres{};
      Diagnostics findings;
      const PocketPlan plan = plan_pocket(area, options, findings);
      EXPECT_TRUE(findings.all().empty()) << render(findings, false);
      EXPECT_EQ(plan.tight, 0U);
      const Region goes = grown(area, in_nm(-allowance), {500});
      std::vector<DrawnRing> ways;
      for (const MillRun& run : plan.mill.tools.at(0).runs) {
        std::vector<PathPoint> points;
        for (const MillPoint& point : run) points.push_back({point.at, point.bulge});
        ways.push_back(chords_of_path(points, false, {500}));
      }
      const Region cut = swept(ways, in_nm(1.5), {500});
      EXPECT_LT(area_mm2(subtracted(cut, goes)), 0.01);
      const double depth = options.floor_allowance.count > 0 ? -2.7 : -3;
      const CutFindings found = cut_findings(plan.mill, subtracted(everything(), goes), opened(goes, 1.5), depth);
      EXPECT_EQ(found.cut_into_mm2, 0);
      EXPECT_EQ(found.left_mm2, 0);
    }
  }
}

}  // namespace
}  // namespace passo
