// PathBuilder: operations -> segments. Follows the frame, keeps geometry exact (no chords), checks the travel.
#pragma once

#include <string>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/path/segment.hpp"

namespace passo {

struct TravelLimit {
  double low = 0;
  double high = 0;
};

struct PathOptions {
  AxisSet axes;                 // the axes that the machine has
  PerAxis<TravelLimit> travel;  // machine coordinates
  Mm tolerance{0.01};           // of junctions, where the program gives none (G64 P)
  double spindle_limit = 0;     // fastest spindle, revolutions a minute; 0: no spindle speed is refused
  Point start;                  // machine position at the start
  std::string file;             // names the program in diagnostics
};

class PathBuilder final : public Source<PathItem> {
 public:
  PathBuilder(Source<Operation>& operations, const PathOptions& options, Diagnostics& diagnostics);

  [[nodiscard]] bool next(PathItem& item) override;

  const Frame& frame() const { return frame_; }

 private:
  Source<Operation>& operations_;
  const PathOptions& options_;
  Diagnostics& diagnostics_;
  Frame frame_;
};

}  // namespace passo
