#include <algorithm>
#include <cmath>
#include <numbers>

#include "random_program.hpp"

#include "passo/trajectory/motion_text.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {
namespace {

using test::xyz;
using Real = double;

MotionLimits jerk_limits(double velocity, double acceleration, double jerk) {
  MotionLimits limits;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
    limits.velocity[axis] = MmPerSecond(velocity);
    limits.acceleration[axis] = MmPerSecond2(acceleration);
    limits.jerk[axis] = MmPerSecond3(jerk);
  }
  return limits;
}

Segment segment_of(const Curve& curve, double speed) {
  return {.curve = curve,
          .speed = MmPerSecond(speed),
          .rapid = false,
          .mode = PathMode::continuous,
          .tolerance = Mm(0.01),
          .source = {}};
}

Segment line(const Point& start, const Point& end, double speed) {
  return segment_of(Curve::line(start, end), speed);
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

std::string to_text(const std::vector<MotionItem>& motion) {
  std::string text;
  for (const MotionItem& item : motion) text += passo::to_text(item);
  return text;
}

// Place and derivatives of an axis by s, from the formulas.
struct Derivatives {
  Real place = 0;
  Real first = 0;
  Real second = 0;
  Real third = 0;
};
Derivatives derivatives(const Curve& curve, Axis axis, Real s) {
  const Real length = curve.length().value();
  const Real from = curve.start()[axis];
  const Real to = curve.end()[axis];
  if (curve.shape() == Curve::Shape::cubic) {
    const Real a = curve.cubic_data().first[axis];
    const Real b = curve.cubic_data().second[axis];
    const Real c = curve.cubic_data().third[axis];
    return {from + s * (a + s * (b + s * c)), a + s * (2 * b + s * 3 * c), 2 * b + 6 * c * s, 6 * c};
  }
  if (curve.shape() == Curve::Shape::arc && (axis == curve.arc_data().first || axis == curve.arc_data().second)) {
    const Curve::ArcData& arc = curve.arc_data();
    const Real turn = arc.sweep / length;
    const Real growth = (arc.end_radius - arc.start_radius) / length;
    const Real radius = arc.start_radius + growth * s;
    const Real angle = arc.start_angle + turn * s - (axis == arc.first ? 0 : std::numbers::pi_v<Real> / 2);
    const Real center = axis == arc.first ? arc.first_center : arc.second_center;
    const Real out = std::cos(angle);
    const Real on = -std::sin(angle) * turn;
    return {center + radius * out, growth * out + radius * on, 2 * growth * on - radius * turn * turn * out,
            -3 * growth * turn * turn * out - radius * turn * turn * on};
  }
  return {from + (to - from) * s / length, (to - from) / length, 0, 0};
}

struct AxisMotion {
  Real velocity = 0;
  Real acceleration = 0;
  Real jerk = 0;
};
AxisMotion motion_at(const Curve& curve, Axis axis, const Phase& phase, Real t) {
  const Real j = phase.jerk.value();
  const Real a = phase.acceleration.value() + j * t;
  const Real v = phase.velocity.value() + t * (phase.acceleration.value() + j * t / 2);
  const Real s = phase.start.value() + t * (phase.velocity.value() + t * (phase.acceleration.value() / 2 + j * t / 6));
  const Derivatives q = derivatives(curve, axis, s);
  return {q.first * v, q.first * a + q.second * v * v, q.first * j + 3 * q.second * v * a + q.third * v * v * v};
}

// Looks at 40 places of each phase, and at what changes from each to the next.
class Oracle {
 public:
  explicit Oracle(const MotionLimits& limits) : limits_(limits) {}

  void check(const std::vector<MotionItem>& motion) {
    for (const MotionItem& item : motion) {
      const auto* move = std::get_if<PlannedMove>(&item);
      if (move == nullptr) {
        rest();
        continue;
      }
      SCOPED_TRACE(passo::to_text(*move));
      ASSERT_GE(move->phase_count, 1U);
      Real at = move->from().value();
      for (const Phase& phase : *move) {
        ASSERT_GT(phase.duration.value(), 0);
        ASSERT_NEAR(phase.start.value(), at, 1e-10);
        at = phase.position_at(phase.duration).value();
        check_phase(move->segment, phase);
        if (testing::Test::HasFatalFailure()) return;
      }
      ASSERT_NEAR(move->to.value(), at, 1e-10);
    }
    rest();
  }

 private:
  void rest() {
    for (const Axis axis : all_axes) {
      ASSERT_NEAR(before_[axis].velocity, 0, 1e-9);
      ASSERT_NEAR(before_[axis].acceleration, 0, 1e-9);
    }
  }

  void check_phase(const Segment& segment, const Phase& phase) {
    for (const Axis axis : all_axes) {
      const double v = limits_.velocity[axis].value();
      const double a = limits_.acceleration[axis].value();
      const double j = limits_.jerk[axis].value();
      const AxisMotion begin = motion_at(segment.curve, axis, phase, 0);
      if (v > 0) {
        ASSERT_NEAR(begin.velocity, before_[axis].velocity, 1e-6 * v);
      }
      if (j > 0) {
        ASSERT_NEAR(begin.acceleration, before_[axis].acceleration, 1e-3 * a);
      }
      for (int k = 0; k <= 40; ++k) {
        const AxisMotion here = motion_at(segment.curve, axis, phase, phase.duration.value() * k / 40.0);
        if (v > 0) {
          ASSERT_LE(std::abs(here.velocity), v * tolerated);
        }
        if (a > 0) {
          ASSERT_LE(std::abs(here.acceleration), a * tolerated);
        }
        if (j > 0) {
          ASSERT_LE(std::abs(here.jerk), j * tolerated);
        }
      }
      before_[axis] = motion_at(segment.curve, axis, phase, phase.duration.value());
    }
    for (int k = 0; k <= 40; ++k) {
      const double speed = phase.velocity_at(phase.duration * (k / 40.0)).value();
      ASSERT_GE(speed, -1e-9);
      ASSERT_LE(speed, segment.speed.value() * tolerated);
    }
  }

  static constexpr double tolerated = 1.0005;
  const MotionLimits limits_;
  PerAxis<AxisMotion> before_;
};

void expect_within_limits(const std::vector<MotionItem>& motion, const MotionLimits& limits) {
  Oracle(limits).check(motion);
}

// Pieces of a uniform cubic B-spline: their tangents and second derivatives go on from one to the next.
std::vector<PathItem> smooth_chain(test::Random& random, int pieces) {
  std::vector<Point> control{xyz(0, 0)};
  double direction = 0;
  double size = std::exp(random.between(-4, 2));
  const double wildness = random.between(0.01, 1.2);
  while (control.size() < static_cast<std::size_t>(pieces) + 3) {
    direction += random.between(-wildness, wildness);
    const Point step = xyz(std::cos(direction), std::sin(direction), random.between(-0.3, 0.3)) * size;
    control.push_back(control.back() + step * random.between(0.3, 1 / 1.05));
  }
  std::vector<PathItem> path;
  const double speed = std::exp(random.between(1, 6));
  const auto place = [&](std::size_t i) { return (control[i] + control[i + 1] * 4 + control[i + 2]) * (1.0 / 6); };
  const auto tangent = [&](std::size_t i) { return (control[i + 2] - control[i]) * (0.5 / size); };
  for (std::size_t i = 0; i + 3 < control.size(); ++i) {
    path.emplace_back(segment_of(Curve::cubic(place(i), tangent(i), place(i + 1), tangent(i + 1), Mm(size)), speed));
  }
  return path;
}

class JerkLimited : public testing::TestWithParam<int> {
 protected:
  MotionLimits draw_limits() {
    MotionLimits limits = jerk_limits(1, 1, 1);
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      limits.velocity[axis] = MmPerSecond(std::exp(random_.between(3, 6)));
      limits.acceleration[axis] = MmPerSecond2(std::exp(random_.between(5, 8)));
      limits.jerk[axis] = MmPerSecond3(std::exp(random_.between(8, 12)));
    }
    return limits;
  }
  std::string seed() const { return "PASSO_SEED=" + std::to_string(random_.seed()); }

  test::Random random_;
};

