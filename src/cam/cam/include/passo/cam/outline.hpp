// plan_outline: cuts boards out, and the openings in them.
//
// The middle of the cutter goes around the board and along its openings, half the cutter's width away from what stays.
// What lies inside is cut before what lies around. The cut goes down in even steps. Corners and arcs that the edge has
// are arcs of the cutter's way.
//
// Tabs hold the board: there the cutter stays at a height above the full depth. By number they are spread evenly along
// each board's outside, on straight edges where there are some; by place they are put at the nearest place of any cut.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/cam/edge_loops.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct OutlineOptions {
  Nanometres cutter{2'000'000};  // diameter
  std::string words = {};        // for the operator
  Nanometres depth{-1'800'000};  // below the board's face, negative
  Nanometres step{500'000};      // how deep a turn goes, at most
  std::uint32_t tabs = 0;        // around each board
  std::vector<DrawnPoint> tab_places = {};
  Nanometres tab_width{2'000'000};  // that stays
  Nanometres tab_height{600'000};   // above the full depth
  double ramp_degrees = 0;          // how steep the cutter goes down along its way; 0: straight down
  Nanometres lead{};                // radius of the arc by which the cutter comes to the edge; 0: none
  bool dog_bones = false;           // inner corners are cut so far that a sharp corner fits in
  bool climb = true;                // with a spindle that turns clockwise; else conventional
  bool openings_only = false;       // the outsides are left; tabs hold what falls out of the openings
  bool skips_narrow = false;        // an opening narrower than the cutter is a warning, and stays; else an error
  DrawnPoint park = {};
};

struct OutlinePlan {
  MillPlan mill = {};
  std::size_t outsides = 0;
  std::size_t openings = 0;
  std::vector<DrawnPoint> tabs = {};  // their middles, of the cutter's way
  std::vector<DrawnRing> ways = {};   // where the middle of the cutter goes, each way once, on chords
  double lost_mm2 = 0;                // of the board, by a sweep of the cutter; dog-bones take a little
};

// Errors "outline.…" are in `diagnostics`.
OutlinePlan plan_outline(const Region& board, const OutlineOptions& options, Diagnostics& diagnostics);

}  // namespace passo
