#include "passo/stepgen/step_generator.hpp"

#include <cstdlib>
#include <random>

#include "kit/board_text.hpp"
#include "kit/stage_test.hpp"
#include "kit/step_oracle.hpp"

namespace passo {
namespace {

using oracle::generate;

// The number of random programs. Few in the usual tests, many in the slow test.
int runs() {
  const char* text = std::getenv("PASSO_RUNS");
  return text != nullptr ? std::atoi(text) : 25;
}

StepOptions machine(std::initializer_list<double> steps_per_mm, double event_rate = 100e3) {
  StepOptions options;
  for (const double steps : steps_per_mm) {
    options.kinematics.add({.steps = {all_axes[options.kinematics.motor_count()], steps}});
  }
  options.clock.highest_event_rate = Hertz(event_rate);
  return options;
}

// A move over the whole curve whose speed changes from `from` to `to`. If the length allows, the speed reaches `peak`
// in between.
PlannedMove planned(const Curve& curve, double from, double peak, double to, double acceleration) {
  PlannedMove move;
  move.segment.curve = curve;
  move.to = move.segment.curve.length();
  const double length = curve.length().value();
  // Differences of v² over 2a are lengths.
  const double highest = std::sqrt((from * from + to * to) / 2 + acceleration * length);
  const double top = std::max({std::min(peak, highest), from, to});
  const double up = (top * top - from * from) / (2 * acceleration);
  const double down = (top * top - to * to) / (2 * acceleration);
  const double level = std::max(0.0, length - up - down);
  if (up > 0) {
    move.add({.duration = Seconds((top - from) / acceleration),
              .start = Mm(0),
              .velocity = MmPerSecond(from),
              .acceleration = MmPerSecond2(acceleration)});
  }
  if (level > 0) move.add({.duration = Seconds(level / top), .start = Mm(up), .velocity = MmPerSecond(top)});
  if (down > 0) {
    move.add({.duration = Seconds((top - to) / acceleration),
              .start = Mm(length - down),
              .velocity = MmPerSecond(top),
              .acceleration = MmPerSecond2(-acceleration)});
  }
  return move;
}

Action dwell(double seconds) {
  Action action;
  action.kind = Action::Kind::dwell;
  action.dwell = Seconds(seconds);
  return action;
}

using test::xyz;

using oracle::expect_exact;

void expect_end(const std::vector<MotionItem>& items, const StepOptions& options) {
  const oracle::Playback played = oracle::play(generate(items, options), options);
  const PlannedMove* last = nullptr;
  for (const MotionItem& item : items) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) last = move;
  }
  ASSERT_NE(last, nullptr);
  const MotorPosition end = options.kinematics.motors(last->segment.curve.end());
  for (unsigned m = 0; m < options.kinematics.motor_count(); ++m) {
    EXPECT_EQ(played.counts[m], std::llround(end[m])) << "motor " << m;
  }
}

TEST(StepGenerator, one_axis_from_rest_to_rest_steps_at_the_exact_times) {
  const StepOptions options = machine({100});
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(10.003, 0)), 0, 25, 0, 200)};
  expect_exact(items, options);
  expect_end(items, options);
}

TEST(StepGenerator, slaves_follow_the_master_within_one_event) {
  const StepOptions options = machine({640, 640, 640});
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(20, 8.123, -0.377)), 0, 100, 0, 800)};
  expect_exact(items, options);
  expect_end(items, options);
}

TEST(StepGenerator, a_full_circle_comes_back_to_its_start) {
  const StepOptions options = machine({640, 640});
  const std::vector<MotionItem> items = {
      planned(Curve::arc(xyz(0, 0), xyz(0, 0), Axis::x, Axis::y, 10, 0, 2 * std::numbers::pi), 0, 60, 0, 500)};
  expect_exact(items, options);
  expect_end(items, options);
}

TEST(StepGenerator, axes_of_unlike_fineness_share_an_arc) {
  const StepOptions options = machine({10, 3200, 48}, 200e3);
  const std::vector<MotionItem> items = {planned(
      Curve::arc(xyz(0, 0), xyz(3, -3, 1), Axis::x, Axis::y, 3, 0, -1.5 * std::numbers::pi - 2 * std::numbers::pi), 0,
      20, 0, 300)};
  expect_exact(items, options);
  expect_end(items, options);
}

