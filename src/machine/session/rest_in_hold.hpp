// RestInHold: what is due when a held program comes to rest: the rest is reported once, and the outputs are switched
// off if the hold is for a door. Private to session/.
#pragma once

#include <utility>

namespace passo {

class RestInHold {
 public:
  // Somebody asks for a hold. Also a program that rests already reports its rest to him.
  void hold(bool for_door) {
    stops_outputs_ = stops_outputs_ || for_door;
    is_reported_ = false;
  }
  void resume() { stops_outputs_ = false; }
  // Call in each turn. True: the program has come to rest, which is to be reported now.
  [[nodiscard]] bool begins(bool rests) { return !std::exchange(is_reported_, rests) && rests; }
  // Call at rest. True, once: the outputs are to be switched off now.
  [[nodiscard]] bool take_stop_of_outputs() { return std::exchange(stops_outputs_, false); }

 private:
  bool is_reported_ = false;
  bool stops_outputs_ = false;
};

}  // namespace passo
