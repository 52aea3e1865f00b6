// Files in a browser: those that the visitor has dropped, all in one place.
#include "file_place.hpp"

#include "passo/base/browser_host.hpp"

namespace passo {

std::string folder_of_file(const std::string& /*file*/) {
  return "";
}

std::string file_in_folder(const std::string& folder, std::string_view name) {
  return folder.empty() ? std::string(name) : folder + "/" + std::string(name);
}

std::string name_without_folder(const std::string& file) {
  return file;
}

bool is_regular_file(const std::string& file) {
  return host_size(file.data(), file.size()) >= 0;
}

}  // namespace passo
