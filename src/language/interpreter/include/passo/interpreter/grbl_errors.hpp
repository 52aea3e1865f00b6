// grbl's numbers for errors in a program.
#pragma once

#include <optional>
#include <string_view>

namespace passo {

// The number that grbl 1.1 gives the error with this diagnostic's code. Empty: grbl has no such error.
std::optional<int> grbl_error_number(std::string_view code);

}  // namespace passo
