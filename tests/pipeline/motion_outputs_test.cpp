// Outputs that change in motion: each at its position on the path, none lost or doubled, whatever happens to the motion
// and to the link.
#include "kit/motion_outputs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "kit/journaled_host.hpp"
#include "kit/line_run.hpp"
#include "kit/line_trouble.hpp"
#include "kit/seed.hpp"
#include "kit/stage_test.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using test::Bytes;
using test::DrivenProgram;
using test::expect_changes;
using test::expect_same_steps;
using test::laser_machine;
using test::MotionOutputLog;
using test::OutputProgram;
using test::OutputProgramWriter;
using test::Random;
using test::RandomTrouble;

void run_to_end(DrivenProgram& job, const Diagnostics& diagnostics) {
  while (job.advance()) {
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  EXPECT_FALSE(job.link().error()) << message_of(*job.link().error());
  EXPECT_EQ(job.machine().counts().outputs, BoardOutputs{});
}

void run_direct(const OutputProgram& program, const MachineDescription& machine, MotionOutputLog& log) {
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", program.text), machine, InterpreterOptions(), diagnostics);
  job.machine().add_observer(log);
  run_to_end(job, diagnostics);
}

int trials(int usual) {
  return static_cast<int>(test::number_of("PASSO_RUNS", static_cast<std::uint64_t>(usual)));
}

class OutputsInMotion : public testing::TestWithParam<std::string> {};

TEST_P(OutputsInMotion, change_at_their_positions) {
  const MachineDescription machine = laser_machine(GetParam());
  const double step = 1 / std::min(machine.axes[0].steps_per_unit, machine.axes[1].steps_per_unit);
  Random random;
  std::size_t changes = 0;
  for (int trial = 0; trial < trials(4); ++trial) {
    SCOPED_TRACE(fmt::format("seed {}, trial {}", random.seed(), trial));
    const double tolerance = trial % 2 == 0 ? 0 : 0.02;
    const OutputProgram program = OutputProgramWriter(random, tolerance).write(60);
    for (const bool over_a_line : {false, true}) {
      MotionOutputLog log(machine);
      Diagnostics diagnostics;
      DrivenProgram job(ProgramReader::from_text("t", program.text), machine, InterpreterOptions(), diagnostics,
                        {.line = over_a_line ? std::optional(LineOptions{}) : std::nullopt});
      job.machine().add_observer(log);
      run_to_end(job, diagnostics);
      // Both motors are within a step of their exact positions, and the change at most a step of the faster one early.
      expect_changes(log.changes, program.changes, tolerance + 3 * step);
      if (HasFatalFailure()) return;
      changes += log.changes.size();
    }
  }
  std::printf("%zu changes\n", changes);
}

TEST_P(OutputsInMotion, survive_a_bad_link) {
  const MachineDescription machine = laser_machine(GetParam());
  Random random;
  int faults = 0;
  int recoveries = 0;
  for (int trial = 0; trial < trials(6); ++trial) {
    SCOPED_TRACE(fmt::format("seed {}, trial {}", random.seed(), trial));
    const OutputProgram program = OutputProgramWriter(random, trial % 2 == 0 ? 0 : 0.02).write(25);
    MotionOutputLog reference(machine);
    run_direct(program, machine, reference);
    RandomTrouble trouble(random.seed() + static_cast<std::uint64_t>(trial));
    MotionOutputLog log(machine);
    Diagnostics diagnostics;
    DrivenProgram job(ProgramReader::from_text("t", program.text), machine, InterpreterOptions(), diagnostics,
                      {.line = LineOptions{}});
    job.machine().add_observer(log);
    job.line().set_trouble([&](bool to_board, const Bytes& bytes) { return trouble(to_board, bytes); });
    run_to_end(job, diagnostics);
    expect_same_steps(log, reference);
    if (HasFatalFailure()) return;
    faults += trouble.faults;
    recoveries += job.drive().ledger()->recoveries();
  }
  std::printf("%d faults, %d recoveries\n", faults, recoveries);
  EXPECT_GT(recoveries, 0);
}

INSTANTIATE_TEST_SUITE_P(Board, OutputsInMotion, testing::Values("router", "uno"));

// The energy of the beam: the sum of power times time, in seconds at full power.
class EnergyLog final : public MachineObserver {
 public:
  explicit EnergyLog(double clock) : clock_(clock) {}
  void on_steps(Ticks /*time*/, std::uint8_t /*stepped*/, std::uint8_t /*directions*/) override {}
  void on_outputs(Ticks time, const BoardOutputs& outputs) override {
    energy += power_ * static_cast<double>(time.count - since_) / clock_;
    since_ = time.count;
    power_ = (outputs.switches & 1U) != 0 ? outputs.spindle_rpm / 24'000.0 : 0;
  }
  double energy = 0;

 private:
  double clock_;
  double power_ = 0;
  std::int64_t since_ = 0;
};

// With M4 the energy is that of the programmed speed, however slow the corners are.
TEST_P(OutputsInMotion, power_that_follows_the_speed_gives_the_same_energy_in_corners) {
  const MachineDescription machine = laser_machine(GetParam());
  std::string program = "G21 G90 G61 M4 S500 F1800\n";
  for (int i = 1; i <= 30; ++i) program += fmt::format("G1 X{} Y{}\n", i / 2 * 2, (i + 1) / 2 * 2);
  EnergyLog log(machine.board.clock.value());
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", program + "M2\n"), machine, InterpreterOptions(), diagnostics,
                    {.line = LineOptions{}});
  job.machine().add_observer(log);
  run_to_end(job, diagnostics);
  const double wanted = 0.5 * 60 / 30;  // 60 mm at 30 mm/s
  EXPECT_NEAR(log.energy, wanted, 0.01 * wanted);
  std::printf("%.4f of %.4f\n", log.energy, wanted);
}

