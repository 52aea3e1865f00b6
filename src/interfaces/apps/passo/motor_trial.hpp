// passo motor --trial: tests a motor on a simulated test bench.
#pragma once

#include <string>

#include "commands.hpp"

#include "passo/motor/running_motor.hpp"

namespace passo {

// `motor` is the motor with its load, `end` the last rate of a table; `words` describes the motor in pictures. Returns
// the exit code.
int try_motor(const MotorArguments& arguments, const MotorSetup& motor, Hertz end, const std::string& words);

}  // namespace passo
