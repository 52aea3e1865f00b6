// EmulatedEncoder: an encoder on the pins T5 and ICP4 of an ATmega2560. The encoder's pulses clock timer 5, and timer 4
// captures its index. The class replaces simavr's timers 4 and 5, because simavr's timer 5 would check its pin only
// once in each of its own cycles.
//
// As in silicon, the count's high byte is from the moment at which its low byte was read. A captured index waits in its
// flag, and an index that comes while the flag is set is lost. Pulses count up in whichever direction the shaft turns.
#pragma once

#include <cstdint>
#include <functional>

namespace passo {

class EmulatedChip;

class EmulatedEncoder {
 public:
  // How many turns the shaft has made at a cycle. The result may never be less than before.
  using Turns = std::function<double(std::uint64_t cycle)>;
  EmulatedEncoder(EmulatedChip& chip, int pulses_per_turn, Turns turns);
  EmulatedEncoder(const EmulatedEncoder&) = delete;

  // How many pulses have come by `cycle` since the shaft began to turn.
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
