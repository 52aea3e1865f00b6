// FolderTest: a test with a separate folder, which is removed at the end.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "kit/scratch_folder.hpp"
#include <gtest/gtest.h>

namespace passo::test {

class FolderTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  std::size_t files() const {
    using std::filesystem::directory_iterator;
    return static_cast<std::size_t>(std::distance(directory_iterator(directory_), directory_iterator()));
  }
  static std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  ScratchFolder scratch_;
  const std::filesystem::path& directory_ = scratch_.path();
};

}  // namespace passo::test
