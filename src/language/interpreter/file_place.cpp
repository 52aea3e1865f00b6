#include "file_place.hpp"

#include <filesystem>
#include <system_error>

namespace passo {

std::string folder_of_file(const std::string& file) {
  return std::filesystem::path(file).parent_path().string();
}

std::string file_in_folder(const std::string& folder, std::string_view name) {
  return (std::filesystem::path(folder) / name).string();
}

std::string name_without_folder(const std::string& file) {
  return std::filesystem::path(file).filename().string();
}

bool is_regular_file(const std::string& file) {
  std::error_code problem;
  return std::filesystem::is_regular_file(file, problem);
}

}  // namespace passo
