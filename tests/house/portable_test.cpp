// A portable file is for the chip too: it includes <stdint.h>, <stddef.h> and portable files, nothing else.
//
// The rule. A file is portable when its opening comment says "Portable." or "Portable:". All files of a module with a
// star in docs/layers.txt are (its tests are not); in other modules single headers may be.
#include "source_tree.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const std::string& module) {
  for (const Layer& layer : layers()) {
    if (layer.module == module) return layer.folder;
  }
  return {};
}

bool says_portable(const fs::path& file) {
  const std::string comment = opening_comment(file);
  return comment.find("Portable.") != std::string::npos || comment.find("Portable:") != std::string::npos;
}

std::vector<fs::path> portable_files() {
  std::vector<fs::path> found;
  for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
    if (!is_test(file) && says_portable(file)) found.push_back(file);
  }
  return found;
}

TEST(Portable, every_file_of_a_starred_module_says_so) {
  std::size_t checked = 0;
  for (const Layer& layer : layers()) {
    if (!layer.portable) continue;
    for (const fs::path& file : files_below(layer.folder.string(), {".hpp", ".cpp"})) {
      if (is_test(file)) continue;
      EXPECT_TRUE(says_portable(file)) << file << " lacks \"Portable.\" in its opening comment";
      ++checked;
    }
  }
  EXPECT_GE(checked, 2U);
}

TEST(Portable, files_include_only_what_a_chip_has) {
  const std::set<std::string> allowed = {"stdint.h", "stddef.h"};
  for (const fs::path& file : portable_files()) {
    for (const Include& include : includes_of(file)) {
      if (allowed.contains(include.name)) continue;
      fs::path target = file.parent_path() / include.name;
      if (include.name.starts_with("passo/")) {
        const std::string module = std::next(fs::path(include.name).begin())->string();
        target = folder_of(module) / "include" / include.name;
      }
      EXPECT_TRUE(include.quoted && says_portable(target.lexically_normal()))
          << file.string() << ":" << include.line << ": " << include.name << " is not portable";
    }
  }
}

TEST(Portable, files_have_no_floating_point_and_no_heap) {
  for (const fs::path& file : portable_files()) {
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const std::string code = lines[i].substr(0, lines[i].find("//"));
      for (const char* word : {"double ", "float ", "new ", "delete ", "throw ", "std::"}) {
        EXPECT_EQ(code.find(word), std::string::npos) << file.string() << ":" << i + 1 << ":" << word;
      }
    }
  }
}

}  // namespace
}  // namespace passo
