// A machine that measures its tools: the host dies, is cut off, held or stopped at any instant of a program with tool
// changes, and another one goes on by the journal. The tool, its length and the place are right in the end, the machine
// never goes across below the safe height while the spindle is off, and no tool falls from the collet or is pulled from
// a collet that has not opened yet.
#include <algorithm>
#include <array>
#include <cmath>
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
// The block of an M6 that calls a macro has no other words.
std::string job_for(ToolChangeWay way) {
  const std::string more = "M6 G0 X3";
  std::string job = changing_job;
  return way == ToolChangeWay::macro ? job.replace(job.find(more), more.size(), "M6\nG0 X3") : job;
}

// Machine Z at which each tool touches the setter; without a tool, nothing does.
constexpr std::array<double, 4> contacts = {-1000, -20, -12.5, -31.2};
constexpr double safe_height = 20;

// Tool n is in pocket n. The holder goes in from the front. The mist output opens the collet.
constexpr MachineXy first_pocket{-25, 30};
constexpr MachineXy pocket_step{15, 0};
constexpr double pocket_entry = -12;  // in Y
constexpr double pocket_height = -10;
constexpr Seconds valve_time{0.2};

MachineXy pocket_of(std::size_t tool) {
  const auto others = static_cast<double>(tool) - 1;
  return {first_pocket.x + others * pocket_step.x, first_pocket.y + others * pocket_step.y};
}

// The same as the rack, as lines of G-code.
const std::string changer_lines =
    "G21 G90 G94 F3000\n"
    "o<put> if [#5400 GT 0]\n"
    "G53 G0 X[-40+15*#5400] Y18\nG53 G1 Z-10\nG53 G1 Y30\nM7\nG4 P0.2\nG53 G0 Z20\nM9\nG4 P0.2\n"
    "o<put> endif\n"
    "G53 G0 X[-40+15*#<_selected_tool>] Y30\nM7\nG4 P0.2\nG53 G1 Z-10\nM9\nG4 P0.2\nG53 G1 Y18\n"
    "M3 S100\n";  // which the change has to stop

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
  if (way == ToolChangeWay::rack) {
    plan.rack = {.pockets = 3,
                 .first = first_pocket,
                 .step = pocket_step,
                 .z = pocket_height,
                 .entry = {0, pocket_entry},
                 .feed = MmPerSecond(50),
                 .opens = ColletOutput::mist,
                 .wait = valve_time};
  }
  if (way == ToolChangeWay::macro) {
    plan.macro = changer_lines;
    plan.macro_collet_wait = valve_time;
    plan.touches = 2;
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

// The motors' position, by their steps.
class Place {
 public:
  explicit Place(const MachineDescription& machine) : machine_(machine) {}
  void step(std::uint8_t stepped, std::uint8_t directions) {
    for (std::size_t m = 0; m < steps_.size(); ++m) {
      if ((stepped >> m & 1U) != 0) steps_[m] += (directions >> m & 1U) != 0 ? -1 : 1;
    }
  }
  double operator[](std::size_t axis) const {
    return static_cast<double>(steps_[axis]) / machine_.axes[axis].steps_per_unit;
  }

 private:
  const MachineDescription& machine_;
  std::array<std::int64_t, 3> steps_{};
};

// A collet with a valve, and the rack. It opens and closes some time after its output. What is in the spindle follows
// from where it does so.
class Collet final : public MachineObserver {
 public:
  Collet(const MachineDescription& machine, ToolPlant& plant, bool has_valve)
      : clock_(machine.board.clock.value()), place_(machine), plant_(plant), has_valve_(has_valve) {
    if (has_valve_) in_rack_ = {false, true, true, true};
  }
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
    pass(time);
    const bool is_loose = held_above_ > 0 && !is_open_;
    if (is_loose) trouble = "a tool was moved that is not seated in the collet";
    place_.step(stepped, directions);
  }
  void on_outputs(Ticks time, const BoardOutputs& outputs) override {
    pass(time);
    const bool wants_open = (outputs.switches & mist_on) != 0;
    if (!has_valve_ || wants_open == wants_open_) return;
    wants_open_ = wants_open;
    switches_at_ = time.count + std::llround(valve_time.value() * clock_ * 0.999);
  }
  std::string trouble;

 private:
  void pass(Ticks time) {
    if (is_open_ == wants_open_ || time.count < switches_at_) return;
    is_open_ = wants_open_;
    is_open_ ? open() : close();
  }
  void open() {
    if (plant_.tool == 0) return;
    if (!is_over(plant_.tool) || place_[2] > pocket_height + reach || in_rack_[plant_.tool]) {
      trouble = "a tool fell from the collet";
    }
    in_rack_[plant_.tool] = true;
    plant_.tool = 0;
    held_above_ = 0;
  }
  void close() {
    for (std::size_t tool = 1; tool < in_rack_.size(); ++tool) {
      if (!in_rack_[tool] || !is_over(tool) || place_[2] > pocket_height + reach) continue;
      in_rack_[tool] = false;
      plant_.tool = tool;
      held_above_ = place_[2] > pocket_height + exact ? place_[2] - pocket_height : 0;
    }
  }
  bool is_over(std::size_t tool) const {
    const MachineXy at = pocket_of(tool);
    return std::abs(place_[0] - at.x) < exact && std::abs(place_[1] - at.y) < exact;
  }

  static constexpr double exact = 0.06;  // mm
  static constexpr double reach = 8;     // of the holder into the collet
  double clock_;
  Place place_;
  ToolPlant& plant_;
  bool has_valve_;
  bool wants_open_ = false;
  bool is_open_ = false;
  std::int64_t switches_at_ = 0;
  double held_above_ = 0;  // the tool was seized so high above its seat
  std::array<bool, contacts.size()> in_rack_{};
};

