// A golden file contains the expected text, byte for byte. Golden files are rewritten only with PASSO_UPDATE_GOLDEN.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

namespace passo::test {

// `path` is relative to the checkout.
inline void expect_golden(const std::string& path, const std::string& text) {
  const std::string full = std::string(PASSO_SOURCE_DIR "/") + path;
  if (std::getenv("PASSO_UPDATE_GOLDEN") != nullptr) {
    std::ofstream(full, std::ios::binary) << text;
    return;
  }
  std::ifstream file(full, std::ios::binary);
  ASSERT_TRUE(file) << full << " is missing; PASSO_UPDATE_GOLDEN=1 writes it";
  const std::string golden{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, golden) << full;
}

}  // namespace passo::test
