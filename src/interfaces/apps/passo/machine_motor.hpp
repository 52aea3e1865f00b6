// The motor of an axis of a machine file, for the commands that study one motor.
#pragma once

#include <string>

#include "passo/base/result.hpp"
#include "passo/motor/running_motor.hpp"

namespace passo {

// `machine` is a file, `axis` a letter of --axis. Reports what is wrong in the file on stderr. The error text can
// follow "passo: error: ".
Result<MotorSetup, std::string> machine_motor(const std::string& machine, const std::string& axis);

}  // namespace passo
