// JerkProfile where nothing is mended: the motion given is still within the limits.
#include "../jerk_profile.hpp"

#include "jerk_kit.hpp"

namespace passo::test {
namespace {

std::vector<MotionItem> planned_with(int rounds, const std::vector<PathItem>& path, const MotionLimits& limits) {
  const std::vector<LimitedAxis> axes = axes_with_limits(limits);
  JerkProfile profile(axes, {.rounds = rounds});
  JerkCutter cutter(axes);
  std::vector<AxisShape> shapes(axes.size());
  std::vector<Segment> segments;
  for (const PathItem& item : path) segments.push_back(std::get<Segment>(item));
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const bool is_last = i + 1 == segments.size();
    cutter.begin(segments[i], {.entry_squared = i == 0 ? 0 : cutter.joint_cap(segments[i - 1], segments[i]),
                               .exit_squared = is_last ? 0 : cutter.joint_cap(segments[i], segments[i + 1]),
                               .feed = segments[i].speed.value()});
    for (JerkCell cell; cutter.next(cell, shapes.data());) {
      profile.push(cell, shapes.data());
    }
  }
  const std::size_t planned = profile.plan(true);
  EXPECT_EQ(planned, profile.size());
  std::vector<MotionItem> motion;
  std::size_t at = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    PlannedMove move;
    move.segment = segments.at(at);
    profile.add_phases(i, move);
    const Phase& last = move.phases[move.phase_count - 1];
    move.to = last.position_at(last.duration);
    motion.emplace_back(move);
    if (profile.cell(i).ends_segment) ++at;
  }
  return motion;
}

TEST(JerkProfile, keeps_every_limit_with_no_mending_at_all_and_takes_hardly_longer) {
  Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  for (int n = 0; n < 12; ++n) {
    SCOPED_TRACE(n);
    const MotionLimits limits =
        jerk_limits(std::exp(random.between(3, 6)), std::exp(random.between(5, 8)), std::exp(random.between(8, 12)));
    const std::vector<PathItem> path = smooth_chain(random, 20);
    const std::vector<MotionItem> slow = planned_with(0, path, limits);
    expect_within_limits(slow, limits);
    if (HasFatalFailure()) return;
    EXPECT_LT(total_time(slow), 1.2 * total_time(plan(path, limits)));
  }
}

// The accelerations of this guess would make the path run back in the second cell.
TEST(JerkOptimizer, raises_a_guess_that_cannot_be_driven) {
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  const std::vector<LimitedAxis> axes = axes_with_limits(limits);
  constexpr std::size_t count = 4;
  std::vector<JerkCell> cells;
  std::vector<AxisShape> shapes;
  for (std::size_t i = 0; i < count; ++i) {
    cells.push_back({.start = static_cast<double>(i),
                     .length = 1,
                     .top_squared = 100,
                     .acceleration = 500,
                     .jerk = 25'000,
                     .straight = true});
    shapes.push_back({.slope_in = 1, .slope_out = 1});
    shapes.insert(shapes.end(), axes.size() - 1, {});
  }
  const std::vector<double> share(count, 1);
  const std::vector<double> cap(count, 100);
  const std::vector<double> node_cap(count + 1, 100);
  std::vector<NodeState> states(count + 1, {.speed = 1});
  states[1].acceleration = -20;
  states[2].acceleration = 20;
  JerkOptimizer lift(axes);
  ASSERT_TRUE(lift.raise({.cells = cells, .shapes = shapes, .share = share, .cap = cap, .node_cap = node_cap}, 0, count,
                         states));
  EXPECT_GT(states[2].speed, 2.2);
}

