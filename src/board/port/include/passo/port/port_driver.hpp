// PortDriver: the computer's side of a parallel port: makes the register writes that put a machine's steps on the pins.
//
// A step takes three writes, each a pulse length after the one before: the direction (if it changes), the clock high,
// the clock low. So every level, and a direction before its edge, lasts as long as a pulse. Motors that step at the
// same time share their writes, as the bits of one register do. At time 0 all lines are set low.
//
// The steps come in order of time. The time from one step of a motor to its next must be at least two pulse lengths.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <vector>

#include "passo/port/parallel_port.hpp"

namespace passo {

inline constexpr std::size_t port_axes = 3;  // X, Y, Z: motors 0, 1, 2

// The pins of the signals. All of them are outputs: 1 to 9, 14, 16, 17.
struct PortPins {
  std::array<int, port_axes> clock = {2, 3, 4};
  std::array<int, port_axes> direction = {5, 6, 7};
  int tool = 8;
};

// From `at` on the register has this value. Times are in nanoseconds, from the same zero as the steps.
struct PortWrite {
  std::int64_t at = 0;
  ParallelPort::Register to = ParallelPort::Register::data;
  std::uint8_t value = 0;
  friend bool operator==(const PortWrite&, const PortWrite&) = default;
};

class PortDriver {
 public:
  // `pulse`: the pulse length, in nanoseconds.
  explicit PortDriver(std::int64_t pulse, const PortPins& pins = {});

  // Adds a step of the motors in `stepped`, as bits; those that are also in `down` step downwards, with the direction
  // line high. Motors beyond the third have no line.
  void step(std::int64_t at, unsigned stepped, unsigned down);
  // Switches the tool's line.
  void switch_tool(std::int64_t at, bool on);
  // Takes the writes before `end`, in order of time. Later steps must not be earlier than `end`.
  std::vector<PortWrite> take(std::int64_t end);

 private:
  struct Change {
    std::int64_t at = 0;
    int pin = 0;
    bool high = false;
  };
  void add(const Change& change);

  std::int64_t pulse_;
  PortPins pins_;
  ParallelPort port_;  // after the writes that were taken
  std::array<bool, port_axes> down_{};
  std::deque<Change> changes_;  // in order of time
};

}  // namespace passo
