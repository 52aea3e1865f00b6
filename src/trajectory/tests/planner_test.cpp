#include "passo/trajectory/planner.hpp"

#include <algorithm>
#include <cmath>

#include "../cell.hpp"
#include "../speed_window.hpp"
#include "random_program.hpp"

#include "passo/path/path_smoother.hpp"
#include "passo/trajectory/motion_text.hpp"

namespace passo {
namespace {

using test::xyz;
using Real = long double;

MotionLimits equal_limits(double velocity, double acceleration) {
  MotionLimits limits;
  for (const Axis axis : all_axes) {
    limits.velocity[axis] = MmPerSecond(velocity);
    limits.acceleration[axis] = MmPerSecond2(acceleration);
  }
  return limits;
}

Segment line(const Point& start, const Point& end, double speed) {
  return {.curve = Curve::line(start, end),
          .speed = MmPerSecond(speed),
          .rapid = false,
          .mode = PathMode::continuous,
          .tolerance = Mm(0.01),
          .source = {}};
}

std::vector<PathItem> polyline(const std::vector<Point>& corners, double speed) {
  std::vector<PathItem> items;
  for (std::size_t i = 1; i < corners.size(); ++i) items.emplace_back(line(corners[i - 1], corners[i], speed));
  return items;
}

std::vector<MotionItem> plan(const std::vector<PathItem>& path, const MotionLimits& limits,
                             std::size_t most_queued = Planner::most_queued_cells) {
  test::ListSource<PathItem> source(path);
  Planner planner(source, limits, most_queued);
  return test::drain(planner);
}

// As a job does it: rounded corners.
std::vector<PathItem> smoothed(const std::vector<PathItem>& path) {
  test::ListSource<PathItem> source(path);
  PathSmoother smoother(source);
  return test::drain(smoother);
}

double total_time(const std::vector<MotionItem>& motion) {
  double sum = 0;
  for (const MotionItem& item : motion) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) sum += move->duration().value();
  }
  return sum;
}

double entry_speed(const PlannedMove& move) {
  return move.begin()->velocity.value();
}
double exit_speed(const PlannedMove& move) {
  const Phase& last = *(move.end() - 1);
  return last.velocity_at(last.duration).value();
}

std::string to_text(const std::vector<MotionItem>& motion) {
  std::string text;
  for (const MotionItem& item : motion) text += passo::to_text(item);
  return text;
}

// Velocity and acceleration of every axis where the path speed is v and its change a: from the polar form, by hand.
struct Motion {
  PerAxis<Real> velocity;
  PerAxis<Real> acceleration;
};
Motion motion_at(const Curve& curve, Real s, Real v, Real a) {
  const Real length = curve.length().value();
  Motion motion;
  for (const Axis axis : all_axes) {
    const Real slope = (Real(curve.end()[axis]) - Real(curve.start()[axis])) / length;
    motion.velocity[axis] = slope * v;
    motion.acceleration[axis] = slope * a;
  }
  if (curve.shape() == Curve::Shape::line) return motion;
  if (curve.shape() == Curve::Shape::cubic) {
    const Curve::CubicData cubic = curve.cubic_data();
    for (const Axis axis : all_axes) {
      const Real slope = cubic.first[axis] + s * (2 * Real(cubic.second[axis]) + 3 * s * Real(cubic.third[axis]));
      const Real bend = 2 * Real(cubic.second[axis]) + 6 * s * Real(cubic.third[axis]);
      motion.velocity[axis] = slope * v;
      motion.acceleration[axis] = slope * a + bend * v * v;
    }
    return motion;
  }
  const Curve::ArcData& arc = curve.arc_data();
  const Real radius = arc.start_radius + (Real(arc.end_radius) - arc.start_radius) * s / length;
  const Real angle = arc.start_angle + Real(arc.sweep) * s / length;
  const Real radius_rate = (Real(arc.end_radius) - arc.start_radius) / length * v;
  const Real angle_rate = Real(arc.sweep) / length * v;
  const Real radius_change = (Real(arc.end_radius) - arc.start_radius) / length * a;
  const Real angle_change = Real(arc.sweep) / length * a;
  const Real radial = radius_change - radius * angle_rate * angle_rate;
  const Real around = radius * angle_change + 2 * radius_rate * angle_rate;
  const Real cosine = std::cos(angle);
  const Real sine = std::sin(angle);
  motion.velocity[arc.first] = radius_rate * cosine - radius * angle_rate * sine;
  motion.velocity[arc.second] = radius_rate * sine + radius * angle_rate * cosine;
  motion.acceleration[arc.first] = radial * cosine - around * sine;
  motion.acceleration[arc.second] = radial * sine + around * cosine;
  return motion;
}

