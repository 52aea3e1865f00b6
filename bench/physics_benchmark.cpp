// Physics of three motors against real time, on one core: always integrated in full, and only where the bound does not
// hold. `times` is the motion's time over the time it took.
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "passo/motor/example_motor.hpp"
#include "passo/plant/rotor_plant.hpp"

namespace passo {
namespace {

// Sixteen microsteps; 20 kHz are six turns a second.
MotorSetup motor_of_a_small_machine() {
  return small_motor_setup("microsteps:16", {0.03});
}

struct Event {
  double time = 0;
  MotorSteps steps{};
};

// Moves there and back that reach 20,000 events a second, with a part of the steps for each motor, and a rest after
// each.
std::vector<Event> moves(const std::array<double, 3>& parts, int events_of_a_move, int count) {
  constexpr double rate = 20'000;
  constexpr double acceleration = 60'000;  // events/s²: 15 % of what the motor can
  std::vector<Event> all;
  double time = 0;
  for (int move = 0; move < count; ++move) {
    std::array<double, 3> due = {0.5, 0.5, 0.5};
    for (int i = 0; i < events_of_a_move; ++i) {
      const double way = std::min(i, events_of_a_move - 1 - i) + 0.5;
      time += 1 / std::min(rate, std::sqrt(2 * acceleration * way));
      Event event{.time = time};
      for (std::size_t m = 0; m < parts.size(); ++m) {
        due[m] += parts[m];
        if (due[m] < 1) continue;
        due[m] -= 1;
        event.steps[m] = move % 2 == 0 ? 1 : -1;
      }
      all.push_back(event);
    }
    time += 0.1;
  }
  return all;
}

void run(benchmark::State& state, const std::vector<Event>& events, Integration integration) {
  double lost = 0;
  for (auto _ : state) {
    RotorPlant plant(integration);
    for (std::size_t m = 0; m < 3; ++m) plant.fit_motor(m, motor_of_a_small_machine());
    for (const Event& event : events) plant.pulse(Seconds(event.time), event.steps);
    for (std::size_t m = 0; m < 3; ++m) lost += static_cast<double>(plant.record(m).lost);
  }
  state.counters["times"] =
      benchmark::Counter(events.back().time * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.counters["lost"] = lost;
}

void together_in_full(benchmark::State& state) {
  run(state, moves({1, 1, 1}, 60'000, 2), Integration::always);
}
void together(benchmark::State& state) {
  run(state, moves({1, 1, 1}, 60'000, 2), Integration::where_needed);
}
void a_slanted_line_in_full(benchmark::State& state) {
  run(state, moves({1, 0.618, 0.283}, 60'000, 2), Integration::always);
}
void a_slanted_line(benchmark::State& state) {
  run(state, moves({1, 0.618, 0.283}, 60'000, 2), Integration::where_needed);
}
void short_moves_in_full(benchmark::State& state) {
  run(state, moves({1, 0.618, 0.283}, 2000, 20), Integration::always);
}
void short_moves(benchmark::State& state) {
  run(state, moves({1, 0.618, 0.283}, 2000, 20), Integration::where_needed);
}
BENCHMARK(together_in_full)->Unit(benchmark::kMillisecond);
BENCHMARK(together)->Unit(benchmark::kMillisecond);
BENCHMARK(a_slanted_line_in_full)->Unit(benchmark::kMillisecond);
BENCHMARK(a_slanted_line)->Unit(benchmark::kMillisecond);
BENCHMARK(short_moves_in_full)->Unit(benchmark::kMillisecond);
BENCHMARK(short_moves)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace passo
