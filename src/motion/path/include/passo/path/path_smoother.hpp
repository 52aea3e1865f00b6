// PathSmoother: rounds the path within its tolerance, so that the machine can pass without stopping.
//
// Place on the street: between the path builder and the planner. Segments that may be passed without stopping make a
// run, which goes from rest to rest. First, lines that are straight within the merge tolerance become one line, and the
// rounded chords of a curve become the curve again. Then the junctions of a run are rounded, over as long a way as the
// tolerance allows. Long lines and arcs between junctions stay lines and arcs, shortened to what is left. The
// result is lines, arcs and cubics (Curve::cubic). Actions pass unchanged.
//
// Invariants: at every s the smoothed path is within the tolerance of the programmed one, over all nine axes,
// millimetres and degrees alike. Segments join bit for bit. Within a run dP/ds and d²P/ds² are continuous, and the last
// segment of a run has the mode exact_stop. The result does not depend on how it is pulled. Memory is bounded: 256
// knots, of 64 pieces each at most, and 512 lines. Time: about a microsecond a segment, half as much again where the
// bend is to change slowly. See docs/decisions/0013.
#pragma once

#include <cstdint>
#include <memory>

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

// What the tolerance is used for. Least bending is best where the acceleration is limited, because the acceleration in
// a bend is p'' v². Where the jerk is limited, the bend must change slowly too, because the jerk is p''' v³.
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