TEST_P(JerkLimited, smooth_chains_keep_every_axis_within_its_limits) {
  SCOPED_TRACE(seed());
  for (int n = 0; n < GetParam(); ++n) random_.between(0, 1);
  for (int n = 0; n < 10; ++n) {
    SCOPED_TRACE(n);
    const MotionLimits limits = draw_limits();
    std::vector<PathItem> path = smooth_chain(random_, 150);
    expect_within_limits(plan(path, limits), limits);
    if (HasFatalFailure()) return;
    expect_within_limits(plan(path, limits, 70), limits);
    if (HasFatalFailure()) return;
  }
}

TEST_P(JerkLimited, lines_arcs_and_rests_keep_every_axis_within_its_limits) {
  SCOPED_TRACE(seed());
  for (int n = 0; n < GetParam(); ++n) random_.between(0, 1);
  const MotionLimits limits = draw_limits();
  std::vector<PathItem> path = test::RandomProgram(random_).draw(1000);
  expect_within_limits(plan(path, limits), limits);
}

INSTANTIATE_TEST_SUITE_P(Five, JerkLimited, testing::Range(0, 5));

TEST(JerkLimitedPlanner, a_line_is_driven_from_rest_to_rest_in_s_curves) {
  test::expect_golden("src/trajectory/tests/golden/s_curve.txt",
                      to_text(plan({line(xyz(0, 0), xyz(10, 0), 40)}, jerk_limits(100, 500, 25'000))));
}

// From rest to a speed v takes v/a + a/j, and as much back: that is the least time.
TEST(JerkLimitedPlanner, a_line_takes_hardly_longer_than_the_best_s_curve) {
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  const double best = 100.0 / 50 + 50.0 / 500 + 500.0 / 25'000;
  const double time = total_time(plan({line(xyz(0, 0), xyz(100, 0), 50)}, limits));
  EXPECT_GE(time, best);
  EXPECT_LE(time, best * 1.01);
}

TEST(JerkLimitedPlanner, the_acceleration_goes_on_across_joints) {
  std::vector<PathItem> whole{line(xyz(0, 0), xyz(20, 0), 80)};
  std::vector<PathItem> pieces;
  for (int i = 0; i < 200; ++i) pieces.emplace_back(line(xyz(i * 0.1, 0), xyz(i * 0.1 + 0.1, 0), 80));
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  const auto motion = plan(pieces, limits);
  expect_within_limits(motion, limits);
  EXPECT_NEAR(total_time(motion) / total_time(plan(whole, limits)), 1, 0.03);
  EXPECT_GT(std::get<PlannedMove>(motion.at(60)).begin()->acceleration.value(), 300);
}

TEST(JerkLimitedPlanner, a_very_high_jerk_costs_next_to_nothing) {
  MotionLimits limits = jerk_limits(100, 500, 1e9);
  const std::vector<PathItem> path{line(xyz(0, 0), xyz(30, 10), 60), line(xyz(30, 10), xyz(0, 10), 60)};
  const double time = total_time(plan(path, limits));
  limits.jerk = {};
  EXPECT_NEAR(time / total_time(plan(path, limits)), 1, 0.03);
}

TEST(JerkLimitedPlanner, gives_the_same_whether_items_are_new_or_used_again) {
  test::Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  const std::vector<PathItem> path = smooth_chain(random, 300);
  const MotionLimits limits = jerk_limits(100, 500, 25'000);
  test::ListSource<PathItem> source(path);
  Planner planner(source, limits);
  std::string text;
  for (MotionItem fresh; planner.next(fresh); fresh = Action{}) text += passo::to_text(fresh);
  EXPECT_EQ(text, to_text(plan(path, limits)));
}

}  // namespace
}  // namespace passo
