// A machine that measures its tools: the host dies, is cut off, held or stopped at any instant of a program with tool
// changes, and another one goes on by the journal. The tool, its length and the place are right in the end, the machine
// never goes across below the safe height while the spindle is off.
#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/in_full.hpp"
#include "kit/journaled_host.hpp"
#include "kit/seed.hpp"
#include "kit/step_log.hpp"
#include <gtest/gtest.h>

#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {
namespace {

using test::HostEnd;

// The last moves depend on what was found.
const std::string changing_job =
    "G21 G90 G64 P0.05\nT1 M6\nG0 X10 Y5\nZ2\nM3 S1000\nG1 Z-1 F1500 X20\nY8\nM8\nT2 M6\nG0 X-5 Y5\nZ3\nM3 S1000\nG1 "
    "Z-1 F1200\n"
    "X-8\nT3 M6 G0 X3\nM3 S1000\nG1 Z1 F1800\nG2 X5 Y7 I1 J1\nM2\n";
// Machine Z at which each tool touches the setter; without a tool, nothing does.
constexpr std::array<double, 4> contacts = {-1000, -20, -12.5, -31.2};
constexpr double safe_height = 20;

MachineDescription changing_machine(ToolChangeWay way) {
  MachineDescription machine = test::example_machine("router");
  ToolChangePlan plan;
  plan.way = way;
  plan.safe_z = safe_height;
  plan.change_at = MachineXy{30, -20};
  plan.measure_at = MachineXy{-30, -25};
  plan.window_low = -40;
  plan.window_high = -5;
  plan.seek = MmPerSecond(25);
  plan.latch = MmPerSecond(2);
  plan.retract = 1;
  plan.run_down = Seconds(0.2);
  plan.wear = 0.05;
  if (way == ToolChangeWay::plate) {
    plan.wear.reset();
    plan.measure_at.reset();
    plan.use = LengthUse::work;
  }
  machine.tool_change = std::make_shared<const ToolChangePlan>(plan);
  return machine;
}

// The plants of all tools side by side. The probe is that of the tool in the spindle.
class ToolPlant final : public Plant {
 public:
  explicit ToolPlant(const MachineDescription& machine) {
    for (const double contact : contacts) {
      TouchBox box;
      box.ranges[Axis::z].high = contact;
      plants_.push_back(plant_of(machine, Point(), {box}));
    }
  }
  std::size_t tool = 0;

  void pulse(Seconds time, const MotorSteps& steps) override {
    for (IdealPlant& plant : plants_) plant.pulse(time, steps);
  }
  std::int64_t events_to_next_change() const override {
    std::int64_t least = never;
    for (const IdealPlant& plant : plants_) least = std::min(least, plant.events_to_next_change());
    return least;
  }
  void command_spindle(Seconds time, double revolutions_per_minute) override {
    for (IdealPlant& plant : plants_) plant.command_spindle(time, revolutions_per_minute);
  }
  void set_switch(std::uint16_t which, bool closed) override {
    for (IdealPlant& plant : plants_) plant.set_switch(which, closed);
  }
  std::uint16_t inputs_at(Seconds time) override { return plants_[tool].inputs_at(time); }
  const VirtualSpindle& spindle() const override { return plants_[tool].spindle(); }
  Truth truth_at(Seconds time) override { return plants_[tool].truth_at(time); }

 private:
  std::vector<IdealPlant> plants_;
};

// Looks at every step: while the spindle is off, X and Y move at the safe height only, but for rounded corners.
class Watchman final : public MachineObserver {
 public:
  explicit Watchman(const MachineDescription& machine) : machine_(machine) {}
  void on_steps(Ticks /*time*/, std::uint8_t stepped, std::uint8_t directions) override {
    constexpr double rounding = 0.06;
    for (std::size_t m = 0; m < steps_.size(); ++m) {
      if ((stepped >> m & 1U) != 0) steps_[m] += (directions >> m & 1U) != 0 ? -1 : 1;
    }
    const double height = static_cast<double>(steps_[2]) / machine_.axes[2].steps_per_unit;
    if (spindle_) lowest_cut = std::min(lowest_cut, height);
    if (spindle_ || height >= safe_height - rounding) {
      low_way_ = 0;
    } else if ((stepped & 3U) != 0) {
      longest_low_way = std::max(longest_low_way, low_way_ += 1 / machine_.axes[0].steps_per_unit);
    }
  }
  void on_outputs(Ticks /*time*/, const BoardOutputs& outputs) override {
    spindle_ = (outputs.switches & spindle_on) != 0;
  }
  double longest_low_way = 0;  // mm
  double lowest_cut = std::numeric_limits<double>::infinity();

