// Numbered parameters that outlive a program, in LinuxCNC's form (.var): a line each, its number, a tab, its value.
//
// Lengths in it are in the machine's unit. Read before a run; written after it with what the program changed: of the
// parameters that are in the file, and always of the homes and offsets (#5161 to #5390).
#pragma once

#include <map>
#include <string>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

using SavedParameters = std::map<int, double>;

// False when something is wrong with the file; all of it is in `diagnostics`.
[[nodiscard]] bool read_parameter_file(const std::string& path, SavedParameters& parameters, Diagnostics& diagnostics);
std::string parameter_file_text(const SavedParameters& parameters);
// Whether a parameter is saved although the file did not name it.
bool is_always_saved(int number);

}  // namespace passo