void expect_within_limits(const PlannedMove& move, const MotionLimits& limits, Real slack = 1e-4L) {
  for (const Phase& phase : move) {
    for (int k = 0; k <= 16; ++k) {
      const Real t = Real(phase.duration.value()) * k / 16;
      const Real v = phase.velocity.value() + phase.acceleration.value() * t;
      const Real s = phase.start.value() + t * (phase.velocity.value() + t * phase.acceleration.value() / 2);
      ASSERT_GE(v, -1e-12L);
      ASSERT_LE(v, Real(move.segment.speed.value()) * (1 + 1e-9L));
      const Motion motion = motion_at(move.segment.curve, s, v, phase.acceleration.value());
      for (const Axis axis : all_axes) {
        ASSERT_LE(std::abs(motion.velocity[axis]), limits.velocity[axis].value() * (1 + 1e-6L)) << letter_of(axis);
        ASSERT_LE(std::abs(motion.acceleration[axis]), limits.acceleration[axis].value() * (1 + slack))
            << letter_of(axis) << " at s " << double(s) << " of " << move.segment.curve.length().value();
      }
    }
  }
}

void expect_continuous(const std::vector<MotionItem>& motion) {
  double speed = 0;
  double position = 0;  // on the segment
  for (const MotionItem& item : motion) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) {
      ASSERT_EQ(speed, 0) << "an action not at rest";
      continue;
    }
    SCOPED_TRACE(passo::to_text(*move));
    const double length = move->segment.curve.length().value();
    ASSERT_GE(move->phase_count, 1U);
    for (const Phase& phase : *move) {
      ASSERT_GT(phase.duration.value(), 0);
      ASSERT_NEAR(phase.start.value(), position, 1e-11 * length);
      ASSERT_NEAR(phase.velocity.value(), speed, 1e-9 * (1 + speed));
      position = phase.position_at(phase.duration).value();
      speed = phase.velocity_at(phase.duration).value();
      ASSERT_GE(speed, 0);
    }
    ASSERT_NEAR(position, move->to.value(), 1e-11 * length);
    if (move->to.value() == length) position = 0;
  }
  ASSERT_EQ(position, 0) << "a segment is not played to its end";
  ASSERT_EQ(speed, 0) << "the program does not end at rest";
}

