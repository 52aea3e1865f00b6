#include "passo/path/path_builder.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "path_test.hpp"

namespace passo {
namespace {

using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

TEST_F(PathTest, small_programs_look_as_their_golden_files) {
  add(operation::SetSpindleSpeed{1000});
  add(operation::StraightTraverse{xyz(10, 0, 5)});
  add(operation::TurnSpindle{SpindleDirection::clockwise});
  add(operation::SetMist{true});
  feed(20);
  go(10, 0, -1);
  go(20, 0, -1);
  add(operation::ArcFeed{.end = xyz(20, 10, -1), .first_center = Mm(20), .second_center = Mm(5), .turns = -1});
  add(operation::SetPathMode{PathMode::exact_stop});
  add(operation::ArcFeed{.end = xyz(20, 10, -3), .first_center = Mm(15), .second_center = Mm(10), .turns = 2});
  add(operation::SetPathMode{PathMode::exact_path});
  go(0, 0, -3);
  add(operation::SetPathMode{PathMode::continuous, Mm(0.05)});
  go(1, 1, 0);
  add(operation::Dwell{Seconds(0.5)});
  add(operation::SetSpindleSpeed{2000});
  go(2, 1, 0);
  add(operation::ChangeTool{7});
  add(operation::ProgramStop{});
  add(operation::OptionalProgramStop{});
  add(operation::SetFlood{true});
  add(operation::ProgramEnd{});
  test::expect_golden("src/motion/path/tests/golden/tour.txt", text());
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
}

TEST_F(PathTest, segments_join_bit_for_bit_and_moves_of_nothing_are_dropped) {
  add(operation::SetWorkOffset{.system = 2, .offset = xyz(0.1, 0.2, 0.3)});
  add(operation::SetRotation{30});
  feed(10);
  go(1.0 / 3, 2.0 / 7);
  go(1.0 / 3, 2.0 / 7);
  add(operation::SetWorkOffset{.system = 1, .offset = xyz(0.7, 0.2, 0.3)});
  go(50, 2);
  arc(50, 2, 51, 2, 1);
  const std::vector<Segment> found = segments();
  ASSERT_EQ(found.size(), 3U);
  for (std::size_t i = 1; i < found.size(); ++i) EXPECT_EQ(found[i - 1].curve.end(), found[i].curve.start());
}

TEST_F(PathTest, an_axis_that_stays_does_not_drift_through_the_frame) {
  feed(10);
  add(operation::SetRotation{17});
  go(10, 10, 3);
  add(operation::SetG92Offset{xyz(0, 0, 0.1)});
  go(20, 10, 2.9);
  const std::vector<Segment> found = segments();
  EXPECT_EQ(found[0].curve.end()[Axis::z], found[1].curve.end()[Axis::z]);
}

TEST_F(PathTest, work_positions_become_machine_positions) {
  add(operation::SetWorkOffset{.system = 1, .offset = xyz(100, 50, 0)});
  add(operation::SetRotation{90});
  add(operation::SetToolOffset{xyz(0, 0, 7)});
  feed(10);
  go(10, 0, 0);
  const Point end = segments().at(0).curve.end();
  EXPECT_NEAR(end[Axis::x], 100, 1e-12);
  EXPECT_NEAR(end[Axis::y], 60, 1e-12);
  EXPECT_NEAR(end[Axis::z], 7, 1e-12);
}

// Cases worked out by hand: where the arc starts and ends on a unit circle (in degrees), `turns`, and the sweep.
TEST_F(PathTest, arcs_sweep_as_rs274_counts_turns) {
  struct Case {
    double start, end;
    int turns;
    double sweep;
  };
  for (const Case& c :
       {Case{0, 90, 1, 90}, Case{0, 90, -1, -270}, Case{0, 90, 2, 450}, Case{0, 90, -3, -990}, Case{90, 0, 1, 270},
        Case{90, 0, -1, -90}, Case{170, -170, 1, 20}, Case{-170, 170, -1, -20}, Case{45, 45, 1, 360},
        Case{45, 45, -1, -360}, Case{45, 45, 3, 1080}, Case{10, 350, 1, 340}, Case{180, -180, -1, -360}}) {
    for (const Plane plane : {Plane::xy, Plane::zx, Plane::yz}) {
      const Axis first = plane == Plane::xy ? Axis::x : plane == Plane::zx ? Axis::z : Axis::y;
      const Axis second = plane == Plane::xy ? Axis::y : plane == Plane::zx ? Axis::x : Axis::z;
      const auto on_circle = [&](double degrees) {
        Point point;
        point[first] = 3 + 2 * std::cos(degrees * pi / 180);
        point[second] = 4 + 2 * std::sin(degrees * pi / 180);
        return point;
      };
      operations_.clear();
      options_.start = on_circle(c.start);
      feed(10);
      add(operation::ArcFeed{
          .plane = plane, .end = on_circle(c.end), .first_center = Mm(3), .second_center = Mm(4), .turns = c.turns});
      const std::vector<Segment> found = segments();
      ASSERT_EQ(found.size(), 1U);
      const Curve::ArcData& data = found[0].curve.arc_data();
      EXPECT_NEAR(data.sweep * 180 / pi, c.sweep, 1e-9) << c.start << " to " << c.end << " turns " << c.turns;
      EXPECT_EQ(data.first, first);
      EXPECT_EQ(data.second, second);
    }
  }
}

TEST_F(PathTest, an_arc_in_a_turned_frame_is_turned) {
  add(operation::SetRotation{90});
  feed(10);
  go(10, 0);
  arc(0, 10, 0, 0, 1);
  const Curve curve = segments().at(1).curve;
  EXPECT_NEAR(curve.start()[Axis::y], 10, 1e-12);
  EXPECT_NEAR(curve.end()[Axis::x], -10, 1e-12);
  EXPECT_NEAR(curve.arc_data().sweep, pi / 2, 1e-12);
}

TEST_F(PathTest, an_arc_of_another_plane_in_a_turned_frame_is_walked_in_chords_within_a_thousandth) {
  add(operation::SetRotation{30});
  feed(10);
  add(operation::ArcFeed{
      .plane = Plane::zx, .end = xyz(0, 1, 4), .first_center = Mm(2), .second_center = Mm(0), .turns = 1});
  const std::vector<Segment> chords = segments();
  ASSERT_GT(chords.size(), 10U);
  EXPECT_TRUE(codes().empty());
  double farthest = 0;
  Point last;
  for (const Segment& chord : chords) {
    EXPECT_EQ(chord.curve.start(), last);
    last = chord.curve.end();
    // Turned back, the path is a half circle of 2 mm about Z 2 in the plane ZX, rising in Y.
    const Point middle = chord.curve.at(chord.curve.length() / 2);
    const double x = middle[Axis::x] * std::cos(pi / 6) + middle[Axis::y] * std::sin(pi / 6);
    farthest = std::max(farthest, std::abs(std::hypot(x, middle[Axis::z] - 2) - 2));
  }
  EXPECT_LE(farthest, 0.001);
  EXPECT_NEAR(last[Axis::x], -std::sin(pi / 6), 1e-12);
  EXPECT_NEAR(last[Axis::y], std::cos(pi / 6), 1e-12);
  EXPECT_NEAR(last[Axis::z], 4, 1e-12);
}

// What the chords take of the tolerance is not there for rounding their corners.
TEST_F(PathTest, an_arc_in_chords_with_its_corners_rounded_is_within_the_tolerance) {
  for (const double tolerance : {0.0, 0.0004, 0.01}) {
    operations_.clear();
    add(operation::SetPathMode{tolerance > 0 ? PathMode::continuous : PathMode::exact_path, Mm(tolerance)});
    add(operation::SetRotation{30});
    feed(10);
    add(operation::ArcFeed{
        .plane = Plane::zx, .end = xyz(0, 0, 4), .first_center = Mm(2), .second_center = Mm(0), .turns = 1});
    double farthest = 0;
    for (const Segment& segment : smoothed_segments()) {
      for (int i = 0; i <= 8; ++i) {
        const Point place = segment.curve.at(segment.curve.length() * (i / 8.0));
        const double x = place[Axis::x] * std::cos(pi / 6) + place[Axis::y] * std::sin(pi / 6);
        farthest = std::max(farthest, std::abs(std::hypot(x, place[Axis::z] - 2) - 2));
      }
    }
    EXPECT_LE(farthest, tolerance > 0 ? tolerance : 0.001);
  }
}

TEST_F(PathTest, feeds_follow_their_mode) {
  options_.axes.add(Axis::a);
  options_.travel[Axis::a] = {.low = -360, .high = 360};
  add(operation::SetFeedRate{operation::FeedPerSecond{MmPerSecond(20), 6}});
  go(10, 0);
  Point turned = xyz(10, 0);
  turned[Axis::a] = 90;
  add(operation::StraightFeed{turned});
  add(operation::StraightFeed{xyz(10, 30)});
  add(operation::SetSpindleSpeed{600});
  add(operation::TurnSpindle{SpindleDirection::counterclockwise});
  add(operation::SetFeedMode{FeedMode::units_per_revolution});
  feed_per_revolution(0.25);
  go(20, 30);
  add(operation::StartSpeedFeedSync{.pitch = Mm(1.5)});
  go(20, 40);
  add(operation::StopSpeedFeedSync{});
  add(operation::SetFeedMode{FeedMode::units_per_minute});
  feed(7);
  go(20, 50);
  add(operation::StraightTraverse{xyz(0, 0)});
  std::vector<double> speeds;
  for (const Segment& segment : segments()) speeds.push_back(segment.speed.value());
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
  EXPECT_THAT(speeds, testing::ElementsAre(20, 6, 20, 2.5, 15, 7, std::numeric_limits<double>::infinity()));
}

TEST_F(PathTest, a_rigid_tap_goes_down_and_back_with_the_spindle_reversed) {
  add(operation::SetWorkOffset{.system = 1, .offset = xyz(0.1, 0.2, 0.3)});
  add(operation::SetSpindleSpeed{600});
  add(operation::TurnSpindle{SpindleDirection::clockwise});
  add(operation::StraightTraverse{xyz(5, 5, 2)});
  add(operation::StartSpeedFeedSync{.pitch = Mm(1.5)});
  add(operation::RigidTap{xyz(5, 5, -10)});
  add(operation::StopSpeedFeedSync{});
  add(operation::ProgramEnd{});
  test::expect_golden("src/motion/path/tests/golden/rigid_tap.txt", text());
  const std::vector<Segment> found = segments();
  EXPECT_EQ(found.at(1).curve.start(), found.at(2).curve.end());
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
}

TEST_F(PathTest, a_probe_move_runs_to_its_end_and_rests_there) {
  feed(10);
  add(operation::TurnProbe{true});
  add(operation::StraightProbe{.end = xyz(5, 0), .toward = true, .must_touch = false});
  add(operation::TurnProbe{false});
  go(9, 0);
  const std::vector<Segment> found = segments();
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].curve.end(), xyz(5, 0));
  EXPECT_EQ(found[0].mode, PathMode::exact_stop);
  EXPECT_EQ(found[0].speed, MmPerSecond(10));
  EXPECT_EQ(found[1].mode, PathMode::continuous);
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
}

