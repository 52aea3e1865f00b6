// EmulatedEncoder: an encoder on the pins T5 and ICP4 of an ATmega2560. Its pulses clock timer 5, and timer 4 captures
// its index. The class replaces simavr's timers 4 and 5, because simavr's timer 5 would check its pin only once in each
// of its own cycles.
//
// As on the real chip, reading the count's low byte latches the high byte. A captured index sets a flag, and a further
// index is lost while the flag is set. Pulses count up in whichever direction the shaft turns.
#pragma once

#include <cstdint>
#include <functional>

namespace passo {

class EmulatedChip;

class EmulatedEncoder {
 public:
  // Returns the shaft's total revolutions at a cycle. The value must never decrease.
  using Turns = std::function<double(std::uint64_t cycle)>;
  EmulatedEncoder(EmulatedChip& chip, int pulses_per_turn, Turns turns);
  EmulatedEncoder(const EmulatedEncoder&) = delete;

  // Returns the number of pulses up to `cycle`.
  std::uint64_t pulses_at(std::uint64_t cycle) const;

 private:
  void set_clock(std::uint8_t control);
  std::uint16_t count() const;
  std::uint64_t indexes() const;

  EmulatedChip& chip_;
  int pulses_per_turn_;
  Turns turns_;
  bool counts_ = false;
  std::uint64_t counted_from_ = 0;
  std::uint64_t seen_indexes_ = 0;
  std::uint8_t temp_ = 0;
};

}  // namespace passo
