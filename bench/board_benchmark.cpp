// Events a second from board segments to counted pulses, through link, wire, board and machine; and the same with
// traces.
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include "passo/firmware/player.hpp"
#include "passo/link/await.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/report/trace_csv.hpp"
#include "passo/report/trace_vcd.hpp"

namespace passo {
namespace {

// A circle of X and Y while Z slowly goes down, with one segment for each of a thousand directions. No two segments are
// alike, so no branch can be learned by heart.
std::vector<BoardSegment> spiral(std::uint8_t events) {
  constexpr int directions = 1000;
  std::vector<BoardSegment> segments;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * 3.14159265358979 * i / directions;
    BoardSegment segment{.events = events, .interval = 160 << 16, .change = i % 7 - 3};
    const std::array<double, 3> slopes = {std::cos(angle), std::sin(angle), -0.05};
    for (unsigned m = 0; m < 3; ++m) {
      const auto increment = static_cast<int>(slopes[m] * 65536);
      segment.increments[m] = static_cast<std::uint16_t>(increment);
      if (slopes[m] < 0) segment.directions = static_cast<std::uint8_t>(segment.directions | 1U << m);
      if (slopes[m] < 0 || increment == whole_step) segment.flips = static_cast<std::uint8_t>(segment.flips | 1U << m);
    }
    segments.push_back(segment);
  }
  return segments;
}

class Counter final : public MachineObserver {
 public:
  void on_steps(Ticks /*time*/, std::uint8_t stepped, std::uint8_t /*directions*/) override { sum += stepped; }
  std::uint64_t sum = 0;
};

void rate(benchmark::State& state, const std::vector<BoardSegment>& segments) {
  double events = 0;
  for (const BoardSegment& segment : segments) events += segment.events;
  state.counters["events/s"] =
      benchmark::Counter(events * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

// The player alone, as the lower bound.
void player(benchmark::State& state) {
  const std::vector<BoardSegment> segments = spiral(static_cast<std::uint8_t>(state.range(0)));
  for (auto _ : state) {
    Player board(3);
    std::uint64_t sum = 0;
    for (const BoardSegment& segment : segments) {
      board.load(segment);
      while (!board.done()) {
        sum += board.wait();
        sum += board.play();
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  rate(state, segments);
}
BENCHMARK(player)->Arg(30)->Arg(255)->Unit(benchmark::kMicrosecond);

void play(benchmark::State& state, MachineObserver* observer) {
  const std::vector<BoardSegment> segments = spiral(static_cast<std::uint8_t>(state.range(0)));
  std::uint64_t bytes = 0;
  for (auto _ : state) {
    VirtualMachine machine(3, Hertz(16e6));
    if (observer != nullptr) machine.add_observer(*observer);
    BoardSession link(machine);
    greet(link, {.motors = 3});
    for (const BoardSegment& segment : segments) send(link, segment);
    drain(link);
    bytes = link.bytes_sent();
    benchmark::DoNotOptimize(machine.counts());
  }
  rate(state, segments);
  state.counters["bytes/segment"] = static_cast<double>(bytes) / static_cast<double>(segments.size());
}

void link_board_machine(benchmark::State& state) {
  play(state, nullptr);
}
BENCHMARK(link_board_machine)->Arg(30)->Arg(100)->Arg(255)->Unit(benchmark::kMicrosecond);

void with_an_observer(benchmark::State& state) {
  Counter counter;
  play(state, &counter);
  benchmark::DoNotOptimize(counter.sum);
}
BENCHMARK(with_an_observer)->Arg(100)->Unit(benchmark::kMicrosecond);

// The text goes nowhere: this measures the cost of the text itself.
template <class SomeTrace>
void with_a_trace(benchmark::State& state) {
  std::size_t bytes = 0;
  SomeTrace trace({.motors = {{.axis = Axis::x}, {.axis = Axis::y}, {.axis = Axis::z}}},
                  [&](std::string_view text) { bytes += text.size(); });
  // The machine and its time start anew each round. A trace expects a time that only grows.
  class Onwards final : public MachineObserver {
   public:
    explicit Onwards(MachineObserver& next) : next_(next) {}
    void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
      if (time.count < last_) start_ += last_;
      last_ = time.count;
      next_.on_steps(Ticks{start_ + time.count}, stepped, directions);
    }

   private:
    MachineObserver& next_;
    std::int64_t start_ = 0;
    std::int64_t last_ = 0;
  } onwards(trace);
  play(state, &onwards);
  benchmark::DoNotOptimize(bytes);
}
BENCHMARK(with_a_trace<TraceCsv>)->Arg(100)->Unit(benchmark::kMicrosecond);
BENCHMARK(with_a_trace<TraceVcd>)->Arg(100)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace passo
