// Lines that a person types (POST /mdi): modes last, refused lines change nothing, and what resets the modes.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "pipeline/api_kit.hpp"

#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

using test::ApiRun;
using test::Json;

class Mdi : public testing::Test {
 protected:
  Mdi() { run.own(); }

  // The line was taken, and is done.
  Json line(const std::string& text) {
    const Json answer = run.post("/mdi", Json({{"line", text}}).dump());
    EXPECT_EQ(run.status, 200U) << text << ": " << answer;
    run.pass(Seconds(0.2));  // it waits a moment for more lines
    EXPECT_TRUE(run.turn_until([&] { return rests(); })) << text << ": " << run.get("/status");
    return answer;
  }
  std::string refused(const std::string& text) {
    const Json answer = run.post("/mdi", Json({{"line", text}}).dump());
    EXPECT_EQ(run.status, 409U) << text << ": " << answer;
    return answer["error"].value("code", "");
  }
  bool rests() {
    run.poll();
    const Json status = run.get("/status");
    if (status["state"] == "Idle") return status["mdi"]["streams"] == false;
    return status["state"] == "Line" && status["outputs"] != off();
  }
  static Json off() { return {{"spindle", "off"}, {"spindle_speed", 0.0}, {"mist", false}, {"flood", false}}; }
  double at(const std::string& axis) { return run.get("/status")["place"][axis]; }
  bool has(const std::string& code) {
    const Json codes = run.get("/status")["mdi"]["codes"];
    return std::ranges::find(codes, Json(code)) != codes.end();
  }

  ApiRun run;
};

TEST_F(Mdi, keeps_its_modes_from_line_to_line) {
  line("G0 Z5");
  line("G91");
  EXPECT_TRUE(has("G91"));
  line("G0 Z-2");
  EXPECT_NEAR(at("z"), 3, 1e-3);
  line("G20");
  line("g0 x1");
  EXPECT_NEAR(at("x"), 25.4, 1e-3);
  line("G21 G90");
  line("G1 X5 F1200");
  EXPECT_NEAR(at("x"), 5, 1e-3);
  EXPECT_EQ(run.get("/status")["mdi"]["feed"], 1200.0);
  EXPECT_EQ(run.get("/status")["state"], "Idle");
}

TEST_F(Mdi, keeps_work_systems_and_offsets) {
  line("G10 L2 P2 X10");
  line("G55");
  line("G0 X1");
  EXPECT_NEAR(at("x"), 11, 1e-3);
  EXPECT_NEAR(run.get("/status")["mdi"]["place"]["x"], 1, 1e-3);
  line("G10 L20 P1 X0");
  EXPECT_EQ(run.get("/status")["work_offset"]["x"], 11.0) << "programs have the offsets of the lines";
  line("G54 G0 X2");
  EXPECT_NEAR(at("x"), 13, 1e-3);
}

TEST_F(Mdi, leaves_the_spindle_on_until_it_is_switched_off_or_stopped) {
  line("M3 S9000");
  line("G0 X1");
  Json status = run.get("/status");
  EXPECT_EQ(status["outputs"]["spindle"], "clockwise") << status;
  EXPECT_EQ(status["state"], "Line");
  EXPECT_TRUE(has("M3"));
  line("M5");
  EXPECT_EQ(run.get("/status")["outputs"], off());
  EXPECT_EQ(run.get("/status")["state"], "Idle");
  line("M3");
  EXPECT_EQ(run.get("/status")["outputs"]["spindle_speed"], 9000.0) << "S lasts";
  run.post("/stop");
  EXPECT_TRUE(run.turn_until_state("Idle"));
  EXPECT_TRUE(has("M5"));
  line("G0 X2");
  EXPECT_EQ(run.get("/status")["outputs"], off()) << "a stop stays one";
  EXPECT_EQ(run.get("/status")["state"], "Idle");
}

