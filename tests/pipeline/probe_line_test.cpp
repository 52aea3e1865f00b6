// Probing over a line: places exact to the step, overrun bounded, whatever the line does.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/line_trouble.hpp"
#include "kit/stage_test.hpp"
#include "kit/step_log.hpp"
#include "pipeline/probe_line_kit.hpp"

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

using test::below;
using test::ContactOracle;
using test::DrivenProgram;
using test::example_machine;
using test::expect_as_the_oracle_saw;
using test::plate;
using test::RandomTrouble;
using test::StepLog;
using test::touches;
using test::xyz;
using Probed = test::LineProbing;

using Bytes = VirtualLine::Bytes;
// Sees each frame with its number, and gives back what passes.
using Trouble = std::function<Bytes(DrivenProgram& job, std::uint64_t number, bool to_board, Bytes bytes)>;

struct Setting {
  LineOptions line = {};
  Trouble trouble = nullptr;
  test::Random* meddles = nullptr;  // with holds and overrides
};

Point end_of(const VirtualMachine& virtual_machine, const MachineDescription& machine) {
  Point end;
  const MachineCounts counts = virtual_machine.counts();
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    const auto steps = static_cast<double>(counts.motors[m].position);
    end[axis.axis] = (axis.inverted ? -steps : steps) / axis.steps_per_unit;
  }
  return end;
}

void meddle(MotionDrive& drive, test::Random& random, int& holds) {
  if (drive.state() == MotionDrive::State::running && random.chance(0.01)) drive.hold();
  if (drive.state() == MotionDrive::State::holding && random.chance(0.02)) drive.resume();
  if (drive.state() == MotionDrive::State::held) {
    ++holds;
    drive.resume();
  }
  if (random.chance(0.02)) drive.set_feed_override(random.between(0.1, 2));
}

Probed run(const std::string& program, const MachineDescription& machine, const TouchBox& box,
           const Setting& setting = {}) {
  Probed result;
  IdealPlant plant = plant_of(machine, Point(), {box});
  DrivenProgram job(ProgramReader::from_text("t", program), machine, {}, result.diagnostics,
                    {.line = setting.line, .plant = &plant});
  ContactOracle oracle(machine, box);
  StepLog log;
  job.machine().add_observer(oracle);
  job.machine().add_observer(log);
  job.line().set_trouble([&](bool to_board, Bytes bytes) {
    const std::uint64_t number = result.frames++;
    return setting.trouble ? setting.trouble(job, number, to_board, std::move(bytes)) : bytes;
  });
  job.drive().probe().watch([&](const ProbeOutcome& outcome) { result.outcomes.push_back(outcome); });
  while (job.advance()) {
    if (setting.meddles != nullptr) meddle(job.drive(), *setting.meddles, result.holds);
  }
  result.error = job.link().error();
  result.contacts = oracle.contacts;
  result.releases = oracle.releases;
  result.stopped_by_probe = job.drive().stopped_by_probe();
  result.outputs = job.machine().counts().outputs;
  result.end = end_of(job.machine(), machine);
  result.recoveries = job.drive().ledger()->recoveries();
  result.longest_ahead = job.drive().ledger()->longest_ahead();
  test::expect_within_limits(machine, log.steps);
  return result;
}

constexpr const char* boards[] = {"router", "uno"};

