// plan_plot: plans drawing with a pen, or cutting with a drag knife.
//
// Each line is drawn once, in an order with short travels: an open line from either of its ends, a closed line from any
// of its points. A dot is a touch.
//
// The blade of a drag knife trails behind the axis on which it swivels, by its offset. The axis therefore moves ahead
// of the blade's tip, and at a corner it goes around the tip on an arc, so that the blade turns. Closed lines are cut a
// little beyond their start, and lines within a closed line before it. The direction of the blade follows from the
// previous line; at the start of the program the blade trails towards -X.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/cam/drawing.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {

struct PlotOptions {
  Nanometres knife{};                      // distance from the axis to the blade's tip; 0: a pen
  double swivel_degrees = 20;              // at corners that turn by more, the blade swivels on an arc
  bool inner_first = false;                // draws lines within a closed line before it; a knife always does
  Nanometres overcut{};                    // how far a closed line is cut beyond its start; only with a knife
  DrawnPoint park = {};                    // where the travels begin and end
  std::uint64_t route_steps = 20'000'000;  // maximum number of steps of shorten_route()
};

struct PlotPlan {
  // Paths of the pen or of the knife's axis, in order. A path of one point is a dot.
  std::vector<std::vector<PathPoint>> paths = {};
  std::size_t closed = 0;
  std::size_t open = 0;
  std::size_t dots = 0;
  double drawn_nm = 0;
  double travel_nm = 0;  // from the park position and back
};

// An open line of one point is a dot.
PlotPlan plan_plot(const EdgeLoops& lines, const PlotOptions& options);

// Removes the dots from a drawing, and returns them: its points, and its paths without a length.
std::vector<DrawnPoint> take_dots(Drawing& drawing);

}  // namespace passo
