// Random programs, smoothed and planned: limits, continuity, order, look-ahead, holds.
#include <limits>

#include "kit/in_full.hpp"
#include "planner_kit.hpp"
#include "random_program.hpp"

namespace passo::test {
namespace {

class RandomPrograms : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    limits_ = random_limits(random_);
    path_ = smoothed(RandomProgram(random_).draw(1500));
    motion_ = plan(path_, limits_);
  }
  std::string seed() const { return "PASSO_SEED=" + std::to_string(random_.seed()); }

  Random random_{static_cast<std::uint64_t>(GetParam())};
  MotionLimits limits_;
  std::vector<PathItem> path_;
  std::vector<MotionItem> motion_;
};

TEST_P(RandomPrograms, keep_every_axis_within_its_velocity_and_acceleration) {
  SCOPED_TRACE(seed());
  for (const MotionItem& item : motion_) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) continue;
    SCOPED_TRACE(passo::to_text(*move));
    expect_within_limits(*move, limits_);
    if (HasFatalFailure()) return;
  }
}

TEST_P(RandomPrograms, keep_motors_that_axes_share_within_their_limits) {
  SCOPED_TRACE(seed());
  for (const double sign : {1.0, -1.0}) {
    limits_.rows.push_back({.row = {{Axis::x, 1}, {Axis::y, sign}},
                            .velocity = limits_.velocity[Axis::x] * random_.between(0.3, 1),
                            .acceleration = limits_.acceleration[Axis::y] * random_.between(0.3, 1)});
  }
  path_.resize(path_.size() / 3);
  const std::vector<MotionItem> motion = plan(path_, limits_);
  expect_continuous(motion);
  for (const MotionItem& item : motion) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) continue;
    SCOPED_TRACE(passo::to_text(*move));
    expect_within_limits(*move, limits_);
    if (HasFatalFailure()) return;
  }
  // The limits of the motors are felt.
  MotionLimits of_axes = limits_;
  of_axes.rows.clear();
  EXPECT_GT(total_time(motion), total_time(plan(path_, of_axes)));
}

TEST_P(RandomPrograms, move_without_jumps_and_rest_at_actions_and_at_the_end) {
  SCOPED_TRACE(seed());
  expect_continuous(motion_);
}

TEST_P(RandomPrograms, play_every_segment_in_order_and_every_action) {
  SCOPED_TRACE(seed());
  std::size_t at = 0;
  for (const MotionItem& item : motion_) {
    ASSERT_LT(at, path_.size());
    if (const auto* move = std::get_if<PlannedMove>(&item)) {
      const auto& segment = std::get<Segment>(path_[at]);
      ASSERT_EQ(move->segment.curve.start(), segment.curve.start());
      ASSERT_EQ(move->segment.source.line, segment.source.line);
      if (move->to == segment.curve.length()) ++at;
    } else {
      ASSERT_EQ(std::get<Action>(item).source.line, std::get<Action>(path_[at]).source.line);
      ++at;
    }
  }
  ASSERT_EQ(at, path_.size());
}

TEST_P(RandomPrograms, take_no_longer_without_limits_of_jerk) {
  SCOPED_TRACE(seed());
  const std::vector<PathItem> path = smoothed(RandomProgram(random_).draw(200), Smoothness::slow_bending);
  MotionLimits jerk = limits_;
  const double rise = std::exp(random_.between(-6, -2));
  for (const Axis axis : all_axes) jerk.jerk[axis] = MmPerSecond3(limits_.acceleration[axis].value() / rise);
  EXPECT_LE(total_time(plan(path, limits_)), total_time(plan(path, jerk)) * 1.001);
}

// A move may end within a cell that was halved.
TEST_P(RandomPrograms, are_planned_as_if_seen_whole) {
  SCOPED_TRACE(seed());
  const std::vector<double> exits = exits_offline(path_, limits_);
  std::size_t cell = 0;
  CellCutter cutter(limits_);
  double end = 0;
  for (const MotionItem& item : motion_) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) continue;
    if (move->from() == Mm(0)) {
      cutter.begin(move->segment, std::numeric_limits<double>::infinity());
      end = 0;
    }
    LoneCell piece;
    for (; end < move->to.value(); end = piece.cell.end) {
      ASSERT_FALSE(cutter.at_end());
      cutter.next(piece.place());
      ++cell;
    }
    if (end > move->to.value()) continue;
    const double reached = exit_speed(*move);
    ASSERT_NEAR(reached * reached, exits[cell - 1], 1e-5 * (1 + exits[cell - 1])) << "cell " << cell;
  }
  ASSERT_EQ(cell, exits.size());
}

TEST_P(RandomPrograms, stay_safe_when_the_queue_is_too_short_for_braking) {
  SCOPED_TRACE(seed());
  const std::vector<MotionItem> hurried = plan(path_, limits_, 70);
  expect_continuous(hurried);
  if (HasFatalFailure()) return;
  for (const MotionItem& item : hurried) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) expect_within_limits(*move, limits_);
    if (HasFatalFailure()) return;
  }
  EXPECT_GE(total_time(hurried), total_time(motion_) * (1 - 1e-9));
}

// Hold, resume and override at any time, in moves of a few milliseconds.
TEST_P(RandomPrograms, keep_all_that_in_spite_of_holds_and_overrides) {
  SCOPED_TRACE(seed());
  ListSource<PathItem> source(std::vector<PathItem>(path_.begin(), path_.begin() + 600));
  Planner planner(source, limits_);
  planner.limit_moves_to(Seconds(0.1));
  std::vector<MotionItem> motion;
  bool holding = false;
  int holds = 0;
  double override = 1;
  MotionItem item;
  while (planner.next(item)) {
    const auto* action = std::get_if<Action>(&item);
    if (action != nullptr && action->kind == Action::Kind::feed_hold) {
      ASSERT_TRUE(holding);
      holding = false;
      planner.resume();
      continue;
    }
    if (auto* move = std::get_if<PlannedMove>(&item)) {
      ASSERT_LE(move->duration().value(), 0.1 * 1.1);  // dust is not cut

      // The limits below use the old feed until the motion has slowed down to the new one.
      move->segment.speed = MmPerSecond(std::numeric_limits<double>::infinity());
    }
    motion.push_back(item);
    if (!holding && random_.chance(0.02)) {
      holding = true;
      ++holds;
      planner.hold();
    }
    if (random_.chance(0.01)) planner.set_feed_override(override = random_.between(0.3, 2));
  }
  EXPECT_GT(holds, 10);
  expect_continuous(motion);
  if (HasFatalFailure()) return;
  for (const MotionItem& planned : motion) {
    if (const auto* move = std::get_if<PlannedMove>(&planned)) expect_within_limits(*move, limits_);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPrograms, testing::Range(0, fewer(4)));

}  // namespace
}  // namespace passo::test
