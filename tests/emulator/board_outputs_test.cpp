// The emulated board's outputs: switched at the event to which they belong, and the spindle's pin left alone at duty 0.
#include <algorithm>
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/uno_cnc_shield.hpp"

namespace passo {
namespace {

// The spindle's PWM: its pin follows the timer only while `connected` is set in `control`.
struct SpindleTimer {
  std::uint16_t duty;
  std::uint16_t control;
  std::uint8_t connected;
};
constexpr SpindleTimer timer_of_uno = {.duty = 0xb3, .control = 0xb0, .connected = 1 << 7};
constexpr SpindleTimer timer_of_mega = {.duty = 0xac, .control = 0xa0, .connected = 1 << 3};

struct OutputPins {
  Pin reverse;
  Pin mist;
  Pin flood;
};

struct BoardWithOutputs {
  BoardUnderTest board;
  OutputPins pins;
  SpindleTimer timer;
  std::uint32_t shortest_interval;
};
BoardWithOutputs uno() {
  return {.board = uno_under_test(PASSO_MOTION_UNO),
          .pins = {uno_cnc_shield.spindle_direction, uno_cnc_shield.mist, uno_cnc_shield.flood},
          .timer = timer_of_uno,
          .shortest_interval = 107};
}
BoardWithOutputs mega() {
  return {.board = mega_under_test(PASSO_MOTION_MEGA, 4),
          .pins = {mega_ramps.spindle_direction, mega_ramps.mist, mega_ramps.flood},
          .timer = timer_of_mega,
          .shortest_interval = 145};
}

// What the outputs are, as the pins and the timer have it, and since when.
struct OutputState {
  std::uint64_t cycle = 0;
  unsigned switches = 0;
  unsigned duty = 0;  // 0 while the pin is not connected
  friend bool operator==(const OutputState& a, const OutputState& b) {
    return a.switches == b.switches && a.duty == b.duty;
  }
};

// Follows them. Two writes that belong together are a few cycles apart: only what lasts longer is kept.
class OutputWatch {
 public:
  OutputWatch(BoardBench& bench, const BoardWithOutputs& kind) : bench_(bench), kind_(kind) {
    bench.chip().on_write(kind.timer.duty, [this](std::uint8_t value) { note([&] { duty_ = value; }); });
    bench.chip().on_write(kind.timer.control, [this](std::uint8_t value) {
      note([&] { connected_ = (value & kind_.timer.connected) != 0; });
      if (connected_ && duty_ == 0) ++spikes_;
    });
  }
  unsigned spikes() const { return spikes_; }

  std::vector<OutputState> states() const {
    std::vector<OutputState> all = timed_;
    unsigned switches = 0;
    for (const PortChange& change : bench_.ports().changes()) {
      const unsigned before = switches;
      const auto follow = [&](Pin pin, unsigned which) {
        if (change.port != pin.port) return;
        switches = (change.now & pin.mask()) != 0 ? switches | which : switches & ~which;
      };
      follow(kind_.pins.reverse, spindle_reverse);
      follow(kind_.pins.mist, mist_on);
      follow(kind_.pins.flood, flood_on);
      if (switches != before) all.push_back({.cycle = change.cycle, .switches = switches | 0x100U, .duty = 0});
    }
    std::ranges::stable_sort(all, {}, &OutputState::cycle);
    return merged(all);
  }

 private:
  template <class Change>
  void note(const Change& change) {
    change();
    timed_.push_back({.cycle = bench_.cycles(), .switches = 0, .duty = connected_ ? duty_ : 0U});
  }
  static std::vector<OutputState> merged(const std::vector<OutputState>& all) {
    std::vector<OutputState> states;
    OutputState now;
    for (const OutputState& one : all) {
      OutputState next = now;
      if ((one.switches & 0x100U) != 0) {
        next.switches = one.switches & 0xffU;
      } else {
        next.duty = one.duty;
      }
      next.cycle = one.cycle;
      if (next == now) continue;
      now = next;
      if (!states.empty() && now.cycle - states.back().cycle < 16) {
        states.back() = now;
      } else {
        states.push_back(now);
      }
    }
    return states;
  }

