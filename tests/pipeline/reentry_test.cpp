// A board loses its power amid a job, or a job begins at a line: the machine is led back onto the path, and the part is
// the same from there on.
#include "passo/journal/reentry.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "api_kit.hpp"
#include "job_kit.hpp"
#include "kit/seed.hpp"
#include "probe_kit.hpp"
#include "session_kit.hpp"

namespace passo::test {
namespace {

const std::string pocket =
    "G21 G90 G64 P.02 F1800 M3 S1000\nG4 P.1\nG0 X2 Y2 Z5\nG0 Z1\nG1 Z-1\nG2 X8 Y2 I3 J0\nM8\nG1 X8 Y9\nG3 X2 I-3\n"
    "G1 Y2\nG0 Z5\nM5 M9\nG0 X0 Y0\nM2\n";

// The last steps of each motor.
void expect_same_end(const StepLog::Steps& run, const StepLog::Steps& whole, std::size_t most) {
  for (unsigned m = 0; m < 3; ++m) {
    const std::size_t count = std::min({most, run[m].size(), whole[m].size()});
    for (std::size_t i = 1; i <= count; ++i) {
      ASSERT_EQ(run[m][run[m].size() - i].down, whole[m][whole[m].size() - i].down) << "motor " << m << ", " << i;
    }
  }
}

struct WholeRun {
  std::array<std::int64_t, StepLog::motors> truth{};
  StepLog::Steps steps;
};
const WholeRun& whole_pocket() {
  static const WholeRun whole = [] {
    JobBench bench(short_router());
    JobServer server(bench);
    server.run(pocket);
    EXPECT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "done");
    return WholeRun{.truth = bench.truth(), .steps = bench.log.steps};
  }();
  return whole;
}

void home(JobServer& server) {
  server.post("/home");
  ASSERT_EQ(server.status, 200U);
  ASSERT_TRUE(server.turn_until([&] { return server.session().state() == MachineState::idle; }));
  server.poll();
  ASSERT_EQ(server.session().status().position.trust, Trust::homed);
}

TEST(Homings, are_told_with_how_well_the_switches_repeat) {
  JobBench bench(short_router());
  JobServer server(bench);
  EXPECT_TRUE(server.get("/homing")["axes"].empty());
  for (int homings = 1; homings <= 3; ++homings) {
    home(server);
    ASSERT_EQ(server.get("/homing")["repeats"].size(), 3U);
    server.post("/jog", R"({"direction": {"x": 1, "z": -1}, "speed": 600, "distance": 3, "lease": 5})");
    ASSERT_TRUE(server.turn_until([&] { return server.session().state() == MachineState::idle; }));
  }
  const Json found = server.get("/homing");
  const Json document = openapi();
  const Json& schemas = document["components"]["schemas"];
  expect_members(schemas["Homing"], found, "Homing");
  expect_members(schemas["HomedAxis"], found["axes"][0], "HomedAxis");
  expect_members(schemas["AxisRepeats"], found["repeats"][0], "AxisRepeats");
  EXPECT_EQ(found["axes"].size(), 3U);
  for (const Json& axis : found["repeats"]) {
    EXPECT_EQ(axis["homings"], 3);
    EXPECT_EQ(axis["spread_steps"], 0) << "a virtual switch closes at the very same step: " << axis;
  }
}

class Reentered : public testing::Test {
 protected:
  // The board loses its power amid the job, and so does the server, perhaps.
  void cut_power(JobServer& server, std::int64_t total_steps) {
    server.run(pocket);
    ASSERT_TRUE(server.turn_until([&] { return steps_made() >= total_steps; }));
    bench_.board->reset_board();
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "interrupted");
  }
  std::int64_t steps_made() const {
    std::int64_t steps = 0;
    for (const auto& motor : bench_.log.steps) steps += static_cast<std::int64_t>(motor.size());
    return steps;
  }
  void reset(JobServer& server) {
    server.post("/reset");
    ASSERT_TRUE(server.turn_until([&] { return server.session().state() == MachineState::idle; }));
    server.poll();
  }

  JobBench bench_{short_router()};
};

