#include "emulator/method_runner.hpp"

#include <stdexcept>

namespace passo {
namespace {

constexpr std::uint16_t gpior0 = 0x3e;
constexpr std::uint16_t gpior1 = 0x4a;
constexpr std::uint16_t gpior2 = 0x4b;

constexpr std::uint64_t most_cycles = 2'000'000'000;

using HostTable = CompiledTable<ramp_table_size>;

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

void put(Output& output, Pulse pulse) {
  output.push_back(pulse.steps);
  output.push_back(pulse.directions);
}
void put(Output& output, std::uint16_t interval) {
  append(output, interval, 2);
}
void put(Output& output, std::uint32_t interval) {
  append(output, interval, 4);
}

}  // namespace

MethodRunner::MethodRunner(const std::string& program) : chip_(program) {
  chip_.on_read(gpior0, [this] { return next_byte(); });
  chip_.on_write(gpior0, [this](std::uint8_t) { marks_.push_back(chip_.cycles()); });
  for (const std::uint16_t port : {gpior1, gpior2}) {
    chip_.on_write(port, [this](std::uint8_t value) { output_.push_back(value); });
  }
  chip_.run(most_cycles);
  if (marks_.size() != 2) throw std::runtime_error("not the program that plays methods: " + program);
  cost_of_marks_ = marks_[1] - marks_[0];
}

// The chip asks for the first byte of an order until there is one.
std::uint8_t MethodRunner::next_byte() {
  if (read_ < order_.size()) return order_[read_++];
  chip_.stop();
  return no_order;
}

MethodRun MethodRunner::play(const Order& order) {
  order_.clear();
  append(order_, order.method, 1);
  append(order_, order.most, 2);
  for (const std::int32_t value : order.values) append(order_, static_cast<std::uint32_t>(value), 4);
  read_ = 0;
  output_.clear();
  marks_.clear();
  chip_.run(most_cycles);

  if (marks_.size() < 2 || marks_.size() % 2 != 0) throw std::runtime_error("the chip did not play the order");
  MethodRun run{.output = output_, .begin = 0, .pulses = {}};
  for (std::size_t i = 0; i < marks_.size(); i += 2) {
    run.pulses.push_back(marks_[i + 1] - marks_[i] - cost_of_marks_);
  }
  run.begin = run.pulses.front();
  run.pulses.erase(run.pulses.begin());
  return run;
}

Output play_on_host(const Order& order) {
  Output output;
  visit_method<HostTable>(order.method, [&](auto method) {
    typename decltype(method)::Walk walk(order);
    for (std::uint16_t left = order.most; left != 0 && !walk.done(); --left) put(output, walk.next());
  });
  return output;
}

std::vector<MethodName> method_names() {
  std::vector<MethodName> names;
  const auto add = [&](auto method) {
    names.push_back({method.name, method.kind, decltype(method)::Walk::axes, method.bits});
  };
  for (std::uint8_t number = 0; visit_method<HostTable>(number, add);) ++number;
  return names;
}

}  // namespace passo
