// shorten_route: the order of places that makes the way through all of them short, from a start to an end.
//
// Nearest neighbour first; then 2-opt and Or-opt among the ten nearest neighbours of each place (Bentley's
// don't-look bits); then small random changes (segment insertion, Or-3opt), each kept if the way gets shorter. All
// random numbers come from one fixed seed, and the work is counted in steps: the same places give the same order on
// every machine.
//
// Source: J. L. Bentley, Fast algorithms for geometric traveling salesman problems (1992); H. R. Lourenço, O. Martin,
// T. Stützle, Iterated local search (2003).
#pragma once

#include <cstdint>
#include <vector>

#include "passo/base/work_progress.hpp"
#include "passo/cam/drawing.hpp"

namespace passo {

// The indices of `places` in a good order. `steps`: distances looked at and places moved, an upper bound but for the
// first order, which needs about 100 a place.
std::vector<std::uint32_t> shorten_route(const std::vector<DrawnPoint>& places, DrawnPoint start, DrawnPoint end,
                                         std::uint64_t steps, const WorkProgress& progress = {});

// More steps hardly shorten the route of so many places: `a_place` for each, and fewer where there are few.
std::uint64_t enough_steps(std::size_t places, std::uint64_t a_place);

// The way from the start through all places in this order to the end, in nanometres.
double route_length(const std::vector<DrawnPoint>& places, const std::vector<std::uint32_t>& order, DrawnPoint start,
                    DrawnPoint end);

}  // namespace passo
