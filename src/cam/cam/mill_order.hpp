// order_ways: turns loops and open paths into runs of the cutter: determines their order, their start points, and where
// the cutter need not lift. Private to cam/.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "arc_fit.hpp"

#include "passo/base/work_progress.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"

namespace passo {

// A path of the cutter at depth. A closed path may begin at any of its points; the last point leads back to the first.
// An open path begins at its first point or, if it may be reversed, at either end.
struct CutterWay {
  DrawnRing points = {};
  bool is_closed = true;
  bool may_be_turned = false;
  bool is_exact = false;  // its chords are no rounded corners of an offset
};

struct WayOrder {
  DrawnPoint start = {};               // where the cutter comes from
  std::optional<DrawnPoint> end = {};  // where it goes; empty: it stays at the end of the last way
  Nanometres z = {};
  std::uint64_t route_steps = 0;
  ArcFit arcs = {};
  // Returns whether the cutter may go straight from one point to the other at depth.
  std::function<bool(DrawnPoint, DrawnPoint)> may_link = {};
};

std::vector<MillRun> order_ways(const std::vector<CutterWay>& ways, const WayOrder& order,
                                const WorkProgress& progress = {});

}  // namespace passo