 private:
  const MachineDescription& machine_;
  bool spindle_ = false;
  double low_way_ = 0;
  std::array<std::int64_t, 3> steps_{};
};

class ChangeBench {
 public:
  explicit ChangeBench(ToolChangeWay way)
      : description_(changing_machine(way)),
        machine_(3, description_.board.clock, description_.board.highest_event_rate,
                 static_cast<std::size_t>(description_.board.held_items)),
        plant_(description_),
        line_(machine_, description_.board.clock, {}),
        host_(description_, changing_job),
        watchman_(description_) {
    machine_.connect(plant_);
    machine_.add_observer(log_);
    machine_.add_observer(watchman_);
    host_.operator_works = [this](const Action& stop) {
      if (stop.kind != Action::Kind::tool_change) return;
      EXPECT_EQ(machine_.counts().outputs.switches & spindle_on, 0) << "the spindle turns while a hand is at it";
      plant_.tool = static_cast<std::size_t>(stop.tool);
      hand_tools.push_back(stop.tool);
    };
  }

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
  std::size_t tool() const { return plant_.tool; }
  const Watchman& watchman() const { return watchman_; }
  void hold_each(std::uint64_t turns) { host_.turns_between_holds = turns; }
  bool done = false;
  std::vector<std::int32_t> hand_tools;

 private:
  MachineDescription description_;
  VirtualMachine machine_;
  ToolPlant plant_;
  VirtualLine line_;
  test::JournaledHost host_;
  test::StepLog log_;
  Watchman watchman_;
};

void expect_as_alone(const ChangeBench& bench, const ChangeBench& alone) {
  ASSERT_TRUE(bench.done);
  EXPECT_EQ(bench.end(), alone.end());
  EXPECT_EQ(bench.tool(), alone.tool());
  EXPECT_LT(bench.watchman().longest_low_way, 0.3);
  EXPECT_EQ(bench.watchman().lowest_cut, alone.watchman().lowest_cut);
  EXPECT_EQ(bench.outputs().switches, alone.outputs().switches);
  ASSERT_EQ(bench.found().size(), alone.found().size());
  for (std::size_t i = 0; i < alone.found().size(); ++i) {
    EXPECT_TRUE(bench.found()[i].touched) << i;
    EXPECT_EQ(bench.found()[i].contact[Axis::z], alone.found()[i].contact[Axis::z]) << i;
  }
}

void die_amid_changes(ToolChangeWay way, int trials) {
  ChangeBench alone(way);
  const std::uint64_t moments = alone.host(test::never, HostEnd::before_frame);
  ASSERT_TRUE(alone.done);
  ASSERT_EQ(alone.tool(), 3U);
  const std::uint64_t seed = test::seed();
  int deaths = 0;
  for (int i = 0; i < trials && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(i));
    ChangeBench bench(way);
    bench.hold_each(random() % 2 == 0 ? 0 : 5 + random() % 200);
    const std::uint64_t lives = 1 + random() % 3;
    for (std::uint64_t life = 0; life < lives && !bench.done && !testing::Test::HasFatalFailure(); ++life) {
      bench.host(random() % moments, static_cast<HostEnd>(random() % 4));
      if (!bench.done) ++deaths;
      bench.let_pass(Seconds(0.05 * static_cast<double>(random() % 5)));
    }
    if (!bench.done) bench.host(test::never, HostEnd::before_frame);
    expect_as_alone(bench, alone);
  }
  std::printf("%d trials, %d hosts died or were stopped\n", trials, deaths);
}

TEST(ToolChangeRestart, ends_with_the_right_tool_length_and_place) {
  ChangeBench bench(ToolChangeWay::setter);
  bench.host(test::never, HostEnd::before_frame);
  ASSERT_TRUE(bench.done);
  EXPECT_EQ(bench.hand_tools, (std::vector<std::int32_t>{1, 2, 3}));
  ASSERT_EQ(bench.found().size(), 12U);  // five measurements: three new tools, two used ones, and the last one
  EXPECT_LT(bench.watchman().longest_low_way, 0.3);
  EXPECT_NEAR(bench.watchman().lowest_cut, 1 - 11.2, 1e-9);  // Z1 with tool 3, which is 11.2 mm shorter than tool 1
}

TEST(ToolChangeRestart, goes_on_whenever_the_host_dies) {
  for (const ToolChangeWay way : {ToolChangeWay::setter, ToolChangeWay::plate}) die_amid_changes(way, test::fewer(3));
}

class ToolChangeRestartInFull : public test::InFull<testing::Test> {};
TEST_F(ToolChangeRestartInFull, goes_on_whenever_the_host_dies) {
  const int trials = static_cast<int>(300 / test::in_full());
  for (const ToolChangeWay way : {ToolChangeWay::setter, ToolChangeWay::plate}) die_amid_changes(way, trials);
}

}  // namespace
}  // namespace passo
