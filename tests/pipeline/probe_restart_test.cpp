// The host of a program with probe moves dies at any instant, and another one goes on by its journal: all that was
// found before is known, a probe move whose outcome nobody knows is made again, and the machine ends where it would
// have ended.
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/journaled_host.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include "pipeline/probe_kit.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using test::HostEnd;

// Down to the plate twice, and off it until it is free; what was found decides where the program goes: its end tells.
// Then a probe move that meets nothing, a slanted one, and a cut under a spindle.
const std::string probing_job =
    "G21 G90 G0 X1 Y2\nF500 G38.2 X1.5 Z-5\n#31=#5063\nF120 G38.4 X1 Z1\n#32=#5063\nF100 G38.3 Z-3\n"
    "G10 L2 P1 Z[#5063-0.5]\nG0 Z2\nG1 X[3+#31] Y[3+#32] Z[2+#5063] F3000\nF1200 G38.3 X-2\nM3 S1000\nG4 P.05\nG1 Z1 "
    "X4\n"
    "F400 G38.2 X5 Y3 Z-4\nG0 Z3\nX[#31*2] Y[#5063+4]\nM5\nM2\n";
constexpr double plate_height = -1.23;

class ProbingBench {
 public:
  explicit ProbingBench(const std::string& machine)
      : description_(test::example_machine(machine)),
        machine_(3, description_.board.clock, description_.board.highest_event_rate,
                 static_cast<std::size_t>(description_.board.held_items)),
        plant_(plant_of(description_, Point(), {test::below(Axis::z, plate_height)})),
        line_(machine_, description_.board.clock, {}),
        host_(description_, probing_job) {
    machine_.connect(plant_);
    machine_.add_observer(log_);
  }

  // Moments that the host lived through.
  std::uint64_t host(std::uint64_t ends_at, HostEnd end) {
    std::uint64_t moments = 0;
    done = host_.live(line_, ends_at, end, moments);
    return moments;
  }
  void let_pass(Seconds time) {
    for (const Seconds until = machine_.elapsed() + time; until - machine_.elapsed() > Seconds(1e-6);) {
      static_cast<void>(line_.run(until - machine_.elapsed()));
      static_cast<void>(line_.replies());
    }
  }
  const std::vector<ProbeOutcome>& found() const { return host_.found; }
  const std::array<std::int64_t, test::StepLog::motors>& end() const { return log_.place; }
  BoardOutputs outputs() const { return machine_.counts().outputs; }
  bool done = false;

 private:
  MachineDescription description_;
  VirtualMachine machine_;
  IdealPlant plant_;
  VirtualLine line_;
  test::JournaledHost host_;
  test::StepLog log_;
};

void expect_as_alone(const ProbingBench& bench, const ProbingBench& alone) {
  ASSERT_TRUE(bench.done);
  EXPECT_EQ(bench.end(), alone.end());
  EXPECT_EQ(bench.outputs().switches, alone.outputs().switches);
  ASSERT_EQ(bench.found().size(), alone.found().size());
  for (std::size_t i = 0; i < alone.found().size(); ++i) {
    EXPECT_EQ(bench.found()[i].touched, alone.found()[i].touched) << i;
    // Z meets the plate at the same step; where the other axes are then, depends on where the move before came to rest.
    const Point& contact = bench.found()[i].contact;
    const Point& alone_at = alone.found()[i].contact;
    if (alone.found()[i].touched) {
      EXPECT_EQ(contact[Axis::z], alone_at[Axis::z]) << i;
    }
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) EXPECT_NEAR(contact[axis], alone_at[axis], 0.3) << i;
  }
}

void die_amid_probing(const std::string& machine, int trials) {
  ProbingBench alone(machine);
  const std::uint64_t moments = alone.host(test::never, HostEnd::before_frame);
  ASSERT_TRUE(alone.done);
  ASSERT_EQ(alone.found().size(), 5U);
  const std::uint64_t seed = test::seed();
  int deaths = 0;
  for (int i = 0; i < trials && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(i));
    ProbingBench bench(machine);
    const std::uint64_t lives = 1 + random() % 4;
    for (std::uint64_t life = 0; life < lives && !bench.done && !testing::Test::HasFatalFailure(); ++life) {
      bench.host(random() % moments, static_cast<HostEnd>(random() % 4));
      if (!bench.done) ++deaths;
      bench.let_pass(Seconds(0.03 * static_cast<double>(random() % 5)));
    }
    if (!bench.done) bench.host(test::never, HostEnd::before_frame);
    expect_as_alone(bench, alone);
  }
  std::printf("%s: %d trials, %d hosts died or were stopped\n", machine.c_str(), trials, deaths);
}

TEST(ProbeRestart, goes_on_from_what_was_found_whenever_the_host_dies) {
  for (const char* machine : {"router", "uno"}) die_amid_probing(machine, 8);
}

class ProbeRestartInFull : public test::InFull<testing::Test> {};
TEST_F(ProbeRestartInFull, goes_on_from_what_was_found_whenever_the_host_dies) {
  for (const char* machine : {"router", "uno"}) die_amid_probing(machine, static_cast<int>(1000 / test::in_full()));
}

}  // namespace
}  // namespace passo
