// Where the files that a program names lie: subroutine files and those of a settings file.
//
// The program implements this with <filesystem>. In a browser there are no folders (wasm/file_place.cpp).
#pragma once

#include <string>
#include <string_view>

namespace passo {

// The folder of a file; empty: it has none in its name.
std::string folder_of_file(const std::string& file);
// The name of a file in a folder.
std::string file_in_folder(const std::string& folder, std::string_view name);
std::string name_without_folder(const std::string& file);
bool is_regular_file(const std::string& file);

}  // namespace passo
