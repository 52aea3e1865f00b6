// The referee itself: it agrees with closed forms, and it finds planted errors.
#include "passo/proof/motion_proof.hpp"

#include <cmath>
#include <numbers>

#include "proof_kit.hpp"
#include <nlohmann/json.hpp>

#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

using namespace test;

// --- It agrees with closed forms.

TEST(MotionProof, a_line_from_rest_to_rest_takes_twice_the_root_of_length_by_acceleration) {
  const MotionProof proof = proof_of({triangle(line(xyz(0, 0), xyz(8, 0)), 500)});
  EXPECT_TRUE(proof.good()) << to_text(proof);
  EXPECT_NEAR(proof.time.value(), 2 * std::sqrt(8.0 / 500), 1e-12);
  EXPECT_NEAR(proof.time_bound.value(), 2 * std::sqrt(8.0 / 500), 1e-12);
  EXPECT_NEAR(proof.axes[0].acceleration.multiple(), 1, 1e-12);
  EXPECT_NEAR(proof.axes[0].velocity.value, std::sqrt(8.0 * 500), 1e-9);
  EXPECT_EQ(proof.axes[1].velocity.value, 0);
}

// A = 500 (1 - v/110): v = 110 (1 - exp(-500 t/110)).
TEST(MotionProof, a_limit_that_falls_with_the_speed_is_asked_at_the_speed) {
  ProofOptions falling = options();
  for (ProvenAxis& axis : falling.axes) {
    axis.acceleration_at = [](MmPerSecond v) { return MmPerSecond2(500 * (1 - v.value() / 110)); };
  }
  MotionProver prover(falling);
  const PlannedMove planned = triangle(line(xyz(0, 0), xyz(8, 0)), 250);  // up to 44.7 mm/s
  prover.watch(PathItem(planned.segment));
  prover.watch(MotionItem(planned));
  const MotionProof proof = prover.finish();
  const double top = std::sqrt(8.0 * 250);
  EXPECT_NEAR(proof.axes[0].acceleration.multiple(), 250 / (500 * (1 - top / 110)), 1e-6);
  EXPECT_NEAR(proof.axes[0].acceleration.limit, 500 * (1 - top / 110), 1e-3);
  const auto way = [](double t) { return 110 * t - 110 * 110 * (1 - std::exp(-500 * t / 110)) / 500; };
  double low = 0;
  double high = 1;
  for (int i = 0; i < 60; ++i) (way((low + high) / 2) < 4 ? low : high) = (low + high) / 2;
  EXPECT_NEAR(proof.time_bound.value(), 2 * low, 1e-3 * low);
}

TEST(MotionProof, the_bound_of_a_line_knows_velocity_and_feed) {
  EXPECT_NEAR(bound_of({line(xyz(0, 0), xyz(60, 0))}), 60.0 / 100 + 100.0 / 500, 1e-12);
  EXPECT_NEAR(bound_of({line(xyz(0, 0), xyz(60, 0), 1, 20)}), 60.0 / 20 + 20.0 / 500, 1e-12);
  // Both axes work on a diagonal.
  EXPECT_NEAR(bound_of({line(xyz(0, 0), xyz(3, 3))}), 2 * std::sqrt(3.0 / 500), 1e-12);
}

TEST(MotionProof, a_line_in_pieces_is_bounded_as_one) {
  std::vector<Segment> pieces;
  for (int i = 0; i < 600; ++i) pieces.push_back(line(xyz(i * 0.1, 0), xyz((i + 1) * 0.1, 0)));
  EXPECT_NEAR(bound_of(pieces), 60.0 / 100 + 100.0 / 500, 1e-9);
}

TEST(MotionProof, a_segment_that_comes_in_parts_is_one) {
  const Segment segment = line(xyz(0, 0), xyz(8, 0));
  const PlannedMove whole = triangle(segment, 500);
  PlannedMove first = move(segment, {whole.phases[0]});
  first.to = Mm(4);
  const MotionProof proof = proof_of({segment}, {first, move(segment, {whole.phases[1]})});
  EXPECT_TRUE(proof.good()) << to_text(proof);
  EXPECT_NEAR(proof.times_bound(), 1, 1e-12);
}

