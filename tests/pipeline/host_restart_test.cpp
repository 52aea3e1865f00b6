// The host dies at any instant, or is stopped, and another one goes on by its journal: each motor makes the same steps
// in the same order as without trouble, under the same outputs, at rest between and within limits.
//
// The board and its line outlive the hosts; what was on the way when a host died arrives, or not, or the last frame in
// part.
#include <cstdio>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/journaled_host.hpp"
#include "kit/line_trouble.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::expect_same_way;
using test::expect_within_limits;
using test::HostEnd;
using test::RandomTrouble;
using test::StepLog;

const MachineDescription& killed_machine(const std::string& name) {
  static std::map<std::string, MachineDescription> known;
  const auto found = known.find(name);
  return found != known.end() ? found->second : known.emplace(name, test::example_machine(name)).first->second;
}

const std::vector<std::string>& killed_programs() {
  static const std::vector<std::string> all = {
      "G21 G90 G1 F4000\nX6\nY4\nX1 Y6 Z-1\nX0 Y0 Z0\nM2\n",
      "G21 G90 G64 P.02 F3000 M3 S1000\nG4 P.1\nG2 X6 Y0 I3 J0\nG3 X9 I1.5\nG1 X4 Y3\nM8\nG4 P.05\nG0 X0 Y0 Z2\nM5 "
      "M9\nX1\nM2\n",
      "G21 G90 F900\nG0 X3 Y3\nG81 Z-2 R1\nX6 Y2\nG80\nG61.1 M4 S500 G1 X8 Y8 F5000\nX4\nG64 Y1\nM2\n",
      "G21 G90 F6000\nG1 X10\nX0\nX10 Y1\nX0 Y2\nM2\n",
  };
  return all;
}

// The outputs at each step of each motor, and in the end.
class OutputLog final : public MachineObserver {
 public:
  void on_steps(Ticks, std::uint8_t stepped, std::uint8_t) override {
    for (unsigned m = 0; m < StepLog::motors; ++m) {
      if ((stepped >> m & 1U) != 0) at_steps[m].push_back(now);
    }
  }
  void on_outputs(Ticks, const BoardOutputs& outputs) override {
    const bool on = (outputs.switches & OutputSwitch::spindle_on) != 0;
    now = on ? outputs.spindle_rpm * 256 + outputs.switches : outputs.switches;
  }
  int now = 0;
  std::array<std::vector<int>, StepLog::motors> at_steps;
};

struct Undisturbed {
  StepLog::Steps steps;
  OutputLog outputs;
  std::array<std::int64_t, StepLog::motors> end{};
};

const Undisturbed& undisturbed(const std::string& machine, std::size_t program) {
  static std::map<std::pair<std::string, std::size_t>, Undisturbed> known;
  const auto found = known.find({machine, program});
  if (found != known.end()) return found->second;
  Diagnostics diagnostics;
  test::DrivenProgram job(ProgramReader::from_text("t", killed_programs()[program]), killed_machine(machine),
                          InterpreterOptions(), diagnostics);
  StepLog log;
  Undisturbed way;
  job.machine().add_observer(log);
  job.machine().add_observer(way.outputs);
  while (job.advance()) {
  }
  way.steps = log.steps;
  way.end = log.place;
  return known.emplace(std::pair(machine, program), way).first->second;
}

// A board that stays, and hosts that come and go.
class Bench {
 public:
  Bench(const std::string& machine, std::size_t program)
      : description_(killed_machine(machine)),
        name_(machine),
        program_(program),
        machine_(static_cast<std::uint8_t>(description_.axes.size()), description_.board.clock,
                 description_.board.highest_event_rate, static_cast<std::size_t>(description_.board.held_items)),
        line_(machine_, description_.board.clock, {}),
        host_(description_, killed_programs()[program]) {
    machine_.add_observer(log_);
    machine_.add_observer(outputs_);
  }

