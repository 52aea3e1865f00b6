// passo motor --trial: a motor on the test bench, tried out with its physics.
#pragma once

#include <string>

#include "commands.hpp"

#include "passo/motor/running_motor.hpp"

namespace passo {

// `motor` is the motor with its load, `end` the last rate of a table, `words` describe the motor in pictures. Returns
// the exit code.
int try_motor(const MotorArguments& arguments, const MotorSetup& motor, Hertz end, const std::string& words);

}  // namespace passo
