// PendantStatus: what clients see of the pendant of this computer.
#pragma once

#include <optional>
#include <string>

#include "passo/base/sentence.hpp"
#include "passo/geometry/axes.hpp"

namespace passo {

struct PendantStatus {
  std::string name;  // empty: no pendant has been connected yet
  bool is_connected = false;
  bool has_link = false;          // a wireless pendant is switched on and within reach
  std::optional<Axis> axis = {};  // the selected one
  bool is_continuous = false;
  double step = 0;   // of a detent, mm or degrees; 0: none is selected
  double share = 0;  // of the highest speed, in continuous mode
  int missed = 0;    // edges that the board's handwheel has missed
  Sentence refusal;  // why the last action was refused; empty: it was not

  friend bool operator==(const PendantStatus&, const PendantStatus&) = default;
};

}  // namespace passo
