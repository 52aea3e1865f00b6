// The code in docs/library.md is that of the examples, which scripts/library_test.sh compiles and runs.
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The lines without their indentation.
std::string without_indentation(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos) result += line.substr(begin) + "\n";
  }
  return result;
}

TEST(LibraryDocument, shows_the_code_of_the_examples) {
  const fs::path root = PASSO_SOURCE_DIR;
  std::string examples;
  for (const char* folder : {"examples/library", "examples/python"}) {
    for (const auto& entry : fs::directory_iterator(root / folder))
      examples += without_indentation(text_of(entry.path()));
  }
  std::istringstream lines(text_of(root / "docs/library.md"));
  std::size_t blocks = 0;
  std::string block;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("```")) {
      if (inside) block += line + "\n";
      continue;
    }
    if (inside) {
      EXPECT_NE(examples.find(without_indentation(block)), std::string::npos) << "in no example:\n" << block;
      ++blocks;
    }
    inside = !inside && (line == "```cpp" || line == "```python" || line == "```cmake");
    block.clear();
  }
  EXPECT_GE(blocks, 6U);
}

}  // namespace
}  // namespace passo
