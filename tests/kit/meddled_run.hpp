// Runs a program as a job and lets MotionProver measure the motion. The job runs undisturbed, or with holds, resumes
// and overrides at random instants.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/stage_test.hpp"
#include <gtest/gtest.h>

#include "passo/proof/motion_proof.hpp"
#include "passo/verdict/proof_options.hpp"

namespace passo::test {

// Observes a job, omits what the proof does not support, and checks each hold.
class Watch {
 public:
  Watch(DrivenProgram& job, const MachineDescription& machine) : prover_(proof_options(machine)) {
    job.path().watch([this](const PathItem& item) {
      prover_.watch(item);
      if (const auto* segment = std::get_if<Segment>(&item)) place_ = segment->curve.end();
    });
    job.items().watch([this](const BoardItem& item) { prover_.watch(item); });
    job.motion().watch([this, &machine](const MotionItem& item) {
      const auto* action = std::get_if<Action>(&item);
      const bool holds = action != nullptr && action->kind == Action::Kind::feed_hold;
      EXPECT_TRUE(rests_ || !holds) << "held in motion";
      prover_.watch(item);
      rests_ = action != nullptr || may_stop_after(std::get<PlannedMove>(item), machine);
    });
  }
  MotionProof finish() { return prover_.finish(); }
  const Point& place() const { return place_; }

 private:
  // The motors may stop at once from their start-stop velocities.
  static bool may_stop_after(const PlannedMove& move, const MachineDescription& machine) {
    if (move.phase_count == 0) return true;
    const Point velocity = move.segment.curve.tangent(move.to) * move.exit_velocity().value();
    return std::ranges::all_of(machine.axes, [&](const AxisDescription& axis) {
      return std::abs(velocity[axis.axis]) <= axis.start_stop.value() * (1 + 1e-9) + 1e-6;
    });
  }

  MotionProver prover_;
  Point place_;
  bool rests_ = true;
};

// The number of disturbances in all runs together.
struct Acts {
  int holds = 0;
  int rests = 0;
  int overrides = 0;
  void print() const { std::printf("%d holds, %d rests, %d overrides\n", holds, rests, overrides); }
};

// Disturbs a run at random.
struct Meddling {
  Random& random;
  Acts& acts;
  double highest_override = 1;
  int chances = 10'000;  // after these the run is left alone, because a slow program would stop at every millimetre

  // Disturbs the run in one way, or not at all.
  void act(MotionDrive& drive) {
    if (chances > 0 && --chances == 0) drive.set_feed_override(1);
    switch (drive.state()) {
      case MotionDrive::State::running:
        if (chances > 0 && random.chance(0.03)) {
          drive.hold();
          ++acts.holds;
        }
        break;
      case MotionDrive::State::holding:
        // Rarely, because stopping takes many iterations.
        if (random.chance(0.008)) drive.resume();
        break;
      case MotionDrive::State::held:
        ++acts.rests;
        EXPECT_NEAR(drive.committed().value(), 0, 0.02);
        if (random.chance(0.5)) let_pass(drive, Seconds(random.between(0, 1)));
        drive.resume();
        break;
      case MotionDrive::State::ended: break;
    }
    if (chances > 0 && random.chance(0.03)) {
      drive.set_feed_override(random.chance(0.3) ? 1 : random.between(0.05, highest_override));
      ++acts.overrides;
    }
  }
};

struct RunOptions {
  Commitment live = live_commitment;
  Meddling* meddling = nullptr;
};

struct Ending {
  std::vector<MotorCounts> motors;
  MotionProof proof;
  Point place;  // the end position of the program
};

inline Ending run(const std::string& program, const MachineDescription& machine, const RunOptions& options = {}) {
  Diagnostics diagnostics;
  DrivenProgram job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics,
                    {.live = options.live});
  Watch watch(job, machine);
  while (job.advance()) {
    if (options.meddling != nullptr) options.meddling->act(job.drive());
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  EXPECT_FALSE(job.link().error());
  const MachineCounts counts = job.machine().counts();
  return {.motors = {counts.motors.begin(), counts.motors.begin() + counts.motor_count},
          .proof = watch.finish(),
          .place = watch.place()};
}

}  // namespace passo::test