TEST_F(PathTest, what_the_machine_has_not_is_told_once) {
  for (int i = 0; i < 2; ++i) {
    add(operation::SetDigitalOutput{.output = 3, .on = true, .with_motion = false});
    add(operation::SetAnalogOutput{});
    add(operation::ReadInput{});
    add(operation::UserCode{});
  }
  add(operation::ReadInput{
      .input = 1, .analog = false, .until = operation::ReadInput::Until::rise, .timeout = Seconds(2)});
  const std::vector<PathItem> items = build();
  EXPECT_THAT(codes(), testing::ElementsAre("path.no-outputs", "path.no-inputs", "path.no-user-codes"));
  EXPECT_FALSE(diagnostics_.any_error());
  ASSERT_EQ(items.size(), 1U);
  EXPECT_EQ(std::get<Action>(items[0]).kind, Action::Kind::dwell);
  EXPECT_EQ(std::get<Action>(items[0]).dwell, Seconds(2));
}

TEST_F(PathTest, a_spindle_that_only_turns_is_asked_for_no_more) {
  add(operation::OrientSpindle{.degrees = 90});
  add(operation::SetSpindleMode{.surface_limit = 2000});
  add(operation::SetSpindleMode{});
  (void)build();
  EXPECT_THAT(codes(), testing::ElementsAre("path.no-orientation", "path.no-surface-speed"));
  EXPECT_EQ(diagnostics_.errors(), 2U);
}

