#include "passo/report/summary.hpp"

#include <numbers>
#include <random>

#include "kit/golden.hpp"
#include "kit/seed.hpp"
#include "kit/smooth_motion.hpp"
#include "kit/stage_test.hpp"
#include "motion.hpp"
#include <nlohmann/json.hpp>

#include "passo/interpreter/frame.hpp"
#include "passo/report/link_peak_rate.hpp"
#include "passo/report/summary_builder.hpp"

namespace passo {
namespace {

constexpr double pi = std::numbers::pi;

Operation of(const OperationKind& what, std::uint32_t line = 0) {
  return {.what = what, .source = {.line = line}};
}

// Shows the builder the motion of a move, and the program's move that it comes from.
void watch(SummaryBuilder& builder, const PlannedMove& move, const OperationKind& what, const Point& zero) {
  builder.watch_operation(of(what));
  builder.watch_path(move.segment);
  builder.watch(move, zero);
}

// A rapid, a cut, a half circle and a dwell. The work zero is at X 10 Y 20.
RunSummary small_job(LengthUnits units = LengthUnits::mm) {
  SummaryBuilder builder({Axis::x, Axis::y, Axis::z});
  const Point offset = at(10, 20);
  builder.watch_operation(of(operation::SetLengthUnits{units}));
  builder.watch_operation(of(operation::Message{"clamp the work"}, 3));
  builder.watch_operation(of(operation::SetWorkOffset{.system = 1, .offset = offset}));
  watch(builder, rapid(at(0, 0, 5), at(10, 20, 5)), operation::StraightTraverse{}, offset);
  watch(builder, feed(at(10, 20, 5), at(10, 20, -1)), operation::StraightFeed{}, offset);
  builder.watch(dwell(0.5), offset);
  watch(builder, play(Curve::arc(at(10, 20, -1), at(30, 20, -1), Axis::x, Axis::y, 20, 20, -pi), 10, 100),
        operation::ArcFeed{}, offset);
  RunSummary summary = builder.summary();
  summary.program = "small.ngc";
  summary.machine = "Test bench";
  summary.axes[0].net_steps.count = 12000;
  summary.axes[0].total_steps.count = 12000;
  summary.axes[0].position = 30;
  summary.axes[1].net_steps.count = 8000;
  summary.axes[1].total_steps.count = 16000;
  summary.axes[1].position = 20;
  summary.axes[2].net_steps.count = -2400;
  summary.axes[2].total_steps.count = 2400;
  summary.axes[2].position = -1;
  summary.board = BoardSummary{
      .end = Seconds(5.25), .pulses = 30400, .events = 41234, .frames = 180, .bytes = 3456, .busiest_second = 789};
  return summary;
}

TEST(LinkPeakRate, is_that_of_the_busiest_second) {
  LinkPeakRate load;
  std::uint64_t sent = 5000;                 // the queue is filled at once
  for (int tick = 0; tick <= 500; ++tick) {  // 5 s; 2 kB/s, in the fourth second 8 kB/s
    load.update(Seconds(0.01 * tick), sent);
    sent += tick >= 300 && tick < 400 ? 80 : 20;
  }
  EXPECT_NEAR(static_cast<double>(load.busiest()), 8000, 100);
}

TEST(RunSummary, reads_as_a_person_wants_it) {
  test::expect_golden("src/draw/report/tests/golden/small_summary.txt", to_text(small_job(), false));
}

// M6 with [tool_change] touches the tool setter, which is beside and below the work.
TEST(RunSummary, counts_no_move_of_a_tool_change_as_cutting) {
  SummaryBuilder builder({Axis::x, Axis::y, Axis::z});
  const auto show = [&](PlannedMove move, const OperationKind& what, std::uint32_t line) {
    move.segment.source.line = line;
    builder.watch_operation(of(what, line));
    builder.watch_path(move.segment);
    builder.watch(move, at(0, 0));
  };
  show(feed(at(0, 0, 0), at(10, 0, -1)), operation::StraightFeed{}, 1);
  builder.watch_operation(of(operation::StartToolChange{}, 2));
  show(rapid(at(10, 0, -1), at(300, 0, -1)), operation::StraightTraverse{}, 2);
  show(feed(at(300, 0, -1), at(300, 0, -80)), operation::StraightProbe{}, 2);
  show(feed(at(300, 0, -80), at(300, 0, -78)), operation::StraightFeed{}, 2);
  show(rapid(at(300, 0, -78), at(10, 0, 0)), operation::StraightTraverse{}, 2);
  show(feed(at(10, 0, 0), at(20, 0, -2)), operation::StraightFeed{}, 3);
  const RunSummary summary = builder.summary();
  EXPECT_EQ(summary.axes[0].cutting_extents->high, 20);
  EXPECT_EQ(summary.axes[2].cutting_extents->low, -2);
  EXPECT_EQ(summary.axes[2].machine_extents->low, -80) << "it goes there, but cuts nothing";
  ASSERT_EQ(summary.work.size(), 1U);
  EXPECT_EQ(summary.work[0].cutting[2]->low, -2);
  ASSERT_EQ(summary.tools.size(), 1U);
  EXPECT_EQ(summary.tools[0].depth, -2);
  EXPECT_LT(summary.cutting_distance, Mm(30));
}

TEST(RunSummary, is_in_inches_if_the_program_is) {
  test::expect_golden("src/draw/report/tests/golden/small_summary_inches.txt",
                      to_text(small_job(LengthUnits::inch), false));
}

TEST(RunSummary, names_the_work_systems_as_programs_do) {
  EXPECT_EQ(name_of_system(1), "G54");
  EXPECT_EQ(name_of_system(6), "G59");
  EXPECT_EQ(name_of_system(9), "G59.3");
}

TEST(RunSummary, is_json_for_programs) {
  test::expect_golden("src/draw/report/tests/golden/small_summary.json", to_json(small_job()));
}

TEST(RunSummary, colour_adds_nothing_but_escapes) {
  std::string coloured = to_text(small_job(), true);
  const std::string plain = to_text(small_job(), false);
  EXPECT_NE(coloured, plain);
  for (const std::string_view escape : {"\x1b[1m", "\x1b[0m"}) {
    for (auto place = coloured.find(escape); place != std::string::npos; place = coloured.find(escape)) {
      coloured.erase(place, escape.size());
    }
  }
  EXPECT_EQ(coloured, plain);
}

TEST(RunSummary, has_the_json_keys_that_are_promised) {
  const auto json = nlohmann::json::parse(to_json(small_job()));
  EXPECT_NEAR(json.at("time_s").get<double>(),
              json.at("time").at("cutting_s").get<double>() + json.at("time").at("rapid_s").get<double>() + 0.5, 1e-12);
  EXPECT_EQ(json.at("steps").at("Y").at("net").get<std::int64_t>(), 8000);
  EXPECT_EQ(json.at("steps").at("Y").at("total").get<std::int64_t>(), 16000);
  EXPECT_EQ(json.at("position_mm").at("Z").get<double>(), -1);
}

TEST(RunSummary, says_in_plain_words_what_the_line_costs) {
  RunSummary summary = small_job();
  const auto line_of = [&](double without) {
    summary.board->without_line = Seconds(without);
    const std::string text = to_text(summary, false);
    const std::size_t from = text.find("\n  line ");
    return from == std::string::npos ? text : text.substr(from + 3, text.find('\n', from + 1) - from - 3);
  };
  EXPECT_EQ(line_of(5.25), "line                    none    no longer than without it");
  EXPECT_EQ(line_of(5.25 - 1e-9), line_of(5.25));
  EXPECT_EQ(line_of(5.249), "line                0:00.001    longer than without it: under 0.1 %");
  EXPECT_EQ(line_of(5), "line                0:00.250    longer than without it: 5.0 %");
}

TEST(RunSummary, of_a_job_without_motion_and_board_is_still_sound) {
  SummaryBuilder builder({Axis::x, Axis::a});
  RunSummary summary = builder.summary();
  summary.program = "bad \xff\x1b[31m name.ngc";
  const auto json = nlohmann::json::parse(to_json(summary));
  EXPECT_TRUE(json.at("extents_mm").at("machine").at("X").is_null());
  EXPECT_FALSE(json.contains("steps"));
  EXPECT_EQ(json.at("time_s").get<double>(), 0);
  const std::string text = to_text(summary, false);
  EXPECT_NE(text.find("no motion"), std::string::npos);
  EXPECT_NE(text.find("A B C in degrees"), std::string::npos);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

TEST(SummaryBuilder, splits_time_and_distance_into_cutting_rapid_and_dwell) {
  const RunSummary summary = small_job();
  // 22.36 mm would need 25 mm of ramps for 50 mm/s at 100 mm/s², so the speed is a triangle.
  EXPECT_NEAR(summary.rapid_time.value(), 2 * std::sqrt(std::sqrt(500.0) / 100), 1e-12);
  // Length / speed + speed / acceleration, for each cut.
  EXPECT_NEAR(summary.cutting_time.value(), 6 / 10.0 + 0.1 + pi + 0.1, 1e-12);
  EXPECT_EQ(summary.dwell_time, Seconds(0.5));
  EXPECT_NEAR(summary.rapid_distance.value(), std::sqrt(500.0), 1e-12);
  EXPECT_NEAR(summary.cutting_distance.value(), 6 + 10 * pi, 1e-12);
  EXPECT_EQ(summary.moves, 3U);
  EXPECT_EQ(summary.rapids, 1U);
  EXPECT_EQ(summary.arcs, 1U);
  EXPECT_EQ(summary.dwells, 1U);
}

// A turn of A beside X is a part of the move along X. A turn of A alone is in degrees, and never counts as millimetres.
TEST(SummaryBuilder, counts_turns_apart_from_distances) {
  SummaryBuilder builder({Axis::x, Axis::a});
  const auto to = [](double x, double a) {
    Point point;
    point[Axis::x] = x;
    point[Axis::a] = a;
    return point;
  };
  builder.watch(rapid(to(0, 0), to(0, 90)), Point());
  watch(builder, feed(to(0, 90), to(0, 450)), operation::StraightFeed{}, Point());
  watch(builder, feed(to(0, 450), to(30, 540)), operation::StraightFeed{}, Point());
  const RunSummary summary = builder.summary();
  EXPECT_EQ(summary.rapid_turn, 90);
  EXPECT_EQ(summary.cutting_turn, 360);
  EXPECT_EQ(summary.rapid_distance, Mm(0));
  EXPECT_NEAR(summary.cutting_distance.value(), 30, 1e-12);
  ASSERT_EQ(summary.tools.size(), 1U);
  EXPECT_EQ(summary.tools[0].cutting_turn, 360);
  EXPECT_NEAR(summary.tools[0].cutting_distance.value(), 30, 1e-12);
  EXPECT_TRUE(summary.tools[0].turn_feed);

  const auto json = nlohmann::json::parse(to_json(summary));
  EXPECT_EQ(json["turning_deg"]["cutting"], 360);
  EXPECT_EQ(json["turning_deg"]["rapid"], 90);
  EXPECT_EQ(json["tools"][0]["cutting_deg"], 360);
  EXPECT_FALSE(json["tools"][0]["feed_deg_min"].is_null());
  EXPECT_NEAR(json["distance_mm"]["cutting"].get<double>(), 30, 1e-12);
  const std::string text = to_text(summary, false);
  EXPECT_NE(text.find("Turning, degrees"), std::string::npos) << text;
  EXPECT_EQ(to_text(small_job(), false).find("Turning"), std::string::npos);
}

TEST(SummaryBuilder, counts_the_programs_moves_and_not_the_pieces_of_the_motion) {
  SummaryBuilder builder({Axis::x});
  builder.watch_operation(of(operation::StraightFeed{}));
  for (int piece = 0; piece < 4; ++piece) builder.watch(feed(at(piece, 0), at(piece + 1, 0)), Point());
  EXPECT_EQ(builder.summary().moves, 1U);
}

TEST(SummaryBuilder, tells_tools_apart_in_path_and_motion) {
  SummaryBuilder builder({Axis::x, Axis::z});
  const auto change = [](std::int32_t tool) { return Action{.kind = Action::Kind::tool_change, .tool = tool}; };
  const PlannedMove first = feed(at(0, 0, 0), at(10, 0, -2), 5);
  const PlannedMove second = feed(at(10, 0, -2), at(0, 0, -7), 8);
  // The path is read far ahead of the motion.
  builder.watch_path(change(3));
  builder.watch_path(first.segment);
  builder.watch_path(change(1));
  builder.watch_path(second.segment);
  builder.watch(change(3), Point());
  builder.watch(first, Point());
  builder.watch(change(1), Point());
  builder.watch(second, Point());
  const RunSummary summary = builder.summary();
  ASSERT_EQ(summary.tools.size(), 2U);
  EXPECT_EQ(summary.tools[0].tool, 3);
  EXPECT_EQ(summary.tools[0].cutting_time, first.duration());
  EXPECT_EQ(*summary.tools[0].depth, -2);
  EXPECT_EQ(summary.tools[1].tool, 1);
  EXPECT_EQ(*summary.tools[1].depth, -7);
  EXPECT_EQ(summary.tools[1].feed->low, 8);
}

TEST(SummaryBuilder, tells_work_systems_apart_and_leaves_probe_moves_out) {
  SummaryBuilder builder({Axis::x});
  const auto path = [&](double from, double to) { builder.watch_path(feed(at(from, 0), at(to, 0)).segment); };
  path(0, 10);
  builder.watch_operation(of(operation::SetWorkOffset{.system = 7, .offset = {}}));
  path(10, 30);
  builder.watch_path(Action{.kind = Action::Kind::probe_begin});
  path(30, 90);
  builder.watch_path(Action{.kind = Action::Kind::probe_end});
  const RunSummary summary = builder.summary();
  ASSERT_EQ(summary.work.size(), 2U);
  EXPECT_EQ(summary.work[0].system, 1);
  EXPECT_EQ(summary.work[0].cutting[0]->high, 10);
  EXPECT_EQ(summary.work[1].system, 7);
  EXPECT_EQ(summary.work[1].cutting[0]->high, 30);
}

// A square of 40 by 20 and a half circle beside it, on a work that lies at 30 degrees and at X 7 on the machine.
TEST(SummaryBuilder, tells_a_turned_work_along_its_own_axes) {
  SummaryBuilder builder({Axis::x, Axis::y, Axis::z});
  const Operation set_offset = of(operation::SetWorkOffset{.system = 3, .offset = at(7, 0, 5)});
  const Operation turn = of(operation::SetRotation{30});
  Frame frame;
  for (const Operation& one : {set_offset, turn}) {
    builder.watch_operation(one);
    frame.follow(one);
  }
  const auto cut = [&](const Curve& curve) { builder.watch_path(play(curve, 10, 100).segment); };
  const auto place = [&](double x, double y) { return frame.machine_from_work(at(x, y, -1)); };
  cut(Curve::line(place(0, 0), place(40, 0)));
  cut(Curve::line(place(40, 0), place(40, 20)));
  const Point center = place(20, 20);
  cut(Curve::arc(place(40, 20), place(0, 20), Axis::x, Axis::y, center[Axis::x], center[Axis::y], pi));
  const RunSummary summary = builder.summary();
  ASSERT_EQ(summary.work.size(), 1U);
  EXPECT_EQ(summary.work[0].system, 3);
  const auto expect = [&](std::size_t axis, double low, double high) {
    EXPECT_NEAR(summary.work[0].cutting[axis]->low, low, 1e-9);
    EXPECT_NEAR(summary.work[0].cutting[axis]->high, high, 1e-9);
  };
  expect(0, 0, 40);
  expect(1, 0, 40);
  expect(2, -1, -1);
  EXPECT_NEAR(*summary.tools[0].depth, -1, 1e-9);
}

TEST(SummaryBuilder, extents_know_how_far_an_arc_bulges_in_both_frames) {
  const RunSummary summary = small_job();
  EXPECT_DOUBLE_EQ(summary.axes[0].machine_extents->low, 0);
  EXPECT_DOUBLE_EQ(summary.axes[0].machine_extents->high, 30);
  EXPECT_DOUBLE_EQ(summary.axes[1].machine_extents->high, 30);
  EXPECT_DOUBLE_EQ(summary.axes[1].work_extents->low, -20);
  EXPECT_DOUBLE_EQ(summary.axes[1].work_extents->high, 10);
}

TEST(SummaryBuilder, peaks_of_a_line_are_shared_out_by_its_direction) {
  SummaryBuilder builder({Axis::x, Axis::y, Axis::z});
  builder.watch(feed(at(0, 0), at(30, -40), 10, 100), Point());
  const RunSummary summary = builder.summary();
  EXPECT_DOUBLE_EQ(summary.axes[0].peak_speed.value(), 6);
  EXPECT_DOUBLE_EQ(summary.axes[1].peak_speed.value(), 8);
  EXPECT_DOUBLE_EQ(summary.axes[2].peak_speed.value(), 0);
  EXPECT_DOUBLE_EQ(summary.axes[0].peak_acceleration.value(), 60);
  EXPECT_DOUBLE_EQ(summary.axes[1].peak_acceleration.value(), 80);
}

TEST(SummaryBuilder, finds_the_top_of_a_speed_that_turns_inside_a_phase) {
  PlannedMove move;
  move.segment.curve = Curve::line(at(0, 0), at(100, 0));
  move.to = move.segment.curve.length();
  // 10 + 20 t − 20 t²/2 is highest at t = 1.
  move.add({Seconds(2), Mm(0), MmPerSecond(10), MmPerSecond2(20), MmPerSecond3(-20)});
  SummaryBuilder builder({Axis::x});
  builder.watch(move, Point());
  EXPECT_DOUBLE_EQ(builder.summary().axes[0].peak_speed.value(), 20);
}

// The peaks, computed from differences of positions in small time steps. This code knows nothing of slopes and angles.
struct SampledPeaks {
  Point speed;
  Point acceleration;
};
SampledPeaks sample(const PlannedMove& move) {
  SampledPeaks peaks;
  for (const Phase& phase : move) {
    // A time step is not shorter than 20 µs, because the second difference would then be mostly rounding.
    const int samples = static_cast<int>(std::clamp(phase.duration.value() / 20e-6, 2.0, 4000.0));
    const double h = phase.duration.value() / samples;
    if (h < 1e-5) continue;
    for (int i = 1; i < samples; ++i) {
      const Point before = move.segment.curve.at(phase.position_at(Seconds((i - 1) * h)));
      const Point now = move.segment.curve.at(phase.position_at(Seconds(i * h)));
      const Point after = move.segment.curve.at(phase.position_at(Seconds((i + 1) * h)));
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        const double speed = std::abs(after[axis] - before[axis]) / (2 * h);
        const double acceleration = std::abs(after[axis] - 2 * now[axis] + before[axis]) / (h * h);
        peaks.speed[axis] = std::max(peaks.speed[axis], speed);
        peaks.acceleration[axis] = std::max(peaks.acceleration[axis], acceleration);
      }
    }
  }
  return peaks;
}

TEST(SummaryBuilder, peaks_on_arcs_helices_and_spirals_are_those_of_the_motion) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int i = 0; i < 60; ++i) {
    const double start_angle = uniform(-pi, pi);
    const double sweep = uniform(0.2, 7) * (uniform(0, 1) < 0.5 ? -1 : 1);
    const double start_radius = uniform(1, 20);
    const double end_radius = i % 3 == 0 ? start_radius * uniform(0.9, 1.1) : start_radius;
    const double depth = i % 2 == 0 ? uniform(-3, 3) : 0;
    const Point start = at(start_radius * std::cos(start_angle), start_radius * std::sin(start_angle), 0);
    const Point end = at(end_radius * std::cos(start_angle + sweep), end_radius * std::sin(start_angle + sweep), depth);
    const PlannedMove move =
        play(Curve::arc(start, end, Axis::x, Axis::y, 0, 0, sweep), uniform(5, 60), uniform(100, 600));

    SummaryBuilder builder({Axis::x, Axis::y, Axis::z});
    builder.watch(move, Point());
    const RunSummary summary = builder.summary();
    const SampledPeaks expected = sample(move);
    for (const AxisSummary& axis : summary.axes) {
      EXPECT_NEAR(axis.peak_speed.value(), expected.speed[axis.axis], 2e-3 * expected.speed[axis.axis] + 1e-3) << i;
      EXPECT_NEAR(axis.peak_acceleration.value(), expected.acceleration[axis.axis],
                  2e-3 * expected.acceleration[axis.axis] + 1e-2)
          << i;
    }
  }
}