// Whether the beam is on, and since when the machine stands.
class BeamWatch final : public MachineObserver {
 public:
  void on_steps(Ticks time, std::uint8_t /*stepped*/, std::uint8_t /*directions*/) override {
    if (is_on) longest_still = std::max(longest_still, time.count - std::max(last_step, switched));
    last_step = time.count;
    steps_with_beam += is_on ? 1 : 0;
  }
  void on_outputs(Ticks time, const BoardOutputs& outputs) override {
    if (is_on) longest_still = std::max(longest_still, time.count - std::max(last_step, switched));
    const bool was_on = std::exchange(is_on, (outputs.switches & 1U) != 0);
    if (was_on && !is_on) beam_off = time.count;
    switches = outputs.switches;
    switched = time.count;
  }
  std::int64_t last_step = 0;
  std::int64_t switched = 0;
  std::int64_t beam_off = 0;
  std::int64_t longest_still = 0;  // with the beam on and no step
  int steps_with_beam = 0;
  bool is_on = false;
  unsigned switches = 0;
};

class BeamInStops : public testing::TestWithParam<bool> {
 protected:
  static constexpr const char* program =
      "G21 G90 F2400 M3 S500\nM62 P0\nM62 P1\nG1 X20\nS700\nX40\nG0 X45\nG1 X60\nM2\n";
};

