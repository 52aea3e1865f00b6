// docs/layers.txt is what the code does.
#include <algorithm>

#include "source_tree.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

const std::set<std::string> cpp_files = {".hpp", ".cpp"};

std::map<std::string, Layer> layers_by_name() {
  std::map<std::string, Layer> by_name;
  for (const Layer& layer : layers()) by_name[layer.module] = layer;
  return by_name;
}

TEST(Layers, list_every_module_and_no_other) {
  std::set<std::string> listed;
  for (const Layer& layer : layers()) {
    EXPECT_TRUE(listed.insert(layer.module).second) << layer.module << " has two lines";
  }
  std::set<std::string> existing;
  for (const auto& entry : fs::directory_iterator(project_root() / "src")) {
    if (entry.is_directory()) existing.insert(entry.path().filename().string());
  }
  EXPECT_EQ(listed, existing);
}

TEST(Layers, stand_on_each_other_from_the_bottom_up_so_that_there_is_no_cycle) {
  std::set<std::string> below;
  for (const Layer& layer : layers()) {
    for (const std::string& used : layer.uses) {
      EXPECT_TRUE(below.contains(used)) << layer.module << " uses " << used << ", which is not above it in the list";
    }
    below.insert(layer.module);
  }
}

TEST(Layers, a_portable_module_stands_on_portable_ones_and_on_base) {
  const auto by_name = layers_by_name();
  for (const auto& [name, layer] : by_name) {
    if (!layer.portable) continue;
    for (const std::string& used : layer.uses) {
      EXPECT_TRUE(used == "base" || by_name.at(used).portable) << name << " uses " << used;
    }
  }
}

TEST(Layers, every_include_of_a_module_is_on_its_line) {
  const auto by_name = layers_by_name();
  std::size_t checked = 0;
  for (const fs::path& file : files_below("src", cpp_files)) {
    const std::string module = module_of(file);
    ASSERT_TRUE(by_name.contains(module)) << file;
    for (const Include& include : includes_of(file)) {
      if (!include.name.starts_with("passo/")) continue;
      const std::string used = std::next(fs::path(include.name).begin())->string();
      const std::vector<std::string>& allowed = by_name.at(module).uses;
      EXPECT_TRUE(used == module || std::ranges::find(allowed, used) != allowed.end())
          << file.string() << ":" << include.line << ": " << module << " may not include " << used
          << " (docs/layers.txt)";
      EXPECT_TRUE(include.quoted) << file.string() << ":" << include.line << ": our own headers go in quotes";
      ++checked;
    }
  }
  EXPECT_GT(checked, 30U);
}

TEST(Layers, what_is_not_public_is_included_by_its_own_module_only) {
  for (const fs::path& file : files_below("src", cpp_files)) {
    for (const Include& include : includes_of(file)) {
      if (!include.quoted || include.name.starts_with("passo/")) continue;
      if (include.name.starts_with("kit/") && is_test(file)) continue;
      const fs::path own = fs::path("src") / module_of(file);
      const fs::path beside = project_root() / file.parent_path() / include.name;
      const fs::path in_module = project_root() / own / include.name;
      const bool inside = fs::exists(beside) && !fs::relative(beside, project_root() / own).string().starts_with("..");
      EXPECT_TRUE(inside || fs::exists(in_module)) << file.string() << ":" << include.line << ": " << include.name;
    }
  }
}

}  // namespace
}  // namespace passo
