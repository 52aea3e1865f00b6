// Describes the serial ports of this computer, as text and as JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "passo/transport/serial_ports.hpp"

namespace passo {

// Returns e.g. "2341:0043 Arduino Uno", the USB ids and what the device calls itself.
std::string describe_device(const SerialPort& port);
nlohmann::ordered_json to_json(const SerialPort& port);
nlohmann::ordered_json to_json(const SerialPortList& list);

}  // namespace passo
