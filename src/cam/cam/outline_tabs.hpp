// tab_places: places tabs along a closed toolpath. Private to cam/.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "closed_toolpath.hpp"

namespace passo {

struct TabSize {
  Nanometres width = {};   // of the material that remains
  Nanometres height = {};  // above the full depth
  Nanometres cutter = {};  // its diameter
};

struct SpreadTabs {
  std::vector<double> middles = {};  // lengths along the track
  double wide_nm = 0;                // stretch of the track that each tab takes
};

// Spreads `wanted` tabs evenly, on straight pieces where they fit. If the track is too short for all of them, it gets
// fewer, but at least one; the only tab of a short track may be narrower.
SpreadTabs spread_tabs(const ClosedToolpath& track, std::uint32_t wanted, const TabSize& size);

// Keeps the cutter above these tabs, and returns their middles on the track.
std::vector<DrawnPoint> put_tabs_on(ClosedToolpath& track, const SpreadTabs& tabs, const TabSize& size,
                                    Nanometres depth);

// Returns a note about a track that gets fewer tabs than wanted. Empty: there is no need for one.
std::string fewer_tabs_words(const ClosedToolpath& track, std::uint32_t wanted, const SpreadTabs& tabs);

// Returns a note about tabs that are likely to break. Empty: there is no need for one.
std::string thin_tabs_words(const TabSize& size, Nanometres depth);

}  // namespace passo
