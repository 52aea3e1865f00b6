// Noise on the wires of the emulated board's switches, and alarms of drives.
#include <algorithm>
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include "kit/in_full.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/uno_cnc_shield.hpp"

namespace passo {
namespace {

constexpr std::uint64_t cycles_a_microsecond = 16;
constexpr std::uint8_t filter = 100;
constexpr std::size_t segments = 10;  // as many as the board takes at once

struct NoisyBoard {
  BoardUnderTest board;
  std::uint32_t interval;
  std::vector<Pin> stops;
  Pin probe;
  Pin alarm;           // cycle start
  std::uint64_t look;  // cycles from the interrupt's look at the pins to the edge
};

NoisyBoard noisy_uno() {
  std::vector<Pin> stops(std::begin(uno_cnc_shield.limits), std::begin(uno_cnc_shield.limits) + 3);
  stops.push_back(uno_cnc_shield.emergency_stop);
  return {.board = uno_under_test(PASSO_MOTION_UNO),
          .interval = 400,
          .stops = stops,
          .probe = uno_cnc_shield.probe,
          .alarm = uno_cnc_shield.cycle_start,
          .look = 4};
}
NoisyBoard noisy_mega() {
  std::vector<Pin> stops(std::begin(mega_ramps.limits), std::end(mega_ramps.limits));
  stops.push_back(mega_ramps.emergency_stop);
  return {.board = mega_under_test(PASSO_MOTION_MEGA, 3),
          .interval = 400,
          .stops = stops,
          .probe = mega_ramps.probe,
          .alarm = mega_ramps.cycle_start,
          .look = 18};
}

class FilteredBench : public BoardBench {
 public:
  explicit FilteredBench(const NoisyBoard& kind, const PinSetup& setup = {.filter = filter})
      : BoardBench(kind.board), kind_(kind), random_(test::seed()) {
    set_up(setup);
    run(50'000);
  }
  void start_long_run() {
    const BoardSegment segment{.events = 200, .flips = 7, .interval = kind_.interval << 16};
    start(std::vector<BoardSegment>(segments, segment));
    run(60'000);
  }
  // A pin is pulled low for 1 to 25 us, after up to 200 us.
  void spike(Pin pin) { spike(pin, 1 + random_() % 25); }
  void spike(Pin pin, std::uint64_t microseconds) {
    run(random_() % (200 * cycles_a_microsecond));
    ports().set_input(pin.port, pin.bit, false);
    run(microseconds * cycles_a_microsecond);
    ports().set_input(pin.port, pin.bit, true);
  }
  EdgeCheck play_random(const StreamKind& kind) {
    return play(random_stream(random_, static_cast<std::uint8_t>(kind_.board.motors.size()), kind));
  }
  Pin any_of(const std::vector<Pin>& pins) { return pins[random_() % pins.size()]; }
  std::vector<std::uint64_t> edges() const {
    std::vector<std::uint64_t> edges;
    const Pin step = kind_.board.motors[0].step;
    for (const PortChange& change : ports().changes()) {
      const unsigned risen = change.now & ~change.before & unsigned{step.mask()};
      if (change.port == step.port && risen != 0) edges.push_back(change.cycle);
    }
    return edges;
  }

 private:
  const NoisyBoard& kind_;
  std::mt19937_64 random_;
};

void expect_no_stop_by_spikes(const NoisyBoard& kind) {
  FilteredBench bench(kind);
  bench.start_long_run();
  for (int i = 0; i < 300; ++i) bench.spike(bench.any_of(kind.stops));
  bench.run(2'000'000);
  EXPECT_FALSE(bench.fault());
  EXPECT_EQ(bench.edges().size(), segments * 200U) << "each step is made";
  // At rest, too.
  for (int i = 0; i < 100; ++i) bench.spike(bench.any_of(kind.stops));
  EXPECT_FALSE(bench.fault());
}

void expect_a_stop_by_spikes_without_a_filter(const NoisyBoard& kind) {
  FilteredBench bench(kind, {});
  bench.start_long_run();
  for (int i = 0; i < 100 && !bench.fault(); ++i) bench.spike(bench.any_of(kind.stops));
  EXPECT_TRUE(bench.fault()) << "else the spikes prove nothing";
}

// Spikes of 3 and 25 us, one after the other, while a long stream comes as fast as the board plays it: each step is
// made in time. Then a switch truly closes.
void expect_no_standstill_by_spikes(NoisyBoard kind) {
  FilteredBench bench(kind);
  std::uint64_t spikes = 0;
  bench.before_item = [&](std::span<const std::uint8_t>) {
    bench.spike(bench.any_of(kind.stops), spikes++ % 2 == 0 ? 3 : 25);
  };
  const int segments_of_stream = test::in_full() == 1 ? 400 : 40;
  const EdgeCheck check = bench.play_random({.shortest_interval = kind.interval,
                                             .longest_interval = kind.interval,
                                             .shortest_segment = 200,
                                             .segments = segments_of_stream,
                                             .ramp = 20});
  EXPECT_TRUE(check.exact());
  EXPECT_FALSE(bench.fault());
  bench.before_item = {};
  bench.ask();
  bench.run(100'000);
  ASSERT_TRUE(bench.status());
  EXPECT_EQ(bench.status()->state & board_slipped, 0) << "it never stood still";
  std::printf("%llu spikes, error %lld cycles, unwatched %llu\n", static_cast<unsigned long long>(spikes),
              static_cast<long long>(check.error), static_cast<unsigned long long>(check.unwatched));
  bench.set_up({.filter = filter});
  bench.run(50'000);
  bench.ports().forget_changes();
  bench.start_long_run();
  const Pin limit = kind.stops.front();
  const std::uint64_t pressed = bench.cycles();
  bench.ports().set_input(limit.port, limit.bit, false);
  bench.run(100'000);
  ASSERT_TRUE(bench.fault());
  EXPECT_EQ(bench.fault()->reason, FaultReason::limit);
  EXPECT_LE(bench.edges().back(), pressed + 2'000 * cycles_a_microsecond);
}

// The longest way of a press to the last step: the filter, and a turn of the board's loop.
void expect_a_stop_within(std::uint64_t microseconds, const NoisyBoard& kind) {
  std::uint64_t worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    FilteredBench bench(kind);
    bench.start_long_run();
    bench.run(static_cast<std::uint64_t>(trial) * 7'001);
    const Pin pin = kind.stops[static_cast<std::size_t>(trial) % kind.stops.size()];
    const std::uint64_t pressed = bench.cycles();
    bench.ports().set_input(pin.port, pin.bit, false);
    bench.run(300'000);
    ASSERT_TRUE(bench.fault());
    const bool is_emergency = pin == kind.stops.back();
    EXPECT_EQ(bench.fault()->reason, is_emergency ? FaultReason::emergency_stop : FaultReason::limit);
    EXPECT_NE(bench.fault()->inputs, 0) << "it is named";
    const std::uint64_t last = bench.edges().back();
    EXPECT_GT(last, pressed + (filter - 20) * cycles_a_microsecond);
    worst = std::max(worst, last - pressed);
  }
  std::printf("from a press to the last step: %.0f us at the most\n",
              static_cast<double>(worst) / cycles_a_microsecond);
  EXPECT_LE(worst, microseconds * cycles_a_microsecond);
}

// Spikes at the probe, none of which counts; then it touches, at each cycle from one event to the next.
void expect_exact_touches_amid_spikes(const NoisyBoard& kind) {
  for (std::uint32_t phase = 0; phase < kind.interval; phase += 31) {
    FilteredBench bench(kind);
    bench.start_long_run();
    for (int i = 0; i < 10; ++i) bench.spike(kind.probe);
    bench.run(60'000 + phase);
    ASSERT_FALSE(bench.captured()) << "a spike is no touch";
    const std::uint64_t touched = bench.cycles();
    bench.ports().set_input(kind.probe.port, kind.probe.bit, false);
    bench.run(300'000);
    ASSERT_TRUE(bench.captured()) << phase;
    const auto until = [edges = bench.edges()](std::uint64_t cycle) {
      return std::ranges::upper_bound(edges, cycle) - edges.begin();
    };
    EXPECT_GE(bench.captured()->positions[0], until(touched)) << phase;
    EXPECT_LE(bench.captured()->positions[0], until(touched + kind.look)) << phase;
  }
}

// While a switch stops the motors nobody but the main loop reads the line, which holds two bytes: a third one comes 640
// cycles after the first. At each rate, with a filter and without one, in motion and at rest.
void expect_no_byte_lost_at_a_stop(NoisyBoard kind) {
  constexpr std::uint64_t most_unwatched = 639;
  std::uint64_t longest = 0;
  for (const std::uint32_t interval : {170U, 400U, 700U, 3'000U}) {
    kind.interval = interval;
    for (const std::uint8_t time : {std::uint8_t{0}, filter}) {
      for (std::size_t trial = 0; trial < 2 * kind.stops.size(); ++trial) {
        FilteredBench bench(kind, {.filter = time});
        const bool moves = trial < kind.stops.size();
        if (moves) {
          bench.start_long_run();
        } else {
          bench.start({});
        }
        const Pin pin = kind.stops[trial % kind.stops.size()];
        bench.run(60'000 + 31 * trial);
        bench.ports().set_input(pin.port, pin.bit, false);
        bench.run(100'000);
        bench.ask();
        bench.run(300'000);
        if (moves) {
          ASSERT_TRUE(bench.fault());
        }
        EXPECT_LE(bench.uart().longest_unwatched(), most_unwatched)
            << interval << " ticks, filter " << int{time} << ", pin " << pin.port << int{pin.bit} << ", moves "
            << moves;
        longest = std::max(longest, bench.uart().longest_unwatched());
      }
    }
  }
  std::printf("at a stop: %llu cycles between two looks at the line at the most\n",
              static_cast<unsigned long long>(longest));
}

void expect_alarm(const NoisyBoard& kind) {
  for (const bool moves : {true, false}) {
    FilteredBench bench(kind, {.alarms = input_start, .filter = filter});
    ASSERT_TRUE(bench.pin_setup());
    EXPECT_EQ(bench.pin_setup()->alarms, unsigned{input_start});
    EXPECT_EQ(bench.pin_setup()->filter, filter);
    if (moves) {
      bench.start_long_run();
    } else {
      bench.start({});
      bench.run(60'000);
    }
    ASSERT_FALSE(bench.fault());
    const std::uint64_t given = bench.cycles();
    bench.ports().set_input(kind.alarm.port, kind.alarm.bit, false);
    bench.run(600'000);
    ASSERT_TRUE(bench.fault()) << moves;
    EXPECT_EQ(bench.fault()->reason, FaultReason::driver);
    EXPECT_EQ(bench.fault()->inputs, unsigned{input_start});
    bench.ask();
    bench.run(200'000);
    ASSERT_TRUE(bench.status());
    EXPECT_EQ(bench.status()->state & board_trusted, 0);
    if (!moves) continue;
    EXPECT_LE(bench.edges().back(), given + 3'000 * cycles_a_microsecond);
  }
}

TEST(UnoFilter, lets_no_spike_stop_the_motors) {
  expect_a_stop_by_spikes_without_a_filter(noisy_uno());
  expect_no_stop_by_spikes(noisy_uno());
}
TEST(UnoFilter, lets_no_spike_delay_a_step_at_the_highest_rate) {
  NoisyBoard kind = noisy_uno();
  kind.interval = 106;
  expect_no_standstill_by_spikes(kind);
}
TEST(UnoFilter, delays_a_stop_by_its_time_and_a_turn_of_the_loop) {
  expect_a_stop_within(2'000, noisy_uno());
}
TEST(UnoFilter, reads_its_line_while_a_switch_stops_the_motors) {
  expect_no_byte_lost_at_a_stop(noisy_uno());
}
TEST(UnoFilter, leaves_touches_exact_to_the_step) {
  expect_exact_touches_amid_spikes(noisy_uno());
}
TEST(UnoFilter, knows_an_alarm_of_the_drives_at_cycle_start) {
  expect_alarm(noisy_uno());
}

TEST(MegaFilter, lets_no_spike_stop_the_motors) {
  expect_a_stop_by_spikes_without_a_filter(noisy_mega());
  expect_no_stop_by_spikes(noisy_mega());
}
TEST(MegaFilter, lets_no_spike_delay_a_step_at_the_highest_rate) {
  NoisyBoard kind = noisy_mega();
  kind.interval = 145;
  expect_no_standstill_by_spikes(kind);
}
TEST(MegaFilter, delays_a_stop_by_its_time_and_a_turn_of_the_loop) {
  expect_a_stop_within(2'000, noisy_mega());
}
TEST(MegaFilter, reads_its_line_while_a_switch_stops_the_motors) {
  expect_no_byte_lost_at_a_stop(noisy_mega());
}
TEST(MegaFilter, leaves_touches_exact_to_the_step) {
  expect_exact_touches_amid_spikes(noisy_mega());
}
TEST(MegaFilter, knows_an_alarm_of_a_drive) {
  expect_alarm(noisy_mega());
}

}  // namespace
}  // namespace passo
