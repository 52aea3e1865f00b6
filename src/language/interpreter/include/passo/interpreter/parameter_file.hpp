// Persistent numbered parameters, in LinuxCNC's format (.var): one line for each parameter, with its number, a tab and
// its value.
//
// Lengths in the file are in the machine's unit. The file is read before a run, and written after the run with the
// program's changes. The parameters that are in the file are written, and always the homes and offsets (#5161 to
// #5390).
#pragma once

#include <map>
#include <string>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

using SavedParameters = std::map<int, double>;

// Returns false if the file has errors, which are in `diagnostics`.
[[nodiscard]] bool read_parameter_file(const std::string& path, SavedParameters& parameters, Diagnostics& diagnostics);
std::string parameter_file_text(const SavedParameters& parameters);
// Returns whether the parameter is saved even if the file did not contain it.
bool is_always_saved(int number);
// Replaces the homes of G28 and G30 and the work offsets in `into` by those of `from`. Keeps values that belong to a
// single program: G92, and the active work coordinate system.
void replace_persistent_offsets(SavedParameters& into, const SavedParameters& from);

}  // namespace passo