TEST(StepGenerator, a_corner_at_speed_loses_nothing) {
  const StepOptions options = machine({100, 100});
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(5.0013, 0)), 0, 20, 3, 200),
                                         planned(Curve::line(xyz(5.0013, 0), xyz(5.0013, 4.4471)), 3, 20, 3, 200),
                                         planned(Curve::line(xyz(5.0013, 4.4471), xyz(0, 0)), 3, 20, 0, 200)};
  expect_exact(items, options);
  expect_end(items, options);
}

TEST(StepGenerator, a_move_shorter_than_a_step_ends_on_the_nearest_step) {
  const StepOptions options = machine({100, 100});
  for (const double length : {0.001, 0.0049, 0.0051, 0.0149, 0.0151}) {
    const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(length, -length)), 0, 1, 0, 200)};
    expect_end(items, options);
  }
}

TEST(StepGenerator, a_half_step_rounds_away_from_zero) {
  const StepOptions options = machine({100, 100});
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(12.345, -12.345)), 0, 20, 0, 200)};
  expect_end(items, options);
  const std::vector<MotionItem> stays = {items[0],
                                         planned(Curve::line(xyz(12.345, -12.345), xyz(13, -12.345)), 0, 20, 0, 200)};
  expect_end(stays, options);
}

TEST(StepGenerator, a_dwell_is_waited_for_without_a_step) {
  const StepOptions options = machine({100});
  const Action pause = dwell(2.5);
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(1, 0)), 0, 10, 0, 200), pause,
                                         planned(Curve::line(xyz(1, 0), xyz(0, 0)), 0, 10, 0, 200)};
  expect_exact(items, options);
  const std::vector<BoardItem> alone = generate({pause}, options);
  const oracle::Playback played = oracle::play(alone, options);
  EXPECT_NEAR(static_cast<double>(played.end_tick), 2.5 * 16e6, 1);
  EXPECT_TRUE(std::holds_alternative<Action>(alone.back()));
}

TEST(StepGenerator, one_step_in_ten_seconds_comes_on_the_tick) {
  const StepOptions options = machine({1});
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(3, 0)), 0.1, 0.1, 0.1, 1)};
  expect_exact(items, options);
}

TEST(StepGenerator, a_long_cruise_fills_whole_segments) {
  const StepOptions options = machine({640});
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(1000, 0)), 100, 100, 100, 800)};
  const oracle::Playback played = oracle::play(generate(items, options), options);
  EXPECT_LE(played.segments, played.events / 250);
}

// A machine brakes with few segments. Each step is within one interval of its exact time, and the end is exact.
TEST(StepGenerator, loose_times_take_few_segments_and_lose_no_step) {
  const StepOptions options = machine({640, 640});
  // Brakes from 61,440 steps a second to rest, in 3,840 steps.
  const MotionItem move = planned(Curve::line(xyz(0, 0), xyz(6, 1.75)), 100, 100, 0, 800);
  test::ListSource<MotionItem> source({move});
  StepGenerator generator(source, options);
  generator.be_exact_to({.one_in = 1, .least_rate = Hertz(0), .longest_segment = longest_segment_of_all});
  int segments = 0;
  std::int64_t time = 0;
  std::array<std::int64_t, 2> place = {whole_step / 2, whole_step / 2};
  BoardItem item;
  while (generator.next(item)) {
    const auto& segment = std::get<BoardSegment>(item);
    ++segments;
    ASSERT_LE(segment.events, longest_segment_of_all);
    for (const std::int64_t interval : oracle::intervals_of(segment)) {
      time += interval;
      for (unsigned m = 0; m < 2; ++m) {
        const bool flipped = (segment.flips >> m & 1U) != 0;
        const std::int64_t carry = (place[m] & 0xffff) + segment.increments[m] >= whole_step ? 1 : 0;
        const bool stepped = (carry != 0) != flipped;
        place[m] = (place[m] >> 16 << 16) + (stepped ? whole_step : 0) + ((place[m] + segment.increments[m]) & 0xffff);
      }
      // s = v t - a t^2 / 2, and at its end the speed is 0. A step is due half a step before its place.
      const double along = static_cast<double>(place[0] >> 16) - 0.5;
      const double left = 3840 - along;
      if (left < 1) continue;
      const double due = (1 - std::sqrt(left / 3840)) * 0.125 * 16e6;
      ASSERT_NEAR(static_cast<double>(time) / whole_tick, due, static_cast<double>(interval) / whole_tick + 1) << along;
    }
  }
  EXPECT_EQ(place[0] >> 16, 3840);
  EXPECT_EQ(place[1] >> 16, 1120);
  EXPECT_LE(segments, 7);
}

