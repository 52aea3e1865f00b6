// How far the verdicts of `passo check` are right: random machines and programs, and for each the verdict beside what
// full physics does with motors that are drawn from their tolerances. Prints the table of docs/manual/checking.md.
//
//   build/release/bench/margin_table [cases] [seed] [threads]
//
// The same numbers come out on every machine, with any number of threads.
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "kit/drawn_machine.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using test::judged_run;
using test::JudgedRun;

struct Count {
  int kept = 0;
  int lost = 0;

  void add(bool loses) { ++(loses ? lost : kept); }
};

void print(const char* verdict, const Count& count, int cases) {
  fmt::print("{:28} {:>10} {:>10} {:>9.1f} %\n", verdict, count.kept, count.lost,
             100.0 * (count.kept + count.lost) / cases);
}

std::vector<JudgedRun> outcomes_of(int cases, std::uint64_t seed, unsigned threads) {
  std::vector<JudgedRun> outcomes(static_cast<std::size_t>(cases));
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < outcomes.size(); i = next++) outcomes[i] = judged_run(seed + i);
  };
  std::vector<std::jthread> others_at_work;
  for (unsigned i = 1; i < threads; ++i) others_at_work.emplace_back(work);
  work();
  others_at_work.clear();
  return outcomes;
}

void table(int cases, std::uint64_t seed, unsigned threads) {
  std::array<Count, 3> verdicts;
  std::array<Count, 3> doubts;  // by what is wanted
  const std::vector<JudgedRun> outcomes = outcomes_of(cases, seed, threads);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const JudgedRun& outcome = outcomes[i];
    verdicts[static_cast<std::size_t>(outcome.verdict)].add(outcome.lost);
    if (outcome.verdict == Verdict::doubtful) doubts[static_cast<std::size_t>(outcome.want)].add(outcome.lost);
    if (outcome.verdict == (outcome.lost ? Verdict::safe : Verdict::lost)) {
      fmt::print(stderr, "seed {} is called {} wrongly\n", seed + i, name_of(outcome.verdict));
    }
  }
  fmt::print("{:28} {:>10} {:>10} {:>11}\n", "verdict", "kept steps", "lost steps", "of all");
  print("safe", verdicts[0], cases);
  print("doubtful", verdicts[1], cases);
  print("  for the torque", doubts[0], cases);
  print("  for the swing after a jump", doubts[1], cases);
  print("  for swinging by itself", doubts[2], cases);
  print("lost", verdicts[2], cases);
}

}  // namespace
}  // namespace passo

int main(int count, char** arguments) {
  const int cases = count > 1 ? std::atoi(arguments[1]) : 1000;
  const auto seed = static_cast<std::uint64_t>(count > 2 ? std::atoll(arguments[2]) : 1);
  const auto threads = static_cast<unsigned>(count > 3 ? std::atoi(arguments[3]) : 2);
  passo::table(cases, seed, threads);
  return 0;
}
