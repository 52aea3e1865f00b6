// Where the emulators' own files are: in libexec/passo of an installed Passo, or in the build folder. Both are found by
// the location of the running program, so an installation can be moved, and the program contains no path of the
// computer on which it was built.
#pragma once

#include <filesystem>
#include <string_view>

namespace passo {

// Returns the path of an emulator's program or folder: "passo-emulate-avr", "pico". Empty: it is not installed.
std::filesystem::path emulator_file(std::string_view name);

// Does the same for a program in the folder `from`. Only folders that belong to this Passo are searched: an installed
// one by its layout, a build folder by its CMakeCache.txt, so that no file of somebody else is run.
std::filesystem::path emulator_file(std::string_view name, const std::filesystem::path& from);

}  // namespace passo
