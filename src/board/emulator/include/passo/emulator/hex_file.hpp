// Intel HEX files, the form in which programs for microcontrollers are flashed.
//
// Source: Intel, Hexadecimal Object File Format Specification, Revision A, 1988.
#pragma once

#include <filesystem>
#include <string>

namespace passo {

// Returns what is wrong with the first wrong line, e.g. "line 7: its checksum is wrong". Empty: each record is whole,
// and the last one ends the file.
std::string find_hex_fault(const std::filesystem::path& file);

}  // namespace passo
