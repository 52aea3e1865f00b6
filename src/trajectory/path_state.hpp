// PathState: the state of a motion at a place on a segment of the path. Private to trajectory/.
#pragma once

#include <cstdint>

namespace passo {

struct PathState {
  std::uint64_t segment = 0;  // its number in PathAhead
  double s = 0;               // mm along its curve
  double speed = 0;           // mm/s
  double acceleration = 0;    // mm/s²
};

}  // namespace passo