TEST_F(PathTest, a_program_without_an_end_leaves_nothing_on) {
  add(operation::SetSpindleSpeed{1000});
  add(operation::TurnSpindle{SpindleDirection::clockwise});
  feed(10);
  go(1, 0);
  const std::vector<PathItem> items = build();
  ASSERT_EQ(items.size(), 3U);
  EXPECT_EQ(std::get<Action>(items[2]).kind, Action::Kind::outputs);
  EXPECT_EQ(std::get<Action>(items[2]).outputs, OutputState{});
}

TEST_F(PathTest, a_feed_without_rate_and_a_thread_without_spindle_are_diagnosed) {
  go(10, 0);
  add(operation::StartSpeedFeedSync{.pitch = Mm(1.5)});
  add(operation::SetSpindleSpeed{600});
  go(20, 0);
  (void)build();
  EXPECT_THAT(codes(), testing::ElementsAre("path.no-feed", "path.spindle-off"));
  EXPECT_EQ(diagnostics_.all()[1].place.line, 4U);
}

TEST_F(PathTest, outputs_without_a_move_between_become_one_action) {
  add(operation::SetSpindleSpeed{1000});
  add(operation::TurnSpindle{SpindleDirection::clockwise});
  add(operation::SetFlood{true});
  add(operation::Dwell{Seconds(1)});
  add(operation::SetSpindleSpeed{2000});
  add(operation::TurnSpindle{SpindleDirection::off});
  add(operation::TurnSpindle{SpindleDirection::clockwise});
  add(operation::ProgramEnd{});
  const std::vector<PathItem> items = build();
  ASSERT_EQ(items.size(), 4U);
  const OutputState turning{SpindleDirection::clockwise, 1000, false, true};
  EXPECT_EQ(std::get<Action>(items[0]).kind, Action::Kind::outputs);
  EXPECT_EQ(std::get<Action>(items[0]).outputs, turning);
  EXPECT_EQ(std::get<Action>(items[1]).kind, Action::Kind::dwell);
  EXPECT_EQ(std::get<Action>(items[1]).outputs, turning);
  EXPECT_EQ(std::get<Action>(items[2]).kind, Action::Kind::outputs);
  EXPECT_EQ(std::get<Action>(items[2]).outputs, OutputState{});
  EXPECT_EQ(std::get<Action>(items[3]).kind, Action::Kind::program_end);
}

