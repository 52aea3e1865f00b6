#include "passo/trajectory/planner.hpp"

#include <algorithm>
#include <cmath>

#include "random_program.hpp"

#include "passo/trajectory/motion_text.hpp"
#include "passo/trajectory/segment_limits.hpp"

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

void expect_within_limits(const PlannedMove& move, const MotionLimits& limits) {
  for (const Phase& phase : move) {
    for (int k = 0; k <= 16; ++k) {
      const Real t = Real(phase.duration.value()) * k / 16;
      const Real v = phase.velocity.value() + phase.acceleration.value() * t;
      const Real s = phase.start.value() + t * (phase.velocity.value() + t * phase.acceleration.value() / 2);
      ASSERT_GE(v, -1e-12L);
      ASSERT_LE(v, Real(move.segment.speed.value()) * (1 + 1e-12L));
      const Motion motion = motion_at(move.segment.curve, s, v, phase.acceleration.value());
      for (const Axis axis : all_axes) {
        ASSERT_LE(std::abs(motion.velocity[axis]), limits.velocity[axis].value() * (1 + 1e-9L)) << letter_of(axis);
        ASSERT_LE(std::abs(motion.acceleration[axis]), limits.acceleration[axis].value() * (1 + 1e-9L))
            << letter_of(axis) << " at s " << double(s) << " of " << move.segment.curve.length().value();
      }
    }
  }
}

void expect_continuous(const std::vector<MotionItem>& motion) {
  double speed = 0;
  for (const MotionItem& item : motion) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) {
      ASSERT_EQ(speed, 0) << "an action not at rest";
      continue;
    }
    SCOPED_TRACE(passo::to_text(*move));
    const double length = move->segment.curve.length().value();
    double position = 0;
    ASSERT_GE(move->phase_count, 1U);
    for (const Phase& phase : *move) {
      ASSERT_GT(phase.duration.value(), 0);
      ASSERT_NEAR(phase.start.value(), position, 1e-12 * length);
      ASSERT_NEAR(phase.velocity.value(), speed, 1e-9 * speed);
      position = phase.position_at(phase.duration).value();
      speed = phase.velocity_at(phase.duration).value();
      ASSERT_GE(speed, 0);
    }
    ASSERT_NEAR(position, length, 1e-12 * length);
  }
  ASSERT_EQ(speed, 0) << "the program does not end at rest";
}

// The whole program at once: backwards, then forwards. The squares of the speeds at which moves are entered.
std::vector<double> entries_offline(const std::vector<PathItem>& path, const MotionLimits& limits) {
  const std::size_t n = path.size();
  std::vector<double> cap(n + 1, 0), reach(n, 0);
  Mm straight{0};
  for (std::size_t i = 0; i < n; ++i) {
    const auto* segment = std::get_if<Segment>(&path[i]);
    if (segment == nullptr) continue;
    const Mm straight_before = straight;
    straight = segment->curve.length();
    const SegmentLimits own = segment_limits(*segment, limits);
    reach[i] = 2 * own.acceleration.value() * segment->curve.length().value();
    const auto* before = i > 0 ? std::get_if<Segment>(&path[i - 1]) : nullptr;
    if (before == nullptr) continue;
    const double top = std::min(own.speed, segment_limits(*before, limits).speed).value();
    const Junction junction = junction_between(*before, *segment, straight_before, limits);
    if (junction.straight) straight += straight_before;
    cap[i] = std::min(junction.speed.value() * junction.speed.value(), top * top);
  }
  for (std::size_t i = n; i-- > 0;) cap[i] = std::min(cap[i], cap[i + 1] + reach[i]);
  for (std::size_t i = 0; i < n; ++i) cap[i + 1] = std::min(cap[i + 1], cap[i] + reach[i]);
  return cap;
}

