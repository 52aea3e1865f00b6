// The progress of the operations: it grows step by step to its end, and changes no program.
#include <functional>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "passo/base/work_progress.hpp"
#include "passo/cam/drill_plan.hpp"
#include "passo/cam/isolation.hpp"
#include "passo/cam/isolation_proof.hpp"
#include "passo/cam/mill_program.hpp"
#include "passo/cam/pocket.hpp"
#include "passo/cam/route.hpp"
#include "passo/cam/v_carve.hpp"

namespace passo {
namespace {

DrawnPoint at_mm(int x, int y) {
  return {{std::int64_t{x} * 1'000'000}, {std::int64_t{y} * 1'000'000}};
}

Region square(int x, int y, int side) {
  return filled({rectangle({at_mm(x, y), at_mm(x + side, y + side)})});
}

// Four pads in two rows, 5 mm apart.
Region pads() {
  return united({square(0, 0, 4), square(9, 0, 4), square(0, 9, 4), square(9, 9, 4)});
}

std::string text_of(const MillPlan& plan) {
  return write_mill_program(plan, {.name = "test", .command = "passo cam", .files = {}, .remarks = {}});
}

// Runs the work with a listener and without one. Returns the shares that were heard.
std::vector<double> shares_of(const std::function<std::string(const WorkProgress&)>& work) {
  std::vector<double> shares;
  const std::string watched = work(WorkProgress([&](double share) { shares.push_back(share); }));
  EXPECT_FALSE(watched.empty());
  EXPECT_EQ(watched, work({}));
  for (std::size_t i = 0; i < shares.size(); ++i) {
    EXPECT_GT(shares[i], i == 0 ? 0 : shares[i - 1]);
    EXPECT_LE(shares[i], 1);
  }
  return shares;
}

// No step of the progress is longer than this share.
void expect_even(const std::vector<double>& shares, double longest) {
  double before = 0;
  for (const double share : shares) {
    EXPECT_LE(share - before, longest) << "from " << before;
    before = share;
  }
  EXPECT_GE(before, 1 - longest);
}

// After the loops, the union of all that they sweep is a single call of Clipper: three quarters of the time.
TEST(CamProgress, of_a_pocket_grows_with_each_loop) {
  const std::vector<double> shares = shares_of([](const WorkProgress& progress) {
    Diagnostics findings;
    return text_of(plan_pocket(square(0, 0, 60), {}, findings, progress).mill);
  });
  ASSERT_GT(shares.size(), 5U);
  EXPECT_EQ(shares.back(), 1);
  double before = 0;
  for (const double share : std::span(shares).first(shares.size() - 1)) {
    EXPECT_LE(share - before, 0.1) << "from " << before;
    before = share;
  }
  EXPECT_NEAR(before, 0.25, 1e-9);
}

TEST(CamProgress, of_constant_engagement_grows_while_discs_are_placed) {
  PocketOptions options;
  options.most_engagement = 60;
  expect_even(shares_of([&](const WorkProgress& progress) {
                Diagnostics findings;
                return text_of(plan_pocket(square(0, 0, 20), options, findings, progress).mill);
              }),
              0.6);
}

// The wide cutter leaves the fine one nothing to mill here, so its part passes at once.
TEST(CamProgress, of_isolation_grows_with_each_loop_and_each_cutter) {
  IsolationOptions options;
  options.cutters = {{{1'000'000}, "wide"}, {{200'000}, "fine"}};
  options.clear = true;
  options.board = square(-5, -5, 25);
  expect_even(shares_of([&](const WorkProgress& progress) {
                Diagnostics findings;
                return text_of(plan_isolation(pads(), options, findings, progress).mill);
              }),
              0.41);
}

TEST(CamProgress, of_the_proof_grows_with_each_strip) {
  IsolationOptions options;
  options.cutters = {{{200'000}, "fine"}};
  Diagnostics findings;
  const IsolationPlan plan = plan_isolation(pads(), options, findings);
  const auto shares = shares_of([&](const WorkProgress& progress) {
    return std::to_string(prove_isolation(pads(), plan.mill, {}, progress).milled_mm2);
  });
  ASSERT_FALSE(shares.empty());
  EXPECT_DOUBLE_EQ(shares.back(), 1);
}

// The medial axis takes most of the time, and is found in one piece.
TEST(CamProgress, of_carving_grows_with_its_stages) {
  expect_even(shares_of([](const WorkProgress& progress) {
                Diagnostics findings;
                return text_of(plan_v_carve(pads(), {}, findings, progress).mill);
              }),
              0.81);
}

TEST(CamProgress, of_drilling_grows_with_the_work_on_the_route) {
  Drawing drawing;
  for (int i = 0; i < 400; ++i) {
    drawing.holes.push_back({.at = at_mm(i * 37 % 101, i * 53 % 97), .diameter = {i % 2 == 0 ? 800'000 : 1'000'000}});
  }
  expect_even(shares_of([&](const WorkProgress& progress) {
                Diagnostics findings;
                const DrillPlan plan = plan_drilling({drawing}, {}, findings, progress);
                std::string text;
                for (const DrillTool& tool : plan.tools) text += std::to_string(tool.rapids_after_nm) + "\n";
                return text;
              }),
              0.05);
}

}  // namespace
}  // namespace passo
