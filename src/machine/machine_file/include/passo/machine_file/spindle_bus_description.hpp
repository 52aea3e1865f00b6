// SpindleBusDescription: [spindle.modbus] of a machine file: a variable-frequency drive (VFD) on an RS-485 bus of this
// computer.
#pragma once

#include <cstdint>
#include <string>

#include "passo/units/units.hpp"

namespace passo {

enum class SerialParity : std::uint8_t { none, even, odd };

struct SpindleBusDescription {
  std::string drive;   // "huanyang", "h100", or the path of a table file, relative to the machine file
  std::string device;  // of the serial port
  int baud = 9600;
  SerialParity parity = SerialParity::none;
  int stop_bits = 1;
  int address = 1;
  int poles = 2;  // of the motor: rpm = Hz * 120 / poles
  double lowest_rpm = 0;
  double highest_rpm = 0;    // max_rpm of [tool]; 0: no limit
  double rated_current = 0;  // A; 0: unknown
  double tolerance = 0.05;   // of the speed for which motion waits, as a fraction
  Seconds reach{15};         // the spindle must reach its speed in this time

  bool has_table_file() const { return drive.ends_with(".toml"); }
  double rpm_per_hertz() const { return 120.0 / poles; }
};

}  // namespace passo