TEST(ProbingOverALine, finds_the_step_of_contact_at_every_speed_of_the_line) {
  for (const char* name : boards) {
    const MachineDescription machine = example_machine(name);
    for (const double baud : {115'200.0, 250'000.0, 500'000.0, 1'000'000.0}) {
      SCOPED_TRACE(name + std::string(" at ") + std::to_string(baud));
      const Probed result = run(touches, machine, below(Axis::z, plate), {.line = {.baud = baud}});
      expect_as_the_oracle_saw(machine, result);
      std::printf(
          "%s, %.0f baud: at most %.1f ms ahead, %d rests; from contact to rest %.3f mm at 8.3 mm/s, %.3f at 2, "
          "%.3f at 0.67\n",
          name, baud, 1000 * result.longest_ahead.value(), result.recoveries,
          distance(result.outcomes[0].rest, result.outcomes[0].contact),
          distance(result.outcomes[1].rest, result.outcomes[1].contact),
          distance(result.outcomes[2].rest, result.outcomes[2].contact));
    }
  }
}

TEST(ProbingOverALine, loses_nothing_by_holds_and_overrides) {
  test::Random random;
  int holds = 0;
  for (int i = 0; i < 10 && !testing::Test::HasFailure(); ++i) {
    const MachineDescription machine = example_machine(boards[i % 2]);
    const Probed result = run(touches, machine, below(Axis::z, plate), {.meddles = &random});
    expect_as_the_oracle_saw(machine, result, 2);
    holds += result.holds;
  }
  EXPECT_GT(holds, 10);
}

TEST(ProbingOverALine, that_finds_nothing_ends_the_program_in_words) {
  const MachineDescription router = example_machine("router");
  const Probed must = run("G21 G90 S1000 M3 F600\nG38.2 Z-3\nG0 X20\nM2\n", router, below(Axis::z, -9));
  ASSERT_EQ(must.diagnostics.errors(), 1U);
  EXPECT_EQ(must.diagnostics.all()[0].code, "gcode.probe-untouched");
  EXPECT_EQ(must.end, xyz(0, 0, -3));
  EXPECT_EQ(must.outputs.switches, 0);
}

TEST(ProbingOverALine, that_begins_in_contact_moves_nothing) {
  const MachineDescription router = example_machine("router");
  const Probed result = run("G21 G90 F300\nG0 X3\nG38.2 Z-5\nM2\n", router, below(Axis::z, 1));
  ASSERT_EQ(result.diagnostics.errors(), 1U);
  EXPECT_EQ(result.diagnostics.all()[0].code, "gcode.probe-before");
  EXPECT_EQ(result.end, xyz(3, 0));
}

// A frame is lost, and no other: the one in which the board tells of the contact.
TEST(ProbingOverALine, does_without_the_message_of_the_contact) {
  for (const char* name : boards) {
    const MachineDescription machine = example_machine(name);
    int lost = 0;
    const Probed result = run(touches, machine, below(Axis::z, plate),
                              {.trouble = [&](DrivenProgram&, std::uint64_t, bool to_board, const Bytes& bytes) {
                                const bool captured = !to_board && bytes[2] == 0x99 && (bytes[5] & 0x40) == 0;
                                lost += captured ? 1 : 0;
                                return captured ? Bytes() : bytes;
                              }});
    EXPECT_GE(lost, 4);
    expect_as_the_oracle_saw(machine, result);
  }
}

void cut_before_frames(const char* name, std::uint64_t stride) {
  const MachineDescription machine = example_machine(name);
  const Probed whole = run(touches, machine, below(Axis::z, plate));
  int trials = 0;
  int recoveries = 0;
  for (const double seconds : {0.02, 0.5}) {
    for (std::uint64_t at = 0; at < whole.frames && !testing::Test::HasFatalFailure(); at += stride, ++trials) {
      SCOPED_TRACE(name + std::string(", cut before frame ") + std::to_string(at) + " for " + std::to_string(seconds));
      const Probed cut = run(touches, machine, below(Axis::z, plate),
                             {.trouble = [&](DrivenProgram& job, std::uint64_t number, bool, Bytes bytes) {
                               if (number == at) job.line().cut(job.machine().elapsed(), Seconds(seconds));
                               return bytes;
                             }});
      expect_as_the_oracle_saw(machine, cut);
      recoveries += cut.recoveries;
    }
  }
  std::printf("%s: %d cuts, %d recoveries from a tail\n", name, trials, recoveries);
  EXPECT_GT(recoveries, trials / 4);
}

void random_faults(const char* name, int trials) {
  const MachineDescription machine = example_machine(name);
  const std::uint64_t seed = test::seed();
  int faults = 0;
  int recoveries = 0;
  for (int i = 0; i < trials && !testing::Test::HasFatalFailure(); ++i) {
    SCOPED_TRACE(name + std::string(", PASSO_SEED=") + std::to_string(seed) + ", trial " + std::to_string(i));
    RandomTrouble trouble(seed + static_cast<std::uint64_t>(i));
    const Probed result = run(touches, machine, below(Axis::z, plate),
                              {.trouble = [&](DrivenProgram&, std::uint64_t, bool to_board, const Bytes& bytes) {
                                return trouble(to_board, bytes);
                              }});
    expect_as_the_oracle_saw(machine, result);
    faults += trouble.faults;
    recoveries += result.recoveries;
  }
  std::printf("%s: %d trials with %d faults, %d recoveries from a tail\n", name, trials, faults, recoveries);
  EXPECT_GT(faults, trials);
}

class ProbingOnABadLine : public testing::TestWithParam<const char*> {};
class ProbingOnABadLineInFull : public test::InFull<testing::TestWithParam<const char*>> {};

TEST_P(ProbingOnABadLine, cut_in_part) {
  cut_before_frames(GetParam(), 23);
}
TEST_P(ProbingOnABadLine, random_faults_in_part) {
  random_faults(GetParam(), 30);
}
TEST_P(ProbingOnABadLineInFull, cut_before_every_frame) {
  cut_before_frames(GetParam(), test::in_full());
}
TEST_P(ProbingOnABadLineInFull, random_faults) {
  random_faults(GetParam(), static_cast<int>(1000 / test::in_full()));
}
INSTANTIATE_TEST_SUITE_P(Board, ProbingOnABadLine, testing::ValuesIn(boards));
INSTANTIATE_TEST_SUITE_P(Board, ProbingOnABadLineInFull, testing::ValuesIn(boards));

TEST(ProbingOverALine, guards_stop_at_a_contact_in_any_other_move) {
  MachineDescription router = example_machine("router");
  router.probe.guards = true;
  const std::string program = "G21 G90 F600\nG38.2 Z-5\nG0 Z5\nM3 S1000\nG0 X50\nG1 Z-5\nX0\nM2\n";
  for (const bool told : {true, false}) {
    const Probed result = run(program, router, below(Axis::z, -2),
                              {.trouble = [&](DrivenProgram&, std::uint64_t, bool to_board, const Bytes& bytes) {
                                const bool captured = !to_board && bytes[2] == 0x99 && (bytes[5] & 0x40) == 0;
                                return captured && !told ? Bytes() : bytes;
                              }});
    EXPECT_TRUE(result.stopped_by_probe);
    ASSERT_EQ(result.outcomes.size(), 1U);
    EXPECT_DOUBLE_EQ(result.outcomes[0].contact[Axis::z], -2);
    EXPECT_EQ(result.end[Axis::x], 50) << "moving off the plate is allowed";
    EXPECT_LE(result.end[Axis::z], -2);
    // A tenth of a second ahead; where the message is lost, a refill more.
    EXPECT_GE(result.end[Axis::z], -2 - 10 * (told ? 0.105 : 0.15) - 10 * 10 / (2 * 500.0) - 0.01);
    EXPECT_EQ(result.outputs.switches, 0);
  }
}

}  // namespace
}  // namespace passo