// Looks at every step: while the spindle is off, X and Y move at the safe height only, but for rounded corners and the
// way into a pocket.
class Watchman final : public MachineObserver {
 public:
  explicit Watchman(const MachineDescription& machine) : machine_(machine), place_(machine) {}
  void on_steps(Ticks /*time*/, std::uint8_t stepped, std::uint8_t directions) override {
    constexpr double rounding = 0.06;
    place_.step(stepped, directions);
    const double height = place_[2];
    if (spindle_) lowest_cut = std::min(lowest_cut, height);
    const bool in_pocket =
        std::abs(height - pocket_height) < rounding && place_[1] > first_pocket.y + pocket_entry - 0.1;
    if (spindle_ || in_pocket || height >= safe_height - rounding) {
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
  Place place_;
  bool spindle_ = false;
  double low_way_ = 0;
};

class ChangeBench {
 public:
  explicit ChangeBench(ToolChangeWay way)
      : description_(changing_machine(way)),
        machine_(3, description_.board.clock, description_.board.highest_event_rate,
                 static_cast<std::size_t>(description_.board.held_items)),
        plant_(description_),
        line_(machine_, description_.board.clock, {}),
        host_(description_, job_for(way)),
        watchman_(description_),
        collet_(description_, plant_, way == ToolChangeWay::rack || way == ToolChangeWay::macro) {
    machine_.connect(plant_);
    machine_.add_observer(log_);
    machine_.add_observer(watchman_);
    machine_.add_observer(collet_);
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
  const Collet& collet() const { return collet_; }
  void hold_each(std::uint64_t turns, bool by_door) {
    host_.turns_between_holds = turns;
    host_.holds_by_door = by_door;
    host_.door_stays_open = valve_time * 2;  // the collet closes meanwhile
  }
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
  Collet collet_;
};

void expect_as_alone(const ChangeBench& bench, const ChangeBench& alone) {
  ASSERT_TRUE(bench.done);
  EXPECT_EQ(bench.collet().trouble, "");
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

constexpr std::array all_ways = {ToolChangeWay::setter, ToolChangeWay::plate, ToolChangeWay::rack,
                                 ToolChangeWay::macro};

const char* name_of_way(ToolChangeWay way) {
  switch (way) {
    case ToolChangeWay::setter: return "setter";
    case ToolChangeWay::plate: return "plate";
    case ToolChangeWay::rack: return "rack";
    case ToolChangeWay::macro: return "macro";
  }
  return "";
}

void die_amid_changes(ToolChangeWay way, int trials) {
  ChangeBench alone(way);
  const std::uint64_t moments = alone.host(test::never, HostEnd::before_frame);
  ASSERT_TRUE(alone.done);
  ASSERT_EQ(alone.tool(), 3U);
  ASSERT_EQ(alone.collet().trouble, "");
  const std::uint64_t seed = test::seed();
  int deaths = 0;
  for (int i = 0; i < trials && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed) + ", trial " + std::to_string(i));
    std::mt19937_64 random(seed + static_cast<std::uint64_t>(i));
    ChangeBench bench(way);
    const std::uint64_t holds = random() % 3;  // none, by a person, by the door
    bench.hold_each(holds == 0 ? 0 : 5 + random() % 200, holds == 2);
    const std::uint64_t lives = 1 + random() % 3;
    for (std::uint64_t life = 0; life < lives && !bench.done && !testing::Test::HasFatalFailure(); ++life) {
      bench.host(random() % moments, static_cast<HostEnd>(random() % 4));
      if (!bench.done) ++deaths;
      bench.let_pass(Seconds(0.05 * static_cast<double>(random() % 5)));
    }
    if (!bench.done) bench.host(test::never, HostEnd::before_frame);
    expect_as_alone(bench, alone);
  }
  std::printf("%s: %d trials, %d hosts died or were stopped, at some of %llu moments\n", name_of_way(way), trials,
              deaths, static_cast<unsigned long long>(moments));
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
  for (const ToolChangeWay way : all_ways) die_amid_changes(way, 1);
}

class ToolChangeRestartInFull : public test::InFull<testing::TestWithParam<ToolChangeWay>> {};
TEST_P(ToolChangeRestartInFull, goes_on_whenever_the_host_dies) {
  die_amid_changes(GetParam(), static_cast<int>(300 / test::in_full()));
}
INSTANTIATE_TEST_SUITE_P(By, ToolChangeRestartInFull, testing::ValuesIn(all_ways),
                         [](const auto& info) { return std::string(name_of_way(info.param)); });

}  // namespace
}  // namespace passo
