// Opens a serial port as a file descriptor: eight raw bits, no flow control, non-blocking.
#pragma once

#include <optional>
#include <string>

#include "passo/base/result.hpp"

namespace passo {

// Opens the port for exclusive use. Waiting input is dropped. The error is a sentence with the reason.
Result<int, std::string> open_serial_line(const std::string& device, unsigned baud);

// Sets the latency timer of an open port's USB adapter to 1 ms. By default an FTDI adapter delays received bytes by up
// to 16 ms. Returns the resulting time in milliseconds, as the driver reports it; empty: this driver has no such
// setting. `sys`: the path of the kernel's sysfs.
std::optional<int> hurry_adapter(int descriptor, const std::string& device, const std::string& sys = "/sys");

}  // namespace passo
