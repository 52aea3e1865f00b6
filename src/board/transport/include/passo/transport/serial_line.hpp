// A serial line as a file descriptor: eight raw bits without flow control, and nothing that waits.
#pragma once

#include <optional>
#include <string>

#include "passo/base/result.hpp"

namespace passo {

// Opens the line for this program alone. What was waiting on it is dropped. The error is a sentence with the reason.
Result<int, std::string> open_serial_line(const std::string& device, unsigned baud);

// Asks an open line's USB adapter to hand on what it has received after 1 ms. An FTDI adapter waits up to 16 ms
// otherwise. Returns the time in milliseconds, as the driver tells it; empty: this driver has no such time. `sys`:
// where the kernel's sysfs is.
std::optional<int> hurry_adapter(int descriptor, const std::string& device, const std::string& sys = "/sys");

}  // namespace passo
