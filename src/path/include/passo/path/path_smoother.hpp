// PathSmoother: rounds the path within its tolerance, so that it can be passed without stopping.
//
// Between the path builder and the planner. Segments that may be passed without stopping make a run: from rest to
// rest. In a run junctions are rounded, over as long a way as the tolerance allows; long lines and arcs between them
// stay what they are, cut to what is left. Lines that are straight within the merge tolerance become one before.
// Segments come out as lines, arcs and cubics (Curve::cubic); actions unchanged.
//
// Invariants: at every s the smoothed path is within the tolerance of the programmed one, over all nine axes,
// millimetres and degrees alike. Segments join bit for bit. Within a run dP/ds and d²P/ds² go on without a jump; the
// segment at its end has the mode exact_stop. What comes out does not depend on how it is pulled. Memory is bounded:
// 128 knots, of 64 segments each at most. Time: about a microsecond a segment. See docs/decisions/0013.
#pragma once

#include <memory>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class PathSmoother final : public Source<PathItem> {
 public:
  explicit PathSmoother(Source<PathItem>& path);
  ~PathSmoother() override;

  [[nodiscard]] bool next(PathItem& item) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