TEST(MotionProof, a_corner_is_a_stop) {
  const double one = 2 * std::sqrt(2.0 / 500);
  EXPECT_NEAR(bound_of({line(xyz(0, 0), xyz(2, 0)), line(xyz(2, 0), xyz(2, 2))}), 2 * one, 1e-6);
}

// On a circle an even speed is not the best: one axis after the other is at its limit, in a parabola of 45 degrees
// each.
TEST(MotionProof, a_turn_of_a_circle_is_eight_parabolas) {
  const double radius = 10;
  const double turn = bound_of({circle(radius, 4)}) - bound_of({circle(radius, 3)});
  EXPECT_NEAR(turn, 8 * std::sqrt(2 * radius * (1 - std::sqrt(0.5)) / 500), 1e-3 * turn);
  // Where the feed is low enough for the circle, the feed decides.
  EXPECT_NEAR(bound_of({circle(radius, 4, 20)}) - bound_of({circle(radius, 3, 20)}), 2 * pi * radius / 20, 1e-8);
}

// The ramps at both ends are a thousandth of a millimetre long, much shorter than a cell.
TEST(MotionProof, the_bound_of_a_slow_arc_is_not_above_its_best_time) {
  const double length = 50 * pi;
  const double bound = bound_of({circle(50, 0.5, 1)});
  EXPECT_GE(bound, length);
  EXPECT_LE(bound, length + 1.0 / 500 + 1e-9);
}

// From rest both axes speed up together, as on a line; then Y is at its highest velocity.
TEST(MotionProof, the_bound_knows_an_axis_that_speeds_up_and_another_that_is_fast_enough) {
  ProofOptions own = options();
  own.axes[1].velocity = MmPerSecond(10);
  MotionProver prover(own);
  const Segment segment = line(xyz(0, 0), xyz(20, 5));
  prover.watch(PathItem(segment));
  prover.watch(MotionItem(steady(segment, 1)));
  EXPECT_NEAR(prover.finish().time_bound.value(), 5.0 / 10 + 40.0 / 500, 1e-9);
}

TEST(MotionProof, the_bound_of_a_circle_does_not_depend_on_how_it_is_cut) {
  std::vector<Segment> cut;
  for (int i = 0; i < 24; ++i) {
    const double from = i * pi / 12;
    const double to = (i + 1) * pi / 12;
    cut.push_back(segment_of(Curve::arc(xyz(5 * std::cos(from), 5 * std::sin(from)),
                                        xyz(5 * std::cos(to), 5 * std::sin(to)), Axis::x, Axis::y, 0, 0, pi / 12)));
  }
  const double whole = bound_of({circle(5, 1)});
  EXPECT_NEAR(bound_of(cut), whole, 5e-4 * whole);
}

// A rounded corner: the bend grows from 0 to its middle and falls again, and |dP/ds| falls to 1/√2 there.
TEST(MotionProof, the_bound_of_a_blend_does_not_depend_on_how_it_is_cut) {
  const double h = 0.3;
  const auto blend = [h](int parts) {
    const auto place = [h](double s) {
      const double first = s <= h ? s - s * s * s / (6 * h * h) : 0;
      const double second = s <= h ? s * s * s / (6 * h * h) : 0;
      return xyz(first, second);
    };
    const auto tangent = [h](double s) { return xyz(1 - s * s / (2 * h * h), s * s / (2 * h * h)); };
    std::vector<Segment> path = {line(xyz(-5, 0), xyz(0, 0))};
    for (int i = 0; i < parts; ++i) {
      const double from = h * i / parts;
      const double to = h * (i + 1) / parts;
      path.push_back(segment_of(Curve::cubic(place(from), tangent(from), place(to), tangent(to), Mm(to - from))));
    }
    // The second half mirrors the first one, backwards: x and y change places about the middle.
    const Point middle = place(h);
    const auto mirrored = [&](double s) {
      const Point p = place(s);
      return xyz(middle[Axis::x] + middle[Axis::y] - p[Axis::y], middle[Axis::x] + middle[Axis::y] - p[Axis::x]);
    };
    const auto turned = [&](double s) { return xyz(tangent(s)[Axis::y], tangent(s)[Axis::x]); };
    for (int i = parts; i > 0; --i) {
      const double from = h * i / parts;
      const double to = h * (i - 1) / parts;
      path.push_back(segment_of(Curve::cubic(mirrored(from), turned(from), mirrored(to), turned(to), Mm(from - to))));
    }
    const Point end = mirrored(0);
    path.push_back(line(end, end + xyz(0, 5)));
    return path;
  };
  const double fine = bound_of(blend(16));
  EXPECT_NEAR(bound_of(blend(1)), fine, 2e-4 * fine);
  // This is faster than stopping at the corner.
  EXPECT_LT(fine, bound_of({line(xyz(-5, 0), xyz(0.25, 0)), line(xyz(0.25, 0), xyz(0.25, 5.25))}));
}

