// ProbeWatcher: the board's eye on its probe. Counts the motors' steps while it watches, and keeps them at the event at
// which the probe does what is waited for.
//
// The counts are written at events until then, and read by report() after: the two never meet. Portable: integers, no
// heap; nothing but a look at `watches()` for an event when nobody asks.
#pragma once

#include "passo/wire/probe.hpp"

namespace passo {

class ProbeWatcher {
 public:
  void begin(const ProbeWatch& watch, bool touched) {
    until_ = watch.until;
    report_ = ProbeReport{.touched = touched};
    owed_ = until_ != ProbeUntil::off;
  }
  bool watches() const { return until_ != ProbeUntil::off; }

  // After the steps of an event.
  void on_event(uint8_t stepped, uint8_t directions, bool touched) {
    uint8_t bit = 1;
    for (uint8_t motor = 0; stepped >= bit && motor < max_motors; ++motor, bit = static_cast<uint8_t>(bit << 1)) {
      if ((stepped & bit) != 0) report_.steps[motor] += (directions & bit) != 0 ? -1 : 1;
    }
    if (touched == report_.touched) return;
    report_.touched = touched;
    if (touched != (until_ == ProbeUntil::touched)) return;
    report_.happened = true;
    owed_ = true;
    until_ = ProbeUntil::off;
  }

  bool owes_report() const { return owed_; }
  const ProbeReport& take_report() {
    owed_ = false;
    return report_;
  }

 private:
  ProbeUntil until_ = ProbeUntil::off;
  bool owed_ = false;
  ProbeReport report_;
};

}  // namespace passo