// The board's items for this motion over a line, as in a tail.
std::vector<BoardItem> loose_items(const std::vector<MotionItem>& motion, const StepOptions& options) {
  test::ListSource<MotionItem> source(motion);
  StepGenerator generator(source, options);
  generator.be_exact_to({.one_in = 1, .least_rate = Hertz(0), .longest_segment = longest_segment_of_all});
  std::vector<BoardItem> items;
  for (BoardItem item; generator.next(item);) items.push_back(item);
  return items;
}

// The last event of X moves Y by more than a step. Y leads from there on, and must not stay behind for as long: then
// each event would be a segment of its own.
TEST(StepGenerator, a_motor_that_becomes_the_master_behind_its_place_catches_up) {
  const StepOptions options = machine({640, 640});
  const std::vector<MotionItem> motion = {
      planned(Curve::line(xyz(0, 0), xyz(1, 0)), 0, 5.7, 5.7, 600),
      planned(Curve::arc(xyz(1, 0), xyz(1.024, 0.024), Axis::x, Axis::y, 1, 0.024, std::numbers::pi / 2), 5.7, 5.7, 5.7,
              600),
      planned(Curve::line(xyz(1.024, 0.024), xyz(1.024, 1)), 5.7, 5.7, 0, 600)};
  const std::vector<BoardItem> items = loose_items(motion, options);
  EXPECT_LE(items.size(), 24U);
  const oracle::Playback played = oracle::play(items, options);
  EXPECT_EQ(played.counts[0], 655);
  EXPECT_EQ(played.counts[1], 640);
}

// Both motors are due at each event, and one of them goes down: rounding decides between this event and the next.
TEST(StepGenerator, a_diagonal_takes_few_segments) {
  StepOptions options = machine({640, 640});
  options.start = xyz(400, 3);
  for (const double way : {6.0, -6.0}) {
    const std::vector<BoardItem> items =
        loose_items({planned(Curve::line(xyz(400, 3), xyz(400 + way, 9)), 40, 100, 0, 600),
                     planned(Curve::line(xyz(400 + way, 9), xyz(400, 3)), 0, 100, 0, 600)},
                    options);
    EXPECT_LE(items.size(), 24U) << way;
    EXPECT_EQ(oracle::play(items, options).counts[0], 0) << way;
  }
}