TEST_F(Reentered, after_a_power_cut_it_homes_and_makes_the_same_part) {
  JobServer server(bench_);
  cut_power(server, 12000);
  reset(server);
  auto told = server.get("/interrupted")["interrupted"];
  EXPECT_EQ(told["code"], "resume.board-reset") << told;
  EXPECT_EQ(told["reentry"]["code"], "reentry.place-unknown");
  EXPECT_EQ(server.post("/interrupted/reenter")["error"]["code"], "reentry.place-unknown");
  EXPECT_EQ(server.get("/status")["trust"], "unknown");
  home(server);
  told = server.get("/interrupted")["interrupted"];
  EXPECT_EQ(told["reentry"]["code"], "") << told;
  EXPECT_EQ(told["reentry"]["steps"][0], "up to Z40.000, at rapid speed") << told;
  server.post("/interrupted/reenter");
  EXPECT_EQ(server.status, 202U);
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done") << server.get("/status");
  EXPECT_EQ(bench_.truth(), whole_pocket().truth);
  expect_same_end(bench_.log.steps, whole_pocket().steps, 800);
}

// What was found before the power was lost is known, and is not probed again. Home is above the plate.
TEST(ReenteredAfterProbing, goes_on_from_what_the_probe_has_found) {
  const std::string text =
      "G21 G90 G0 Z5\nF400 G38.2 Z-10\nG10 L2 P1 Z[#5063]\nG0 Z3\n" + pocket.substr(std::string("G21 G90 ").size());
  const std::vector<Touchable> things = {below(Axis::z, -3.75)};
  JobBench whole(short_router(), things);
  {
    JobServer server(whole);
    server.run(text);
    ASSERT_TRUE(server.to_end());
    ASSERT_EQ(server.job_state(), "done");
  }
  whole.parameters = {};
  JobBench bench(short_router(), things);
  JobServer server(bench);
  server.run(text);
  ASSERT_TRUE(server.turn_until([&] { return server.session().status().executes.line > 9; }));
  bench.board->reset_board();
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "interrupted");
  server.post("/reset");
  ASSERT_TRUE(server.turn_until([&] { return server.session().state() == MachineState::idle; }));
  server.poll();
  home(server);
  server.post("/interrupted/reenter");
  EXPECT_EQ(server.status, 202U) << server.get("/interrupted");
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done") << server.get("/status");
  EXPECT_EQ(bench.truth(), whole.truth());
  expect_same_end(bench.log.steps, whole.log.steps, 800);
}

TEST_F(Reentered, not_if_the_machine_was_moved_while_it_had_no_power) {
  {
    JobServer server(bench_);
    cut_power(server, 12000);
  }
  Point at;
  for (std::size_t m = 0; m < bench_.description.axes.size(); ++m) {
    const AxisDescription& axis = bench_.description.axes[m];
    at[axis.axis] = static_cast<double>(bench_.truth()[m]) / axis.steps_per_unit;
  }
  at[Axis::x] += 7;
  bench_.power_up(at);
  JobServer server(bench_);
  EXPECT_EQ(server.get("/interrupted")["interrupted"]["code"], "resume.board-reset");
  home(server);
  const auto refused = server.post("/interrupted/reenter")["error"];
  EXPECT_EQ(refused["code"], "reentry.shifted") << refused;
  EXPECT_NE(refused["message"].get<std::string>().find("according to its switch, X was at"), std::string::npos)
      << refused;
}

// Power is cut at random moments, also on the way back; the server dies with it or lives on.
void cut_at_random(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  JobBench bench(short_router());
  std::unique_ptr<JobServer> server = std::make_unique<JobServer>(bench);
  server->run(pocket);
  const int cuts = 1 + static_cast<int>(random() % 3);
  for (int cut = 0; cut < cuts; ++cut) {
    const Seconds moment = server->session().now() + Seconds(0.05 + static_cast<double>(random() % 8000) / 1000);
    server->turn_until(
        [&] { return server->session().now() >= moment || server->api().job().state > JobState::running; });
    if (server->api().job().state > JobState::running) break;
    bench.board->reset_board();
    const bool lives = random() % 2 == 0;
    if (lives) {
      ASSERT_TRUE(server->to_end());
      server->post("/reset");
      ASSERT_TRUE(server->turn_until([&] { return server->session().state() == MachineState::idle; }));
      server->poll();
    } else {
      server.reset();
      server = std::make_unique<JobServer>(bench);
    }
    const auto told = server->get("/interrupted")["interrupted"];
    if (told.is_null()) return;  // it had not begun
    home(*server);
    server->post("/interrupted/reenter");
    ASSERT_EQ(server->status, 202U) << server->get("/interrupted");
  }
  ASSERT_TRUE(server->to_end());
  EXPECT_EQ(server->job_state(), "done") << server->get("/status");
  EXPECT_EQ(bench.truth(), whole_pocket().truth);
}

TEST(ReenteredAtRandom, makes_the_same_part) {
  for (std::uint64_t i = 0; i < test::number_of("PASSO_RUNS", 3) && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("PASSO_SEED={}, trial {}", seed(), i));
    cut_at_random(seed() + i);
  }
}