TEST_F(Mdi, changes_nothing_by_a_line_that_is_refused) {
  line("G0 X3");
  const Json before = run.get("/status")["mdi"];
  EXPECT_EQ(refused("G91 G99.9 X1"), "gcode.unknown-code");
  EXPECT_EQ(refused("X99999"), "travel.exceeded");
  EXPECT_EQ(refused("G20 G91 X99999"), "travel.exceeded");
  EXPECT_EQ(refused("G55 M3 S100 Q#"), "gcode.missing-value");
  EXPECT_EQ(run.get("/status")["mdi"], before);
  EXPECT_EQ(run.get("/status")["state"], "Idle");
  EXPECT_EQ(refused(std::string(300, 'G')), "mdi.too-long");
  run.key = "nobody";
  run.post("/mdi", R"({"line": "G0 X1"})");
  EXPECT_EQ(run.status, 403U);
}

TEST_F(Mdi, begins_anew_after_a_job_and_after_m2) {
  line("G91 G20 F100");
  const std::uint64_t id = run.upload("G21 G90 G0 X4\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  EXPECT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "done"; }));
  EXPECT_TRUE(has("G90") && has("G21") && has("G54"));
  line("G0 X5");
  EXPECT_NEAR(at("x"), 5, 1e-3);
  line("G91 M3 S100");
  line("M2");
  EXPECT_TRUE(has("G90") && has("M5"));
  EXPECT_EQ(run.get("/status")["state"], "Idle");
  line("G55 G91");
  run.owner.release();
  run.owner.claim_for_sender();
  run.poll();
  EXPECT_TRUE(has("G54") && has("G90")) << "a sender has driven";
}

TEST_F(Mdi, keeps_its_modes_over_a_stop_and_a_new_zero) {
  line("G91 G20");
  run.post("/stop");
  EXPECT_TRUE(run.turn_until_state("Idle"));
  EXPECT_TRUE(has("G91") && has("G20"));
  run.post("/work", R"({"place": {"x": 0}})");
  EXPECT_EQ(run.status, 200U);
  run.poll();
  EXPECT_TRUE(has("G91") && has("G20"));
}

// A program that begins where lines have moved the machine, and lines after jogs.
TEST_F(Mdi, goes_on_from_where_the_machine_stands) {
  line("G91 G0 X1");
  run.post("/jog", R"({"direction": {"x": 1}, "speed": 3000, "distance": 5, "lease": 5})");
  EXPECT_TRUE(run.turn_until_state("Jog"));
  EXPECT_EQ(refused("G0 X1"), "machine.busy");
  EXPECT_TRUE(run.turn_until_state("Idle"));
  line("G0 X1");
  EXPECT_NEAR(at("x"), 7, 1e-3);
  const double steps_per_mm = run.run.description().axes[0].steps_per_unit;
  EXPECT_NEAR(std::abs(static_cast<double>(run.run.board().counts().motors[0].position)), 7 * steps_per_mm, 1);
}

TEST_F(Mdi, runs_one_line_behind_the_other) {
  for (int i = 1; i <= 5; ++i) {
    run.post("/mdi", Json({{"line", fmt::format("G1 X{} F3000", i)}}).dump());
    EXPECT_EQ(run.status, 200U);
    run.poll();
  }
  EXPECT_TRUE(run.turn_until_state("Idle"));
  EXPECT_NEAR(at("x"), 5, 1e-3);
}

TEST_F(Mdi, knows_words_with_dollar) {
  EXPECT_EQ(line("$g")["words"][0], "[GC:G80 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]");
  line("G10 L2 P3 X7");
  EXPECT_EQ(line("$#")["words"][2], "[G56:7.000,0.000,0.000]");
  EXPECT_GT(line("$$")["words"].size(), 10U);
  EXPECT_EQ(line("$X")["words"][0], "[MSG:Nothing is locked]");
  for (const char* const word : {"$J=X1", "$C", "$110=5", "$N0=G20", "$RST=*", "$?"}) {
    EXPECT_EQ(refused(word), "mdi.unsupported") << word;
  }
  run.post("/mdi", R"({"line": "$H"})");
  EXPECT_TRUE(run.turn_until([&] { return run.get("/status")["trust"] == "homed"; }));
  run.post("/mdi", R"({"line": "$SLP"})");
  EXPECT_TRUE(run.turn_until_state("Sleep"));
}

// As a sender does it by $X.
TEST(MdiPlace, takes_lines_where_the_place_is_known_or_a_person_vouches_for_it) {
  ApiRun run(KnownPosition{.place = Point(), .trust = Trust::unknown});
  run.own();
  const auto take = [&](const char* line) { return run.post("/mdi", Json({{"line", line}}).dump()); };
  EXPECT_EQ(take("G0 X1")["error"]["code"], "run.place-unknown");
  EXPECT_EQ(run.post(fmt::format("/programs/{}/run", run.upload("G0 X1\nM2\n")))["error"]["code"], "run.place-unknown");
  run.pass(Seconds(1));
  EXPECT_EQ(run.get("/status")["place"]["x"], 0.0);
  run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 2})");
  EXPECT_EQ(run.status, 200U) << "a jog needs no place";
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] == 2.0; }));
  ASSERT_TRUE(run.turn_until_state("Idle"));
  take("$X");
  EXPECT_EQ(run.get("/status")["trust"], "commanded");
  take("G0 X1");
  EXPECT_EQ(run.status, 200U);
  EXPECT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] == 1.0; }));
}

