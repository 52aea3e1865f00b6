// The interpolators and ramps on the chip: every pulse is the host's, and none costs more cycles than it may.
#include <cstdint>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "emulator/method_cost.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// A whole number from 0 to 2^bits − 1, as often small as large.
std::int32_t any_size(std::mt19937_64& random, unsigned bits) {
  return static_cast<std::int32_t>(random() >> (64 - 1 - random() % bits));
}
std::int32_t either_sign(std::mt19937_64& random, std::int32_t value) {
  return random() % 2 == 0 ? value : -value;
}

void choose_line(std::mt19937_64& random, unsigned bits, Order& order) {
  for (std::int32_t& value : order.values) value = either_sign(random, any_size(random, bits - 1));
}
// The end is the start, mirrored: on the same circle for certain.
void choose_arc(std::mt19937_64& random, unsigned bits, Order& order) {
  const std::int32_t x = any_size(random, bits - 2);
  const std::int32_t y = any_size(random, bits - 2);
  const bool swapped = random() % 2 == 0;
  order.values[0] = either_sign(random, x);
  order.values[1] = either_sign(random, y);
  order.values[2] = either_sign(random, swapped ? y : x);
  order.values[3] = either_sign(random, swapped ? x : y);
}
void choose_ramp(std::mt19937_64& random, unsigned bits, Order& order) {
  order.values[0] = 1 + any_size(random, bits < 64 ? 15 : 30);
  order.values[1] = either_sign(random, any_size(random, 15));
  order.values[2] = 1 + static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(order.values[0]));
}

Order random_order(std::mt19937_64& random, std::uint8_t number, const MethodName& method) {
  Order order;
  order.method = number;
  order.most = 300;
  const auto bits = static_cast<unsigned>(method.bits);
  switch (method.kind) {
    case MethodKind::line: choose_line(random, bits, order); break;
    case MethodKind::arc: choose_arc(random, bits, order); break;
    case MethodKind::ramp:
    case MethodKind::move: choose_ramp(random, bits, order); break;
  }
  return order;
}

std::string text_of(const MethodName& method, const Order& order) {
  std::ostringstream text;
  text << name_of(method.kind) << ' ' << method.name << ' ' << method.bits << ':';
  for (const std::int32_t value : order.values) text << ' ' << value;
  return text.str();
}

class MethodsOnTheChip : public testing::Test {
 protected:
  static const std::vector<MethodCost>& costs() {
    static const std::vector<MethodCost> measured = [] {
      MethodRunner runner(PASSO_METHODS_PROGRAM);
      return measure_all(runner);
    }();
    return measured;
  }
  static MethodCost cost_of(MethodKind kind, const std::string& name, int axes, int bits) {
    for (const MethodCost& cost : costs()) {
      if (cost.method.kind == kind && cost.method.name == name && cost.method.axes == axes && cost.method.bits == bits)
        return cost;
    }
    ADD_FAILURE() << "no method " << name_of(kind) << " " << name << " of " << axes << " axes with " << bits << " bits";
    return {};
  }
};

TEST_F(MethodsOnTheChip, give_every_pulse_that_they_give_on_the_host) {
  for (const MethodCost& cost : costs()) {
    EXPECT_TRUE(cost.same_as_host) << name_of(cost.method.kind) << " " << cost.method.name << " " << cost.method.bits;
  }
}

TEST_F(MethodsOnTheChip, cost_no_more_cycles_than_an_interrupt_has) {
  EXPECT_LE(cost_of(MethodKind::line, "lean", 3, 16).most, 150U);
  EXPECT_LE(cost_of(MethodKind::line, "dda", 3, 16).most, 120U);
  EXPECT_LE(cost_of(MethodKind::ramp, "table", 1, 16).most, 80U);
}

// Moves of every size up to the largest, of which the first pulses show whether anything overflows.
TEST_F(MethodsOnTheChip, give_the_hosts_pulses_of_random_moves) {
  MethodRunner runner(PASSO_METHODS_PROGRAM);
  std::mt19937_64 random(test::seed());
  const std::vector<MethodName> methods = method_names();
  for (std::size_t number = 0; number < methods.size(); ++number) {
    for (int move = 0; move < 100; ++move) {
      const Order order = random_order(random, static_cast<std::uint8_t>(number), methods[number]);
      const MethodRun run = runner.play(order);
      const Output expected = play_on_host(order);
      ASSERT_EQ(run.output, expected) << text_of(methods[number], order);
    }
  }
}

TEST_F(MethodsOnTheChip, cost_what_the_documentation_says) {
  std::ifstream file(PASSO_SOURCE_DIR "/docs/interpolation/costs.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  ASSERT_FALSE(text.empty()) << "scripts/costs.sh writes it";
  if (text.find("compiled by " PASSO_CHIP_COMPILER ".") == std::string::npos) {
    GTEST_SKIP() << "the figures are another compiler's than " PASSO_CHIP_COMPILER;
  }
  const std::string table = cost_table(costs(), PASSO_CHIP_COMPILER);
  EXPECT_NE(text.find(table), std::string::npos) << "run scripts/costs.sh; now it is\n" << table;
}

}  // namespace
}  // namespace passo
