// plan_drilling: which tool makes which hole of the drawings, in which order, and where each tool goes.
//
// A hole goes to the drill of the rack that is nearest to its diameter, within the tolerance. Without a rack each
// diameter has a drill of its own; with one drill that drill makes every hole. With a milling cutter, wide holes are
// milled in circles and slots along their sides; without, slots are drilled as rows of holes. A hole or slot that
// nothing can make is an error: no hole is lost without a word.
//
// Holes at one place (a pad and its drill, a hole in two files) become one: the narrowest. The order of a tool's holes
// is shortened by shorten_route() from the park place and back to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/drawing.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct DrillOptions {
  std::vector<Nanometres> rack = {};         // diameters of the drills at hand; empty: one for each diameter
  Nanometres tolerance{50'000};              // between a hole and its drill
  std::optional<Nanometres> one_drill = {};  // this drill makes every hole and slot
  std::optional<Nanometres> mill = {};       // diameter of the milling cutter
  DrawnPoint park = {};                      // where the tool is at the start, at tool changes and at the end
  std::uint64_t route_steps = 200'000'000;   // work of shorten_route() on each tool, at most
};

// What one tool makes at one place.
struct DrillTarget {
  enum class Kind : std::uint8_t {
    hole,    // drilled at points.front()
    circle,  // milled about points.front(), `radius` from there to the middle of the cutter
    slot     // milled along points, the middle of the cutter; closed where `radius` is not 0: a straight slot's sides
  };
  Kind kind = Kind::hole;
  std::vector<PathPoint> points = {};
  Nanometres radius = {};
};

struct DrillTool {
  Nanometres diameter = {};
  bool is_mill = false;
  std::vector<DrillTarget> targets = {};  // in the order in which they are made
  std::size_t holes = 0;                  // drilled or milled
  std::size_t slots = 0;
  double rapids_before_nm = 0;  // the way of the rapids in the files' order, from the park place and back
  double rapids_after_nm = 0;
};

struct DrillPlan {
  std::vector<DrillTool> tools = {};    // drills from thin to thick, then the milling cutter
  std::vector<std::string> notes = {};  // what was changed or left out, a sentence each without a full stop
};

// Errors "drill.…" are in `diagnostics`.
DrillPlan plan_drilling(const std::vector<Drawing>& drawings, const DrillOptions& options, Diagnostics& diagnostics,
                        const WorkProgress& progress = {});

}  // namespace passo
