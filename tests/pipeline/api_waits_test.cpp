// Where a job waits for a person: what it says there, and what the person may do meanwhile.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "pipeline/api_kit.hpp"

namespace passo {
namespace {

using test::ApiRun;
using test::Json;

bool waits(ApiRun& run) {
  return run.turn_until([&] { return !run.get("/status")["waits"].is_null(); });
}

Json wait_of(const char* code, int line, const Json& tool, const char* message) {
  return {{"for", code}, {"line", line}, {"tool", tool}, {"message", message}};
}

// Goes through all stops of a program. What each has shown, but for `free`.
Json stops_of(ApiRun& run, const std::string& text, const std::string& query = "") {
  run.post(fmt::format("/programs/{}/run", run.upload(text, query)));
  EXPECT_EQ(run.status, 202U);
  Json all = Json::array();
  while (run.turn_until([&] {
    const Json status = run.get("/status");
    return !status["waits"].is_null() || status["job"]["state"] == "done";
  })) {
    Json wait = run.get("/status")["waits"];
    if (wait.is_null()) break;
    wait.erase("free");
    all.push_back(wait);
    run.post("/operator-done");
  }
  return all;
}

constexpr const char* turn_over =
    "%\nG21 G90 F600\n(MSG,Turn the plate over and clamp it at the left)\nM0\nG1 X2\nT5 M6\nG1 X3\nM2\n%\n";

TEST(ApiWaits, show_what_the_program_says) {
  ApiRun run;
  run.own();
  EXPECT_EQ(
      stops_of(run, turn_over),
      Json::array({wait_of("M0", 4, Json(), "Turn the plate over and clamp it at the left"), wait_of("M6", 6, 5, "")}));
}

TEST(ApiWaits, show_what_the_program_of_the_issue_says) {
  std::ifstream file(PASSO_SOURCE_DIR "/../shared/cases/serve/msg-at-m0.ngc");
  if (!file) GTEST_SKIP() << "no ../shared/cases/serve";
  std::ostringstream text;
  text << file.rdbuf();
  ApiRun run;
  run.own();
  const Json all = stops_of(run, text.str());
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0]["message"], "Turn the plate over and clamp it at the left");
  EXPECT_EQ(all[1]["tool"], 5);
}

TEST(ApiWaits, messages_before_a_feed_are_of_the_past) {
  ApiRun run;
  run.own();
  const char* const text =
      "G21 G90 F600\n(MSG, begin)\nG1 X1\n( MSG , one )\nG0 X0\n(MSG,two)\n(a remark)\nM1 (three)\n"
      "M0\nT2 M6 (6 mm drill)\nO1 repeat [2]\n(MSG,again)\nM0 (MSG,and again)\nO1 endrepeat\nM2\n";
  EXPECT_EQ(stops_of(run, text),
            Json::array({wait_of("M1", 8, Json(), "one\ntwo\nthree"), wait_of("M0", 9, Json(), ""),
                         wait_of("M6", 10, 2, "6 mm drill"), wait_of("M0", 13, Json(), "again\nand again"),
                         wait_of("M0", 13, Json(), "again\nand again")}));
}

TEST(ApiWaits, show_what_a_program_in_grbls_dialect_says) {
  ApiRun run;
  run.own();
  EXPECT_EQ(stops_of(run, "G21 G90 F600\n(MSG,Turn it)\nM0\nG1 X1\nM2\n", "?dialect=grbl"),
            Json::array({wait_of("M0", 3, Json(), "Turn it")}));
}

TEST(ApiWaits, are_in_the_history) {
  const std::string file = testing::TempDir() + "waits.sqlite";
  std::filesystem::remove(file);
  std::filesystem::remove(file + "-wal");
  auto history = JobHistory::open(file);
  if (!history) GTEST_SKIP() << history.error();
  ApiRun run(test::GrblRun::at_zero(), history->get());
  run.own();
  stops_of(run, turn_over);
  Json waits = run.get("/history")["jobs"][0]["waits"];
  ASSERT_EQ(waits.size(), 2U);
  for (Json& one : waits) {
    EXPECT_GT(one["at"].get<double>(), 1e9);
    one.erase("at");
  }
  EXPECT_EQ(waits, Json::array({wait_of("M0", 4, Json(), "Turn the plate over and clamp it at the left"),
                                wait_of("M6", 6, 5, "")}));
  test::expect_members(test::openapi()["components"]["schemas"]["HistoryJob"], run.get("/history")["jobs"][0],
                       "HistoryJob");
}