struct Corner {
  Real turn = 0;          // radians
  Real acceleration = 0;  // along the change of direction
  bool only_xyz = true;
};
Corner corner_between(const Curve& in, const Curve& out, const MotionLimits& limits) {
  PerAxis<Real> in_unit;
  PerAxis<Real> out_unit;
  Corner corner;
  Real across = 0;
  Real along = 0;
  for (const Axis axis : all_axes) {
    in_unit[axis] = (Real(in.end()[axis]) - Real(in.start()[axis])) / Real(in.length().value());
    out_unit[axis] = (Real(out.end()[axis]) - Real(out.start()[axis])) / Real(out.length().value());
    across += (out_unit[axis] - in_unit[axis]) * (out_unit[axis] - in_unit[axis]);
    along += (out_unit[axis] + in_unit[axis]) * (out_unit[axis] + in_unit[axis]);
    corner.only_xyz &= axis <= Axis::z || (in_unit[axis] == 0 && out_unit[axis] == 0);
  }
  corner.turn = 2 * std::atan2(std::sqrt(across), std::sqrt(along));
  corner.acceleration = std::numeric_limits<Real>::infinity();
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    const Real part = std::abs(out_unit[axis] - in_unit[axis]) / std::sqrt(across);
    if (part > 0) corner.acceleration = std::min(corner.acceleration, limits.acceleration[axis].value() / part);
  }
  return corner;
}

class RandomPrograms : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    limits_ = test::random_limits(random_);
    path_ = test::RandomProgram(random_).draw(4000);
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

TEST_P(RandomPrograms, keep_the_order_of_their_items) {
  SCOPED_TRACE(seed());
  const auto line_of = [](const auto& item) {
    return std::visit(
        [](const auto& what) {
          if constexpr (requires { what.segment; })
            return what.segment.source.line;
          else
            return what.source.line;
        },
        item);
  };
  ASSERT_EQ(motion_.size(), path_.size());
  for (std::size_t i = 0; i < path_.size(); ++i) ASSERT_EQ(line_of(motion_[i]), line_of(path_[i]));
}

