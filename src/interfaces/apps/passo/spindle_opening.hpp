// Opens the spindle that the machine file describes in [spindle.modbus].
#pragma once

#include <cstdint>
#include <memory>

#include "passo/machine_file/machine_description.hpp"
#include "passo/spindle/modbus_spindle.hpp"

namespace passo {

enum class SpindleWish : std::uint8_t {
  none,
  later,  // the drive may be switched on later; until it answers, no program starts
  now,    // it must answer
};

// Null, with a message and the exit code in `code`: the serial port or the table of the drive cannot be used, or the
// drive does not answer. The drive is stopped if it answers. `wish`: later or now.
std::unique_ptr<ModbusSpindle> open_spindle(const SpindleBusDescription& bus, SpindleWish wish, int& code);

}  // namespace passo
