// Threads over a line: the encoder's counts come in the answers of the board, and what follows them in refills.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kit/in_full.hpp"
#include "kit/line_trouble.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include "pipeline/spindle_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::Bytes;
using test::Cut;
using test::DrivenProgram;
using test::expect_within_limits;
using test::grooves_at;
using test::ideal;
using test::lathe;
using test::play;
using test::Played;
using test::RandomTrouble;
using test::rippling;
using test::Spread;
using test::spread;
using test::StepLog;
using test::Thread;
using test::thread_program;

// And by how much a groove may wander, and passes may lie beside each other, in mm; the second with limits of jerk.
struct LineCase {
  const char* name;
  LineOptions line;
  double wander[2];
  double apart[2];
  bool may_be_too_slow = false;  // with limits of jerk: then the thread is ended in words
};
const std::vector<LineCase>& thread_lines() {
  static const std::vector<LineCase> all = {
      {"115,200, 1 ms", {.baud = 115'200, .latency = Seconds(0.001)}, {0.12, 0.2}, {0.12, 0.4}, true},
      {"500,000, 1 ms", {.baud = 500'000, .latency = Seconds(0.001)}, {0.016, 0.035}, {0.016, 0.035}},
      {"1,000,000, 1 ms", {.baud = 1'000'000, .latency = Seconds(0.001)}, {0.012, 0.06}, {0.012, 0.06}},
      {"500,000, 8 ms", {.baud = 500'000, .latency = Seconds(0.008)}, {0.08, 0.08}, {0.08, 0.08}}};
  return all;
}

Played run(const std::string& program, const MachineDescription& machine, const LineOptions& line) {
  const Played played = play(program, machine, {.line = line});
  EXPECT_FALSE(played.error) << message_of(*played.error);
  return played;
}

TEST(SpindleOverALine, a_thread_has_its_pitch) {
  for (const LineCase& each : thread_lines()) {
    for (const bool jerk : {false, true}) {
      const Played even = run(thread_program("600"), lathe(ideal, jerk), each.line);
      const Played uneven = run(thread_program("600"), lathe(rippling, jerk), each.line);
      const double straight = spread(even.cuts, 1.5, -4, -19).mm(1.5);
      const double wander = spread(uneven.cuts, 1.5, -4, -19).mm(1.5);
      std::printf("%-16s %s: along 10 turns the groove wanders %.4f mm, without ripple %.4f mm\n", each.name,
                  jerk ? "jerk limited" : "", wander, straight);
      EXPECT_LT(straight, 0.02);
      EXPECT_LT(wander, each.wander[jerk ? 1 : 0]);
    }
  }
}

TEST(SpindleOverALine, all_passes_of_a_threading_cycle_lie_in_one_groove) {
  const std::string program = "G21 G18 S600 M3\nG0 X5 Z0\nG76 P1.5 Z-15 I-1 J0.2 K0.9 R1.5 H2\nM5\nM2\n";
  for (const LineCase& each : thread_lines()) {
    const bool is_extreme = each.may_be_too_slow || each.line.latency > Seconds(0.005);
    if (test::one_in(2) > 1 && !is_extreme) continue;
    for (const bool jerk : {false, true}) {
      const Played result = play(program, lathe(rippling, jerk), {.line = each.line});
      if (each.may_be_too_slow && jerk && result.error == LinkError::thread_lost) {
        std::printf("%-16s jerk limited: too slow\n", each.name);
        continue;
      }
      EXPECT_FALSE(result.error) << message_of(*result.error);
      double worst = 0;
      std::size_t passes = 0;
      for (const double z : {-5.0, -8.0, -11.0, -14.0}) {
        Spread all;
        const std::vector<double> grooves = grooves_at(result.cuts, 1.5, z);
        for (const double pass : grooves) all.see(pass);
        passes = grooves.size();
        EXPECT_GE(passes, 8U);
        // With limits of jerk a slow line has not made up for its start within three turns.
        const bool in_lead_in = jerk && each.line.latency > Seconds(0.005) && z > -6;
        if (in_lead_in) {
          std::printf("%-16s jerk limited: %.4f mm at 3 turns\n", each.name, all.mm(1.5));
        } else {
          worst = std::max(worst, all.mm(1.5));
        }
      }
      std::printf("%-16s %s: %zu passes of a G76 lie within %.4f mm of each other\n", each.name,
                  jerk ? "jerk limited" : "", passes, worst);
      // Whatever comes of a line that is told to be too slow, or nearly is (decision 0049).
      if (each.may_be_too_slow && jerk) continue;
      EXPECT_LT(worst, each.apart[jerk ? 1 : 0]);
    }
  }
}

// Three passes, each a little deeper.
const std::string passes =
    "G21 G61.1 S600 M3\nG0 X1 Z1\nG33 Z-9 K1.5\nG0 X2\nZ1\nX.8\nG33 Z-9 K1.5\nG0 X2\nZ1\nX.6\nG33 Z-9 K1.5\nG0 X2\nZ1\n"
    "M5\nM2\n";

struct Troubled {
  StepLog::Steps steps;
  std::vector<Cut> cuts;
  std::optional<LinkError> error;
  BoardOutputs outputs;
  std::uint64_t frames = 0;
};
// Sees each frame with its number, and gives back what passes.
using ThreadTrouble = std::function<Bytes(DrivenProgram& job, std::uint64_t number, bool to_board, const Bytes& bytes)>;

Troubled run_with(const ThreadTrouble& trouble, const SpindleModel* fitted = nullptr, double fitted_at = 0) {
  Troubled result;
  Diagnostics diagnostics;
  const MachineDescription machine = lathe(rippling);
  IdealPlant plant = plant_of(machine);
  DrivenProgram job(ProgramReader::from_text("t", passes), machine, InterpreterOptions(), diagnostics,
                    {.line = LineOptions{}, .plant = &plant});
  StepLog log;
  Thread thread(machine, plant);
  job.machine().add_observer(log);
  job.machine().add_observer(thread);
  job.line().set_trouble([&](bool to_board, Bytes bytes) {
    const std::uint64_t number = result.frames++;
    return trouble ? trouble(job, number, to_board, bytes) : bytes;
  });
  do {
    const bool now =
        fitted != nullptr && (fitted_at == 0 || (!thread.cuts.empty() && thread.cuts.back().z < fitted_at));
    if (now) plant.fit_spindle(*std::exchange(fitted, nullptr));
  } while (job.advance());
  EXPECT_FALSE(diagnostics.any_error());
  result.steps = log.steps;
  result.cuts = thread.cuts;
  result.error = job.link().error();
  result.outputs = job.machine().counts().outputs;
  expect_within_limits(machine, log.steps);
  return result;
}

// The same steps in the same order, as far as they go.
void expect_begins_as(const StepLog::Steps& run, const StepLog::Steps& reference, bool ends_as) {
  for (unsigned m = 0; m < StepLog::motors; ++m) {
    ASSERT_LE(run[m].size(), reference[m].size()) << "motor " << m;
    if (ends_as) {
      ASSERT_EQ(run[m].size(), reference[m].size()) << "motor " << m;
    }
    for (std::size_t i = 0; i < run[m].size(); ++i) {
      ASSERT_EQ(run[m][i].down, reference[m][i].down) << "motor " << m << " step " << i;
    }
  }
}

// All is done, and in one groove; or nothing went on behind a rest in a thread.
void expect_whole_or_lost(const Troubled& result, const Troubled& reference, int& lost) {
  expect_begins_as(result.steps, reference.steps, !result.error);
  Spread all;
  for (const double groove : grooves_at(result.cuts, 1.5, -6)) all.see(groove);
  EXPECT_LT(all.mm(1.5), 0.15) << "a tenth of a turn";
  if (!result.error) return;
  EXPECT_EQ(*result.error, LinkError::thread_lost) << message_of(*result.error);
  EXPECT_EQ(result.outputs.switches, 0) << "the spindle is off";
  ++lost;
}

// Another spindle than the machine file's, from the start or when the tool is so deep.
void expect_given_up(const SpindleModel& fitted, double at, LinkError expected) {
  const Troubled result = run_with(nullptr, &fitted, at);
  ASSERT_TRUE(result.error);
  EXPECT_EQ(*result.error, expected) << message_of(*result.error);
  EXPECT_EQ(result.outputs.switches, 0) << "the spindle is off";
  EXPECT_EQ(result.cuts.empty(), at == 0);
  if (at != 0) {
    EXPECT_GT(result.cuts.back().z, -9) << "braked in the thread";
  }
}

TEST(SpindleOverALine, a_spindle_that_stands_or_an_encoder_that_counts_otherwise_is_told_in_words) {
  expect_given_up({.counts_per_turn = 4096, .run_up = 1e9}, 0, LinkError::spindle_stands);
  expect_given_up({.counts_per_turn = 3900}, 0, LinkError::encoder_wrong);
  expect_given_up({.counts_per_turn = 2048}, 0, LinkError::encoder_wrong);
  const SpindleModel none;
  EXPECT_EQ(run_with(nullptr, &none).error, LinkError::no_encoder);
  // The cable to the encoder breaks in the thread: from there on it counts nothing.
  expect_given_up({.counts_per_turn = 4096, .run_up = 1e9}, -3, LinkError::spindle_stands);
}

TEST(SpindleOverABadLine, a_pass_is_cut_whole_in_its_groove_or_ends_where_the_line_broke) {
  const char* const in_full = std::getenv("PASSO_IN_FULL");
  const Troubled reference = run_with(nullptr);
  ASSERT_FALSE(reference.error);
  int lost = 0;
  int trials = 0;
  for (const double seconds : {0.02, 0.5}) {
    for (std::uint64_t at = 7; at < reference.frames; at += in_full != nullptr ? 3 : 61) {
      SCOPED_TRACE("cut before frame " + std::to_string(at) + " for " + std::to_string(seconds) + " s");
      expect_whole_or_lost(run_with([&](DrivenProgram& job, std::uint64_t number, bool, const Bytes& bytes) {
                             if (number == at) job.line().cut(job.machine().elapsed(), Seconds(seconds));
                             return bytes;
                           }),
                           reference, lost);
      ++trials;
      if (testing::Test::HasFailure()) return;
    }
  }
  std::printf("%d cuts, %d of them in a thread that ended there\n", trials, lost);
  EXPECT_GT(lost, trials / 4);
  EXPECT_LT(lost, trials);
}

TEST(SpindleOverABadLine, random_faults_make_no_wrong_step_and_no_second_groove) {
  const std::uint64_t seed = test::seed();
  const int trials = std::getenv("PASSO_IN_FULL") != nullptr ? 2000 : 30;
  const Troubled reference = run_with(nullptr);
  int lost = 0;
  int faults = 0;
  for (int i = 0; i < trials; ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    RandomTrouble trouble(seed + static_cast<std::uint64_t>(i));
    expect_whole_or_lost(run_with([&](DrivenProgram&, std::uint64_t, bool to_board, const Bytes& bytes) {
                           return trouble(to_board, bytes);
                         }),
                         reference, lost);
    faults += trouble.faults;
    if (testing::Test::HasFailure()) return;
  }
  std::printf("%d runs with %d faults, %d threads ended by them\n", trials, faults, lost);
  EXPECT_GT(faults, trials);
}

}  // namespace
}  // namespace passo
