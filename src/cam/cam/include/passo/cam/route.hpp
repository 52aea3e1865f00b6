// shorten_route: finds a short route from a start through all points to an end, or to whichever point is best.
//
// It begins with the nearest neighbour order; then applies 2-opt and Or-opt among the ten nearest neighbours of each
// point (Bentley's don't-look bits); then small random changes (segment insertion, Or-3opt), each kept if it shortens
// the route. All random numbers come from a fixed seed, and the work is counted in steps: the same points give the same
// order on every computer.
//
// Source: J. L. Bentley, Fast algorithms for geometric traveling salesman problems (1992); H. R. Lourenço, O. Martin,
// T. Stützle, Iterated local search (2003).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/drawing.hpp"

namespace passo {

// Returns the indices of `places` in a good order. `end`: empty: the route ends at any of the places. `steps`: the
// maximum number of distances evaluated and points moved, not counting the initial order, which needs about 100 per
// point.
std::vector<std::uint32_t> shorten_route(const std::vector<DrawnPoint>& places, DrawnPoint start,
                                         std::optional<DrawnPoint> end, std::uint64_t steps,
                                         const WorkProgress& progress = {});

// Returns the number of steps beyond which the route hardly improves: `a_place` for each point, fewer for few points.
std::uint64_t enough_steps(std::size_t places, std::uint64_t a_place);

// Returns the length of the route from the start through all points in this order to the end, in nanometres.
double route_length(const std::vector<DrawnPoint>& places, const std::vector<std::uint32_t>& order, DrawnPoint start,
                    std::optional<DrawnPoint> end);

}  // namespace passo
