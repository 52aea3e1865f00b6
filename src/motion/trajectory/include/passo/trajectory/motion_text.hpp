// Motion as text: one line for the segment of a move, and one line for each phase. Golden files use this form.
//
//   line 4: feed (X0.000000) to (X10.000000) length 10.000000 speed 20.000000 continuous 0.010000
//     t 0.040000 s 0.000000 v 0.000000 a 500.000000 j 0.000000
#pragma once

#include <string>

#include "passo/trajectory/phase.hpp"

namespace passo {

std::string to_text(const PlannedMove& move);
std::string to_text(const MotionItem& item);

}  // namespace passo
