// The hooks of the machine file in a whole job of a server: each runs once, also if it is held, if the server dies in
// it, or if it was started again by a resume. A job that is stopped leaves its last hook out.
#include <cmath>
#include <cstdio>

#include "job_kit.hpp"
#include "kit/in_full.hpp"

namespace passo::test {
namespace {

// Only the hooks go to Y7 and Y-7, and switch the coolant.
constexpr double far_y = 7;
const std::string hooked_part = "G21 G90 F1500\nG1 X6\nG1 Y1\nG1 X0\nG1 Y0\nM2\n";

MachineDescription hooked_router() {
  MachineDescription machine = example_machine("router");
  machine.hooks = {.at_start = "M8\nG53 G1 Y7 F900\nG4 P0.1\nG53 G0 Y0\n",
                   .at_end = "G53 G1 Y-7 F900\nG4 P0.1\nG53 G0 Y0\nM9\n"};
  return machine;
}

// Counts the visits to the places of the hooks, by steps.
class HookCounter final : public MachineObserver {
 public:
  explicit HookCounter(const MachineDescription& machine) : steps_per_mm_(machine.axes[1].steps_per_unit) {}
  void on_steps(Ticks /*time*/, std::uint8_t stepped, std::uint8_t directions) override {
    constexpr double reached = far_y - 0.1;
    if ((stepped >> 1U & 1U) == 0) return;
    const double before = y();
    steps_ += (directions >> 1U & 1U) != 0 ? -1 : 1;
    if (before < reached && y() >= reached) ++starts;
    if (before > -reached && y() <= -reached) ++ends;
  }
  void on_outputs(Ticks /*time*/, const BoardOutputs& outputs) override { switches = outputs.switches; }
  double y() const { return static_cast<double>(steps_) / steps_per_mm_; }

  int starts = 0;
  int ends = 0;
  std::uint8_t switches = 0;

 private:
  double steps_per_mm_;
  std::int64_t steps_ = 0;
};

struct HookBench {
  JobBench bench{hooked_router()};
  HookCounter hooks{bench.description};

  HookBench() { bench.board->add_observer(hooks); }
  double x() const { return static_cast<double>(bench.log.place[0]) / bench.description.axes[0].steps_per_unit; }
  void expect_done_once() const {
    EXPECT_EQ(hooks.starts, 1);
    EXPECT_EQ(hooks.ends, 1);
    EXPECT_EQ(hooks.switches, 0);
    EXPECT_EQ(bench.log.place, (std::array<std::int64_t, StepLog::motors>{}));
  }
};

TEST(HookRestart, hooks_run_once_in_a_job_and_again_in_the_next_one) {
  HookBench at;
  JobServer server(at.bench);
  server.run(hooked_part);
  ASSERT_TRUE(server.turn_until([&] { return at.x() > 1; }));
  EXPECT_EQ(at.hooks.starts, 1) << "before the first line";
  EXPECT_EQ(at.hooks.switches, flood_on) << "the coolant of the hook stays on";
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done") << server.get("/status");
  at.expect_done_once();
  server.run(hooked_part);
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(at.hooks.starts, 2);
  EXPECT_EQ(at.hooks.ends, 2);
  // Lines of the console are no job.
  server.post("/mdi", R"({"line": "G0 X1"})");
  ASSERT_TRUE(server.turn_until([&] { return at.x() > 0.999; }));
  EXPECT_EQ(at.hooks.starts, 2);
}

TEST(HookRestart, a_job_that_is_held_in_a_hook_goes_on_in_it) {
  HookBench at;
  JobServer server(at.bench);
  const auto hold_at = [&](double y) {
    ASSERT_TRUE(server.turn_until([&] { return std::abs(at.hooks.y()) > std::abs(y) && at.hooks.y() * y > 0; }));
    server.post("/hold");
    ASSERT_TRUE(server.turn_until([&] { return server.session().state() == MachineState::hold; }));
    ASSERT_TRUE(server.turn_until([&] { return server.session().status().rests; }));
    const auto held = at.bench.log.place;
    server.turn_until([] { return false; }, Seconds(1));
    EXPECT_EQ(at.bench.log.place, held);
    server.post("/resume");
  };
  server.run(hooked_part);
  hold_at(2);
  hold_at(-2);
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done") << server.get("/status");
  at.expect_done_once();
}

TEST(HookRestart, a_job_that_is_stopped_in_a_hook_or_after_it_leaves_the_last_hook_out) {
  for (const bool in_hook : {true, false}) {
    SCOPED_TRACE(in_hook);
    HookBench at;
    JobServer server(at.bench);
    server.run(hooked_part);
    ASSERT_TRUE(server.turn_until([&] { return in_hook ? at.hooks.y() > 0.5 : at.x() > 2; }));
    server.post("/stop");
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "stopped");
    EXPECT_EQ(at.hooks.switches, 0) << "the coolant is off";
    EXPECT_EQ(at.hooks.ends, 0);
    // The next job begins with its first hook.
    ASSERT_TRUE(server.turn_until([&] { return server.session().state() == MachineState::idle; }));
    const int before = at.hooks.starts;
    server.run(hooked_part);
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "done") << server.get("/status");
    EXPECT_EQ(at.hooks.starts, before + 1);
    EXPECT_EQ(at.hooks.ends, 1);
  }
}

// Servers die at moments spread over the whole job, and the next one resumes it.
TEST(HookRestart, a_job_whose_server_was_killed_runs_no_hook_again) {
  std::uint64_t moments = 0;
  {
    HookBench whole;
    JobServer server(whole.bench);
    server.run(hooked_part);
    ASSERT_TRUE(server.to_end());
    moments = server.moments();
  }
  int in_start = 0;
  int in_end = 0;
  const auto trials = static_cast<std::uint64_t>(fewer(24, 3));
  for (std::uint64_t i = 1; i < trials && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("dies at moment {} of {}", moments * i / trials, moments));
    HookBench at;
    try {
      JobServer server(at.bench, moments * i / trials, static_cast<HostEnd>(i % 3));
      server.run(hooked_part);
      server.to_end();
    } catch (const HostDied&) {
    }
    at.bench.let_pass(Seconds(1));
    if (at.hooks.y() > 1.5) ++in_start;
    if (at.hooks.y() < -0.5) ++in_end;
    JobServer server(at.bench);
    const auto told = server.get("/interrupted")["interrupted"];
    if (!told.is_object()) continue;  // it had not begun, or had ended
    ASSERT_EQ(told["goes_on"], true) << told;
    server.post("/interrupted/resume");
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "done") << server.get("/status");
    at.expect_done_once();
  }
  EXPECT_GT(in_start, 0);
  EXPECT_GT(in_end, 0);
  std::printf("killed in the first hook: %d, in the last hook: %d\n", in_start, in_end);
}

}  // namespace
}  // namespace passo::test