TEST(ApiWaits, are_told_to_senders_that_look_on) {
  ApiRun run;
  run.own();
  run.run.collect();
  run.run.replies.clear();
  stops_of(run, turn_over);
  EXPECT_EQ(run.run.replies,
            (std::deque<std::string>{"[MSG:Turn the plate over and clamp it at the left]", "[MSG:Tool 5]"}));
}

TEST(ApiWaits, are_described) {
  ApiRun run;
  run.own();
  run.post(fmt::format("/programs/{}/run", run.upload(turn_over)));
  ASSERT_TRUE(waits(run));
  const Json status = run.get("/status");
  test::expect_members(test::openapi()["components"]["schemas"]["Status"], status, "Status");
  test::expect_members(test::openapi()["components"]["schemas"]["Status"]["properties"]["waits"], status["waits"],
                       "waits");
}

TEST(ApiOverrides, are_a_hundred_percent_again_after_a_job) {
  ApiRun run;
  run.own();
  run.post("/override", R"({"feed": 1.5, "adaptive_feed": 0.9, "rapids": 0.5, "spindle": 0.8})");
  for (const char* const end : {"%\n", "M2\n"}) {
    run.post(fmt::format("/programs/{}/run", run.upload(std::string("%\nG21 G91 G1 X2 F600\n") + end)));
    ASSERT_TRUE(run.turn_until_state("Run"));
    EXPECT_EQ(run.get("/status")["overrides"],
              (Json{{"feed", 1.5}, {"adaptive_feed", 0.9}, {"rapids", 0.5}, {"spindle", 0.8}}));
    ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "done"; }));
  }
  EXPECT_EQ(run.get("/status")["overrides"],
            (Json{{"feed", 1.0}, {"adaptive_feed", 0.9}, {"rapids", 1.0}, {"spindle", 1.0}}));
}

// Two tools cut lines at Z-1. Between them the tool is changed, at X0 Y0 Z5.
constexpr const char* two_tools =
    "G21 G90 G54 F1200\nT1 M6\nM3 S1000\nG0 X0 Y0 Z5\nG1 Z-1\nG1 X10\nG0 Z5\nG0 X0\nT2 M6 (longer)\nM3 S1000\n"
    "G0 X2 Y4\nG1 Z-1\nG1 X10\nG0 Z5\nM2\n";

// The machine's place by the steps of its motors, while one condition holds.
class Steps {
 public:
  explicit Steps(ApiRun& run) : run_(run) {}
  Point now() const {
    const Json place = run_.get("/status")["place"];
    Point point;
    point[Axis::x] = place["x"];
    point[Axis::y] = place["y"];
    point[Axis::z] = place["z"];
    return point;
  }
  // Turns until the job has ended or waits. The lowest Z, and the Z's of all that moved across below `height`.
  double lowest_until_rest() {
    double lowest = 1e9;
    run_.turn_until([&] {
      const Json status = run_.get("/status");
      lowest = std::min(lowest, status["place"]["z"].get<double>());
      return status["job"]["state"] != "checking" &&
             (!status["waits"].is_null() || status["job"]["state"] != "running");
    });
    return lowest;
  }

 private:
  ApiRun& run_;
};

void jog(ApiRun& run, const std::string& direction, double distance) {
  run.post("/jog",
           fmt::format(R"({{"direction": {{{}}}, "speed": 1200, "distance": {}, "lease": 10}})", direction, distance));
  ASSERT_EQ(run.status, 200U);
  ASSERT_TRUE(run.turn_until([&] { return run.run.session().state() == MachineState::idle; }));
}