// The whole program at once: backwards over all cells, then forwards. The squares of the speeds at their ends.
std::vector<double> exits_offline(const std::vector<PathItem>& path, const MotionLimits& limits) {
  struct Whole {
    CellCutter::Piece piece;
    double top = 0;
    double entry = 0;
  };
  std::vector<Whole> cells;
  CellCutter cutter(limits);
  const Segment* before = nullptr;
  for (const PathItem& item : path) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment != nullptr) cutter.begin(*segment);
    bool rest = before == nullptr || segment == nullptr || before->mode == PathMode::exact_stop;
    if (!rest) {
      const Point turn = segment->curve.tangent(Mm(0)) - before->curve.tangent(before->curve.length());
      for (const double part : turn.values) rest = rest || std::abs(part) > 1e-6;
    }
    before = segment;
    Whole cell;
    while (segment != nullptr && cutter.next(cell.piece)) {
      cell.top = std::min(cell.piece.cell.top_squared, cell.piece.cell.feed_squared);
      cell.entry = rest || cells.empty() ? 0 : std::min(cell.top, cells.back().top);
      rest = false;
      cells.push_back(cell);
    }
  }
  double exit = 0;
  for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell) {
    const Cell& data = cell->piece.cell;
    const std::span demands(cell->piece.demands.data(), cell->piece.demand_count);
    exit = cell->entry = data.straight ? std::min(cell->entry, exit + 2 * data.acceleration * data.length)
                                       : largest_entry(demands, cell->entry, std::min(exit, cell->top));
  }
  std::vector<double> exits;
  double speed = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& data = cells[i].piece.cell;
    const std::span demands(cells[i].piece.demands.data(), cells[i].piece.demand_count);
    const double most = std::min(cells[i].top, i + 1 < cells.size() ? cells[i + 1].entry : 0);
    const double change = 2 * data.acceleration * data.length;
    speed = data.straight ? std::min(most, speed + change) : largest_exit(demands, speed, most);
    exits.push_back(speed);
  }
  return exits;
}

class RandomPrograms : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    limits_ = test::random_limits(random_);
    path_ = smoothed(test::RandomProgram(random_).draw(4000));
    motion_ = plan(path_, limits_);
  }
  std::string seed() const { return "PASSO_SEED=" + std::to_string(random_.seed()); }

  test::Random random_;
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

TEST_P(RandomPrograms, are_planned_as_if_seen_whole) {
  SCOPED_TRACE(seed());
  const std::vector<double> exits = exits_offline(path_, limits_);
  std::size_t cell = 0;
  CellCutter cutter(limits_);
  for (const MotionItem& item : motion_) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) continue;
    if (move->from() == Mm(0)) cutter.begin(move->segment);
    CellCutter::Piece piece;
    double end = 0;
    do {
      ASSERT_TRUE(cutter.next(piece));
      end = piece.cell.start + piece.cell.length;
      ++cell;
    } while (end < move->to.value());
    const double expected = std::sqrt(exits[cell - 1]);
    ASSERT_NEAR(exit_speed(*move), expected, 1e-9 * (1 + expected)) << "cell " << cell;
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
  test::ListSource<PathItem> source(std::vector<PathItem>(path_.begin(), path_.begin() + 600));
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
      // A rest of a nanometre's thousandth is not cut off, however slowly it is crossed.
      ASSERT_LE(move->duration().value(), 0.1 * 1.1);
      // The feed that counts for the limits below: what it was, until it has slowed down to the new one.
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
    if (const auto* move = std::get_if<PlannedMove>(&planned)) expect_within_limits(*move, limits_, 1e-3L);
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Five, RandomPrograms, testing::Range(0, 5));

TEST(Planner, a_single_move_is_a_trapezoid_and_a_short_one_a_triangle) {
  std::vector<PathItem> path = polyline({xyz(0, 0), xyz(10, 0)}, 20);
  path.emplace_back(Action{.kind = Action::Kind::dwell, .dwell = Seconds(0.5)});
  path.emplace_back(line(xyz(10, 0), xyz(10.5, 0), 20));
  path.emplace_back(Action{.kind = Action::Kind::program_end});
  test::expect_golden("src/trajectory/tests/golden/trapezoid_and_triangle.txt",
                      to_text(plan(path, equal_limits(100, 500))));
}

TEST(Planner, a_square_slows_at_its_corners) {
  test::expect_golden("src/trajectory/tests/golden/square.txt",
                      to_text(plan(smoothed(polyline({xyz(0, 0), xyz(10, 0), xyz(10, 10), xyz(0, 10), xyz(0, 0)}, 20)),
                                   equal_limits(100, 500))));
}