TEST_P(BeamInStops, a_hold_switches_off_within_a_millisecond_and_goes_on_as_before) {
  const MachineDescription machine = laser_machine("router");
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                    {.line = GetParam() ? std::optional(LineOptions{}) : std::nullopt, .live = live_commitment});
  BeamWatch watch;
  MotionOutputLog log(machine);
  job.machine().add_observer(watch);
  job.machine().add_observer(log);
  int holds = 0;
  double next = 5;
  for (int turn = 0; job.advance(); ++turn) {
    MotionDrive& drive = job.drive();
    const double x = static_cast<double>(job.machine().counts().motors[0].position) / machine.axes[0].steps_per_unit;
    if (drive.state() == MotionDrive::State::running && x > next) drive.hold();
    if (drive.state() != MotionDrive::State::held) continue;
    ++holds;
    next = x + 4;
    EXPECT_FALSE(watch.is_on) << x;
    EXPECT_EQ(watch.switches & 12U, 4U) << "only P1 stays on";
    EXPECT_LE(static_cast<double>(watch.beam_off - watch.last_step), machine.board.clock.value() / 1000) << x;
    test::let_pass(drive, Seconds(0.3));
    EXPECT_FALSE(watch.is_on) << x;
    drive.resume();
  }
  EXPECT_GE(holds, 6);
  MotionOutputLog reference(machine);
  run_direct({.text = program, .changes = {}}, machine, reference);
  expect_same_steps(log, reference);
}

TEST_P(BeamInStops, a_stop_switches_everything_off) {
  const MachineDescription machine = laser_machine("router");
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                    {.line = GetParam() ? std::optional(LineOptions{}) : std::nullopt, .live = live_commitment});
  BeamWatch watch;
  job.machine().add_observer(watch);
  while (job.advance()) {
    const double x = static_cast<double>(job.machine().counts().motors[0].position) / machine.axes[0].steps_per_unit;
    if (x > 10 && !job.drive().stopped()) job.drive().stop();
  }
  EXPECT_GT(watch.steps_with_beam, 1000);
  EXPECT_EQ(watch.switches, 0U);
  EXPECT_LE(static_cast<double>(watch.switched - watch.last_step), machine.board.clock.value() / 10);
}