TEST(SummaryBuilder, peaks_on_cubics_with_jerk_are_those_of_the_motion) {
  test::Random random;
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(random.seed()));
  const auto uniform = [&](double low, double high) { return random.between(low, high); };
  const auto anywhere = [&] { return at(uniform(-9, 9), uniform(-9, 9), uniform(-9, 9)); };
  for (int i = 0; i < 60; ++i) {
    const std::vector<Curve> curves = test::spline_through({anywhere(), anywhere(), anywhere(), anywhere()});
    double length = 0;
    for (const Curve& curve : curves) length += curve.length().value();
    test::PhaseChain chain;
    chain.change_speed(1, 1, uniform(0.1, 0.5));
    chain.change_speed(uniform(0.1, 0.9), 1, uniform(0.1, 0.5));
    chain.change_speed(0, 1, uniform(0.1, 0.5));

    SummaryBuilder builder({Axis::x, Axis::y, Axis::z});
    Point speed;
    Point acceleration;
    for (const MotionItem& item : test::moves_along(curves, chain.over(length, uniform(5, 60)), length / 7)) {
      builder.watch(item, Point());
      const SampledPeaks move = sample(std::get<PlannedMove>(item));
      for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
        speed[axis] = std::max(speed[axis], move.speed[axis]);
        acceleration[axis] = std::max(acceleration[axis], move.acceleration[axis]);
      }
    }
    const RunSummary summary = builder.summary();
    EXPECT_NEAR(summary.cutting_distance.value(), length, 1e-9);
    for (const AxisSummary& axis : summary.axes) {
      EXPECT_NEAR(axis.peak_speed.value(), speed[axis.axis], 2e-3 * speed[axis.axis] + 1e-3) << i;
      EXPECT_NEAR(axis.peak_acceleration.value(), acceleration[axis.axis], 3e-3 * acceleration[axis.axis] + 1e-2) << i;
    }
  }
}

TEST(SummaryBuilder, a_long_helix_is_understood_as_quickly_as_a_short_one) {
  const double sweep = 2 * pi * 2000;
  const PlannedMove move = play(Curve::arc(at(10, 0, 0), at(10, 0, -100), Axis::x, Axis::y, 0, 0, sweep), 20, 200);
  SummaryBuilder builder({Axis::x, Axis::y});
  builder.watch(move, Point());
  for (const AxisSummary& axis : builder.summary().axes) {
    EXPECT_NEAR(axis.peak_speed.value(), 20, 0.03);
    // Most of the acceleration comes from 20 mm/s on a radius of 10 mm. While the speed changes, the change of speed is
    // added at a right angle.
    EXPECT_GE(axis.peak_acceleration.value(), 40);
    EXPECT_LE(axis.peak_acceleration.value(), std::hypot(200, 40) * 1.001);
  }
}

}  // namespace
}  // namespace passo
