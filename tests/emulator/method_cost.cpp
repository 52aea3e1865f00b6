#include "emulator/method_cost.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>
#include <stdexcept>

namespace passo {
namespace {

using Values = std::array<std::int32_t, 4>;

constexpr std::uint64_t clock_rate = 16'000'000;

// All directions, steep and flat, one axis alone, all axes at every pulse.
constexpr std::array<Values, 5> lines = {
    {{1000, -700, 333}, {-517, 1000, 999}, {1000, 1000, 1000}, {0, -1000, 0}, {-3, 5000, 4999}}};
// Full circle, through three quadrants, a short one, all counterclockwise.
constexpr std::array<Values, 3> arcs = {{{500, 0, 500, 0}, {300, 400, 0, -500}, {700, 100, 100, 700}}};
// First interval in ticks, steps, shortest interval: a trapezoid, a triangle, the longest first interval.
constexpr std::array<Values, 3> ramps = {{{20000, 900, 700}, {4000, 600, 1}, {65535, 900, 1}}};

template <std::size_t count>
std::vector<Order> orders_of(const std::array<Values, count>& moves, std::uint8_t number, std::uint16_t most) {
  std::vector<Order> orders;
  for (const Values& values : moves) {
    Order order;
    order.method = number;
    order.most = most;
    std::ranges::copy(values, order.values);
    orders.push_back(order);
  }
  return orders;
}

MethodCost measure(MethodRunner& runner, std::uint8_t number, const MethodName& method) {
  MethodCost cost{.method = method, .same_as_host = true};
  std::uint64_t sum = 0;
  std::uint64_t pulses = 0;
  for (const Order& order : measured_orders(number, method)) {
    const MethodRun run = runner.play(order);
    if (run.pulses.empty()) throw std::runtime_error("no pulse of " + method.name);
    cost.same_as_host = cost.same_as_host && run.output == play_on_host(order);
    cost.begin = std::max(cost.begin, run.begin);
    sum += std::accumulate(run.pulses.begin(), run.pulses.end(), std::uint64_t{0});
    pulses += run.pulses.size();
    cost.most = std::max(cost.most, std::ranges::max(run.pulses));
  }
  cost.mean = static_cast<double>(sum) / static_cast<double>(pulses);
  return cost;
}

}  // namespace

std::vector<Order> measured_orders(std::uint8_t number, const MethodName& method) {
  switch (method.kind) {
    case MethodKind::line: return orders_of(lines, number, 60'000);
    case MethodKind::arc: return orders_of(arcs, number, 60'000);
    case MethodKind::ramp: return orders_of(ramps, number, ramp_table_size - 1);
    case MethodKind::move: return orders_of(ramps, number, 60'000);
  }
  return {};
}

std::vector<MethodCost> measure_all(MethodRunner& runner) {
  std::vector<MethodCost> costs;
  for (const MethodName& method : method_names()) {
    costs.push_back(measure(runner, static_cast<std::uint8_t>(costs.size()), method));
  }
  return costs;
}

std::string cost_table(const std::vector<MethodCost>& costs, const std::string& compiler) {
  std::string text = "ATmega328P at 16 MHz, compiled by " + compiler + ".\n\n";
  text += "| what | method | axes | bits | cycles a pulse, mean | most | pulses/s | cycles to begin |\n";
  text += "|---|---|---:|---:|---:|---:|---:|---:|\n";
  for (const MethodCost& cost : costs) {
    std::array<char, 160> row{};
    std::snprintf(row.data(), row.size(), "| %s | %s | %d | %d | %.0f | %llu | %llu | %llu |\n",
                  name_of(cost.method.kind), cost.method.name.c_str(), cost.method.axes, cost.method.bits, cost.mean,
                  static_cast<unsigned long long>(cost.most), static_cast<unsigned long long>(clock_rate / cost.most),
                  static_cast<unsigned long long>(cost.begin));
    text += row.data();
  }
  return text;
}

}  // namespace passo
