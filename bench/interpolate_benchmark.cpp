// Pulses a second of every interpolator and ramp on the host, for the same list of methods as on the chip
// (tests/emulator/methods.hpp). Names: kind/method/axes/bits.
#include <algorithm>
#include <cstdint>
#include <iterator>
#include <sstream>

#include "emulator/methods.hpp"
#include <benchmark/benchmark.h>

namespace passo {
namespace {

using ChosenTable = CompiledTable<ramp_table_size>;

// Long enough that the start costs nothing in comparison, without a pattern that a branch predictor could learn.
Order long_order(MethodKind kind) {
  Order order{.method = 0, .values = {}, .most = 60'000};
  const auto choose = [&](std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
    const std::int32_t values[] = {a, b, c, d};
    std::copy(std::begin(values), std::end(values), order.values);
  };
  switch (kind) {
    case MethodKind::line: choose(29'917, -20'011, 17'393, 0); break;
    case MethodKind::arc: choose(12'000, 5'000, 12'000, 5'000); break;
    case MethodKind::ramp: choose(60'000, 0, 0, 0), order.most = ramp_table_size - 1; break;
    case MethodKind::move: choose(60'000, 30'000, 1'000, 0); break;
  }
  return order;
}

template <class Walk>
void pulses(benchmark::State& state, const Order& order) {
  std::int64_t count = 0;
  for (auto _ : state) {
    Walk walk(order);
    std::uint16_t left = order.most;
    for (; left != 0 && !walk.done(); --left) {
      const auto pulse = walk.next();
      benchmark::DoNotOptimize(pulse);  // each pulse, as if a port were written
    }
    count += order.most - left;
  }
  state.SetItemsProcessed(count);
}

int add_all() {
  const auto add = [](auto method) {
    using Walk = typename decltype(method)::Walk;
    std::ostringstream name;
    name << name_of(method.kind) << '/' << method.name << '/' << int{Walk::axes} << '/' << int{method.bits};
    const Order order = long_order(method.kind);
    benchmark::RegisterBenchmark(name.str().c_str(), [order](benchmark::State& state) { pulses<Walk>(state, order); });
  };
  std::uint8_t count = 0;
  while (visit_method<ChosenTable>(count, add)) ++count;
  return count;
}
const int methods = add_all();

}  // namespace
}  // namespace passo
