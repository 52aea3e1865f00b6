// Reads a list of lines of G-code in a machine file.
#pragma once

#include <string>
#include <string_view>

#include "passo/toml/table_reader.hpp"

namespace passo {

// Returns the lines, each with its end. Empty: the value is wrong, which is reported with `code`.
std::string read_code_lines(TableReader& reader, const char* code, std::string_view key, const TomlValue& value);

}  // namespace passo
