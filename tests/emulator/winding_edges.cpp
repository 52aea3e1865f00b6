#include "emulator/winding_edges.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace passo {
namespace {

using Patterns = std::vector<std::string>;  // F1 F2 F3 F4, step by step upwards

const Patterns& patterns_of(DriveMode drive) {
  static const Patterns two_on = {"1100", "0110", "0011", "1001"};
  static const Patterns wave = {"1000", "0100", "0010", "0001"};
  static const Patterns half_step = {"1100", "0100", "0110", "0010", "0011", "0001", "1001", "1000"};
  return drive == DriveMode::two_on ? two_on : drive == DriveMode::wave ? wave : half_step;
}

// Ports are written one after the other: what comes within so many cycles is one step.
constexpr std::uint64_t one_step = 40;

}  // namespace

WindingEdges winding_edges(const MotorPins& motor, const std::vector<PortChange>& changes, int& place) {
  WindingEdges edges;
  const Patterns& patterns = patterns_of(motor.drive);
  const int count = static_cast<int>(patterns.size());
  std::array<std::uint8_t, 256> levels = {};
  std::array<bool, 256> known = {};
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  const auto settle = [&] {
    if (first == 0) return;
    std::string pattern;
    for (const Pin pin : motor.windings) {
      pattern += (levels[static_cast<std::uint8_t>(pin.port)] & pin.mask()) != 0 ? '1' : '0';
    }
    if (pattern == "0000") {  // switched off: the place stays
      first = 0;
      return;
    }
    const int up = (place + 1) % count;
    const int down = (place + count - 1) % count;
    const bool went_up = pattern == patterns[static_cast<std::size_t>(up)];
    if (!went_up && pattern != patterns[static_cast<std::size_t>(down)]) ++edges.wrong;
    place = went_up ? up : down;
    edges.steps.push_back({.cycle = first, .down = !went_up});
    edges.apart = std::max(edges.apart, static_cast<std::int64_t>(last - first));
    first = 0;
  };
  // As each port was before its first change.
  for (const PortChange& change : changes) {
    const auto port = static_cast<std::uint8_t>(change.port);
    if (!known[port]) levels[port] = change.before;
    known[port] = true;
  }
  for (const PortChange& change : changes) {
    if (first != 0 && change.cycle > first + one_step) settle();
    levels[static_cast<std::uint8_t>(change.port)] = change.now;
    const unsigned turned_over = change.before ^ change.now;
    if ((turned_over & motor.winding_bits(change.port)) == 0) continue;
    if (first == 0) first = change.cycle;
    last = change.cycle;
  }
  settle();
  return edges;
}

}  // namespace passo