// From rest an axis without a limit of jerk is at its feed at once. The guess took the next axis's jerk for all the way
// from the rest, so that the speed fell by nine tenths between two nodes. The cell there was split 40 times, the pieces
// had no phases at any speed, and no plan was found.
TEST(JerkProfile, begins_on_an_axis_without_a_limit_of_jerk_and_goes_on_with_another) {
  MotionLimits limits = jerk_limits(200, 250, 4000);
  limits.jerk[Axis::x] = MmPerSecond3(0);
  JerkProfile profile(axes_with_limits(limits));
  constexpr std::size_t each = 9;
  constexpr double feed = 0.02;
  double way = 0;
  for (std::size_t i = 0; i < 2 * each; ++i) {
    const bool on_x = i < each;
    std::vector<AxisShape> shapes(3);
    shapes[on_x ? 0 : 1] = {.slope_in = 1, .slope_out = 1};
    const JerkCell cell{.start = way,
                        .length = on_x ? 1e-8 : std::ldexp(1e-9, static_cast<int>(2 * (i - each))),
                        .top_squared = feed * feed,
                        .acceleration = 250,
                        .jerk = on_x ? 1e13 : 4000,
                        .straight = true};
    profile.push(cell, shapes.data());
    way += cell.length;
  }
  const std::size_t decided = profile.plan(true);
  ASSERT_EQ(decided, profile.size());
  EXPECT_LE(profile.size(), 4 * each);
  double time = 0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    PlannedMove move;
    profile.add_phases(i, move);
    time += move.duration().value();
  }
  // The way at the feed, and the time in which Y alone would brake with a third of its jerk.
  EXPECT_LT(time, way / feed + 4 * std::sqrt(3 * feed / 4000));
}

// Cells of any length side by side on a line, which no cutter makes. Some have no phases at any speed until the stretch
// gets another shape.
class UnevenLine {
 public:
  UnevenLine(Random& random, double shortest, double longest)
      : random_(random),
        shortest_(shortest),
        longest_(longest),
        limits_(jerk_limits(100, 500, std::exp(random.between(8, 12)))),
        profile_(axes_with_limits(limits_)) {}

  JerkProfile& profile() { return profile_; }

  void push() {
    const std::vector<AxisShape> shapes = {{.slope_in = 1, .slope_out = 1}, {}, {}};
    const double length = std::exp(random_.between(shortest_, longest_));
    const double top = std::exp(random_.between(0, 4.6));
    profile_.push({.start = s_,
                   .length = length,
                   .top_squared = top * top,
                   .acceleration = 500,
                   .jerk = limits_.jerk[Axis::x].value(),
                   .straight = true},
                  shapes.data());
    s_ += length;
  }
  void play(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      PlannedMove move;
      move.segment = segment_of(Curve::line(xyz(0, 0), xyz(1e6, 0)), 100);
      profile_.add_phases(i, move);
      const Phase& last = move.phases[move.phase_count - 1];
      move.to = last.position_at(last.duration);
      motion_.emplace_back(move);
    }
    profile_.drop(count);
  }
  void expect_good() const { expect_within_limits(motion_, limits_); }

 private:
  Random& random_;
  double shortest_;  // logarithms of millimetres
  double longest_;
  MotionLimits limits_;
  JerkProfile profile_;
  double s_ = 0;
  std::vector<MotionItem> motion_;
};

TEST(JerkProfile, keeps_every_limit_on_cells_that_hardly_fit_together) {
  Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    UnevenLine line(random, -10, 4);
    for (int i = 0; i < 8; ++i) line.push();
    const std::size_t planned = line.profile().plan(true);
    ASSERT_EQ(planned, line.profile().size());
    line.play(planned);
    line.expect_good();
    if (HasFatalFailure()) return;
  }
}

// Where no plan is found in motion, the plan before goes on, to its last cell.
TEST(JerkProfile, keeps_every_limit_from_window_to_window) {
  Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  int fell_back = 0;
  for (int n = 0; n < 300; ++n) {
    SCOPED_TRACE(n);
    UnevenLine line(random, -8, 1);
    JerkProfile& profile = line.profile();
    constexpr std::size_t queued = 12;
    for (int pushed = 0; pushed < 60 || profile.size() > 0;) {
      for (; pushed < 60 && profile.size() < queued; ++pushed) line.push();
      const bool closed = pushed == 60;
      std::size_t decided = profile.plan(closed);
      if (!closed) decided = std::max(decided, (profile.planned() + 1) / 2);
      if (profile.fell_back()) ++fell_back;
      line.play(decided);
    }
    line.expect_good();
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(fell_back, 100);
}

}  // namespace
}  // namespace passo::test