Result<ResumePoint, ReentryRefusal> line_of(const std::string& text, const LinePlace& place) {
  static const MachineDescription machine = short_router();
  const auto found = find_line(ProgramReader::from_text("t", text), machine, InterpreterOptions(), place);
  if (!found) return Failure{found.error().refusal};
  return *found;
}
Result<ResumePoint, ReentryRefusal> line_of(const std::string& text, std::uint32_t line) {
  return line_of(text, LinePlace{.line = line});
}

TEST(FromLine, has_all_that_the_lines_before_have_set) {
  const auto at = line_of(
      "G21 G90 G61 F600\nG10 L2 P2 X10 Y5 Z-3\nG55 M6 T3\nM3 S900\nG0 X0 Y0 Z8\nM8\nG20\nG1 Z0 "
      "F40\nX1\n\n(words)\nY1\nM2\n",
      10);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->line, 12U) << "the next line with motion";
  EXPECT_NEAR(at->point[Axis::x], 10 + 25.4, 1e-9);
  EXPECT_NEAR(at->point[Axis::y], 5, 1e-9);
  EXPECT_NEAR(at->point[Axis::z], -3, 1e-9);
  EXPECT_EQ(at->outputs.spindle, SpindleDirection::clockwise);
  EXPECT_EQ(at->outputs.revolutions_per_minute, 900);
  EXPECT_TRUE(at->outputs.flood);
  EXPECT_EQ(at->tool, 3);
  EXPECT_NEAR(at->feed.value() * 60, 40 * 25.4, 1e-6);
}

TEST(FromLine, a_spindle_that_the_line_itself_starts_turns_before_the_way_down) {
  const auto at = line_of("G21 G90 F600\nG0 X5\nM3 S900\nG4 P2\nG1 X9\nM2\n", 3);
  ASSERT_TRUE(at);
  EXPECT_EQ(at->line, 5U);
  EXPECT_EQ(at->outputs.spindle, SpindleDirection::clockwise);
  EXPECT_EQ(at->spindle_wait, Seconds(2));
}

TEST(FromLine, is_refused_where_it_means_nothing) {
  const std::string loop = "G21 G91 F600\no1 repeat [3]\nG1 X1\nX-1\no1 endrepeat\nG90 X5\nM2\n";
  EXPECT_EQ(line_of(loop, 3).error(), ReentryRefusal::done_often);
  EXPECT_EQ(line_of(loop, 6)->line, 6U);
  const std::string sub = "o1 sub\nG1 X1\nX2\no1 endsub\nG21 G90 F600\no1 call\no1 call\nG1 X9\nM2\n";
  EXPECT_EQ(line_of(sub, 2).error(), ReentryRefusal::done_often);
  EXPECT_EQ(line_of(sub, 8)->point[Axis::x], 1) << "goes straight on with a line of the sub: one motion";
  const std::string straight = "G21 G90 F600\nG1 X1\nX2\nX3\nY1\nM2\n";
  EXPECT_EQ(line_of(straight, 4)->line, 2U) << "merged: nothing is left out";
  EXPECT_EQ(line_of(straight, 5)->line, 5U);
  EXPECT_EQ(line_of(straight, 6).error(), ReentryRefusal::no_motion);
  EXPECT_EQ(line_of("G21 G1 X1 F600\nM2\n", 99).error(), ReentryRefusal::no_motion);
  EXPECT_EQ(line_of("G21 G38.3 Z-1 F60\nG1 X1\nM2\n", 2).error(), ReentryRefusal::after_probe);
  const auto probe = line_of("G21 G90 G1 X3 F60\nG38.3 Z-1\nG1 X1\nM2\n", 2);
  ASSERT_TRUE(probe) << "the probe move itself can be begun at";
  EXPECT_EQ(probe->point, (Point{{{3}}}));
  EXPECT_EQ(probe->line, 2U);
  EXPECT_EQ(probe->probes, 0U);
  EXPECT_EQ(line_of("G1 X1\nM2\n", 1).error(), ReentryRefusal::bad_program);
}

