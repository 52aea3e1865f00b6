#include "passo/machine/virtual_machine.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "kit/seed.hpp"

#include "passo/link/await.hpp"

namespace passo {
namespace {

constexpr Hertz clock{16e6};
constexpr Seconds forever{std::numeric_limits<double>::infinity()};

// Motor 0 steps at every event, up or down.
BoardSegment every_event(std::uint8_t events, std::uint32_t ticks, bool down = false) {
  return {.events = events, .directions = down, .flips = 1, .interval = ticks << 16};
}

void watch(BoardSession& link, ProbeUntil until, std::uint8_t limit = 0) {
  link.watch_probe(until, limit);
  await(link, [&] { return link.settled(); });
}
void recall(BoardSession& link) {
  link.recall_contact();
  await(link, [&] { return link.settled(); });
}

struct Step {
  std::int64_t time;
  unsigned motor;
  int direction;
  friend bool operator==(const Step&, const Step&) = default;
};
class Recorder final : public MachineObserver {
 public:
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
    EXPECT_NE(stepped, 0);
    for (unsigned m = 0; m < max_motors; ++m) {
      if ((stepped >> m & 1) != 0) steps.push_back({time.count, m, (directions >> m & 1) != 0 ? -1 : 1});
    }
  }
  void on_outputs(Ticks time, const BoardOutputs& outputs) override {
    switched.emplace_back(time.count, outputs.switches);
  }
  std::vector<Step> steps;
  std::vector<std::pair<std::int64_t, int>> switched;
};

TEST(VirtualMachine, stands_still_until_it_is_told_to_move) {
  VirtualMachine machine(3, clock);
  EXPECT_FALSE(machine.run(forever));
  const MachineCounts counts = machine.counts();
  EXPECT_EQ(counts.motor_count, 3);
  EXPECT_EQ(counts.time.count, 0);
  EXPECT_EQ(counts.events, 0);
  EXPECT_EQ(counts.shortest_event_interval.count, 0);
  for (const MotorCounts& motor : counts.motors) EXPECT_EQ(motor, MotorCounts());
}

TEST(VirtualMachine, counts_net_and_total_steps_reversals_and_intervals) {
  VirtualMachine machine(1, clock);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  send(link, every_event(200, 160));
  send(link, every_event(50, 100, true));
  send(link, every_event(10, 500));
  drain(link);
  ASSERT_FALSE(link.error());
  const MachineCounts counts = machine.counts();
  EXPECT_EQ(counts.motors[0].position, 160);
  EXPECT_EQ(counts.motors[0].total, 260);
  EXPECT_EQ(counts.motors[0].reversals, 2);
  EXPECT_EQ(counts.motors[0].shortest_interval.count, 100);
  EXPECT_EQ(counts.motors[0].last_step.count, 200 * 160 + 50 * 100 + 10 * 500);
  EXPECT_EQ(counts.time, counts.motors[0].last_step);
  EXPECT_EQ(machine.now(), counts.time);
  EXPECT_EQ(counts.events, 260);
  EXPECT_EQ(counts.shortest_event_interval.count, 100);
}

TEST(VirtualMachine, a_first_step_downwards_is_no_reversal) {
  VirtualMachine machine(1, clock);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  send(link, every_event(1, 100, true));
  drain(link);
  EXPECT_EQ(machine.counts().motors[0].reversals, 0);
  EXPECT_EQ(machine.counts().motors[0].shortest_interval.count, 0);
  send(link, every_event(1, 100));
  drain(link);
  EXPECT_EQ(machine.counts().motors[0].reversals, 1);
}

TEST(VirtualMachine, events_without_steps_take_time_and_are_not_shown) {
  VirtualMachine machine(1, clock);
  Recorder recorder;
  machine.add_observer(recorder);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  send(link, BoardSegment{.events = 100, .interval = 32768U << 16});
  send(link, every_event(1, 10));
  drain(link);
  EXPECT_THAT(recorder.steps, testing::ElementsAre(Step{3276810, 0, 1}));
  EXPECT_EQ(machine.counts().events, 101);
}

TEST(VirtualMachine, tells_at_which_step_it_got_into_a_body) {
  VirtualMachine machine(1, clock);
  TouchBody far;
  far.motors[0] = {.low = 500, .high = 600};
  TouchBody body;
  body.motors[0] = {.low = 120, .high = 130};
  IdealPlant plant;
  plant.add(far);
  plant.add(body);
  machine.connect(plant);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  send(link, every_event(20, 100));
  drain(link);
  watch(link, ProbeUntil::touched);
  EXPECT_FALSE(link.probe_report().touched);
  send(link, every_event(200, 100));
  await(link, [&] { return link.probe_report().happened; });
  EXPECT_TRUE(link.probe_report().happened);
  EXPECT_EQ(machine.counts().motors[0].position, 120) << "told at once";
  EXPECT_TRUE(link.busy());
  drain(link);
  EXPECT_EQ(machine.counts().motors[0].position, 220);
  EXPECT_FALSE(link.probe_report().touched);
  recall(link);
  EXPECT_TRUE(link.probe_report().happened);
  EXPECT_EQ(link.probe_report().steps[0], 100) << "kept";
  EXPECT_FALSE(link.error());
  send(link, every_event(95, 100, true));
  drain(link);
  watch(link, ProbeUntil::released);
  EXPECT_TRUE(link.probe_report().touched);
  send(link, every_event(5, 100, true));
  drain(link);
  EXPECT_FALSE(link.probe_report().happened) << "it waits for the change to free, which was not yet";
  send(link, every_event(5, 100, true));
  drain(link);
  EXPECT_TRUE(link.probe_report().happened);
  recall(link);
  EXPECT_EQ(link.probe_report().steps[0], -6);
}

TEST(VirtualMachine, a_limit_switch_stops_it_and_captures_where_it_is_watched) {
  VirtualMachine machine(1, clock);
  IdealPlant plant;
  plant.add(TravelSwitch{.input = input_limit, .motor = 0, .at_high_end = true, .closes_at = 120, .opens_at = 110});
  machine.connect(plant);
  const auto session = [&] {
    auto greeted = std::make_unique<BoardSession>(machine);
    greet(*greeted, {.motors = 1});
    return greeted;
  };
  auto link = session();
  watch(*link, ProbeUntil::touched, input_limit);
  EXPECT_FALSE(link->error());
  EXPECT_FALSE(link->probe_report().touched);
  send(*link, every_event(200, 100));
  drain(*link);
  EXPECT_EQ(machine.counts().motors[0].position, 200) << "watched, it stops nothing";
  recall(*link);
  EXPECT_TRUE(link->probe_report().happened);
  EXPECT_EQ(link->probe_report().steps[0], 120);
  watch(*link, ProbeUntil::released, input_limit);
  EXPECT_TRUE(link->probe_report().touched);
  send(*link, every_event(150, 100, true));
  drain(*link);
  recall(*link);
  EXPECT_EQ(link->probe_report().steps[0], -90);
  watch(*link, ProbeUntil::off);
  send(*link, every_event(200, 100));
  drain(*link);
  EXPECT_EQ(link->error(), LinkError::stopped);
  EXPECT_EQ(machine.counts().motors[0].position, 120);
  // Closed already, it does not stop; that it closes does.
  link = session();
  send(*link, every_event(5, 100, true));
  drain(*link);
  EXPECT_FALSE(link->error());
  EXPECT_EQ(machine.counts().motors[0].position, 115);
}

// A plant whose motor does not make every fifth step.
class SlippingPlant final : public Plant {
 public:
  void pulse(Seconds time, const MotorSteps& steps) override {
    EXPECT_LE(std::abs(steps[0]), 1) << "it asked to see each pulse";
    EXPECT_GE(time, last_);
    last_ = time;
    if (++pulses_ % 5 != 0) ideal_.pulse(time, steps);
  }
  std::int64_t events_to_next_change() const override { return 1; }
  void command_spindle(Seconds, double) override {}
  void set_switch(std::uint16_t which, bool closed) override { ideal_.set_switch(which, closed); }
  std::uint16_t inputs_at(Seconds time) override { return ideal_.inputs_at(time); }
  const VirtualSpindle& spindle() const override { return ideal_.spindle(); }
  Truth truth_at(Seconds time) override { return ideal_.truth_at(time); }
  void add(const TravelSwitch& added) { ideal_.add(added); }