KnownPosition amid_travel() {
  Point place;
  place[Axis::x] = 20;
  place[Axis::y] = 20;
  place[Axis::z] = -40;
  return {.place = place, .trust = Trust::commanded};
}

// At the zero of the work stands the machine at the start. The second tool is 5 mm longer.
class TwoTools {
 public:
  explicit TwoTools(const ToolTable& tools = {}) : run(amid_travel(), nullptr, {}, nullptr, tools), steps(run) {
    run.own();
    run.post("/work", R"({"place": {"x": 0, "y": 0, "z": 0}})");
    EXPECT_EQ(run.status, 200U);
  }
  void run_to_second_tool(const std::string& text = two_tools) {
    run.post(fmt::format("/programs/{}/run", run.upload(text)));
    ASSERT_EQ(run.status, 202U);
    steps.lowest_until_rest();
    ASSERT_EQ(run.get("/status")["waits"]["tool"], 1);
    run.post("/operator-done");
    ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["waits"].is_null(); }));
    EXPECT_NEAR(steps.lowest_until_rest(), -41, 0.01);
    ASSERT_EQ(run.get("/status")["waits"]["tool"], 2);
  }
  // Goes on to the end. The lowest Z on the way.
  double go_on() {
    const Json answer = run.post("/operator-done");
    EXPECT_EQ(run.status, 200U) << answer;
    return steps.lowest_until_rest();
  }

  ApiRun run;
  Steps steps;
};

TEST(ApiTouchOff, a_longer_tool_cuts_as_deep_as_the_one_before) {
  TwoTools two;
  two.run_to_second_tool();
  const Json wait = two.run.get("/status")["waits"];
  EXPECT_EQ(wait["free"], true);
  jog(two.run, R"("x": -1, "y": 1)", 7);
  EXPECT_EQ(two.run.get("/status")["state"], "Idle");
  EXPECT_EQ(two.run.get("/status")["waits"], wait) << "it waits until somebody goes on";
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "running");
  // The tip touches the work where the spindle stands 5 mm above the zero of before.
  jog(two.run, R"("z": 1)", 7);
  jog(two.run, R"("z": -1)", 7);
  ASSERT_NEAR(two.steps.now()[Axis::z], -35, 0.001);
  two.run.post("/work", R"({"place": {"z": 0}})");
  ASSERT_EQ(two.run.status, 200U);
  EXPECT_NEAR(two.go_on(), -36, 0.01) << "1 mm below the work, with 5 mm more of tool";
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "done");
  EXPECT_TRUE(two.run.get("/status")["waits"].is_null());
  const Point end = two.steps.now();
  EXPECT_NEAR(end[Axis::x], 30, 0.01);
  EXPECT_NEAR(end[Axis::y], 24, 0.01);
  EXPECT_NEAR(end[Axis::z], -30, 0.01);
  EXPECT_EQ(two.run.get("/status")["work_offset"]["z"], -35.0) << "it stays for the next job";
}

TEST(ApiTouchOff, the_tool_goes_back_up_over_and_down) {
  TwoTools two;
  two.run_to_second_tool();
  jog(two.run, R"("z": -1)", 8);
  jog(two.run, R"("x": 1)", 15);
  two.run.post("/operator-done");
  ASSERT_EQ(two.run.status, 200U);
  // It rises to the top before it moves across, and is at X0 before it comes down.
  const Point from = two.steps.now();
  double top = from[Axis::z];
  bool crossed_low = false;
  ASSERT_TRUE(two.run.turn_until([&] {
    const Point at = two.steps.now();
    top = std::max(top, at[Axis::z]);
    const bool is_across = std::abs(at[Axis::x] - from[Axis::x]) > 0.01 && std::abs(at[Axis::x] - 20) > 0.01;
    crossed_low = crossed_low || (is_across && at[Axis::z] < top - 0.01);
    return std::abs(at[Axis::x] - 20) < 0.01 && std::abs(at[Axis::z] + 35) < 0.01;
  }));
  EXPECT_NEAR(top, 60, 0.01) << "the top of the travel";
  EXPECT_FALSE(crossed_low);
  EXPECT_NEAR(two.steps.lowest_until_rest(), -41, 0.01);
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "done");
}