TEST(FromLine, a_pass_of_a_line_that_is_done_often_can_be_chosen) {
  const std::string loop = "G21 G91 G61 F600\no1 repeat [3]\nG1 X1\nY1\no1 endrepeat\nG90 X9\nM2\n";
  for (const unsigned pass : {1U, 2U, 3U}) {
    const auto at = line_of(loop, {.line = 4, .pass = pass});
    ASSERT_TRUE(at) << pass;
    EXPECT_EQ(at->line, 4U);
    EXPECT_EQ(at->point, (Point{{{static_cast<double>(pass), static_cast<double>(pass) - 1}}}));
  }
  EXPECT_EQ(line_of(loop, {.line = 4, .pass = 4}).error(), ReentryRefusal::no_pass);
  EXPECT_EQ(line_of(loop, {.line = 6, .pass = 1})->line, 6U) << "a line that is done once has one pass";
  const auto often = find_line(ProgramReader::from_text("t", loop), short_router(), InterpreterOptions(), {.line = 3});
  EXPECT_EQ(often.error().times, 3U);
  // A visit that was merged begins where the merged motion does: in the same pass.
  const std::string merged = "G21 G91 F600\no1 repeat [2]\nG1 X1\nX1\nY1\no1 endrepeat\nM2\n";
  EXPECT_NEAR(line_of(merged, {.line = 4, .pass = 2})->point[Axis::x], 2, 0.05) << "after a rounded corner";
  EXPECT_EQ(line_of(merged, {.line = 4, .pass = 2})->line, 3U);
  const std::string probing = "G21 G91 F60\no1 repeat [2]\nG1 X1\nG38.3 Z-1\nG1 Y1\no1 endrepeat\nM2\n";
  EXPECT_EQ(line_of(probing, {.line = 3, .pass = 1})->line, 3U);
  EXPECT_EQ(line_of(probing, {.line = 3, .pass = 2}).error(), ReentryRefusal::after_probe);
}

TEST(FromLine, any_point_of_the_path_can_be_chosen) {
  const std::string text = "G21 G90 G61 F600\nG1 X10\nY10\nG2 X20 Y20 I10\nG1 X30\nM2\n";
  const auto amid = line_of(text, {.line = 3, .pass = 0, .after = Mm(4)});
  ASSERT_TRUE(amid);
  EXPECT_EQ(amid->point, (Point{{{10, 4}}}));
  EXPECT_EQ(amid->line, 3U);
  const auto arc = line_of(text, {.line = 2, .pass = 0, .after = Mm(20 + 5 * std::numbers::pi / 2)});
  ASSERT_TRUE(arc);
  EXPECT_EQ(arc->line, 4U);
  EXPECT_NEAR(std::hypot(arc->point[Axis::x] - 20, arc->point[Axis::y] - 10), 10, 1e-9) << "on the arc";
  EXPECT_NEAR(arc->point[Axis::x], 20 - 10 * std::cos(std::numbers::pi / 4), 1e-9);
  EXPECT_EQ(line_of(text, {.line = 5, .pass = 0, .after = Mm(10.001)}).error(), ReentryRefusal::beyond_end);
  EXPECT_EQ(line_of("G21 G90 G1 X3 F60\nG38.3 Z-1\nG1 X1\nM2\n", {.line = 1, .pass = 0, .after = Mm(3.5)}).error(),
            ReentryRefusal::after_probe);
}

TEST(FromLine, leads_up_over_and_down) {
  const MachineDescription machine = short_router();
  const auto at = line_of("G21 G90 F600 M3 S900\nG0 X5 Y5 Z4\nX20\nZ1\nG1 Z-2\nM7\nG1 X30\nM2\n", 7);
  ASSERT_TRUE(at);
  const auto way = plan_reentry(machine, *at, {{{1, 2, -10}}});
  ASSERT_TRUE(way);
  std::string steps;
  for (const Sentence& step : way->steps) steps += step.text + "\n";
  const double top = machine.axes[2].travel_high;
  EXPECT_EQ(steps,
            fmt::format("up to Z{:.3f}, at rapid speed\n"
                        "spindle on, clockwise at 900 rpm, and a wait of {:g} s\n"
                        "over to X20.000 Y5.000, at rapid speed\n"
                        "coolant on: mist\n{}"
                        "down to Z-2.000, at 600 mm/min\n"
                        "the program continues at line 7\n",
                        top, machine.silence.spindle_wait.value(), top > 4 ? "down to Z4.000, at rapid speed\n" : ""));
  EXPECT_EQ(std::get<Segment>(way->lead_in.back()).curve.end(), at->point);
}