TEST_F(PathTest, the_program_end_switches_off_what_was_forgotten) {
  add(operation::SetSpindleSpeed{1000});
  add(operation::TurnSpindle{SpindleDirection::clockwise});
  feed(10);
  go(1, 0);
  add(operation::ProgramEnd{});
  const std::vector<PathItem> items = build();
  ASSERT_EQ(items.size(), 4U);
  EXPECT_EQ(std::get<Action>(items[2]).outputs, OutputState{});
  EXPECT_EQ(std::get<Action>(items[3]).kind, Action::Kind::program_end);
}

TEST_F(PathTest, a_spindle_speed_above_the_machines_is_a_warning_and_cut) {
  options_.spindle_limit = 10000;
  add(operation::SetSpindleSpeed{24000});
  add(operation::TurnSpindle{SpindleDirection::clockwise});
  add(operation::SetSpindleSpeed{24000});
  add(operation::Dwell{Seconds(1)});
  const std::vector<PathItem> items = build();
  ASSERT_EQ(items.size(), 3U);  // and off at the end
  EXPECT_EQ(std::get<Action>(items[0]).outputs.revolutions_per_minute, 10000);
  EXPECT_THAT(codes(), testing::ElementsAre("path.spindle-too-fast"));
  EXPECT_FALSE(diagnostics_.any_error());
}