TEST(MotionProof, a_circle_at_the_limit_of_its_curvature_is_at_the_limit_of_both_axes) {
  const double radius = 4;
  const double speed = std::sqrt(500 * radius);
  const MotionProof proof = proof_of({steady(circle(radius, 1), speed)});
  for (const AxisProof& axis : proof.axes) {
    EXPECT_NEAR(axis.acceleration.multiple(), 1, 1e-9);
    EXPECT_NEAR(axis.velocity.value, speed, 1e-6);
    EXPECT_NEAR(axis.jerk.value, std::pow(speed, 3) / (radius * radius), 1e-3);
  }
}

TEST(MotionProof, a_line_as_a_cubic_is_a_line) {
  const Segment cubic = segment_of(Curve::cubic(xyz(0, 0), xyz(1, 0), xyz(8, 0), xyz(1, 0), Mm(8)));
  const MotionProof proof = proof_of({line(xyz(0, 0), xyz(8, 0))}, {triangle(cubic, 500)});
  EXPECT_TRUE(proof.good()) << to_text(proof);
  // Cells are not exact where the acceleration turns.
  EXPECT_NEAR(proof.time_bound.value(), proof.time.value(), 1e-3 * proof.time.value());
}

TEST(MotionProof, a_spiral_s_peaks_are_those_of_its_differences) {
  const Curve spiral = Curve::arc(xyz(3, 0), xyz(-5, 0), Axis::x, Axis::y, 0, 0, 3 * pi);
  const double speed = 12;
  const MotionProof proof = proof_of({steady(segment_of(spiral), speed)});
  double velocity = 0;
  double acceleration = 0;
  const double h = 1e-3;
  for (double s = h; s < spiral.length().value() - h; s += h) {
    const double before = spiral.at(Mm(s - h))[Axis::y];
    const double here = spiral.at(Mm(s))[Axis::y];
    const double after = spiral.at(Mm(s + h))[Axis::y];
    velocity = std::max(velocity, std::abs(after - before) / (2 * h) * speed);
    acceleration = std::max(acceleration, std::abs(after - 2 * here + before) / (h * h) * speed * speed);
  }
  EXPECT_NEAR(proof.axes[1].velocity.value, velocity, 1e-3 * velocity);
  EXPECT_NEAR(proof.axes[1].acceleration.value, acceleration, 1e-3 * acceleration);
}

TEST(MotionProof, dwells_count_in_both_times) {
  MotionProver prover(options());
  const PlannedMove there = triangle(line(xyz(0, 0), xyz(8, 0)), 500);
  const Action dwell{.kind = Action::Kind::dwell, .dwell = Seconds(2)};
  prover.watch(PathItem(there.segment));
  prover.watch(PathItem(dwell));
  prover.watch(MotionItem(there));
  prover.watch(MotionItem(dwell));
  const MotionProof proof = prover.finish();
  EXPECT_TRUE(proof.good()) << to_text(proof);
  EXPECT_NEAR(proof.time.value(), 2 + 2 * std::sqrt(8.0 / 500), 1e-12);
  EXPECT_NEAR(proof.times_bound(), 1, 1e-12);
}

// --- It finds what is planted.

std::string faults_of(const MotionProof& proof) {
  std::string all;
  for (const std::string& fault : proof.faults()) all += fault + "\n";
  return all;
}

