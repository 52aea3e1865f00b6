// Invariants of every diagnostic and every layer of a board, whatever the input bytes were.
#pragma once

#include <cmath>

#include "kit/require.hpp"

#include "passo/cam/design_board.hpp"
#include "passo/cam/gerber.hpp"

namespace passo::test {

inline void check_findings(const Diagnostics& findings) {
  for (const Diagnostic& finding : findings.all()) {
    require(!finding.code.empty() && !finding.message.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
}

inline void check_within(DrawnPoint at) {
  const std::int64_t limit = farthest_of_region.count;
  require(std::abs(at.x.count) <= limit && std::abs(at.y.count) <= limit, "too far");
}

inline void check_layer(const GerberLayer& layer) {
  for (const DrawnRing& ring : layer.dark.rings) {
    require(ring.size() >= 3, "a ring of fewer than three points");
    for (const DrawnPoint& point : ring) check_within(point);
  }
  require(area_mm2(layer.dark) >= 0, "an area below 0");
  for (const GerberPad& pad : layer.pads) {
    require(pad.aperture < layer.apertures.size() && pad.net < layer.nets.size(), "a wrong pad");
  }
  require(layer.strokes.layers.size() == layer.apertures.size(), "a layer for each aperture");
  for (const DrawnPath& path : layer.strokes.paths) {
    require(path.points.size() >= 2 && path.layer < layer.strokes.layers.size(), "a wrong stroke");
    for (const PathPoint& point : path.points) require(std::isfinite(point.bulge), "a bulge that is not finite");
  }
}

inline void check_board(const DesignBoard& board) {
  for (const DesignLayer& one : board.copper) check_layer(one.layer);
  check_layer(board.edge);
  for (const DrawnHole& hole : board.drills.holes) {
    check_within(hole.at);
    require(hole.diameter.count > 0 && hole.layer < 2, "a wrong hole");
  }
}

}  // namespace passo::test