 private:
  IdealPlant ideal_;
  std::int64_t pulses_ = 0;
  Seconds last_{0};
};

TEST(VirtualMachine, counts_what_it_commands_and_its_plant_knows_what_is_true) {
  VirtualMachine machine(1, clock);
  SlippingPlant plant;
  plant.add(TravelSwitch{.input = input_limit, .motor = 0, .at_high_end = true, .closes_at = 100, .opens_at = 100});
  machine.connect(plant);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  send(link, every_event(50, 100));
  drain(link);
  EXPECT_EQ(machine.counts().motors[0].position, 50);
  EXPECT_EQ(plant.truth_at(machine.elapsed()).positions[0], 40);
  send(link, every_event(200, 100));
  drain(link);
  EXPECT_EQ(link.error(), LinkError::stopped) << "by the switch, which closes where the motor truly is";
  EXPECT_EQ(machine.counts().motors[0].position, 124);
  EXPECT_EQ(plant.truth_at(machine.elapsed()).positions[0], 100);
}

TEST(VirtualMachine, its_plant_is_up_to_date_behind_each_run) {
  VirtualMachine machine(1, clock);
  IdealPlant plant;
  plant.stand_at({1000});
  machine.stand_at({7});
  machine.connect(plant);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  send(link, every_event(30, 100));
  send(link, every_event(20, 100, true));
  drain(link);
  EXPECT_EQ(machine.counts().motors[0].position, 17);
  EXPECT_EQ(plant.truth_at(machine.elapsed()).positions[0], 1010);
}

TEST(VirtualMachine, heeds_a_switch_that_somebody_closes) {
  VirtualMachine machine(1, clock);
  IdealPlant plant;
  machine.connect(plant);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  machine.set_switch(input_hold, true);
  EXPECT_EQ(machine.board().inputs(), input_hold);
  EXPECT_EQ(plant.inputs_at(machine.elapsed()), input_hold);
  plant.set_switch(input_hold, false);
  plant.set_switch(input_door, true);
  static_cast<void>(machine.run(Seconds(0)));
  EXPECT_EQ(machine.board().inputs(), input_door);
}

TEST(VirtualMachine, time_goes_on_past_32_bits) {
  VirtualMachine machine(1, clock);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  for (int i = 0; i < 1000; ++i) send(link, BoardSegment{.events = 255, .interval = largest_interval});
  drain(link);
  // 65535.99998 ticks each; the fractions of all the intervals make whole ticks too.
  const std::int64_t intervals = 255 * 1000;
  EXPECT_EQ(machine.now().count, (intervals * largest_interval + 0x8000) >> 16);
}

TEST(VirtualMachine, switches_outputs_between_segments) {
  VirtualMachine machine(1, clock);
  Recorder recorder;
  machine.add_observer(recorder);
  BoardSession link(machine);
  greet(link, {.motors = 1});
  send(link, BoardOutputs{.switches = spindle_on, .spindle_rpm = 9000});
  send(link, every_event(3, 100));
  send(link, BoardOutputs{.switches = spindle_on | mist_on, .spindle_rpm = 9000});
  send(link, every_event(3, 100));
  send(link, BoardOutputs());
  drain(link);
  EXPECT_THAT(recorder.switched,
              testing::ElementsAre(testing::Pair(0, 1), testing::Pair(300, 5), testing::Pair(600, 0)));
  EXPECT_EQ(machine.counts().output_changes, 3);
  EXPECT_EQ(machine.counts().outputs.switches, 0);
}

TEST(VirtualMachine, does_the_same_whether_or_not_it_is_watched) {
  const auto run = [](bool watched) {
    VirtualMachine machine(2, clock);
    Recorder recorder;
    if (watched) machine.add_observer(recorder);
    BoardSession link(machine);
    greet(link, {.motors = 2});
    for (std::uint32_t i = 0; i < 500; ++i) {
      BoardSegment segment = every_event(static_cast<std::uint8_t>(1 + i % 255), 160 + i % 9, i % 3 == 0);
      segment.increments[1] = static_cast<std::uint16_t>(i * 131);
      send(link, segment);
    }
    drain(link);
    return std::tuple(machine.counts().time, machine.counts().motors, link.bytes_sent());
  };
  EXPECT_EQ(run(true), run(false));
}

// What segments mean, by the words of board_segment.hpp: shares no code with the board.
class Oracle {
 public:
  explicit Oracle(unsigned motors) : place_(motors, 32768) {}

