// What the numbers of Grbl 1.1 mean: errors and alarms.
//
// Position in the pipeline: below both sides of the protocol, the sender (sender/) and the controller for senders
// (grbl/). Source: doc/csv and doc/markdown/interface.md of github.com/gnea/grbl.
#pragma once

#include <span>
#include <string_view>

namespace passo {

// The meaning of a number, as a clause.
struct GrblMeaning {
  int number = 0;
  std::string_view words;
};

std::span<const GrblMeaning> grbl_errors();
std::span<const GrblMeaning> grbl_alarms();

}  // namespace passo
