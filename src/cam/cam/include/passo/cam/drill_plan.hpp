// plan_drilling: assigns the holes of the drawings to tools and optimises the order of each tool's holes.
//
// A hole is assigned to the drill of the rack that is closest to its diameter, within the tolerance. Without a rack
// each diameter gets its own drill; with `one_drill` that drill makes every hole. With a milling cutter, large holes
// are milled in circles, and slots along their sides; without one, slots are drilled as rows of holes. A hole or slot
// that no tool can make is an error: no hole is dropped silently.
//
// Holes at the same position (a pad and its drill, the same hole in two files) become one hole of the smallest
// diameter. The route of each tool is optimised by shorten_route(), from the park position and back to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/drawing.hpp"
#include "passo/cam/route_link.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct DrillOptions {
  std::vector<Nanometres> rack = {};         // diameters of the available drills; empty: one drill per diameter
  Nanometres tolerance{50'000};              // maximum difference between the diameters of a hole and its drill
  std::optional<Nanometres> one_drill = {};  // this drill makes every hole and slot
  std::optional<Nanometres> mill = {};       // diameter of the milling cutter
  // Of a job file, which chooses holes for a tool: a hole that is not wider than `mill` is an error instead of being
  // drilled, and holes with another diameter than `one_drill` are warned about.
  bool in_job = false;
  DrawnPoint park = {};  // tool position at the start, at tool changes and at the end
  RouteLink link = {};
  std::uint64_t route_steps = 200'000'000;  // maximum number of steps of shorten_route() per tool
};

// What one tool makes at one position.
struct DrillTarget {
  enum class Kind : std::uint8_t {
    hole,    // drilled at points.front()
    circle,  // milled about points.front(); `radius`: from there to the cutter centre
    slot     // milled along points, the path of the cutter centre; closed if `radius` is not 0 (a straight slot's
             // sides)
  };
  Kind kind = Kind::hole;
  std::vector<PathPoint> points = {};
  Nanometres radius = {};
};

struct DrillTool {
  Nanometres diameter = {};
  bool is_mill = false;
  std::vector<DrillTarget> targets = {};  // in machining order
  std::size_t holes = 0;                  // number of holes, drilled or milled
  std::size_t slots = 0;
  // The length of the rapids in file order, with the ways to the first target and from the last.
  double rapids_before_nm = 0;
  double rapids_after_nm = 0;
};

struct DrillPlan {
  std::vector<DrillTool> tools = {};    // drills by ascending diameter, then the milling cutter
  std::vector<std::string> notes = {};  // changes and omissions, each a sentence without a full stop
};

// Reports errors "drill.…" in `diagnostics`.
DrillPlan plan_drilling(const std::vector<Drawing>& drawings, const DrillOptions& options, Diagnostics& diagnostics,
                        const WorkProgress& progress = {});

}  // namespace passo
