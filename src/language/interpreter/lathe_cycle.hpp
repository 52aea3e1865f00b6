// LatheCycle: the moves of a lathe cycle (G70 to G72) along a contour, as operations.
//
// LatheRoughing and LatheFinishing compute the cuts, in the contour's own orientation and in the program's units.
// LatheCycle converts them to moves in work coordinates. It stores the whole contour.
#pragma once

#include <optional>
#include <variant>

#include "arc_center.hpp"
#include "code_table.hpp"
#include "cycle.hpp"
#include "lathe_moves.hpp"

namespace passo {

struct LathePlan {
  std::variant<LatheRoughing, LatheFinishing> cuts;
  Point start;      // tool position; all axes except X and Z stay there
  double unit = 1;  // millimetres per unit of the contour
  ArcTolerance tolerance = arc_tolerance_mm;
};

class LatheCycle final : public Cycle {
 public:
  LatheCycle(LathePlan plan, const OperationSource& source) : Cycle(plan.start, source), plan_(std::move(plan)) {}

  // Returns why the cycle was aborted.
  LatheFault fault() const { return fault_; }
  // Returns the motion code of the last move. As in LinuxCNC, this code stays active after the cycle. Empty: there was
  // no move.
  std::optional<CodeNumber> last_motion() const { return last_motion_; }

 private:
  bool step() override;
  LatheFault add(const LatheMove& move, const LatheOrientation& orientation);
  LatheFault add_arc(const LatheMove& move, const LatheOrientation& orientation, const Point& end);

  LathePlan plan_;
  LatheFault fault_ = LatheFault::none;
  std::optional<CodeNumber> last_motion_;
};

}  // namespace passo
