// Grbl's error numbers.
#pragma once

#include <optional>
#include <string_view>

namespace passo {

// Returns the error number of Grbl 1.1 that corresponds to a diagnostic code. Empty: Grbl has no such error.
std::optional<int> grbl_error_number(std::string_view code);

}  // namespace passo
