// LatheCycle: the moves of a lathe cycle (G70 to G72) along a contour, as operations.
//
// LatheRoughing and LatheFinishing know where to cut, in the contour's own orientation and in the program's units.
// LatheCycle turns their moves into moves in work coordinates. A LatheCycle keeps the whole contour in memory.
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
  Point start;      // the tool's position; all axes but X and Z stay there
  double unit = 1;  // millimetres in one unit of the contour
  ArcTolerance tolerance = arc_tolerance_mm;
};

class LatheCycle final : public Cycle {
 public:
  LatheCycle(LathePlan plan, const OperationSource& source) : Cycle(plan.start, source), plan_(std::move(plan)) {}

  // Why the cycle broke off.
  LatheFault fault() const { return fault_; }
  // The motion code of the last move. As in LinuxCNC this code stays active after the cycle. Empty: there was no move.
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
