// What motion, spindle and coolant do when something happens amid a job: each row of the table in docs/manual/stops.md
// is what this test measures, and what the row says of how the job goes on is done.
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>

#include "api_kit.hpp"
#include "job_kit.hpp"
#include "session_kit.hpp"

namespace passo::test {
namespace {

const std::string long_job =
    "G21 G90 G61.1 F3000 M3 S1000 M8\nG4 P.1\nG1 X30\nX0\nX30\nX0\nX30\nX0\nX30\nX0\nG4 P.1\nM2\n";

// The last steps of X, and when the outputs went off. Times are ticks.
class LastSteps final : public MachineObserver {
 public:
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t) override {
    if ((stepped & 1U) == 0) return;
    interval = time.count - last;
    last = time.count;
  }
  void on_outputs(Ticks time, const BoardOutputs& outputs) override {
    is_on = (outputs.switches & OutputSwitch::spindle_on) != 0;
    if (!is_on) off = time.count;
  }
  std::int64_t last = 0;
  std::int64_t interval = 0;
  std::int64_t off = 0;
  bool is_on = false;
};

// A job on a board, to which something happens as X moves at full speed.
class Happening {
 public:
  explicit Happening(const std::string& program = long_job) {
    bench.board->add_observer(steps);
    server = std::make_unique<JobServer>(bench);
    server->run(program);
    EXPECT_TRUE(server->turn_until([&] { return x() > 15 && steps.is_on; }));
    cruises_ = steps.interval;
  }

  // Lets so much time pass, with the server or without it.
  void pass(double seconds) {
    if (server == nullptr) return bench.let_pass(Seconds(seconds));
    const Seconds end = server->session().now() + Seconds(seconds);
    server->turn_until([&] { return server->session().now() >= end; }, Seconds(seconds + 1));
  }
  void look() {
    pass(1);
    const std::int64_t rest = steps.last;
    const bool is_on_at_rest = steps.is_on;
    pass(4);
    motion = rest != steps.last ? "continues" : steps.interval > 4 * cruises_ ? "brakes on the path" : "stops at once";
    outputs = steps.is_on                                                  ? "stay on"
              : is_on_at_rest                                              ? "off after 2 s"
              : steps.off > rest || motion == std::string("stops at once") ? "off"
                                                                           : "off during motion";
    if (server == nullptr) return;
    state = name_of(server->session().state());
    job = server->job_state();
  }
  std::string row(const std::string& what, const std::string& how) const {
    return "| " + what + " | " + motion + " | " + outputs + " | " + state + " | " + job + " | " + how + " |\n";
  }
  void reset() {
    server->post("/reset");
    ASSERT_TRUE(server->turn_until([&] { return server->session().state() == MachineState::idle; }));
    server->poll();
  }
  void home() {
    server->post("/home");
    ASSERT_TRUE(server->turn_until([&] { return server->session().state() == MachineState::idle; }));
    server->poll();
  }
  void expect_done() {
    ASSERT_TRUE(server->to_end());
    EXPECT_EQ(server->job_state(), "done") << server->get("/status");
    EXPECT_FALSE(steps.is_on);
  }

  double x() const { return static_cast<double>(bench.log.place[0]) / bench.description.axes[0].steps_per_unit; }

  JobBench bench{short_router()};
  LastSteps steps;
  std::unique_ptr<JobServer> server;
  std::string motion;
  std::string outputs;
  std::string state = "-";
  std::string job = "-";