// M6 with [tool_change] goes to machine coordinates, with a movable plate too: its safe height is one.
TEST(ToolChangePlace, is_homed_or_a_person_vouches_for_it) {
  ToolChangePlan plan;
  plan.way = ToolChangeWay::plate;
  plan.safe_z = 5;
  plan.window_low = -20;
  plan.window_high = -1;
  plan.seek = MmPerSecond(5);
  plan.latch = MmPerSecond(1);
  plan.retract = 1;
  MachineDescription machine = test::example_machine("router");
  machine.homing.clear();  // so the other lines and programs need no known position
  machine.tool_change = std::make_shared<const ToolChangePlan>(plan);
  ApiRun run(KnownPosition{}, nullptr, {}, nullptr, {}, nullptr, nullptr, nullptr, {}, machine);
  run.own();
  const auto take = [&](const char* line) { return run.post("/mdi", Json({{"line", line}}).dump()); };
  EXPECT_EQ(take("T1 M6")["error"]["code"], "run.tool-change-unplaced");
  EXPECT_EQ(run.status, 409U);
  take("G0 X1");
  ASSERT_EQ(run.status, 200U) << "only the tool change is refused";
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] == 1.0; }));
  ASSERT_TRUE(run.turn_until_state("Idle"));

  const std::string start = fmt::format("/programs/{}/run", run.upload("G21 G90\nG0 X3\nT1 M6\nM2\n"));
  run.post(start);
  ASSERT_EQ(run.status, 202U) << "it is still unchecked";
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "failed"; }));
  EXPECT_EQ(run.get("/status")["place"]["x"], 1.0) << "nothing moves";
  EXPECT_EQ(run.post(start)["error"]["code"], "run.tool-change-unplaced");
  EXPECT_EQ(run.status, 409U);

  take("$X");
  EXPECT_EQ(run.get("/status")["trust"], "commanded");
  run.post(start);
  ASSERT_EQ(run.status, 202U);
  EXPECT_TRUE(run.turn_until_state("Tool"));
}

TEST_F(Mdi, tells_what_is_wrong_apart_from_what_was_expected) {
  const Json error = run.post("/mdi", R"({"line": "G1 X1"})")["error"];
  EXPECT_EQ(error["code"], "gcode.missing-feed");
  EXPECT_EQ(error["message"], "no feed rate is set");
  EXPECT_NE(error["expected"], "");
}

TEST_F(Mdi, says_why_nothing_jogs_while_it_has_the_spindle_on) {
  line("M3 S9000");
  const Json answer = run.post("/jog", R"({"direction": {"x": 1}, "speed": 600, "distance": 2})");
  EXPECT_EQ(run.status, 409U);
  EXPECT_NE(answer["error"]["message"].get<std::string>().find("M5 M9"), std::string::npos) << answer;
}

TEST_F(Mdi, tells_of_a_probe_that_has_touched_nothing) {
  line("G38.2 X5 F600");
  EXPECT_NE(run.get("/status")["mdi"]["trouble"], "");
  line("G0 X1");
  EXPECT_EQ(run.get("/status")["mdi"]["trouble"], "");
}

}  // namespace
}  // namespace passo
