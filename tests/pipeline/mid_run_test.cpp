// Hold, resume, override and stop at random instants: on the path, within the limits, and with nothing lost.
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "kit/stage_test.hpp"

#include "passo/controller/job.hpp"
#include "passo/proof/motion_proof.hpp"
#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

using State = Drive::State;

MachineDescription example_machine(const std::string& name) {
  Diagnostics diagnostics;
  auto machine = load_machine_file(PASSO_SOURCE_DIR "/examples/machines/" + name + ".toml", diagnostics);
  EXPECT_TRUE(machine) << render(diagnostics, false);
  return machine.value_or(MachineDescription());
}

ProofOptions proof_options(const MachineDescription& machine) {
  ProofOptions options;
  for (const AxisDescription& axis : machine.axes) {
    options.axes.push_back(
        {.axis = axis.axis, .step = axis.step(), .velocity = axis.velocity, .acceleration = axis.acceleration});
  }
  options.tick_rate = machine.board.clock;
  return options;
}

// What a program is made of.
std::string lines() {
  return "G21 G90 G1 F4000\nX20\nY15\nX3 Y20 Z-2\nX0 Y0 Z0\nG61.1 X8 Y8\nX12\nG64 X-5 Y3\nG0 X0 Y0\nM2\n";
}
std::string arcs() {
  return "G21 G90 F5000\nG2 X20 Y0 I10 J0\nG3 X40 I10\nG2 X40 Y20 I0 J10\nG1 X30\nG3 X30 Y10 J-5 Z-3\nG2 X30.5 Y10 "
         "I.25\n"
         "G1 X10 Y10\nG3 I-3 Z0\nM2\n";
}
// Chords of a few hundredths to a few tenths of a millimetre, as CAM writes them.
std::string dense() {
  std::string text = "G21 G90 G64 P.02 F6000\n";
  double angle = 0;
  for (double at = 0; at < 40; angle += 0.04) {
    at += 0.05 + 0.04 * std::sin(3 * angle);
    text += "G1 X" + std::to_string(at) + " Y" + std::to_string(6 * std::sin(angle)) + " Z" +
            std::to_string(-std::fabs(std::sin(angle / 3))) + "\n";
  }
  return text + "M2\n";
}
std::string cycles() {
  return "G21 G90 S8000 M3 M8\nG98 G81 X5 Y5 Z-4 R2 F900\nX10\nX15 Y8\nG83 X20 Z-6 R1 Q2\nG82 X25 P.05 Z-1 R1\nG80 M5 "
         "M9\n"
         "G0 X0 Y0 Z5\nG4 P.1\nG1 Y10 F2000\nM2\n";
}

struct Ending {
  std::vector<MotorCounts> motors;
  MotionProof proof;
  int holds = 0;
  int rests = 0;
  int overrides = 0;
};

// Watches a job, filters what the proof does not know, and looks at each hold.
class Watch {
 public:
  Watch(Job& job, const MachineDescription& machine) : prover_(proof_options(machine)) {
    job.path().watch([this](const PathItem& item) { prover_.watch(item); });
    job.board().watch([this](const BoardItem& item) { prover_.watch(item); });
    job.motion().watch([this](const MotionItem& item) {
      const auto* action = std::get_if<Action>(&item);
      if (action != nullptr && action->kind == Action::Kind::feed_hold) {
        EXPECT_LT(speed_, 1e-6) << "held in motion";
        return;
      }
      prover_.watch(item);
      speed_ = action != nullptr ? 0 : end_speed(std::get<PlannedMove>(item));
    });
  }
  MotionProof finish() { return prover_.finish(); }

 private:
  static double end_speed(const PlannedMove& move) {
    const Phase& last = move.phases[move.phase_count - 1];
    return last.velocity_at(last.duration).value();
  }
  MotionProver prover_;
  double speed_ = 0;
};

// One random act in mid-run, or none.
void meddle(Drive& drive, test::Random& random, Ending& ending) {
  switch (drive.state()) {
    case State::running:
      if (random.chance(0.03)) {
        drive.hold();
        ++ending.holds;
      }
      break;
    case State::holding:
      if (random.chance(0.02)) drive.resume();
      break;
    case State::held:
      ++ending.rests;
      EXPECT_NEAR(drive.committed().value(), 0, 0.02);
      if (random.chance(0.5)) drive.wait(Seconds(random.between(0, 1)));
      drive.resume();
      break;
    case State::ended: break;
  }
  if (random.chance(0.03)) {
    drive.set_feed_override(random.chance(0.3) ? 1 : random.between(0.05, 1));
    ++ending.overrides;
  }
}

Ending run(const std::string& program, const MachineDescription& machine, test::Random* random,
           const LiveOptions& live = {}) {
  Diagnostics diagnostics;
  Job job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics);
  Watch watch(job, machine);
  job.drive().go_live(live);
  Ending ending;
  while (job.advance()) {
    if (random != nullptr) meddle(job.drive(), *random, ending);
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  EXPECT_FALSE(job.link().error());
  const MachineCounts counts = job.machine().counts();
  ending.motors.assign(counts.motors.begin(), counts.motors.begin() + counts.motor_count);
  ending.proof = watch.finish();
  return ending;
}

void expect_nothing_lost(const std::string& program, const std::string& machine_name, int runs) {
  SCOPED_TRACE(machine_name);
  test::Random random;
  const MachineDescription machine = example_machine(machine_name);
  const Ending undisturbed = run(program, machine, nullptr);
  EXPECT_TRUE(undisturbed.proof.good()) << to_text(undisturbed.proof);
  int holds = 0;
  int rests = 0;
  int overrides = 0;
  for (int i = 0; i < runs && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("run " + std::to_string(i));
    const Ending ending = run(program, machine, &random);
    EXPECT_TRUE(ending.proof.good()) << to_text(ending.proof);
    for (std::size_t m = 0; m < machine.axes.size(); ++m) {
      EXPECT_EQ(ending.motors[m].position, undisturbed.motors[m].position) << "motor " << m;
    }
    holds += ending.holds;
    rests += ending.rests;
    overrides += ending.overrides;
  }
  std::printf("%d holds, %d rests, %d overrides\n", holds, rests, overrides);
}

TEST(MidRun, holds_and_overrides_lose_nothing_on_lines) {
  for (const char* machine : {"bench", "router", "pantograph", "forty-eight"}) expect_nothing_lost(lines(), machine, 4);
}
TEST(MidRun, holds_and_overrides_lose_nothing_on_arcs) {
  for (const char* machine : {"bench", "router", "pantograph", "forty-eight"}) expect_nothing_lost(arcs(), machine, 4);
}
TEST(MidRun, holds_and_overrides_lose_nothing_on_dense_paths) {
  for (const char* machine : {"bench", "router", "pantograph", "forty-eight"}) expect_nothing_lost(dense(), machine, 4);
}
TEST(MidRun, holds_and_overrides_lose_nothing_in_cycles) {
  for (const char* machine : {"bench", "router", "pantograph", "forty-eight"})
    expect_nothing_lost(cycles(), machine, 4);
}

}  // namespace
}  // namespace passo