TEST(MotionProof, finds_too_much_acceleration_and_its_line) {
  const MotionProof proof =
      proof_of({triangle(line(xyz(0, 0), xyz(8, 0), 1), 500), triangle(line(xyz(8, 0), xyz(8, 8), 2), 501)});
  EXPECT_EQ(proof.axes[1].acceleration.line, 2U);
  EXPECT_NEAR(proof.axes[1].acceleration.multiple(), 1.002, 1e-9);
  ASSERT_EQ(proof.faults().size(), 1U) << faults_of(proof);
  EXPECT_THAT(faults_of(proof), testing::HasSubstr("axis Y acceleration: 501, limit 500 (line 2"));
}

TEST(MotionProof, finds_too_much_velocity_and_feed) {
  const MotionProof fast = proof_of({triangle(line(xyz(0, 0), xyz(21, 0)), 500)});
  EXPECT_THAT(faults_of(fast), testing::HasSubstr("axis X velocity: 102.47"));
  const MotionProof over = proof_of({triangle(line(xyz(0, 0), xyz(8, 0), 1, 60), 500)});
  EXPECT_THAT(faults_of(over), testing::HasSubstr("feed: 63.24"));
}

TEST(MotionProof, finds_a_corner_at_speed) {
  const Segment first = line(xyz(0, 0), xyz(1, 0), 1);
  const Segment second = line(xyz(1, 0), xyz(1, 1), 2);
  const double speed = std::sqrt(1000.0);
  const MotionProof proof =
      proof_of({move(first, {phase(speed / 500, 0, 0, 500)}), move(second, {phase(speed / 500, 0, speed, -500)})});
  EXPECT_NEAR(proof.axes[0].velocity_jump.value, speed, 1e-9);
  EXPECT_NEAR(proof.axes[1].velocity_jump.value, speed, 1e-9);
  EXPECT_EQ(proof.axes[1].velocity_jump.line, 2U);
  EXPECT_FALSE(proof.good());
  EXPECT_LT(proof.times_bound(), 1);
}

TEST(MotionProof, finds_a_motion_that_does_not_end_at_rest) {
  const MotionProof proof = proof_of({move(line(xyz(0, 0), xyz(1, 0)), {phase(std::sqrt(2.0 / 500), 0, 0, 500)})});
  EXPECT_NEAR(proof.axes[0].velocity_jump.value, std::sqrt(1000.0), 1e-9);
  EXPECT_FALSE(proof.good());
}

