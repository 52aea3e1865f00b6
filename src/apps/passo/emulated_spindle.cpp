#include "emulated_spindle.hpp"

#include <memory>

#include "passo/emulator/emulated_board.hpp"
#include "passo/machine/virtual_spindle.hpp"

namespace passo {

void fit_emulated_spindle(const SpindleDescription& spindle, BoardPort* board) {
  auto* const emulated = dynamic_cast<EmulatedBoard*>(board);
  if (emulated == nullptr || spindle.counts_per_turn == 0) return;
  const auto turning = std::make_shared<VirtualSpindle>(SpindleModel{.counts_per_turn = spindle.counts_per_turn,
                                                                     .run_up = spindle.run_up.value(),
                                                                     .droop = spindle.droop,
                                                                     .ripple = spindle.ripple,
                                                                     .ripple_rate = spindle.ripple_rate.value()});
  // A board without pins for an encoder says so itself.
  static_cast<void>(
      emulated->fit_spindle({.pulses_per_turn = spindle.counts_per_turn,
                             .command = [turning](Seconds time, double rpm) { turning->command(time, rpm); },
                             .turns = [turning](Seconds time) { return turning->turns_at(time); }}));
}

}  // namespace passo