TEST(ApiTouchOff, nothing_is_changed_where_nobody_has_moved) {
  TwoTools two;
  two.run_to_second_tool();
  EXPECT_NEAR(two.go_on(), -41, 0.01);
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "done");
}

TEST(ApiTouchOff, the_way_after_it_is_that_of_a_whole_run_to_the_step) {
  TwoTools plain;
  plain.run_to_second_tool();
  plain.go_on();
  TwoTools moved;
  moved.run_to_second_tool();
  jog(moved.run, R"("x": 1, "z": 1)", 3);
  moved.go_on();
  EXPECT_EQ(moved.run.get("/status")["place"], plain.run.get("/status")["place"]);
}

TEST(ApiTouchOff, a_program_in_steps_of_its_own_goes_on_where_it_waited) {
  TwoTools two;
  two.run_to_second_tool("G21 G91 F1200\nT1 M6\nG1 X10 Z-1\nG1 X-4\nT2 M6\nG1 X2\nG1 Z1\nM2\n");
  jog(two.run, R"("x": 1)", 20);
  EXPECT_NEAR(two.go_on(), -41, 0.01);
  EXPECT_NEAR(two.steps.now()[Axis::x], 28, 0.01);
  EXPECT_NEAR(two.steps.now()[Axis::z], -40, 0.01);
}

TEST(ApiTouchOff, a_console_line_may_set_the_zero) {
  TwoTools two;
  two.run_to_second_tool();
  two.run.post("/mdi", R"({"line": "G10 L2 P1 Z-35"})");
  ASSERT_EQ(two.run.status, 200U);
  two.run.pass(Seconds(0.3));
  EXPECT_NEAR(two.go_on(), -36, 0.01);
}

TEST(ApiTouchOff, a_tool_that_is_measured_there_counts_with_G43) {
  ToolTable tools;
  tools.name = "tools.tbl";
  for (int number : {1, 2}) ASSERT_TRUE(tools.add({.number = number, .pocket = number}));
  TwoTools two(tools);
  two.run_to_second_tool(
      "G21 G90 G54 F1200\nT1 M6\nM3 S1000\nG0 X0 Y0 Z5\nG1 Z-1\nG1 X10\nG0 Z5\nG0 X0\nT2 M6\nG43 H2\n"
      "M3 S1000\nG0 X2 Y4\nG1 Z-1\nG1 X10\nG0 Z5\nM2\n");
  const Json answer = two.run.post("/mdi", R"({"line": "G10 L1 P2 Z5"})");
  ASSERT_EQ(two.run.status, 200U) << answer;
  two.run.pass(Seconds(2));
  EXPECT_NEAR(two.go_on(), -36, 0.01);
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "done");
}

TEST(ApiTouchOff, a_job_that_waits_keeps_others_out_and_can_be_stopped) {
  TwoTools two;
  two.run_to_second_tool();
  jog(two.run, R"("x": 1)", 3);
  const std::uint64_t other = two.run.upload("G1 X1 F100\nM2\n");
  EXPECT_EQ(two.run.post(fmt::format("/programs/{}/run", other))["error"]["code"], "jobs.waits");
  const std::uint64_t own = two.run.get("/status")["job"]["program"];
  two.run.ask("DELETE", fmt::format("/programs/{}", own));
  EXPECT_EQ(two.run.status, 409U);
  two.run.post("/stop");
  EXPECT_EQ(two.run.status, 200U);
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "stopped");
  EXPECT_TRUE(two.run.get("/status")["waits"].is_null());
  EXPECT_EQ(two.run.post("/operator-done")["error"]["code"], "machine.not-waiting");
}

TEST(ApiTouchOff, a_zero_that_the_program_sets_itself_is_not_hidden) {
  TwoTools two;
  two.run_to_second_tool("G10 L2 P1 Z-40\n" + std::string(two_tools));
  two.run.post("/mdi", R"({"line": "G10 L2 P1 Z-35"})");
  two.run.pass(Seconds(0.3));
  EXPECT_EQ(two.run.post("/operator-done")["error"]["code"], "waits.own-zero");
  EXPECT_EQ(two.run.status, 409U);
  EXPECT_EQ(two.run.get("/status")["waits"]["tool"], 2);
}

