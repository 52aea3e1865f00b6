// How fast a cell may be entered and left: two linear programs in the squares x, y of the speeds at its ends.
// Private to trajectory/.
//
//     y ^      exit demands          All demands |p x + q y| <= limit are stripes about the origin: what they leave
//       |.    .                      of the rectangle [0, X] x [0, Y] is convex and has the origin in it. Backwards:
//     Y +-.--+-------+               the largest x in it. Forwards: the largest y for a given x. (Pham and Pham 2018)
//       |  . |########.
//       |   .|#########.  entry demands
//       +----+----------.---> x
//
// About 20 ns with three axes where braking decides, 200 ns where the corner of the region does.
#pragma once

#include <span>

#include "cell.hpp"

namespace passo {

// The largest x <= X with a y <= Y that meet all demands.
double largest_entry(std::span<const AxisDemand> demands, double entry_most, double exit_most);

// The largest y <= Y for this x, which is at most largest_entry(); for a larger x, the smallest y there is.
double largest_exit(std::span<const AxisDemand> demands, double entry, double exit_most);

// The smallest y: braking as hard as may be.
double least_exit(std::span<const AxisDemand> demands, double entry);

// A deceleration from this x to rest that all demands allow wherever in the cell of this length the rest is; 0 or less:
// none is sure to be allowed.
double sure_deceleration(std::span<const AxisDemand> demands, double length, double entry);

// The same with limits that fall with the speed, by iteration: with the line of each curve that is the highest at the
// speed found before, a linear program as above. Each line keeps to its curve, so each solution is possible.
//
// Backwards, the lines of the best solution are kept in the demands: with them the forward pass always finds a way.
double largest_entry(std::span<const AxisDemand> demands, std::span<FallingDemand> falling, double entry_most,
                     double exit_most);

// `top`: of the cell. As far as the limits decide the answer does not depend on `exit_most`.
double largest_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry,
                    double exit_most, double top);
double least_exit(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double entry);
double sure_deceleration(std::span<const AxisDemand> demands, std::span<const FallingDemand> falling, double length,
                         double entry);

}  // namespace passo
