// The path as text, one item per line. Golden files use this form.
//
//   line 7: feed (X10.000000 Y2.000000) to (X20.000000 Y2.000000) length 10.000000 speed 20.000000 continuous 0.010000
//   line 8: dwell 0.500000; spindle clockwise 1000.000 mist on flood off
//
// An axis is shown if it moves or is not at 0. A rapid has no speed. Overrides that are disabled for the item (M48 to
// M53) are named at the end.
#pragma once

#include <string>

#include "passo/path/segment.hpp"

namespace passo {

std::string to_text(const Segment& segment);
std::string to_text(const Action& action);
std::string to_text(const PathItem& item);

}  // namespace passo