 private:
  std::int64_t cruises_ = 0;
};

std::string page() {
  std::ifstream file(PASSO_SOURCE_DIR "/docs/manual/stops.md");
  return {std::istreambuf_iterator<char>(file), {}};
}
void expect_on_page(const std::string& row) {
  EXPECT_NE(page().find(row), std::string::npos) << "docs/manual/stops.md has no line\n" << row;
}

TEST(Policies, a_hold_keeps_the_outputs) {
  Happening job;
  job.server->post("/hold");
  job.look();
  expect_on_page(job.row("hold: web interface, `POST /hold`, `!`, feed hold button", "resume: `POST /resume`, `~`"));
  job.server->post("/resume");
  job.expect_done();
}

TEST(Policies, an_open_door_is_a_hold_until_it_is_closed_and_somebody_resumes) {
  Happening job;
  job.bench.board->set_switch(input_door, true);
  job.look();
  expect_on_page(job.row("the door switch opens", "close it, then resume"));
  EXPECT_EQ(job.server->post("/resume")["error"]["code"], "machine.door-open");
  job.bench.board->set_switch(input_door, false);
  job.pass(1);
  job.server->post("/resume");
  job.expect_done();
}

TEST(Policies, a_door_command_switches_off_at_rest) {
  Happening job;
  ASSERT_TRUE(job.server->session().request(request::Hold{.for_door = true}));
  job.look();
  expect_on_page(job.row("a sender's door command (0x84)", "resume: spindle on, spindle wait, coolant on"));
  job.server->post("/resume");
  job.pass(0.5);
  EXPECT_TRUE(job.steps.is_on);
  job.expect_done();
}

TEST(Policies, a_program_that_waits_keeps_what_it_has_switched) {
  Happening job("G21 G90 F3000 M3 S1000 M8\nG4 P.1\nG1 X30\nM0\nX0\nM2\n");
  job.look();
  expect_on_page(job.row("the program waits: M0, M1, M6", "`POST /operator-done`, `~`"));
  job.server->post("/operator-done");
  job.expect_done();
}

TEST(Policies, a_line_that_has_ended_in_single_block_keeps_the_outputs) {
  Happening job;
  job.server->post("/stops", R"({"single_block": true})");
  job.look();
  expect_on_page(job.row("single block: a line of the program is done", "resume: `POST /resume`, cycle start button"));
  job.server->post("/stops", R"({"single_block": false})");
  job.server->post("/resume");
  job.expect_done();
}

TEST(Policies, a_stop_and_the_end_switch_off) {
  Happening stopped;
  stopped.server->post("/stop");
  stopped.look();
  expect_on_page(stopped.row("stop: web interface, `POST /stop`, Ctrl-X", "not at all; the position stays known"));
  EXPECT_NE(stopped.server->session().status().position.trust, Trust::unknown);
  Happening ended("G21 G90 F3000 M3 S1000 M8\nG4 P.1\nG1 X30\nM2\n");
  ended.look();
  expect_on_page(ended.row("the program ends: M2, M30", "-"));
  Happening failed("G21 G90 F3000 M3 S1000 M8\nG4 P.1\nG1 X30\nG38.2 X20\nX0\nM2\n");
  failed.look();
  expect_on_page(
      failed.row("the program fails: a probe move finds no contact", "not at all; the position stays known"));
}

TEST(Policies, an_emergency_stop_and_a_limit_stop_at_once) {
  for (const std::uint16_t which : {input_emergency_stop, input_limit}) {
    Happening job;
    job.bench.board->set_switch(which, true);
    job.look();
    expect_on_page(
        job.row("an emergency stop, a limit switch", "release it, `POST /reset`, home, `POST /interrupted/reenter`"));
    EXPECT_EQ(job.server->session().status().position.trust, Trust::unknown);
    job.bench.board->set_switch(which, false);
    job.reset();
    job.home();
    job.server->post("/interrupted/reenter");
    job.expect_done();
  }
}

TEST(Policies, a_client_that_goes_ends_its_jog_and_not_its_job) {
  Happening job;
  job.look();
  expect_on_page(job.row("the client that started the job disconnects", "-"));
  job.expect_done();
  job.server->post("/jog", R"({"direction": {"x": 1}, "speed": 3000})");
  EXPECT_EQ(job.server->status, 200U);
  job.pass(2);
  EXPECT_EQ(job.server->session().state(), MachineState::idle) << "its lease of 250 ms is over";
  EXPECT_GT(job.x(), 1);
  EXPECT_LT(job.x(), 35);
}

TEST(Policies, a_sender_that_goes_leaves_a_held_program) {
  ApiRun run;
  ASSERT_TRUE(run.owner.claim_for_sender());
  run.run.grbl().connect();
  run.run.send("M3 S1000\nG1 X30 F3000\nX0\n");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] > 5.0; }));
  run.run.grbl().disconnect();
  run.pass(Seconds(5));
  const Json status = run.get("/status");
  EXPECT_EQ(status["state"], "Hold");
  EXPECT_EQ(status["outputs"]["spindle"], "clockwise");
  expect_on_page("| the sender disconnects | brakes on the path | stay on | Hold | - | the next sender's `~` |\n");
  run.run.grbl().connect();
  run.run.send("~");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["place"]["x"] == 0.0; }));
}

TEST(Policies, a_board_that_is_silent_brakes_by_itself) {
  Happening job;
  job.bench.line->cut(job.bench.board->elapsed(), Seconds(6));
  job.look();
  expect_on_page(job.row("the board is silent for longer than a minute", "`POST /reset`, `POST /interrupted/resume`"));
  job.pass(3);
  job.reset();
  job.server->post("/interrupted/resume");
  job.expect_done();
}

TEST(Policies, a_board_that_is_silent_for_a_moment_goes_on_by_itself) {
  Happening job;
  job.bench.line->cut(job.bench.board->elapsed(), Seconds(1.5));
  job.pass(1);
  const std::int64_t rest = job.steps.last;
  job.pass(0.3);
  EXPECT_EQ(job.steps.last, rest) << "it rests";
  EXPECT_TRUE(job.steps.is_on);
  expect_on_page(
      "| the board is silent for a moment | brakes on the path | off after 2 s | Run | running | by itself |\n");
  job.expect_done();
}

TEST(Policies, a_server_that_is_killed_leaves_a_board_that_brakes) {
  Happening job;
  job.server.reset();
  job.look();
  expect_on_page(job.row("`passo serve` is killed", "start it, `POST /interrupted/resume`"));
  job.server = std::make_unique<JobServer>(job.bench);
  job.server->post("/interrupted/resume");
  job.expect_done();
}

TEST(Policies, a_board_without_power_stops_at_once) {
  Happening job;
  job.bench.board->reset_board();
  job.look();
  expect_on_page(job.row("the board loses its power, or is reset", "`POST /reset`, home, `POST /interrupted/reenter`"));
  job.reset();
  job.home();
  job.server->post("/interrupted/reenter");
  job.expect_done();
}

}  // namespace
}  // namespace passo::test
