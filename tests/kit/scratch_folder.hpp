// scratch_folder: a new, empty folder, removed when the process ends. Tests run beside each other: a folder with a
// fixed name belongs to another test too.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <list>
#include <stdexcept>
#include <string>

namespace passo::test {

class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "passo-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code none;
    std::filesystem::permissions(path_, std::filesystem::perms::owner_all, none);
    std::filesystem::remove_all(path_, none);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::filesystem::path scratch_folder() {
  static std::list<ScratchFolder> folders;
  return folders.emplace_back().path();
}

}  // namespace passo::test