  void play(const BoardSegment& segment) {
    std::int64_t interval = segment.interval;
    for (unsigned k = 0; k < segment.events; ++k, interval += segment.change) {
      time_ += interval;
      for (unsigned m = 0; m < place_.size(); ++m) {
        const std::int64_t before = place_[m] >> 16;
        place_[m] += increment(segment, m);
        const auto moved = static_cast<int>((place_[m] >> 16) - before);
        if (moved != 0) steps.push_back({time_ >> 16, m, moved});
      }
    }
  }
  std::vector<Step> steps;

 private:
  static std::int64_t increment(const BoardSegment& segment, unsigned m) {
    const bool flip = (segment.flips >> m & 1) != 0;
    if ((segment.directions >> m & 1) == 0) return flip ? 65536 : segment.increments[m];
    return flip ? segment.increments[m] - 65536 : 0;
  }
  std::vector<std::int64_t> place_;  // 1/65536 step, half a step added
  std::int64_t time_ = 32768;        // 1/65536 tick, half a tick added
};

TEST(VirtualMachine, makes_the_very_steps_that_random_segments_ask_for) {
  const std::uint64_t seed = test::seed();
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (std::uint8_t motors = 1; motors <= max_motors; ++motors) {
    VirtualMachine machine(motors, clock);
    Recorder recorder;
    machine.add_observer(recorder);
    BoardSession link(machine);
    greet(link, {.motors = motors});
    Oracle oracle(motors);
    for (int i = 0; i < 300; ++i) {
      BoardSegment segment{.events = static_cast<std::uint8_t>(1 + random() % 255),
                           .interval = static_cast<std::uint32_t>(random() % (1000 << 16)) + (300 << 16),
                           .change = static_cast<std::int32_t>(random() % 0x20001) - 0x10000};
      for (unsigned m = 0; m < motors; ++m) {
        const auto bit = static_cast<std::uint8_t>(1U << m);
        segment.increments[m] = static_cast<std::uint16_t>(random());
        switch (random() % 4) {
          case 0: break;  // up
          case 1:         // up at every event
            segment.increments[m] = 0;
            segment.flips |= bit;
            break;
          default:  // down
            segment.directions |= bit;
            segment.flips |= bit;
            break;
        }
      }
      send(link, segment);
      oracle.play(segment);
    }
    drain(link);
    ASSERT_FALSE(link.error());
    ASSERT_EQ(recorder.steps, oracle.steps) << int{motors} << " motors";
    const MachineCounts counts = machine.counts();
    for (unsigned m = 0; m < motors; ++m) {
      std::int64_t position = 0;
      std::int64_t total = 0;
      std::int64_t reversals = 0;
      std::int64_t shortest = INT64_MAX;
      const Step* last = nullptr;
      for (const Step& step : oracle.steps) {
        if (step.motor != m) continue;
        position += step.direction;
        ++total;
        if (last != nullptr) {
          if (last->direction != step.direction) ++reversals;
          shortest = std::min(shortest, step.time - last->time);
        }
        last = &step;
      }
      ASSERT_NE(last, nullptr);
      EXPECT_EQ(counts.motors[m].position, position);
      EXPECT_EQ(counts.motors[m].total, total);
      EXPECT_EQ(counts.motors[m].reversals, reversals);
      EXPECT_EQ(counts.motors[m].shortest_interval.count, shortest);
      EXPECT_EQ(counts.motors[m].last_step.count, last->time);
    }
  }
}

}  // namespace
}  // namespace passo
