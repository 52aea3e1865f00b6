// peel_runs: turns a peeled region into runs of the cutter, layer by layer. Private to cam/.
#pragma once

#include <vector>

#include "peel.hpp"

namespace passo {

struct PeelLayers {
  std::vector<Nanometres> floors = {};  // from above
  Nanometres rough_depth = {};          // floors below it are finished
  double ramp_degrees = 0;
};

// In each layer the cutter descends along the helix, or straight down, and follows all runs. Links are slightly lifted.
std::vector<MillRun> peel_runs(const PeelWay& way, const PeelLayers& layers);

// Returns the area that the cutter mills on the rims, and adds the laps along the walls to `laps`.
Region swept_rims(const PeelWay& way, Nanometres radius, std::vector<DrawnRing>& laps);

}  // namespace passo
