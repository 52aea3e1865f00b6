// TemporaryFolder: a folder for one process or one run, removed with all its contents.
#pragma once

#include <string>

namespace passo {

// Its name is empty until it is created.
class TemporaryFolder {
 public:
  TemporaryFolder() = default;
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { remove(); }

  // Returns false if it cannot be created.
  bool make();
  void remove();
  const std::string& name() const { return name_; }
  std::string path(const std::string& file) const { return name_ + "/" + file; }

 private:
  std::string name_;
};

}  // namespace passo