// From each line on, the rest of the part is the same.
void expect_same_part_from(const MachineDescription& machine, const std::string& text, const std::vector<int>& lines,
                           const std::string& more = {}) {
  JobBench whole(machine);
  {
    JobServer server(whole);
    server.run(text);
    ASSERT_TRUE(server.to_end());
    ASSERT_EQ(server.job_state(), "done") << server.get("/status");
  }
  for (const int line : lines) {
    SCOPED_TRACE(line);
    JobBench bench(machine);
    JobServer server(bench);
    const auto program = server.ask("POST", "/programs?name=part.ngc", text);
    const std::string path = fmt::format("/programs/{}", program["id"].get<int>());
    const auto way = server.get(fmt::format("{}/way?from_line={}{}", path, line, more));
    EXPECT_TRUE(way["line"] == line || !more.empty()) << way;
    EXPECT_GT(way["steps"].size(), 3U);
    server.post(fmt::format("{}/run?from_line={}{}", path, line, more));
    ASSERT_EQ(server.status, 202U) << way;
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "done") << server.get("/status");
    EXPECT_EQ(bench.truth(), whole.truth());
    expect_same_end(bench.log.steps, whole.log.steps, 800);
  }
}

TEST(FromLine, the_path_after_the_line_is_the_same) {
  expect_same_part_from(short_router(), pocket, {6, 8, 9, 10});
}

TEST(FromLine, the_line_may_be_an_arc_a_hole_of_a_cycle_or_in_a_sub) {
  const std::string text =
      "o1 sub\nG1 Z-2\nX[#1+3]\nG0 Z5\no1 endsub\nG21 G90 G64 P.02 F1800 M3 S1000\nG0 X0 Y0 Z5\nG1 Z-1\nG2 X8 Y0 I4\n"
      "G3 X12 Y4 R4\nG0 Z5\nG98 G81 X14 Y0 Z-3 R2\nX18\nG83 Y6 Z-4 R2 Q1\nG80\no1 call [20]\nG0 X0 Y0\nM2\n";
  expect_same_part_from(short_router(), text, {9, 13, 3});
}

TEST(FromLine, the_place_may_be_amid_a_move_of_a_loop) {
  const std::string text =
      "G21 G90 G64 P.02 F1800 M3 S1000\nG0 X0 Y0 Z5\nG1 Z-1\nG91\no1 repeat [4]\nG1 X6\nY2\nX-6\nY2\n"
      "o1 endrepeat\nG90 G0 Z5\nX0 Y0\nM2\n";
  expect_same_part_from(short_router(), text, {6, 8}, "&pass=3&after=2.5");
}

TEST(FromLine, rotary_axes_turn_to_their_places_on_the_way_over) {
  MachineDescription machine = short_router();
  AxisDescription rotary = machine.axes[0];
  rotary.axis = Axis::a;
  rotary.home.reset();
  rotary.steps_per_unit = 50;
  rotary.travel_low = -3600;
  rotary.travel_high = 3600;
  machine.axes.push_back(rotary);
  const std::string text =
      "G21 G90 G64 P.02 F900\nG0 X5 Z5 A90\nG1 Z-1\nA450 X9\nG0 Z5\nA0\nG1 Z-1\nX2 A30\nG0 Z5\nM2\n";
  expect_same_part_from(machine, text, {8});
}

// A rounded corner has a speed along its own parameter, which is no feed.
TEST(FromLine, the_way_down_has_the_feed_of_the_program) {
  const auto at = line_of("G21 G90 G64 P0.02 F1200\nG0 Z5\nG1 Z-1\nG2 X20 Y0 I10 J0\nM2\n", 4);
  ASSERT_TRUE(at);
  EXPECT_NEAR(at->feed.value() * 60, 1200, 1e-9);
}

TEST(FromLine, is_refused_with_its_reason_by_the_api) {
  JobBench bench(short_router());
  JobServer server(bench);
  server.ask("POST", "/programs", pocket);
  EXPECT_EQ(server.post("/programs/1/run?from_line=99")["error"]["code"], "reentry.no-motion");
  EXPECT_EQ(server.status, 409U);
  EXPECT_EQ(server.post("/programs/1/run?from_line=x")["error"]["code"], "http.bad-body");
  EXPECT_EQ(server.get("/programs/1/way?from_line=99")["code"], "reentry.no-motion");
  EXPECT_EQ(server.get("/programs/1/way")["error"]["code"], "http.bad-body");
  for (const char* const bad : {"pass=0", "pass=x", "after=-1", "after=nan", "after=1e999", "pass=4294967296"}) {
    EXPECT_EQ(server.get(fmt::format("/programs/1/way?from_line=6&{}", bad))["error"]["code"], "http.bad-body") << bad;
  }
  EXPECT_EQ(server.get("/programs/1/way?from_line=6&pass=2")["code"], "reentry.no-pass");
  EXPECT_EQ(server.get("/programs/1/way?from_line=6&after=1e9")["code"], "reentry.beyond-end");
  const auto amid = server.get("/programs/1/way?from_line=6&pass=1&after=0.5");
  EXPECT_EQ(amid["code"], "") << amid;
}

}  // namespace
}  // namespace passo::test
