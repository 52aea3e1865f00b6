// OutputSequencer: switches outputs while the machine is stopped, one after the other: first the spindle, then a wait
// for its run-up, then the coolant, whose output may open the collet of a tool changer. The steps are added to the
// drive's script.
#pragma once

#include "passo/drive/commanded_outputs.hpp"
#include "passo/drive/feed.hpp"
#include "passo/drive/host_spindle.hpp"
#include "passo/drive/script.hpp"
#include "passo/link/link.hpp"

namespace passo {

class OutputSequencer {
 public:
  struct Parts {
    CommandedOutputs& order;
    Feed& feed;
    const Link& link;
    Script& script;
    const HostSpindle* spindle = nullptr;
  };
  struct Times {
    Seconds not_before{0};      // the first pause ends at this time on the board's side
    Seconds spindle_wait{0};    // after the board had switched its outputs off
    Seconds spindle_run_up{0};  // from standstill to 1000 rpm; the wait is at least as long as the run-up
    Seconds coolant_wait{0};    // before motion continues, after the coolant
  };
  // All parts must outlive this object.
  OutputSequencer(const Parts& parts, const Times& times)
      : parts_(parts), times_(times), pause_end_(times.not_before) {}

  // Sends the commanded outputs to the board.
  void switch_as_ordered();
  void switch_off();
  void switch_on(const OutputState& outputs, Seconds spindle_wait);
  // Restores the outputs after the board had switched them off.
  void switch_on_again() { switch_on(parts_.order.ordered(), times_.spindle_wait); }
  // Switches on again what was stopped in a hold. If nothing was, only waits for the end of the pause.
  void let_go();
  // Stops the spindle alone, or starts it again.
  void stop_spindle(bool stands);
  // Call before a thread without an encoder: sets the spindle to the programmed speed before the thread begins.
  void hold_speed(const Action& action);

  void await_pause_end();
  // Null: the board's spindle.
  const HostSpindle* host_spindle() const { return parts_.spindle; }
  Seconds pause_end() const { return pause_end_; }

 private:
  void pause(Seconds time) { pause_end_ = parts_.link.now() + time; }
  void await_feed();

  Parts parts_;
  Times times_;
  Seconds pause_end_;  // on the board's side
};

}  // namespace passo