TEST_F(PathTest, a_move_beyond_the_travel_says_where_and_by_how_much) {
  add(operation::SetWorkOffset{.system = 1, .offset = xyz(200, 0, 0)});
  feed(10);
  go(112.5, 0);
  (void)build();
  ASSERT_THAT(codes(), testing::ElementsAre("travel.exceeded"));
  const Diagnostic& found = diagnostics_.all()[0];
  EXPECT_EQ(found.place.line, 3U);
  EXPECT_EQ(found.message, "X would reach 312.500 (work 112.500), 12.500 mm beyond its travel's end at 300.000");
}

TEST_F(PathTest, a_finding_points_at_the_words_that_the_operation_names) {
  AxisWords axis_words;
  axis_words[Axis::x] = {.column = 9, .length = 4};
  feed(10);
  operations_.push_back({.what = operation::StraightFeed{xyz(400, 400)},
                         .source = {.line = 5},
                         .word = {.column = 6, .length = 7},
                         .axis_words = &axis_words,
                         .text = "any text"});
  go(0, 0, 400);
  (void)build();
  ASSERT_EQ(diagnostics_.all().size(), 3U);
  EXPECT_EQ(diagnostics_.all()[0].place, (SourceLocation{5, 9, 4}));
  EXPECT_EQ(diagnostics_.all()[1].place, (SourceLocation{5, 6, 7}));  // no word of Y: all that ask for the move
  EXPECT_EQ(diagnostics_.all()[2].place, (SourceLocation{3, 0, 1}));  // no word at all: the line
  EXPECT_EQ(diagnostics_.all()[0].text, "any text");
}

TEST_F(PathTest, an_excursion_is_reported_once_until_the_path_is_back_inside) {
  feed(10);
  for (int i = 0; i < 100; ++i) go(301 + i % 2, i);
  go(299, 0);
  go(299, -101);
  go(305, -101);
  go(0, 0);
  (void)build();
  EXPECT_THAT(codes(), testing::ElementsAre("travel.exceeded", "travel.exceeded", "travel.exceeded"));
}

TEST_F(PathTest, an_arc_that_bulges_out_of_the_travel_is_found) {
  feed(10);
  go(295, 0);
  arc(295, 20, 295, 10, 1);
  (void)build();
  ASSERT_THAT(codes(), testing::ElementsAre("travel.exceeded"));
  EXPECT_THAT(diagnostics_.all()[0].message, HasSubstr("X would reach 305.000"));
}

TEST_F(PathTest, the_very_end_of_the_travel_may_be_reached) {
  feed(10);
  go(300, 0);
  arc(280, 20, 280, 0, 1);
  go(-100, -100, -100);
  (void)build();
  EXPECT_TRUE(diagnostics_.all().empty()) << render(diagnostics_, false);
}

TEST_F(PathTest, an_axis_that_the_machine_does_not_have_is_named_once_and_only_if_it_moves) {
  add(operation::SetFeedRate{operation::FeedPerSecond{MmPerSecond(10), 10}});
  Point end = xyz(1, 0);
  add(operation::StraightFeed{end});
  end[Axis::a] = 90;
  add(operation::StraightFeed{end});
  end[Axis::a] = 180;
  add(operation::StraightFeed{end});
  (void)build();
  ASSERT_THAT(codes(), testing::ElementsAre("travel.no-such-axis"));
  EXPECT_THAT(diagnostics_.all()[0].message, HasSubstr("axis A"));
  EXPECT_EQ(diagnostics_.all()[0].place.line, 3U);
}

TEST_F(PathTest, the_junction_tolerance_is_the_programs_or_the_machines) {
  options_.tolerance = Mm(0.02);
  feed(10);
  go(1, 0);
  add(operation::SetPathMode{PathMode::continuous, Mm(0.1)});
  go(2, 0);
  add(operation::SetPathMode{PathMode::continuous, Mm(0)});
  go(3, 0);
  add(operation::SetPathMode{PathMode::exact_path, Mm(0)});
  go(4, 0);
  std::vector<double> tolerances;
  for (const Segment& segment : segments()) tolerances.push_back(segment.tolerance.value());
  EXPECT_THAT(tolerances, testing::ElementsAre(0.02, 0.1, 0.02, 0));
}

}  // namespace
}  // namespace passo
