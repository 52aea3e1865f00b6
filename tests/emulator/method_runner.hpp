// MethodRunner: lets the emulated chip play an order, and tells the result and the cost of each pulse. The host plays
// the same order with the same code, for comparison.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "emulator/methods.hpp"

#include "passo/emulator/emulated_chip.hpp"

namespace passo {

// The bytes of all pulses or intervals, in the order in which they are made.
using Output = std::vector<std::uint8_t>;

struct MethodRun {
  Output output;
  std::uint64_t begin = 0;            // cycles: from the order to the first pulse
  std::vector<std::uint64_t> pulses;  // cycles of each: call, next(), the result to the ports, return
};

class MethodRunner {
 public:
  explicit MethodRunner(const std::string& program);
  MethodRun play(const Order& order);

  // Cycles between two marks with nothing between them. All figures are without these cycles.
  std::uint64_t cost_of_marks() const { return cost_of_marks_; }

 private:
  std::uint8_t next_byte();
  void mark();

  EmulatedChip chip_;
  std::vector<std::uint8_t> order_;
  std::size_t read_ = 0;
  Output output_;
  std::vector<std::uint64_t> marks_;
  std::uint64_t cost_of_marks_ = 0;
};

Output play_on_host(const Order& order);

struct MethodName {
  std::string name;
  MethodKind kind = MethodKind::line;
  int axes = 0;
  int bits = 0;
};
// By number. No two are alike.
std::vector<MethodName> method_names();

}  // namespace passo
