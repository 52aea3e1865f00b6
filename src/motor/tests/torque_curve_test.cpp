#include "passo/motor/torque_curve.hpp"
