// Random programs on random machines, from text to steps, each measured by the referee: no limit exceeded on any axis,
// no place off the path, the steps those of the motion, the end where the program says, and not slower than it must be.
//
// PASSO_SEED=S PASSO_RUNS=N random_motion_tests takes the programs S to S + N - 1. Each depends on its number alone.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "kit/random_gcode.hpp"

#include "passo/controller/job.hpp"
#include "passo/controller/stage_options.hpp"
#include "passo/proof/motion_proof.hpp"
#include "passo/proof/proof_text.hpp"

namespace passo {
namespace {

std::uint64_t number_of(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

struct Played {
  MotionProof proof;
  Point end;
  MachineCounts counts;
};

Played play(const std::string& program, const MachineDescription& machine) {
  Diagnostics diagnostics;
  Job job(ProgramReader::from_text("t", program), machine, InterpreterOptions(), diagnostics);
  MotionProver prover(proof_options(machine));
  Played played;
  job.path().watch([&](const PathItem& item) {
    prover.watch(item);
    if (const auto* segment = std::get_if<Segment>(&item)) played.end = segment->curve.end();
  });
  job.motion().watch([&](const MotionItem& item) { prover.watch(item); });
  job.board().watch([&](const BoardItem& item) { prover.watch(item); });
  while (job.advance()) {
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  EXPECT_FALSE(job.link().error());
  played.proof = prover.finish();
  played.counts = job.machine().counts();
  return played;
}

// How much longer than the bound they took, of those of more than a second.
struct Slowness {
  std::size_t is_jerk = 0;
  std::vector<double> of_all;
  double worst = 1;
  std::uint64_t worst_seed = 0;

  void add(const MotionProof& proof, std::uint64_t seed) {
    if (proof.time < Seconds(1)) return;
    of_all.push_back(proof.times_bound());
    if (of_all.back() > worst) {
      worst = of_all.back();
      worst_seed = seed;
    }
  }
  void print(const char* name) {
    if (of_all.empty()) return;
    std::ranges::sort(of_all);
    const auto at = [this](double share) {
      return of_all[static_cast<std::size_t>(share * static_cast<double>(of_all.size() - 1))];
    };
    std::printf("%s: %zu of more than a second, T/bound median %.4f, 99 %% %.4f, worst %.4f (%llu)\n", name,
                of_all.size(), at(0.5), at(0.99), worst, static_cast<unsigned long long>(worst_seed));
  }
};

void expect_end(const Played& played, const MachineDescription& machine) {
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const double place = played.end[machine.axes[m].axis] * machine.axes[m].steps_per_unit;
    EXPECT_NEAR(static_cast<double>(played.counts.motors[m].position), place, 0.5 + 1e-6) << "motor " << m;
  }
}

TEST(RandomMotion, keeps_limits_and_path_and_is_nearly_the_fastest) {
  const std::uint64_t first = number_of("PASSO_SEED", 1);
  const std::uint64_t runs = number_of("PASSO_RUNS", 300);
  Slowness with_jerk;
  with_jerk.is_jerk = 1;
  Slowness without_jerk;
  std::uint64_t moves = 0;
  double seconds = 0;
  for (std::uint64_t seed = first; seed < first + runs && !HasFailure(); ++seed) {
    test::Random random = test::Random::of(seed);
    const MachineDescription machine = test::random_machine(random);
    const std::string program = test::RandomGcode(random, machine).draw();
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + "\n" + describe(machine) + program);
    const Played played = play(program, machine);
    for (const std::string& fault : played.proof.faults()) ADD_FAILURE() << fault;
    expect_end(played, machine);
    if (runs == 1) std::printf("%s%s%s", describe(machine).c_str(), program.c_str(), to_text(played.proof).c_str());
    (has_jerk_limit(machine) ? with_jerk : without_jerk).add(played.proof, seed);
    moves += played.proof.moves;
    seconds += played.proof.time.value();
  }
  std::printf("%llu programs from %llu on, %llu moves, %.0f s of motion\n", static_cast<unsigned long long>(runs),
              static_cast<unsigned long long>(first), static_cast<unsigned long long>(moves), seconds);
  without_jerk.print("acceleration limited");
  with_jerk.print("jerk limited");
}

}  // namespace
}  // namespace passo
