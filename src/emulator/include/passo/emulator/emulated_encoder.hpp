// EmulatedEncoder: an encoder on the pins T5 and ICP4 of an ATmega2560. Its pulses clock timer 5, its index is captured
// by timer 4. Stands in for simavr's timers there, of which timer 5 would look at its pin once a cycle of its own.
//
// As in silicon: the count's high byte is that of the moment at which its low one was read; a captured index waits in
// its flag, and one that comes while the flag is set is not told. Pulses count up, whichever way the shaft turns.
#pragma once

#include <cstdint>
#include <functional>

namespace passo {

class EmulatedChip;

class EmulatedEncoder {
 public:
  // How many turns the shaft has made at that cycle: never less than before.
  using Turns = std::function<double(std::uint64_t cycle)>;
  EmulatedEncoder(EmulatedChip& chip, int pulses_per_turn, Turns turns);
  EmulatedEncoder(const EmulatedEncoder&) = delete;

  // That have come at that cycle since the shaft began to turn.
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