  // Moments that it lived through; `done` tells whether it came to the end of the program.
  std::uint64_t host(std::uint64_t ends_at, HostEnd end, bool rest_is_lost = false) {
    std::uint64_t moments = 0;
    done = host_.live(line_, ends_at, end, moments);
    if (!done && rest_is_lost) line_.cut(machine_.elapsed(), Seconds(0.01));
    return moments;
  }
  // From now on the line loses, doubles, flips and swaps.
  void go_bad(std::uint64_t seed) {
    host_.may_fail = true;
    line_.set_trouble([trouble = RandomTrouble(seed)](bool to_board, const VirtualLine::Bytes& bytes) mutable {
      return trouble(to_board, bytes);
    });
  }
  void let_pass(Seconds time) {
    const Seconds until = machine_.elapsed() + time;
    while (until - machine_.elapsed() > Seconds(1e-6)) {
      static_cast<void>(line_.run(until - machine_.elapsed()));
      static_cast<void>(line_.replies());
    }
  }
  void expect_as_if_nothing_had_been() {
    const Undisturbed& reference = undisturbed(name_, program_);
    expect_same_way(log_.steps, reference.steps);
    expect_within_limits(description_, log_.steps, 6);
    EXPECT_EQ(log_.place, reference.end);
    EXPECT_EQ(outputs_.now, reference.outputs.now);
    for (unsigned m = 0; m < StepLog::motors; ++m) ASSERT_EQ(outputs_.at_steps[m], reference.outputs.at_steps[m]);
  }

  bool done = false;

 private:
  const MachineDescription& description_;
  std::string name_;
  std::size_t program_;
  VirtualMachine machine_;
  VirtualLine line_;
  test::JournaledHost host_;
  StepLog log_;
  OutputLog outputs_;
};

constexpr std::array ends = {HostEnd::before_frame, HostEnd::amid_frame, HostEnd::behind_frame, HostEnd::stopped};

struct Counted {
  int trials = 0;
  int deaths = 0;
  int stops = 0;
};

// Every host but the last ends at its moment. `kind`: how, whether what is on the way gets lost, and when the next one
// comes: at once, while the board still brakes, or later.
void trial(const std::string& machine, std::size_t program, const std::vector<std::uint64_t>& lives, unsigned kind,
           Counted& counted) {
  std::string trace = machine + ", program " + std::to_string(program) + ", hosts end at";
  for (const std::uint64_t life : lives) trace += " " + std::to_string(life);
  SCOPED_TRACE(trace + ", kind " + std::to_string(kind));
  Bench bench(machine, program);
  ++counted.trials;
  for (const std::uint64_t life : lives) {
    const HostEnd end = ends[kind % ends.size()];
    bench.host(life, end, kind / ends.size() % 3 == 2);
    if (testing::Test::HasFatalFailure()) return;
    if (bench.done) break;
    ++(end == HostEnd::stopped ? counted.stops : counted.deaths);
    const unsigned later = kind / 7 % 5;
    bench.let_pass(Seconds(later < 4 ? 0.03 * later : 2));
  }
  if (!bench.done) bench.host(test::never, HostEnd::before_frame);
  EXPECT_TRUE(bench.done);
  if (!testing::Test::HasFatalFailure()) bench.expect_as_if_nothing_had_been();
}

std::uint64_t moments_of(const std::string& machine, std::size_t program) {
  Bench bench(machine, program);
  const std::uint64_t moments = bench.host(test::never, HostEnd::before_frame);
  bench.expect_as_if_nothing_had_been();
  return moments;
}