  BoardBench& bench_;
  const BoardWithOutputs& kind_;
  unsigned duty_ = 0;
  bool connected_ = false;
  unsigned spikes_ = 0;
  std::vector<OutputState> timed_;
};

std::vector<std::uint64_t> edges_of(const BoardBench& bench, Pin step) {
  std::vector<std::uint64_t> edges;
  for (const PortChange& change : bench.ports().changes()) {
    const unsigned rose = change.now & ~change.before & unsigned{step.mask()};
    if (change.port == step.port && rose != 0) edges.push_back(change.cycle);
  }
  return edges;
}

// A segment, outputs, a segment, outputs: three of each, at one rate, with a step of each motor at every event.
struct Program {
  std::vector<BoardBench::Item> items;
  std::vector<std::size_t> events;  // up to each of the outputs
  std::vector<OutputState> states;  // that they make
};
Program random_program(std::mt19937_64& random, const BoardWithOutputs& kind) {
  Program program;
  const auto motors = kind.board.motors.size();
  const std::uint32_t interval = kind.shortest_interval + static_cast<std::uint32_t>(random() % 400);
  std::size_t events = 0;
  unsigned before = 0;
  for (int i = 0; i < 3; ++i) {
    BoardSegment segment{.events = static_cast<std::uint8_t>(100 + random() % 150), .interval = interval << 16};
    segment.flips = static_cast<std::uint8_t>((1U << motors) - 1);
    segment.directions = static_cast<std::uint8_t>(random() % (1U << motors));
    program.items.emplace_back(segment);
    events += segment.events;
    // Never the same twice; the last one switches the spindle off.
    BoardOutputs outputs;
    do {
      outputs.switches = static_cast<std::uint8_t>(random() % 16);
      if (i == 2) outputs.switches = static_cast<std::uint8_t>(outputs.switches & ~unsigned{spindle_on});
    } while (outputs.switches == before);
    before = outputs.switches;
    outputs.spindle_rpm = static_cast<std::uint16_t>(1'000 + random() % 23'000);
    program.items.emplace_back(outputs);
    program.events.push_back(events);
    const bool on = (outputs.switches & spindle_on) != 0;
    program.states.push_back(
        {.switches = outputs.switches & ~unsigned{spindle_on}, .duty = on ? outputs.spindle_rpm * 255U / 24'000 : 0U});
  }
  return program;
}

void expect_outputs_in_step(const BoardWithOutputs& kind, std::uint64_t most) {
  std::mt19937_64 random(test::seed());
  std::uint64_t worst = 0;
  std::int64_t worst_edge = 0;
  for (int trial = 0; trial < 40; ++trial) {
    BoardBench bench(kind.board);
    const OutputWatch watch(bench, kind);
    const Program program = random_program(random, kind);
    bench.start_items(program.items);
    bench.run(1'200'000);
    const std::vector<std::uint64_t> edges = edges_of(bench, kind.board.motors[0].step);
    ASSERT_EQ(edges.size(), program.events.back());
    const std::vector<OutputState> states = watch.states();
    ASSERT_EQ(states.size(), program.states.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      const std::uint64_t edge = edges[program.events[i] - 1];
      EXPECT_EQ(states[i].switches, program.states[i].switches);
      EXPECT_NEAR(states[i].duty, program.states[i].duty, 1);
      EXPECT_GT(states[i].cycle, edge);
      worst = std::max(worst, states[i].cycle - edge);
    }
    EXPECT_EQ(watch.spikes(), 0U) << "the pin was given to a PWM of duty 0";
    for (std::size_t i = 2; i < edges.size(); ++i) {
      const auto change =
          static_cast<std::int64_t>(edges[i] - edges[i - 1]) - static_cast<std::int64_t>(edges[i - 1] - edges[i - 2]);
      worst_edge = std::max(worst_edge, std::abs(change));
    }
  }
  std::printf("an edge to its outputs: %llu cycles at the most\n", static_cast<unsigned long long>(worst));
  EXPECT_LE(worst, most);
  EXPECT_LE(worst_edge, 8) << "the edges around are where they would be: each within four cycles";
}

TEST(UnoOutputs, are_switched_at_the_event_to_which_they_belong) {
  expect_outputs_in_step(uno(), 64);
}
TEST(MegaOutputs, are_switched_at_the_event_to_which_they_belong) {
  expect_outputs_in_step(mega(), 80);
}

// The host is killed with all outputs on: after half a second the spindle stands, a moment later the mist is off, and
// the flood goes on.
void expect_outputs_to_end(const BoardWithOutputs& kind) {
  constexpr std::uint64_t clock_rate = 16'000'000;
  BoardBench bench(kind.board);
  const OutputWatch watch(bench, kind);
  const auto all = std::uint8_t{spindle_on | spindle_reverse | mist_on | flood_on};
  BoardSegment segment{.events = 200, .flips = 1, .interval = kind.shortest_interval << 16};
  bench.start_items({segment, BoardOutputs{.switches = all, .spindle_rpm = 12'000}, segment});
  bench.name_session({.number = 7, .silence = {.spindle = 5, .mist = 8, .flood = 0}});
  bench.run(clock_rate / 5);
  const std::uint64_t silent_from = bench.cycles() - clock_rate / 5;
  bench.run(clock_rate);
  const std::vector<OutputState> states = watch.states();
  ASSERT_EQ(states.size(), 3U);
  EXPECT_EQ(states[0].switches, unsigned{spindle_reverse | mist_on | flood_on});
  EXPECT_GT(states[0].duty, 0U);
  EXPECT_EQ(states[1].duty, 0U);
  EXPECT_EQ(states[1].switches, states[0].switches);
  EXPECT_NEAR(static_cast<double>(states[1].cycle - silent_from) / clock_rate, 0.5, 0.12);
  EXPECT_EQ(states[2].switches, unsigned{spindle_reverse | flood_on});
  EXPECT_NEAR(static_cast<double>(states[2].cycle - states[1].cycle) / clock_rate, 0.3, 0.02);
  bench.ask();
  bench.run(clock_rate / 100);
  ASSERT_TRUE(bench.status());
  EXPECT_EQ(bench.status()->inputs & outputs_timed_out, unsigned{outputs_timed_out});
}

TEST(UnoOutputs, end_when_the_host_is_silent) {
  expect_outputs_to_end(uno());
}
TEST(MegaOutputs, end_when_the_host_is_silent) {
  expect_outputs_to_end(mega());
}

}  // namespace
}  // namespace passo
