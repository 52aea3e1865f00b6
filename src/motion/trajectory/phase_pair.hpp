// PhasePair: a short distance in two phases of constant jerk and equal time, from one state to another. Private to
// trajectory/.
#pragma once

#include <cmath>

namespace passo {

// The state of the motion at a node between cells.
struct NodeState {
  double speed = 0;
  double acceleration = 0;
};

struct PhasePair {
  double half = 0;   // the time of each phase. 0: there is no such pair
  double first = 0;  // the jerk of the first phase
  double second = 0;
  NodeState middle;

  // distance = (v0 + v1) t - (a1 - a0) t²/3 with t half the time.
  static PhasePair over(double way, const NodeState& from, const NodeState& to) {
    const double sum = from.speed + to.speed;
    const double change = to.acceleration - from.acceleration;
    const double root = sum * sum - 4.0 / 3 * change * way;
    PhasePair pair;
    if (!(root > 0)) return pair;
    const double t = 2 * way / (sum + std::sqrt(root));
    pair.half = t;
    pair.first = ((to.speed - from.speed) / t - 2 * from.acceleration - change / 2) / t;
    pair.second = change / t - pair.first;
    pair.middle = {.speed = from.speed + t * (from.acceleration + t * pair.first / 2),
                   .acceleration = from.acceleration + t * pair.first};
    return pair;
  }
};

}  // namespace passo