TEST(ApiTouchOff, a_zero_of_another_system_is_refused) {
  TwoTools two;
  std::string text = two_tools;
  text.replace(text.find("G54"), 3, "G55");
  two.run.post("/mdi", R"({"line": "G10 L2 P2 X20 Y20 Z-40"})");
  two.run.pass(Seconds(0.3));
  two.run_to_second_tool(text);
  two.run.post("/work", R"({"place": {"z": 0}})");
  EXPECT_EQ(two.run.post("/operator-done")["error"]["code"], "waits.other-zero");
  EXPECT_FALSE(two.run.get("/status")["waits"].is_null());
  two.run.post("/mdi", R"({"line": "G10 L2 P2 Z-35"})");
  two.run.pass(Seconds(0.3));
  EXPECT_NEAR(two.go_on(), -36, 0.01);
}

TEST(ApiTouchOff, where_the_program_leaves_the_travel_it_waits_on) {
  TwoTools two;
  two.run_to_second_tool();
  two.run.post("/mdi", R"({"line": "G10 L2 P1 Z57"})");
  two.run.pass(Seconds(0.3));
  two.run.post("/operator-done");
  EXPECT_EQ(two.run.status, 409U);
  EXPECT_FALSE(two.run.get("/status")["waits"].is_null());
}

TEST(ApiTouchOff, with_the_spindle_on_nobody_moves_at_M0) {
  TwoTools two;
  two.run.post(fmt::format("/programs/{}/run", two.run.upload("G21 G90 F1200\nM3 S1000\nG1 X1\nM0\nG1 X2\nM2\n")));
  ASSERT_TRUE(waits(two.run));
  EXPECT_EQ(two.run.get("/status")["waits"]["free"], false);
  two.run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 1})");
  EXPECT_EQ(two.run.status, 409U);
  EXPECT_EQ(two.run.get("/status")["state"], "Hold");
  EXPECT_NEAR(two.go_on(), -40, 0.01);
}

TEST(ApiTouchOff, a_probing_cycle_that_fails_leaves_the_job_waiting) {
  TwoTools two;
  two.run_to_second_tool();
  jog(two.run, R"("x": 1)", 3);
  two.run.post("/probe", R"({"cycle": "surface", "reach": 3})");
  ASSERT_EQ(two.run.status, 202U);
  ASSERT_TRUE(two.run.turn_until([&] {
    return two.run.get("/status")["job"]["state"] != "running" && two.run.get("/status")["job"]["state"] != "checking";
  }));
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "failed") << "there is nothing to touch";
  EXPECT_EQ(two.run.get("/status")["waits"]["tool"], 2) << "the job waits on";
  EXPECT_NEAR(two.go_on(), -41, 0.01);
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "done");
}

// The cycle is a job of its own, which begins elsewhere: the job that waits keeps where its path begins, and what it
// has probed.
TEST(ApiTouchOff, after_a_probing_cycle_a_program_in_steps_of_its_own_goes_on_where_it_waited) {
  TwoTools two;
  two.run_to_second_tool("G21 G91 F1200\nT1 M6\nG1 X10 Z-1\nG1 X-4\nT2 M6\nG1 X2\nG1 Z1\nM2\n");
  jog(two.run, R"("x": 1)", 20);
  two.run.post("/probe", R"({"cycle": "surface", "reach": 3})");
  ASSERT_EQ(two.run.status, 202U);
  ASSERT_TRUE(two.run.turn_until([&] { return two.run.get("/status")["job"]["state"] == "failed"; }));
  EXPECT_NEAR(two.go_on(), -44, 0.01) << "where the probe has ended";
  EXPECT_EQ(two.run.get("/status")["job"]["state"], "done");
  EXPECT_NEAR(two.steps.now()[Axis::x], 28, 0.01);
  EXPECT_NEAR(two.steps.now()[Axis::z], -40, 0.01);
}

}  // namespace
}  // namespace passo