void die_at_every(std::uint64_t stride, const std::string& machine, std::size_t program, Counted& counted,
                  unsigned kind = 0) {
  const std::uint64_t moments = moments_of(machine, program);
  for (std::uint64_t at = 0; at < moments; at += stride) {
    trial(machine, program, {at}, static_cast<unsigned>(at / stride) + kind, counted);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// The second host dies at every moment of its beginning: it asks, says hello, names the session, switches on, sends.
void die_again_at_every(std::uint64_t stride, std::uint64_t beginning, const std::string& machine, std::size_t program,
                        Counted& counted) {
  const std::uint64_t moments = moments_of(machine, program);
  unsigned kind = 0;
  for (std::uint64_t first = 1; first < moments; first += stride) {
    for (std::uint64_t second = 0; second < beginning; ++second, ++kind) {
      trial(machine, program, {first, second}, kind, counted);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

void die_at_random(int trials, const std::string& machine, Counted& counted) {
  const std::uint64_t seed = test::seed();
  for (int i = 0; i < trials && !testing::Test::HasFatalFailure(); ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(i));
    const std::size_t program = random() % killed_programs().size();
    const std::uint64_t moments = moments_of(machine, program);
    std::vector<std::uint64_t> lives(1 + random() % 6);
    for (std::uint64_t& life : lives) life = random() % moments;
    trial(machine, program, lives, static_cast<unsigned>(random() % 420), counted);
  }
}

// And the line is bad, too.
void die_on_a_bad_line(int trials, const std::string& machine, Counted& counted) {
  const std::uint64_t seed = test::seed();
  for (int i = 0; i < trials && !testing::Test::HasFatalFailure(); ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(i));
    const std::size_t program = random() % killed_programs().size();
    Bench bench(machine, program);
    bench.go_bad(random());
    ++counted.trials;
    for (int host = 0; host < 50 && !bench.done && !testing::Test::HasFatalFailure(); ++host) {
      const bool lives = random() % 5 == 0;
      const HostEnd end = ends[random() % ends.size()];
      bench.host(lives ? test::never : random() % 300, end);
      if (!bench.done) ++(end == HostEnd::stopped ? counted.stops : counted.deaths);
      bench.let_pass(Seconds(0.03 * static_cast<double>(random() % 5)));
    }
    ASSERT_TRUE(bench.done);
    bench.expect_as_if_nothing_had_been();
  }
}

void print(const Counted& counted) {
  std::printf("%d trials, %d hosts died, %d were stopped\n", counted.trials, counted.deaths, counted.stops);
}

class HostRestart : public testing::TestWithParam<std::string> {};
class HostRestartInFull : public test::InFull<testing::TestWithParam<std::string>> {};

TEST_P(HostRestart, at_moments_of_all_programs) {
  Counted counted;
  for (std::size_t program = 0; program < killed_programs().size(); ++program)
    die_at_every(127, GetParam(), program, counted);
  print(counted);
  EXPECT_GT(counted.deaths + counted.stops, counted.trials * 9 / 10);
}

TEST_P(HostRestart, at_every_moment_of_a_beginning) {
  Counted counted;
  die_again_at_every(2000, 31, GetParam(), 1, counted);
  print(counted);
  EXPECT_GT(counted.deaths + counted.stops, counted.trials * 3 / 2);
}

TEST_P(HostRestart, again_and_again) {
  Counted counted;
  die_at_random(15, GetParam(), counted);
  print(counted);
  EXPECT_GT(counted.deaths + counted.stops, counted.trials);
}

TEST_P(HostRestart, on_a_bad_line) {
  Counted counted;
  die_on_a_bad_line(10, GetParam(), counted);
  print(counted);
  EXPECT_GT(counted.deaths, counted.trials);
}

TEST_P(HostRestartInFull, at_every_moment_of_all_programs) {
  Counted counted;
  for (std::size_t program = 0; program < killed_programs().size(); ++program) {
    die_at_every(test::in_full(), GetParam(), program, counted);
    die_at_every(test::in_full(), GetParam(), program, counted, 2);
  }
  print(counted);
}

TEST_P(HostRestartInFull, at_every_moment_of_many_beginnings) {
  Counted counted;
  for (std::size_t program = 0; program < killed_programs().size(); ++program) {
    die_again_at_every(101 * test::in_full(), 60, GetParam(), program, counted);
  }
  print(counted);
}

TEST_P(HostRestartInFull, again_and_again) {
  Counted counted;
  die_at_random(static_cast<int>(1500 / test::in_full()), GetParam(), counted);
  print(counted);
}

TEST_P(HostRestartInFull, on_a_bad_line) {
  Counted counted;
  die_on_a_bad_line(static_cast<int>(1000 / test::in_full()), GetParam(), counted);
  print(counted);
}

INSTANTIATE_TEST_SUITE_P(Board, HostRestart, testing::Values("router", "uno"));
INSTANTIATE_TEST_SUITE_P(Board, HostRestartInFull, testing::Values("router", "uno"));

}  // namespace
}  // namespace passo
