// PathSmoother: rounds the path within its tolerance, so that the machine can pass without stopping.
//
// Position in the pipeline: between the path builder and the planner. Segments that may be passed without stopping form
// a run, which reaches from one stop point to the next. First, lines that are straight within the merge tolerance
// become one line, and the rounded chords of a curve become the curve again. Then the junctions of a run are rounded,
// over the longest distance that the tolerance allows. Long lines and arcs between junctions stay lines and arcs,
// shortened accordingly. The result consists of lines, arcs and cubics (Curve::cubic). Actions pass unchanged.
//
// Invariants: at every s the smoothed path is within the tolerance of the programmed one, over all nine axes. A degree
// counts as much as tolerance / turn_tolerance millimetres (Segment). The end of each segment is bit-identical to the
// start of the next. Within a run dP/ds and d²P/ds² are continuous, and the last segment of a run has the mode
// exact_stop. The result does not depend on when items are pulled. Memory is bounded: 256 knots, of at most 64 pieces
// each, and 512 lines. Time: about 1 µs per segment, 1.5 µs with slow_bending. See docs/decisions/0013.
#pragma once

#include <cstdint>
#include <memory>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

// How the tolerance is used. The least curvature is best if only the acceleration is limited, because the acceleration
// in a curve is p'' v². If the jerk is limited, the curvature must change slowly too, because the jerk is p''' v³.
enum class Smoothness : std::uint8_t { least_bending, slow_bending };

class PathSmoother final : public Source<PathItem> {
 public:
  // `share`: of each tolerance, above 0 and at most 1. The smoothed path deviates by at most this fraction of it, which
  // is also the tolerance of the smoothed segments.
  explicit PathSmoother(Source<PathItem>& path, Smoothness smoothness = Smoothness::least_bending, double share = 1);
  ~PathSmoother() override;

  [[nodiscard]] bool next(PathItem& item) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace passo