TEST_P(RandomPrograms, are_planned_as_if_seen_whole) {
  SCOPED_TRACE(seed());
  const std::vector<double> entries = entries_offline(path_, limits_);
  double speed_after = 0;
  for (std::size_t i = 0; i < path_.size(); ++i) {
    const auto* move = std::get_if<PlannedMove>(&motion_[i]);
    if (move == nullptr) continue;
    // A phase that ends at rest may begin a rounding beside its speed.
    const double expected = std::sqrt(entries[i]);
    ASSERT_NEAR(entry_speed(*move), expected, 1e-15 * expected) << "item " << i;
    speed_after = std::sqrt(entries[i + 1]);
    ASSERT_NEAR(exit_speed(*move), speed_after, 1e-9 * speed_after) << "item " << i;
    if (move->phase_count == 3) {
      const double top = segment_limits(move->segment, limits_).speed.value();
      ASSERT_DOUBLE_EQ(move->phases[1].velocity.value(), top) << "cruises below its top speed";
    }
  }
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

// By angles, in long double: the circle beside the corner, and it begins within half of the straight way before.
TEST_P(RandomPrograms, pass_junctions_of_lines_no_faster_than_the_circle_beside_them) {
  SCOPED_TRACE(seed());
  int checked = 0;
  Real straight = 0;
  for (std::size_t i = 1; i < motion_.size(); ++i) {
    const auto* before = std::get_if<PlannedMove>(&motion_[i - 1]);
    const auto* after = std::get_if<PlannedMove>(&motion_[i]);
    if (before == nullptr || after == nullptr) {
      straight = 0;
      continue;
    }
    const Curve& in = before->segment.curve;
    const Curve& out = after->segment.curve;
    straight += in.length().value();
    if (in.shape() != Curve::Shape::line || out.shape() != Curve::Shape::line) {
      straight = 0;
      continue;
    }
    const Corner corner = corner_between(in, out, limits_);
    const Real straight_before = straight;
    if (corner.turn > 1e-6L) straight = 0;
    if (before->segment.mode != PathMode::continuous || !corner.only_xyz) continue;
    if (corner.turn < 1e-3L || corner.turn > 3.14L) continue;
    const Real half = corner.turn / 2;
    const Real by_tolerance = Real(before->segment.tolerance.value()) * std::cos(half) / (1 - std::cos(half));
    const Real radius = std::min(by_tolerance, straight_before / 2 / std::tan(half));
    ASSERT_LE(entry_speed(*after), std::sqrt(corner.acceleration * radius) * (1 + 1e-6L)) << "item " << i;
    ++checked;
  }
  EXPECT_GT(checked, 100);
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
  test::expect_golden(
      "src/trajectory/tests/golden/square.txt",
      to_text(plan(polyline({xyz(0, 0), xyz(10, 0), xyz(10, 10), xyz(0, 10), xyz(0, 0)}, 20), equal_limits(100, 500))));
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

TEST(Planner, a_right_angle_is_passed_at_the_speed_of_the_circle_beside_it) {
  const auto motion = plan(polyline({xyz(0, 0), xyz(50, 0), xyz(50, 50)}, 50), equal_limits(100, 500));
  // The circle's radius is 0.01·cos 45°/(1 − cos 45°); along the diagonal two axes give √2 times 500.
  const double radius = 0.01 * std::sqrt(0.5) / (1 - std::sqrt(0.5));
  EXPECT_NEAR(entry_speed(std::get<PlannedMove>(motion[1])), std::sqrt(500 * std::sqrt(2) * radius), 1e-9);
}

TEST(Planner, exact_stop_stops_and_exact_path_stops_at_corners_only) {
  for (const auto& [mode, bend, stops] :
       {std::tuple(PathMode::exact_stop, 0.0, true), std::tuple(PathMode::exact_path, 0.0, false),
        std::tuple(PathMode::exact_path, 0.005, false), std::tuple(PathMode::exact_path, 0.02, true)}) {
    std::vector<PathItem> path = polyline({xyz(0, 0), xyz(50, 0), xyz(100, 50 * bend)}, 50);
    std::get<Segment>(path[0]).mode = mode;
    std::get<Segment>(path[0]).tolerance = Mm(0);
    const double speed = entry_speed(std::get<PlannedMove>(plan(path, equal_limits(100, 500))[1]));
    if (stops) {
      EXPECT_EQ(speed, 0);
    } else {
      EXPECT_DOUBLE_EQ(speed, 50);
    }
  }
}

TEST(Planner, splitting_a_line_hardly_changes_its_time) {
  const Point end = xyz(80, 37, 11);
  const auto whole = plan(polyline({xyz(0, 0), end, xyz(80, 0)}, 150), equal_limits(200, 700));
  for (const int pieces : {2, 7, 100, 10'000}) {
    std::vector<Point> corners;
    for (int i = 0; i <= pieces; ++i) corners.push_back(end * (double(i) / pieces));
    corners.push_back(xyz(80, 0));
    EXPECT_NEAR(total_time(plan(polyline(corners, 150), equal_limits(200, 700))) / total_time(whole), 1, 1e-3)
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
    // Straight on after it, so that the spiral is still speeding up where it is widest.
    const Point end = spiral.curve.end();
    const Point beyond = end + spiral.curve.tangent(spiral.curve.length()) * 500;
    const auto motion = plan({spiral, line(end, beyond, 1e5)}, limits);
    SCOPED_TRACE(to_text(motion));
    expect_within_limits(std::get<PlannedMove>(motion.at(0)), limits);
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
    // Faster by what two axes give together along a diagonal, on which an arc does not count.
    EXPECT_NEAR(total_time(plan(polyline(corners, 300), equal_limits(400, 500))) / round, 0.84, 0.05) << chords;
  }
}

TEST(Planner, dust_of_a_nanometre_thousandth_is_planned_without_a_jump) {
  std::vector<Point> corners;
  for (int i = 0; i <= 3000; ++i) corners.push_back(xyz(1 + 1e-9 * i, 0));
  corners.push_back(xyz(50, 0));
  corners.push_back(xyz(50 + 1e-9, 0));
  corners.push_back(xyz(50 + 1e-9, 1e-9));
  corners.push_back(xyz(100, 1e-9));
  const auto motion = plan(polyline(corners, 100), equal_limits(200, 700));
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
