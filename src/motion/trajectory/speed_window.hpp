// The entry and exit speeds of a cell: two linear programs in the squares x, y of the speeds at its ends. Private to
// trajectory/.
//
//     y ^      exit demands          Each demand |p x + q y| <= limit is a strip around the origin. The intersection
//       |.    .                      of the strips and [0, X] x [0, Y] is convex and contains the origin. Backwards:
//     Y +-.--+-------+               find the largest x in it. Forwards: the largest y for a given x. (Pham, Pham 2018)
//       |  . |########.
//       |   .|#########.  entry demands
//       +----+----------.---> x
//
// About 20 ns with three axes if braking is the limit, 60 ns if a corner of the region is.
#pragma once

#include <span>

#include "cell.hpp"

namespace passo {

// Returns the largest x <= X for which some y <= Y satisfies all demands.
double largest_entry(std::span<const AxisDemand> demands, double entry_most, double exit_most);

// Returns the largest y <= Y for this x, which should be at most largest_entry(). For a larger x, returns the smallest
// possible y.
double largest_exit(std::span<const AxisDemand> demands, double entry, double exit_most);

// Returns the smallest possible y, by the hardest deceleration.
double least_exit(std::span<const AxisDemand> demands, double entry);

// Returns a deceleration from this x to a stop that all demands allow, wherever in the cell of this length the stop is.
// 0 or less: no such deceleration is certain.
double sure_deceleration(std::span<const AxisDemand> demands, double length, double entry);

// The same for limits that fall with the speed, by iteration. Each step is a linear program as above, with the line of
// each curve that is the highest at the last speed found. Each line is within its curve, so each solution is feasible.
//
// Backwards, the demands keep the lines of the best solution. With these lines the forward pass always finds a
// solution.
double largest_entry(std::span<const AxisDemand> demands, std::span<FallingDemand> falling, double entry_most,
                     double exit_most);

// `top` is the maximum of the cell. Where the limits decide, the result does not depend on `exit_most`.
double largest_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry,
                    double exit_most, double top);
double least_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry);
double sure_deceleration(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double length,
                         double entry);

// The distance that the motion covers in a cell, and the squared speed after it.
struct Ride {
  double way = 0;
  double exit = 0;
};
// Decelerates to a stop within the cell if possible, otherwise passes the cell as slowly as possible.
Ride hardest_braking(const Cell& cell, std::span<const AxisDemand> demands, std::span<const FallingDemand> falling,
                     double entry);

// The data of a cell when it is executed: its length, the squared speeds at both ends, and its maximum.
struct CellRide {
  double length = 0;
  double entry = 0;
  double exit = 0;
  double top = 0;
};
// Whether a linear v² from entry to exit takes noticeably longer than rising above both ends, with an acceleration that
// all demands certainly allow. Divided into two halves the cell takes less time.
bool is_too_long(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, const CellRide& ride);

}  // namespace passo