// Over a line: plays a way of many bends, and returns how many segments it took. Each step comes within one and a half
// intervals of its time.
std::size_t play_loosely(const std::vector<MotionItem>& items) {
  const StepOptions options = machine({640, 640, 640}, 140e3);
  test::ListSource<MotionItem> source(items);
  StepGenerator generator(source, options);
  generator.be_exact_to({.one_in = 2, .least_rate = Hertz(1'000), .longest_segment = longest_segment_of_all});
  std::vector<BoardItem> board;
  for (BoardItem item; generator.next(item);) board.push_back(item);

  const oracle::Playback played = oracle::play(board, options);
  for (unsigned m = 0; m < options.kinematics.motor_count(); ++m) {
    const std::vector<oracle::ExactStep> exact = oracle::exact_steps(items, options, m);
    const std::vector<oracle::PlayedStep>& steps = played.steps[m];
    EXPECT_EQ(steps.size(), exact.size()) << m << " ends at " << played.counts[m];
    for (std::size_t i = 0; i < std::min(steps.size(), exact.size()) && !testing::Test::HasFailure(); ++i) {
      EXPECT_EQ(steps[i].direction, exact[i].direction) << "motor " << m << " step " << i;
      EXPECT_LE(std::fabs(static_cast<long double>(steps[i].tick) - exact[i].time),
                1.5L * static_cast<long double>(steps[i].interval) + 1)
          << "motor " << m << " step " << i;
    }
  }
  return board.size();
}

TEST(StepGenerator, loose_arcs_take_few_segments_and_lose_no_step) {
  const Curve circle = Curve::arc(xyz(0, 0), xyz(0, 0), Axis::x, Axis::y, 30, 0, 2 * std::numbers::pi);
  EXPECT_LE(play_loosely({planned(circle, 0, 60, 0, 600)}), 120U);  // quadratics alone: 1,300
}

// No motor stands still: the master lends its place.
TEST(StepGenerator, loose_ways_on_which_all_motors_bend_take_few_segments_and_lose_no_step) {
  const Curve helix = Curve::arc(xyz(0, 0), xyz(0, 0, 20), Axis::x, Axis::y, 30, 0, 2 * std::numbers::pi);
  EXPECT_LE(play_loosely({planned(helix, 0, 60, 0, 600)}), 180U);  // without that: 1,375
  const Curve twisted = Curve::cubic(xyz(0, 0, 0), xyz(1, 0.1, 0.5), xyz(18, 12, 16), xyz(0.6, 1, 0.7), Mm(27));
  EXPECT_LE(play_loosely({planned(twisted, 0, 30, 0, 600)}), 60U);  // 191
}

TEST(StepGenerator, bends_no_motor_of_a_machine_with_two_motors_at_an_axis) {
  StepOptions options = machine({640, 640, 640}, 140e3);
  options.bends = false;
  test::ListSource<MotionItem> source(
      {planned(Curve::arc(xyz(0, 0), xyz(0, 0), Axis::x, Axis::y, 30, 0, 2 * std::numbers::pi), 0, 60, 0, 600)});
  StepGenerator generator(source, options);
  generator.be_exact_to({.one_in = 2, .least_rate = Hertz(1'000), .longest_segment = longest_segment_of_all});
  for (BoardItem item; generator.next(item);) ASSERT_EQ(std::get<BoardSegment>(item).bend, 0);
}

TEST(BoardText, a_short_move_from_rest_to_rest_and_a_dwell_read_as_they_are_played) {
  const StepOptions options = machine({100, 100, 100}, 50e3);
  const std::vector<MotionItem> items = {planned(Curve::line(xyz(0, 0), xyz(0.4, -0.1)), 0, 10, 0, 200), dwell(0.5)};
  std::string text;
  for (const BoardItem& item : generate(items, options)) text += to_text(item, options);
  test::expect_golden("src/motion/stepgen/tests/golden/short_move.txt", text);
}

// Lines and arcs with random corners, speeds and machines.
class RandomPrograms : public testing::Test {
 protected:
  test::Random random_;

  double uniform(double low, double high) { return random_.between(low, high); }
  int below(int n) { return static_cast<int>(random_.between(0, n)); }

  StepOptions random_machine() {
    constexpr std::array<double, 7> finenesses = {10, 48, 100, -100, 640, 1000, -3200};
    const double event_rate = below(2) == 0 ? 100e3 : 50e3;
    const auto fineness = [&] { return finenesses[static_cast<std::size_t>(below(7))]; };
    return machine({fineness(), fineness(), fineness()}, event_rate);
  }

  // Two of the axes share two motors. Where one of them is Z, these move straight and round at once on a helix.
  StepOptions random_machine_of_shared_axes() {
    constexpr std::array<std::array<Axis, 3>, 3> orders = {
        {{Axis::x, Axis::y, Axis::z}, {Axis::x, Axis::z, Axis::y}, {Axis::y, Axis::z, Axis::x}}};
    const auto [first, second, alone] = orders[static_cast<std::size_t>(below(3))];
    const StepOptions own = random_machine();
    const double one = own.kinematics.rows()[0].steps.factor();
    const double other = below(2) == 0 ? one : own.kinematics.rows()[1].steps.factor();
    StepOptions options{.clock = own.clock};
    options.kinematics = {{.steps = {{first, one}, {second, other}}},
                          {.steps = {{first, one}, {second, -other}}},
                          {.steps = {alone, own.kinematics.rows()[2].steps.factor()}}};
    return options;
  }

  Curve random_curve(const Point& start) {
    const double size = std::pow(10.0, uniform(-2.5, 1));
    Point end = start + xyz(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) * size;
    if (below(3) == 0) end[all_axes[static_cast<std::size_t>(below(3))]] = start[Axis::x];
    if (below(3) != 0) return Curve::line(start, end);
    const double center_x = start[Axis::x] + uniform(-1, 1) * size;
    const double center_y = start[Axis::y] + uniform(-1, 1) * size;
    const double radius = std::hypot(start[Axis::x] - center_x, start[Axis::y] - center_y);
    const double from = std::atan2(start[Axis::y] - center_y, start[Axis::x] - center_x);
    const double sweep = uniform(-8, 8);
    const double growth = below(3) == 0 ? uniform(0.999, 1.001) : 1;
    end[Axis::x] = center_x + growth * radius * std::cos(from + sweep);
    end[Axis::y] = center_y + growth * radius * std::sin(from + sweep);
    return Curve::arc(start, end, Axis::x, Axis::y, center_x, center_y, sweep);
  }

  // The highest speed in the bend of a curve. No machine takes a bend of a hundredth of a millimetre at full speed.
  static double fastest_round(const Curve& curve) {
    constexpr double sideways = 4000;  // mm/s²
    if (curve.shape() == Curve::Shape::line) return 1e9;
    return std::sqrt(sideways * std::min(curve.arc_data().start_radius, curve.arc_data().end_radius));
  }

  std::vector<MotionItem> random_program(const StepOptions& options) {
    double finest = 0;
    for (const MotorRow& motor : options.kinematics.rows()) {
      double squares = 0;
      for (const auto& [axis, factor] : motor.steps.shares()) squares += factor * factor;
      finest = std::max(finest, std::sqrt(squares));
    }
    const double fastest = 0.8 * options.clock.highest_event_rate.value() / finest;
    std::vector<Curve> curves;
    const int moves = 1 + below(8);
    for (int i = 0; i < moves; ++i) curves.push_back(random_curve(i == 0 ? Point() : curves.back().end()));

    std::vector<MotionItem> items;
    double speed = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const Curve& curve = curves[i];
      const double length = curve.length().value();
      const double peak = uniform(0.05, 1) * std::min(fastest, fastest_round(curve));
      const bool last = i + 1 == curves.size();
      const double most = last ? 0 : std::min({fastest, fastest_round(curve), fastest_round(curves[i + 1])});
      // The acceleration that is enough to slow down in time for the next move.
      const double needed = (speed * speed - most * most) / (2 * length) * (1 + 1e-9);
      const double acceleration = std::max(needed, std::pow(10.0, uniform(1.5, 3.5)));
      const double reach = std::sqrt(speed * speed + 2 * acceleration * length);
      const double least = std::sqrt(std::max(0.0, speed * speed - 2 * acceleration * length));
      const double exit = last ? 0 : std::max(least, below(4) == 0 ? 0 : uniform(0, 1) * std::min(reach, most));
      items.push_back(planned(curve, speed, peak, exit, acceleration));
      speed = exit;
      if (speed == 0 && below(5) == 0) items.push_back(dwell(uniform(0, 0.01)));
    }
    return items;
  }
};

TEST_F(RandomPrograms, step_where_and_when_mathematics_puts_it) {
  for (int i = 0; i < runs(); ++i) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << random_.seed() << " program " << i);
    const StepOptions options = random_machine();
    expect_exact(random_program(options), options);
    if (HasFatalFailure()) return;
  }
}

TEST_F(RandomPrograms, step_where_and_when_mathematics_puts_it_if_axes_share_motors) {
  for (int i = 0; i < (runs() + 4) / 5; ++i) {
    SCOPED_TRACE(testing::Message() << "PASSO_SEED=" << random_.seed() << " program " << i);
    const StepOptions options = random_machine_of_shared_axes();
    expect_exact(random_program(options), options);
    if (HasFailure()) return;
  }
}

TEST_F(RandomPrograms, give_the_same_bytes_twice) {
  const StepOptions options = random_machine();
  const std::vector<MotionItem> items = random_program(options);
  const oracle::Playback once = oracle::play(generate(items, options), options);
  const oracle::Playback again = oracle::play(generate(items, options), options);
  EXPECT_EQ(once.end_tick, again.end_tick);
  EXPECT_EQ(once.counts, again.counts);
  EXPECT_EQ(once.segments, again.segments);
}

}  // namespace
}  // namespace passo
