// The entry and exit speeds of a cell: two linear programs in the squares x, y of the speeds at its ends. Private to
// trajectory/.
//
//     y ^      exit demands          Each demand |p x + q y| <= limit is a stripe about the origin. What the stripes
//       |.    .                      leave of the rectangle [0, X] x [0, Y] is convex and holds the origin. Backwards:
//     Y +-.--+-------+               find the largest x in it. Forwards: the largest y for a given x. (Pham, Pham 2018)
//       |  . |########.
//       |   .|#########.  entry demands
//       +----+----------.---> x
//
// About 20 ns with three axes where braking decides, 60 ns where a corner of the region does.
#pragma once

#include <span>

#include "cell.hpp"

namespace passo {

// The largest x <= X for which some y <= Y meets all demands.
double largest_entry(std::span<const AxisDemand> demands, double entry_most, double exit_most);

// The largest y <= Y for this x, which is at most largest_entry(). For a larger x, the smallest possible y.
double largest_exit(std::span<const AxisDemand> demands, double entry, double exit_most);

// The smallest possible y: the hardest braking.
double least_exit(std::span<const AxisDemand> demands, double entry);

// A deceleration from this x to rest that all demands allow, wherever in the cell of this length the rest is. 0 or
// less: no such deceleration is certain.
double sure_deceleration(std::span<const AxisDemand> demands, double length, double entry);

// The same where limits fall with the speed, by iteration. Each step is a linear program as above, with the line of
// each curve that is the highest at the last speed found. Each line keeps to its curve, so each solution is possible.
//
// Backwards, the demands keep the lines of the best solution. With these lines the forward pass always finds a
// solution.
double largest_entry(std::span<const AxisDemand> demands, std::span<FallingDemand> falling, double entry_most,
                     double exit_most);

// `top` is that of the cell. Where the limits decide, the answer does not depend on `exit_most`.
double largest_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry,
                    double exit_most, double top);
double least_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry);
double sure_deceleration(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double length,
                         double entry);

// The way into a cell that the motion goes, and the square of the speed after it.
struct Ride {
  double way = 0;
  double exit = 0;
};
// To rest within the cell if possible, else through the cell as slowly as possible.
Ride hardest_braking(const Cell& cell, std::span<const AxisDemand> demands, std::span<const FallingDemand> falling,
                     double entry);

// What is known of a cell when it is played: its length, and the squares of the speeds at both ends and of its top.
struct CellRide {
  double length = 0;
  double entry = 0;
  double exit = 0;
  double top = 0;
};
// Whether the straight line of v² from entry to exit takes noticeably longer than rising above both ends, with an
// acceleration that all demands surely allow. In two halves the cell takes less time.
bool is_too_long(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, const CellRide& ride);

}  // namespace passo
