// The overshoot of a rotor after a step change of its load, by the equal-area criterion. Private to verdict/.
#pragma once

namespace passo {

// Returns the minimum pull-out torque with which an undamped rotor stays in synchronism when its load changes from
// `before` to `after`, N·m, signed with respect to one direction. At least as large as either load. From 0 to T:
// 1.38·T.
double torque_to_catch(double before, double after);

}  // namespace passo
