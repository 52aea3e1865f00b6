// A serial line as a file descriptor: eight raw bits without flow control, and nothing that waits.
#pragma once

#include <string>

#include "passo/base/result.hpp"

namespace passo {

// Opens the line for this program alone. What was waiting on it is dropped. The error is a sentence with the reason.
Result<int, std::string> open_serial_line(const std::string& device, unsigned baud);

}  // namespace passo