TEST(BeamOverALine, a_cut_cable_ends_with_the_beam_off) {
  const MachineDescription machine = laser_machine("router");
  const std::string program = "G21 G90 F2400 M3 S500\nM62 P0\nM62 P1\nG1 X20\nS700\nX40\nG0 X45\nG1 X60\nM2\n";
  MotionOutputLog reference(machine);
  run_direct({.text = program, .changes = {}}, machine, reference);
  for (double at = 0.3; at < 1.35; at += 0.1) {
    SCOPED_TRACE(at);
    Diagnostics diagnostics;
    DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                      {.line = LineOptions{}});
    BeamWatch watch;
    MotionOutputLog log(machine);
    job.machine().add_observer(watch);
    job.machine().add_observer(log);
    bool cut = false;
    bool looked = false;
    while (job.advance()) {
      const double now = job.machine().elapsed().value();
      if (!cut && now > at) job.line().cut(job.machine().elapsed(), Seconds(2));
      cut = cut || now > at;
      if (!cut || looked || now < at + 1.8) continue;
      looked = true;
      EXPECT_FALSE(watch.is_on);
      EXPECT_EQ(watch.switches & 12U, 4U) << "only P1 stays on";
      EXPECT_LE(watch.beam_off, watch.last_step) << "with the last step";
    }
    EXPECT_TRUE(looked);
    expect_same_steps(log, reference);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// Hosts that are killed at any moment, each followed by one that resumes the job.
TEST(BeamOverALine, a_resumed_job_burns_what_it_has_not_burned) {
  const MachineDescription machine = laser_machine("router");
  const std::string program =
      "G21 G90 F3000 M3 S500\nM62 P0\nM62 P1\nG1 X4\nS700\nX6\nG0 Y1\nS300\nG1 X2\nM63 P0\nG4 P.02\nX0\nM2\n";
  MotionOutputLog reference(machine);
  run_direct({.text = program, .changes = {}}, machine, reference);
  int killed = 0;
  for (std::uint64_t moment = 5; moment < 120; moment += 7) {
    SCOPED_TRACE(moment);
    VirtualMachine board(static_cast<std::uint8_t>(machine.axes.size()), machine.board.clock,
                         machine.board.highest_event_rate, static_cast<std::size_t>(machine.board.held_items));
    IdealPlant plant(plant_of(machine, Point()));
    board.connect(plant);
    board.stand_at(steps_at(machine, Point()));
    MotionOutputLog log(machine);
    board.add_observer(log);
    test::JournaledHost host(machine, program);
    bool done = false;
    for (std::uint64_t lives = 0; !done && lives < 3; ++lives) {
      VirtualLine line(board, machine.board.clock, LineOptions{});
      std::uint64_t moments = 0;
      done = host.live(line, lives < 2 ? moment + lives * 31 : test::never, test::HostEnd::before_frame, moments);
      killed += done ? 0 : 1;
      static_cast<void>(line.run(Seconds(2)));
    }
    EXPECT_TRUE(done);
    expect_same_steps(log, reference);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(killed, 10);
}

TEST_P(BeamInStops, it_is_off_in_dwells) {
  const MachineDescription machine = laser_machine("router");
  const std::string dwells = "G21 G90 F2400 M3 S500\nG1 X5\nG4 P.2\nX10\nM62 P0\nG4 P.2\nG0 X12\nG1 X14\nM2\n";
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", dwells), machine, InterpreterOptions(), diagnostics,
                    {.line = GetParam() ? std::optional(LineOptions{}) : std::nullopt});
  BeamWatch watch;
  job.machine().add_observer(watch);
  run_to_end(job, diagnostics);
  EXPECT_LE(static_cast<double>(watch.longest_still), machine.board.clock.value() / 200);
}

// 50 mm with another S every 0.1 mm take as long as without. Over a line, the first queue update is later.
TEST_P(BeamInStops, no_change_of_power_costs_time) {
  const MachineDescription machine = laser_machine("router");
  std::string changing = "G21 G90 F3000 M3\n";
  for (int i = 1; i <= 500; ++i) changing += fmt::format("G1 X{:.1f} S{}\n", i * 0.1, 100 + i % 2 * 800);
  std::vector<double> times;
  for (const std::string& text : {changing + "M2\n", std::string("G21 G90 F3000 M3 S500\nG1 X50\nM2\n")}) {
    MotionOutputLog log(machine);
    Diagnostics diagnostics;
    DrivenProgram job(ProgramReader::from_text("t", text), machine, InterpreterOptions(), diagnostics,
                      {.line = GetParam() ? std::optional(LineOptions{}) : std::nullopt});
    job.machine().add_observer(log);
    run_to_end(job, diagnostics);
    times.push_back(job.machine().elapsed().value());
    EXPECT_EQ(log.changes.size(), times.size() == 1 ? 501U : 2U);
  }
  EXPECT_NEAR(times[0], times[1], GetParam() ? 0.05 : 0.0001);
  std::printf("%.4f s, and %.4f s without changes\n", times[0], times[1]);
}

// A change of power needs two items or more of the queue. Too many in a corner would leave a board of 42 places without
// motion, so that it stops on the path.
TEST(BeamOverALine, corners_with_m4_do_not_stop_a_board_with_a_short_queue) {
  const MachineDescription machine = laser_machine("uno");
  std::string program = "G21 G90 G64 P0.02 M4 S500 F1000\nG1 X50\nY20\nX0\nY0\nG2 X0 Y0 I5\n";
  for (int i = 1; i <= 100; ++i) program += fmt::format("G1 X{:.3f} Y{:.3f}\n", 0.2 * i, 5 * std::sin(0.05 * i));
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", program + "M2\n"), machine, InterpreterOptions(), diagnostics,
                    {.line = LineOptions{}});
  run_to_end(job, diagnostics);
  EXPECT_EQ(job.drive().ledger()->recoveries(), 0);
  EXPECT_EQ(job.drive().ledger()->slowdowns(), 0);
}

INSTANTIATE_TEST_SUITE_P(Line, BeamInStops, testing::Bool());

}  // namespace
}  // namespace passo
