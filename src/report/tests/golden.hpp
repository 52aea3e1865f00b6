// Golden files: what a text must be, to the byte. PASSO_UPDATE_GOLDEN=1 writes them anew.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

namespace passo {

inline void expect_golden(const std::string& name, const std::string& text) {
  const std::string path = std::string(PASSO_SOURCE_DIR "/src/report/tests/golden/") + name;
  if (std::getenv("PASSO_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  std::ifstream file(path, std::ios::binary);
  ASSERT_TRUE(file) << path << " is missing; PASSO_UPDATE_GOLDEN=1 writes it";
  EXPECT_EQ(text, std::string(std::istreambuf_iterator<char>(file), {})) << path;
}

}  // namespace passo
