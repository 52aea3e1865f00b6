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
// 256 knots, of 64 segments each at most. Time: about a microsecond a segment, half as much again where the bend is to
// change slowly. See docs/decisions/0013.
#pragma once

#include <cstdint>
#include <memory>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

// What the tolerance is used for. Least bending is best where the acceleration is limited, which is p'' v² in a bend.
// Where the jerk is limited, which is p''' v³, the bend is to change slowly too.
enum class Smoothness : std::uint8_t { least_bending, slow_bending };

class PathSmoother final : public Source<PathItem> {
 public:
  explicit PathSmoother(Source<PathItem>& path, Smoothness smoothness = Smoothness::least_bending);
  ~PathSmoother() override;

  [[nodiscard]] bool next(PathItem& item) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