TEST(MotionProof, finds_a_path_that_leaves_the_tolerance) {
  const std::vector<Segment> corner = {line(xyz(0, 0), xyz(5, 0), 1), line(xyz(5, 0), xyz(5, 5), 2)};
  // A cut corner: the middle of the cut is d / √2 from the corner.
  const auto cut = [&](double d) {
    return proof_of(corner, {steady(line(xyz(0, 0), xyz(5 - d, 0)), 1), steady(line(xyz(5 - d, 0), xyz(5, d)), 1),
                             steady(line(xyz(5, d), xyz(5, 5)), 1)});
  };
  EXPECT_NEAR(cut(0.1).deviation.value, 0.1 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(cut(0.1).deviation.multiple(), 10 / std::sqrt(2.0), 1e-6);
  EXPECT_LE(cut(0.014).deviation.multiple(), 1);
  EXPECT_GT(cut(0.0145).deviation.multiple(), 1);
  EXPECT_THAT(faults_of(cut(0.0145)), testing::HasSubstr("deviation from the programmed path: 0.010253, limit 0.01"));
}

TEST(MotionProof, finds_a_path_that_goes_astray_between_two_points_of_the_programmed_one) {
  const std::vector<Segment> programmed = {line(xyz(0, 0), xyz(5, 0))};
  const Segment bow = segment_of(Curve::cubic(xyz(0, 0), xyz(1, 0.02), xyz(5, 0), xyz(1, -0.02), Mm(5)));  // 0.025 high
  EXPECT_NEAR(proof_of(programmed, {steady(bow, 1)}).deviation.value, 0.025, 1e-9);
}

TEST(MotionProof, finds_a_programmed_detour_that_is_left_out) {
  const std::vector<Segment> programmed = {line(xyz(0, 0), xyz(5, 0), 1), line(xyz(5, 0), xyz(5, 3), 2),
                                           line(xyz(5, 3), xyz(5, 0), 3), line(xyz(5, 0), xyz(9, 0), 4)};
  const MotionProof proof =
      proof_of(programmed, {steady(line(xyz(0, 0), xyz(5, 0)), 1), steady(line(xyz(5, 0), xyz(9, 0)), 1)});
  EXPECT_NEAR(proof.deviation.value, 3, 1e-9);
}

TEST(MotionProof, finds_a_path_that_ends_early) {
  const MotionProof proof =
      proof_of({line(xyz(0, 0), xyz(5, 0), 1), line(xyz(5, 0), xyz(5, 3), 2)}, {steady(line(xyz(0, 0), xyz(5, 0)), 1)});
  EXPECT_NEAR(proof.deviation.value, 3, 1e-9);
  EXPECT_EQ(proof.deviation.line, 2U);
}

TEST(MotionProof, an_exact_path_may_not_be_left) {
  std::vector<Segment> corner = {line(xyz(0, 0), xyz(5, 0)), line(xyz(5, 0), xyz(5, 5))};
  for (Segment& segment : corner) segment.tolerance = Mm(0);
  const MotionProof proof =
      proof_of(corner, {steady(line(xyz(0, 0), xyz(5 - 0.002, 0)), 1),
                        steady(line(xyz(5 - 0.002, 0), xyz(5, 0.002)), 1), steady(line(xyz(5, 0.002), xyz(5, 5)), 1)});
  EXPECT_THAT(faults_of(proof), testing::HasSubstr("deviation"));
  EXPECT_EQ(proof_of(corner, {steady(corner[0], 1), steady(corner[1], 1)}).deviation.value, 0);
}

TEST(MotionProof, angles_count_in_their_own_tolerance) {
  Segment programmed = line(xyz(0, 0), xyz(10, 0));
  const auto multiple = [&](double sideways, double turned) {
    Point middle = xyz(5, sideways);
    middle[Axis::a] = turned;
    return proof_of({programmed}, {steady(line(xyz(0, 0), middle), 1), steady(line(middle, xyz(10, 0)), 1)})
        .deviation.multiple();
  };
  EXPECT_NEAR(multiple(0, 0.04), 4, 1e-9);  // a degree counts as a millimetre
  programmed.turn_tolerance = 0.05;
  EXPECT_NEAR(multiple(0, 0.04), 0.8, 1e-9);
  EXPECT_NEAR(multiple(0, 0.06), 1.2, 1e-9);
  EXPECT_NEAR(multiple(0.006, 0.04), 1, 1e-9);
  EXPECT_NEAR(multiple(0.008, 0.04), std::hypot(0.8, 0.8), 1e-9);
}

TEST(MotionProof, the_same_way_back_is_no_deviation) {
  std::vector<Segment> path;
  for (int i = 0; i < 20; ++i) {
    path.push_back(line(xyz(0, 0), xyz(7, 0.5)));
    path.push_back(line(xyz(7, 0.5), xyz(0, 0)));
    path.push_back(circle(0.01, 1));
    path.back().curve = Curve::arc(xyz(0, 0), xyz(0, 0), Axis::x, Axis::y, -0.5, 0, -2 * pi);
  }
  std::vector<PlannedMove> planned;
  for (const Segment& segment : path) planned.push_back(steady(segment, 1));
  EXPECT_LT(proof_of(planned).deviation.value, 1e-9);
}

// One move along it passes dozens of short lines in one stride.
TEST(MotionProof, a_line_of_many_short_ones_is_followed) {
  std::vector<Segment> chords;
  for (int i = 0; i < 1000; ++i) chords.push_back(line(xyz(0.01 * i, 0), xyz(0.01 * (i + 1), 0)));
  EXPECT_LT(proof_of(chords, {steady(line(xyz(0, 0), xyz(10, 0)), 1)}).deviation.value, 1e-9);
  EXPECT_NEAR(proof_of(chords, {steady(line(xyz(0, 0), xyz(10, 0.02)), 1)}).deviation.value, 0.02, 1e-3);
  EXPECT_NEAR(proof_of(chords, {steady(line(xyz(0, 0), xyz(9, 0)), 1)}).deviation.value, 1, 1e-9);
}

// The way back is nearer to the way out than to the programmed way back.
TEST(MotionProof, a_path_that_turns_short_of_a_tip_is_followed_on_its_way_back) {
  std::vector<Segment> path = {line(xyz(0, 0), xyz(5.05, 0)), line(xyz(5.05, 0), xyz(0, 0.02))};
  for (Segment& segment : path) segment.tolerance = Mm(0.1);
  const std::vector<PlannedMove> planned = {steady(line(xyz(0, 0), xyz(5, 0)), 1),
                                            steady(line(xyz(5, 0), xyz(0, 0.001)), 1)};
  const MotionProof proof = proof_of(path, planned);
  EXPECT_NEAR(proof.deviation.value, 0.05, 1e-3);
  EXPECT_EQ(proof.deviation.limit, 0.1);
}

TEST(MotionProof, finds_a_gap) {
  const MotionProof between =
      proof_of({steady(line(xyz(0, 0), xyz(1, 0)), 1), steady(line(xyz(1.001, 0), xyz(2, 0)), 1)});
  EXPECT_NEAR(between.gap.value, 0.001, 1e-12);
  const MotionProof inside = proof_of({move(line(xyz(0, 0), xyz(1, 0)), {phase(0.4, 0, 1, 0), phase(0.5, 0.5, 1, 0)})});
  EXPECT_NEAR(inside.gap.value, 0.1, 1e-12);
}

TEST(MotionProof, finds_an_exact_stop_that_is_passed_at_speed) {
  Segment first = line(xyz(0, 0), xyz(10, 0));
  const Segment second = line(xyz(10, 0), xyz(20, 0));
  const double top = 50;  // half of each line at 125 mm/s²
  const auto motion = [&] {
    return proof_of({move(first, {phase(2 * 10 / top, 0, 0, top * top / 20)}),
                     move(second, {phase(2 * 10 / top, 0, top, -top * top / 20)})});
  };
  EXPECT_TRUE(motion().good());
  first.mode = PathMode::exact_stop;
  const MotionProof proof = motion();
  EXPECT_NEAR(proof.axes[0].velocity_jump.value, top, 1e-9);
  EXPECT_FALSE(proof.good());
}

TEST(MotionProof, tells_how_much_too_slow_a_motion_is) {
  const MotionProof proof = proof_of({triangle(line(xyz(0, 0), xyz(8, 0)), 125)});
  EXPECT_TRUE(proof.good()) << to_text(proof);
  EXPECT_NEAR(proof.times_bound(), 2, 1e-12);
}

TEST(MotionProof, jerk_counts_where_it_has_a_limit) {
  const Segment segment = line(xyz(0, 0), xyz(8, 0));
  const PlannedMove abrupt = triangle(segment, 500);
  EXPECT_TRUE(proof_of({segment}, {abrupt}).good());
  const MotionProof proof = proof_of({segment}, {abrupt}, 10000);
  EXPECT_NEAR(proof.axes[0].acceleration_jump.value, 1000, 1e-9);
  EXPECT_THAT(faults_of(proof), testing::HasSubstr("axis X acceleration jumps: 1000"));

  // Four phases of jerk 10,000 cover 2 j t³ in all.
  const Segment shorter = line(xyz(0, 0), xyz(2, 0));
  const double t = std::cbrt(2.0 / (2 * 10000));
  const double a = 10000 * t;
  const double v = a * t / 2;
  const PlannedMove smooth =
      move(shorter, {phase(t, 0, 0, 0, 10000), phase(t, 10000 * t * t * t / 6, v, a, -10000),
                     phase(t, 1, 2 * v, 0, -10000), phase(t, 2 - 10000 * t * t * t / 6, v, -a, 10000)});
  const MotionProof good = proof_of({shorter}, {smooth}, 10000);
  EXPECT_TRUE(good.good()) << to_text(good);
  EXPECT_NEAR(good.axes[0].jerk.multiple(), 1, 1e-12);
}

// --- The steps.

// Steps of X at the exact times of motion from rest to rest over `length`, with an event each hundredth of a
// millisecond.
MotionProof proof_of_steps(double length, double acceleration) {
  MotionProver prover(options());
  const double half = std::sqrt(length / acceleration);
  const double per_tick = 1 / tick_rate;
  std::int64_t count = 0;
  for (double t = 1e-5; t < 2 * half; t += 1e-5) {
    const double rest = 2 * half - t;
    const double place = t < half ? acceleration * t * t / 2 : length - acceleration * rest * rest / 2;
    const auto now = static_cast<std::int64_t>(std::floor(place / 0.0025 + 0.5));
    BoardSegment segment{.events = 1, .interval = static_cast<std::uint32_t>(1e-5 / per_tick * 65536)};
    if (now > count) segment.flips = 1;  // a whole step
    count = now;
    prover.watch(BoardItem(segment));
  }
  return prover.finish();
}

// X goes 3 mm, and the surface at a radius of 20 mm 4 mm, at F 10. `speed` is that of X.
MotionProof proof_on_cylinder(double speed, double planned_feed) {
  ProofOptions on_cylinder = options();
  on_cylinder.axes.push_back(
      {.axis = Axis::a, .velocity = MmPerSecond(1000), .acceleration = MmPerSecond2(1e6), .surface_radius = Mm(20)});
  Point end = xyz(3, 0);
  end[Axis::a] = 4 / (20 * pi / 180);
  MotionProver prover(on_cylinder);
  prover.watch(PathItem(line(xyz(0, 0), end, 1, 10)));
  prover.watch(MotionItem(steady(line(xyz(0, 0), end, 1, planned_feed), speed)));
  return prover.finish();
}

// The plan counts X alone. The prover computes the way of the surface from the radius.
TEST(MotionProof, the_feed_on_a_cylinder_is_that_of_its_surface) {
  EXPECT_THAT(faults_of(proof_on_cylinder(10, 10)), testing::HasSubstr("feed: 16.6667, limit 10 "));
  const MotionProof good = proof_on_cylinder(6, 10);
  EXPECT_NEAR(good.feed.multiple(), 1, 1e-9);
  // The limit is the feed of the program, not that of the plan.
  EXPECT_NEAR(proof_on_cylinder(7, 20).feed.multiple(), 7.0 / 6, 1e-9);
}

TEST(MotionProof, steps_of_a_good_motion_are_within_limit_and_rounding) {
  const MotionProof proof = proof_of_steps(8, 500);
  EXPECT_TRUE(proof.good()) << to_text(proof);
  EXPECT_NEAR(proof.axes[0].step_acceleration.value, 500, proof.axes[0].step_acceleration_noise);
  EXPECT_NEAR(proof.axes[0].step_velocity.value, std::sqrt(8.0 * 500), 2);
  EXPECT_EQ(proof.axes[1].step_velocity.value, 0);
}

TEST(MotionProof, finds_too_much_acceleration_in_the_steps_alone) {
  const MotionProof proof = proof_of_steps(8, 800);
  EXPECT_THAT(faults_of(proof), testing::HasSubstr("axis X acceleration of the steps"));
}

TEST(MotionProof, text_and_json_say_the_same) {
  const MotionProof proof = proof_of({triangle(line(xyz(0, 0), xyz(8, 0), 7), 501)});
  EXPECT_THAT(to_text(proof), testing::HasSubstr("time / bound 0.9990"));
  EXPECT_THAT(to_text(proof), testing::HasSubstr("NOT within its limits"));
  const auto json = nlohmann::json::parse(to_json(proof));
  EXPECT_EQ(json["good"], false);
  EXPECT_NEAR(json["tube_bound_s"], proof.time_bound.value(), 1e-9);  // on a line they are the same
  EXPECT_NEAR(json["time_over_tube_bound"], proof.times_bound(), 1e-9);
  EXPECT_NEAR(json["axes"]["X"]["acceleration"]["multiple"], 1.002, 1e-9);
  EXPECT_EQ(json["axes"]["X"]["acceleration"]["line"], 7);
  EXPECT_EQ(json["axes"]["X"]["jerk"]["limit"], nullptr);
  EXPECT_EQ(json["faults"].size(), 1U);
}

}  // namespace
}  // namespace passo
