// The swing of a rotor after a jump of its load, by the equal-area criterion. Private to verdict/.
#pragma once

namespace passo {

// The least pull-out torque with which a rotor without damping keeps in step when its load jumps from `before` to
// `after`, N·m, signs as of one direction. Not less than either load. From rest to T: 1.38·T.
double torque_to_catch(double before, double after);

}  // namespace passo