TEST(Planner, a_stadium_is_driven_through_its_tangent_joints) {
  std::vector<PathItem> path = polyline({xyz(0, 0), xyz(20, 0)}, 20);
  Segment bow = line(xyz(20, 0), xyz(20, 10), 20);
  bow.curve = Curve::arc(xyz(20, 0), xyz(20, 10), Axis::x, Axis::y, 20, 5, std::numbers::pi);
  path.emplace_back(bow);
  path.emplace_back(line(xyz(20, 10), xyz(0, 10), 20));
  test::expect_golden("src/trajectory/tests/golden/stadium.txt", to_text(plan(path, equal_limits(100, 500))));
}

TEST(Planner, a_reversal_stops_at_the_corner) {
  const auto motion = plan(polyline({xyz(0, 0), xyz(7, 3, 1), xyz(0, 0)}, 20), equal_limits(100, 500));
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion[1])), 0, 1e-6);
}

TEST(Planner, a_rounded_right_angle_is_passed_faster_than_it_could_be_stopped_at) {
  const auto corner = polyline({xyz(0, 0), xyz(50, 0), xyz(50, 50)}, 50);
  const double rounded = total_time(plan(smoothed(corner), equal_limits(100, 500)));
  const double stopped = total_time(plan(corner, equal_limits(100, 500)));
  // A parabola with both axes at 500 mm/s² that passes 0.01 mm beside the corner saves 2 sqrt(sqrt(2) 0.01 / 500) s.
  EXPECT_LT(rounded, stopped - 0.006);
  EXPECT_GT(rounded, stopped - 0.0107);
}

TEST(Planner, exact_stop_stops_and_exact_path_stops_at_corners_only) {
  for (const auto& [mode, bend, stops] :
       {std::tuple(PathMode::exact_stop, 0.0, true), std::tuple(PathMode::exact_path, 0.0, false),
        std::tuple(PathMode::exact_path, 0.005, false), std::tuple(PathMode::exact_path, 0.02, true)}) {
    std::vector<PathItem> path = polyline({xyz(0, 0), xyz(50, 0), xyz(100, 50 * bend)}, 50);
    std::get<Segment>(path[0]).mode = mode;
    std::get<Segment>(path[0]).tolerance = Mm(0);
    double slowest = 50;
    double way = 0;
    for (const MotionItem& item : plan(smoothed(path), equal_limits(100, 500))) {
      const auto& move = std::get<PlannedMove>(item);
      const double speed = exit_speed(move);
      way += (move.to - move.from()).value();
      if (way > 20 && way < 80) slowest = std::min(slowest, speed);
    }
    EXPECT_EQ(slowest == 0, stops) << slowest;
    if (bend == 0 && !stops) {
      EXPECT_DOUBLE_EQ(slowest, 50);
    }
  }
}

