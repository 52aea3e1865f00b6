// StopInHold: the actions when a held program stops: the stop is reported once, and the outputs are switched off if the
// hold is for a door. Private to session/.
#pragma once

#include <utility>

namespace passo {

class StopInHold {
 public:
  // Records a hold request. A program that is already stopped reports its stop for the new request, too.
  void hold(bool for_door) {
    stops_outputs_ = stops_outputs_ || for_door;
    is_reported_ = false;
  }
  void resume() { stops_outputs_ = false; }
  // Call in each pass. Returns true if the program has stopped, which must be reported now.
  [[nodiscard]] bool begins(bool rests) { return !std::exchange(is_reported_, rests) && rests; }
  // Call at standstill. Returns true once, if the outputs must be switched off now.
  [[nodiscard]] bool take_stop_of_outputs() { return std::exchange(stops_outputs_, false); }

 private:
  bool is_reported_ = false;
  bool stops_outputs_ = false;
};

}  // namespace passo
