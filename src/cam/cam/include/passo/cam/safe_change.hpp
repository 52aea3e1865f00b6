// SafeChange: where a program starts, changes tools and ends, and how long its spindle needs to reach its speed.
#pragma once

#include "passo/cam/drawing.hpp"

namespace passo {

struct SafeChange {
  // Z of the first and the last rapid, and of tool changes. A higher clearance height replaces it.
  Nanometres height{20'000'000};
  double spindle_seconds = 2;  // dwell after M3
};

}  // namespace passo
