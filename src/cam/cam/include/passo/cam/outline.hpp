// plan_outline: plans cutting boards out, including their cutouts.
//
// The cutter centre follows the outline and the cutouts at half the cutter diameter from the board. Inner contours are
// cut before the contours around them. The depth is divided into equal passes. Corners and arcs of the edge become arcs
// of the toolpath.
//
// Tabs hold the board: at a tab the cutter stays above the full depth. Tabs given by number are spread evenly along
// each contour, on straight edges if possible; if the contour is too short for all of them, it gets as many as fit. In
// an opening they hold the slug; a slug narrower than `least_slug` is milled away instead. Tabs given by position are
// placed at the nearest point of any cut.
//
// Gaps exactly as wide as the cutter are cut along their centre line in one pass; holes by a plunge.
//
// With an allowance each contour is roughed at a distance, and then finished by one lap at full depth, which begins and
// ends within the slot that roughing cut.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/cam/edge_loops.hpp"
#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

inline constexpr Nanometres least_slug{3'000'000};

struct OutlineOptions {
  Nanometres cutter{2'000'000};  // cutter diameter
  std::string words = {};        // tool name for the operator
  Nanometres depth{-1'800'000};  // final depth below the board's surface, negative
  Nanometres step{500'000};      // maximum depth per pass
  std::uint32_t tabs = 0;        // number of tabs on each contour
  std::vector<DrawnPoint> tab_places = {};
  Nanometres tab_width{2'000'000};    // width of the material that remains
  Nanometres tab_height{600'000};     // height of the tabs above the full depth
  double ramp_degrees = 0;            // ramp angle of the descent along the toolpath; 0: straight down
  Nanometres lead{};                  // radius of the lead-in arc; 0: none
  bool dog_bones = false;             // overcuts inner corners so that a sharp corner fits in
  Nanometres allowance{};             // stock that roughing leaves on the contour
  bool finishes = false;              // cuts the allowance in one lap at full depth
  std::uint32_t spring_passes = 0;    // additional laps without stock
  bool climb = true;                  // climb milling, for a clockwise spindle; otherwise conventional
  bool openings_only = false;         // cuts no outer contours
  std::vector<DrawnRing> slots = {};  // lines on which the middle of the cutter makes slots as wide as it is
  bool skips_narrow = false;  // an opening narrower than the cutter is skipped with a warning; otherwise an error
  DrawnPoint park = {};
  RouteLink link = {};
};

struct OutlinePlan {
  MillPlan mill = {};
  std::size_t outsides = 0;
  std::size_t openings = 0;
  std::size_t slots = 0;
  std::size_t tight = 0;              // number of cuts exactly as wide as the cutter
  std::size_t finished = 0;           // number of contours with a finishing pass
  std::size_t unfinished = 0;         // number of contours cut without an allowance, for lack of room
  std::vector<DrawnPoint> tabs = {};  // tab centres on the path of the cutter centre
  std::vector<DrawnRing> ways = {};   // paths of the cutter centre as chords, each once
  double lost_mm2 = 0;                // board area lost according to a sweep of the cutter; dog-bones cause a small
                                      // loss
};

// Reports errors "outline.…" in `diagnostics`. Slots are cut first.
OutlinePlan plan_outline(const Region& board, const OutlineOptions& options, Diagnostics& diagnostics);

}  // namespace passo
