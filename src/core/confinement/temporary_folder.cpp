#include "passo/confinement/temporary_folder.hpp"

#include <cstdlib>
#include <filesystem>

namespace passo {

bool TemporaryFolder::make() {
  if (!name_.empty()) return true;
  std::error_code none;
  std::string made = (std::filesystem::temp_directory_path(none) / "passo-XXXXXX").string();
  if (mkdtemp(made.data()) == nullptr) return false;
  name_ = made;
  return true;
}

void TemporaryFolder::remove() {
  std::error_code none;
  if (!name_.empty()) std::filesystem::remove_all(name_, none);
  name_.clear();
}

}  // namespace passo
