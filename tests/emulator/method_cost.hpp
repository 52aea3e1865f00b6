// Measures what a pulse of each method costs on the emulated chip, over a fixed set of moves, and makes the table in
// docs/interpolation/costs.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/method_runner.hpp"

namespace passo {

struct MethodCost {
  MethodName method;
  double mean = 0;  // cycles a pulse
  std::uint64_t most = 0;
  std::uint64_t begin = 0;    // cycles from the move to its first pulse, the most
  bool same_as_host = false;  // every pulse of every move
};

// The moves that a method is measured with.
std::vector<Order> measured_orders(std::uint8_t number, const MethodName& method);

std::vector<MethodCost> measure_all(MethodRunner& runner);

// Markdown, from the compiler's name to the last row.
std::string cost_table(const std::vector<MethodCost>& costs, const std::string& compiler);

}  // namespace passo