TEST(Planner, splitting_a_line_hardly_changes_its_time) {
  const Point end = xyz(80, 37, 11);
  const auto whole = plan(smoothed(polyline({xyz(0, 0), end, xyz(80, 0)}, 150)), equal_limits(200, 700));
  for (const int pieces : {2, 7, 100, 10'000}) {
    std::vector<Point> corners;
    for (int i = 0; i <= pieces; ++i) corners.push_back(end * (double(i) / pieces));
    corners.push_back(xyz(80, 0));
    EXPECT_NEAR(total_time(plan(smoothed(polyline(corners, 150)), equal_limits(200, 700))) / total_time(whole), 1, 1e-3)
        << pieces;
  }
}

TEST(Planner, strong_spirals_keep_the_axes_within_their_limits_too) {
  test::Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  const MotionLimits limits = equal_limits(1e5, 500);
  for (int n = 0; n < 500; ++n) {
    const double start = random.between(-3, 3);
    const double sweep = random.between(0.3, random.chance(0.8) ? 1.5 : 12) * (random.chance(0.5) ? 1 : -1);
    const double radius = random.between(1, 20);
    Segment spiral = line(xyz(0, 0), xyz(1, 0), 1e5);
    spiral.curve = Curve::arc(xyz(radius * std::cos(start), radius * std::sin(start)),
                              xyz(radius * 2 * std::cos(start + sweep), radius * 2 * std::sin(start + sweep)), Axis::x,
                              Axis::y, 0, 0, sweep);
    const auto motion = plan({spiral}, limits);
    SCOPED_TRACE(to_text(motion));
    for (const MotionItem& item : motion) expect_within_limits(std::get<PlannedMove>(item), limits);
    if (HasFatalFailure()) return;
  }
}

TEST(Planner, a_circle_of_chords_is_driven_like_the_circle) {
  Segment circle = line(xyz(5, 0), xyz(5, 0), 300);
  circle.curve = Curve::arc(xyz(5, 0), xyz(5, 0), Axis::x, Axis::y, 0, 0, 4 * std::numbers::pi);
  const double round = total_time(plan({circle}, equal_limits(400, 500)));
  for (const int chords : {300, 3000, 30'000}) {
    std::vector<Point> corners;
    for (int i = 0; i <= 2 * chords; ++i) {
      const double angle = 2 * std::numbers::pi * i / chords;
      corners.push_back(xyz(5 * std::cos(angle), 5 * std::sin(angle)));
    }
    EXPECT_NEAR(total_time(plan(smoothed(polyline(corners, 300)), equal_limits(400, 500))) / round, 1, 0.01) << chords;
  }
}

TEST(Planner, dust_of_a_nanometre_thousandth_is_planned_without_a_jump) {
  std::vector<Point> corners;
  for (int i = 0; i <= 3000; ++i) corners.push_back(xyz(1 + 1e-9 * i, 0));
  corners.push_back(xyz(50, 0));
  corners.push_back(xyz(50 + 1e-9, 0));
  corners.push_back(xyz(50 + 1e-9, 1e-9));
  corners.push_back(xyz(100, 1e-9));
  const auto motion = plan(smoothed(polyline(corners, 100)), equal_limits(200, 700));
  expect_continuous(motion);
  for (const MotionItem& item : motion) expect_within_limits(std::get<PlannedMove>(item), equal_limits(200, 700));
}

// Counts how far the planner looks ahead of what it gave.
class Watched final : public Source<PathItem> {
 public:
  Watched(double size, std::size_t count) : size_(size), count_(count) {}
  [[nodiscard]] bool next(PathItem& item) override {
    if (pulled == count_) return false;
    const double at = size_ * static_cast<double>(pulled++);
    item = line(xyz(at, 0), xyz(at + size_, 0), 100);
    return true;
  }
  std::size_t pulled = 0;

 private:
  double size_;
  std::size_t count_;
};

TEST(Planner, looks_ahead_as_far_as_braking_needs_and_no_further) {
  // From 100 mm/s with 500 mm/s² braking takes 10 mm: 1,000 pieces of 0.01 mm.
  Watched source(0.01, 50'000);
  Planner planner(source, equal_limits(200, 500));
  std::size_t given = 0;
  std::size_t most = 0;
  for (MotionItem item; planner.next(item);) {
    most = std::max(most, source.pulled - given);
    ++given;
    // At the start not even that much: what the first pieces can reach, a few dozen behind them can brake from.
    if (given == 1) {
      EXPECT_LE(source.pulled, 64U);
    }
    if (given == 20'000) {
      EXPECT_DOUBLE_EQ(exit_speed(std::get<PlannedMove>(item)), 100);
    }
  }
  EXPECT_EQ(given, 50'000U);
  EXPECT_GT(most, 1'000U);
  EXPECT_LE(most, 2'100U);
}

TEST(Planner, never_queues_more_than_it_may) {
  Watched source(1e-6, 20'000);
  Planner planner(source, equal_limits(200, 500), 1'000);
  std::size_t given = 0;
  for (MotionItem item; planner.next(item); ++given) ASSERT_LE(source.pulled - given, 1'000U);
  EXPECT_EQ(given, 20'000U);
}

TEST(Planner, an_empty_path_is_no_motion) {
  EXPECT_TRUE(plan({}, equal_limits(1, 1)).empty());
}

}  // namespace
}  // namespace passo
