// SafeChange: where a program starts, changes tools and ends, how long its spindle needs to reach its speed, and the
// coolant.
#pragma once

#include <string_view>

#include "passo/cam/drawing.hpp"

namespace passo {

struct SafeChange {
  // Z of the first and the last rapid, and of tool changes. A higher clearance height replaces it.
  Nanometres height{20'000'000};
  double spindle_seconds = 2;  // dwell after M3
  // Whether tools are changed, and whether the program ends, above the last cut instead of the park position.
  bool changes_in_place = false;
  bool ends_in_place = false;
  std::string_view coolant = {};  // M7 (mist) or M8 (flood); empty: off
};

}  // namespace passo
