// Nanoseconds a pulse of every interpolator and ramp on the host, the same list of methods as on the chip
// (tests/emulator/methods.hpp). Names: kind/method/axes/bits.
#include <cstdint>
#include <string>

#include <benchmark/benchmark.h>

#include "emulator/methods.hpp"

namespace passo {
namespace {

std::uint32_t sum_of(Pulse pulse) {
  return std::uint32_t{pulse.steps} + pulse.directions;
}
std::uint32_t sum_of(std::uint32_t interval) {
  return interval;
}

template <class Walk>
void pulses(benchmark::State& state, const Order& order) {
  std::uint64_t pulses = 0;
  for (auto _ : state) {
    Walk walk(order);
    std::uint32_t sum = 0;
    std::uint32_t left = order.most;
    for (; left != 0 && !walk.done(); --left) sum += sum_of(walk.next());
    benchmark::DoNotOptimize(sum);
    pulses += order.most - left;
  }
  const double count = static_cast<double>(pulses);
  state.counters["pulses/s"] = benchmark::Counter(count, benchmark::Counter::kIsRate);
  state.counters["s/pulse"] =
      benchmark::Counter(count, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

const int registered = [] {
  const auto add = [](auto method) {
    using Walk = typename decltype(method)::Walk;
    const std::string name = std::string(name_of(method.kind)) + "/" + method.name + "/" +
                             std::to_string(Walk::axes) + "/" + std::to_string(method.bits);
    const Order order = long_order(method.kind);
    benchmark::RegisterBenchmark(name.c_str(), [order](benchmark::State& state) { pulses<Walk>(state, order); });
  };
  std::uint8_t number = 0;
  while (visit_method(number, add)) ++number;
  return number;
}();

}  // namespace
}  // namespace passo
