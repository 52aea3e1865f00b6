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
  std::set<fs::path> listed;
  std::set<std::string> names;
  for (const Layer& layer : layers()) {
    EXPECT_TRUE(names.insert(layer.module).second) << layer.module << " has two lines";
    listed.insert(project_root() / layer.folder);
  }
  std::set<fs::path> existing;
  for (const auto& district : fs::directory_iterator(project_root() / "src")) {
    if (!district.is_directory()) continue;
    for (const auto& module : fs::directory_iterator(district)) {
      if (module.is_directory()) existing.insert(module.path());
    }
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

// What the module may include, and for its tests all below that.
std::set<std::string> allowed_for(const std::map<std::string, Layer>& by_name, const std::string& module, bool test) {
  std::set<std::string> allowed = {module};
  for (const std::string& used : by_name.at(module).uses) {
    if (test) allowed.merge(allowed_for(by_name, used, true));
    allowed.insert(used);
  }
  return allowed;
}

TEST(Layers, every_include_of_a_module_is_on_its_line_and_nothing_else) {
  const auto by_name = layers_by_name();
  std::map<std::string, std::set<std::string>> unused;
  for (const auto& [name, layer] : by_name) unused[name] = {layer.uses.begin(), layer.uses.end()};
  std::size_t checked = 0;
  for (const fs::path& file : files_below("src", cpp_files)) {
    const std::string module = module_of(file);
    ASSERT_TRUE(by_name.contains(module)) << file;
    const std::set<std::string> allowed = allowed_for(by_name, module, is_test(file));
    for (const Include& include : includes_of(file)) {
      if (!include.name.starts_with("passo/")) continue;
      const std::string used = std::next(fs::path(include.name).begin())->string();
      EXPECT_TRUE(allowed.contains(used)) << file.string() << ":" << include.line << ": " << module
                                          << " may not include " << used << " (docs/layers.txt)";
      EXPECT_TRUE(include.quoted) << file.string() << ":" << include.line << ": our own headers go in quotes";
      unused[module].erase(used);
      ++checked;
    }
  }
  EXPECT_GT(checked, 30U);
  for (const auto& [name, names] : unused) {
    EXPECT_THAT(names, testing::IsEmpty()) << name << " does not include what its line lists";
  }
}

TEST(Layers, what_is_not_public_is_included_by_its_own_module_only) {
  const auto by_name = layers_by_name();
  for (const fs::path& file : files_below("src", cpp_files)) {
    for (const Include& include : includes_of(file)) {
      if (!include.quoted || include.name.starts_with("passo/")) continue;
      if (include.name.starts_with("kit/") && is_test(file)) continue;
      const fs::path own = by_name.at(module_of(file)).folder;
      const fs::path beside = project_root() / file.parent_path() / include.name;
      const fs::path in_module = project_root() / own / include.name;
      const bool inside = fs::exists(beside) && !fs::relative(beside, project_root() / own).string().starts_with("..");
      EXPECT_TRUE(inside || fs::exists(in_module)) << file.string() << ":" << include.line << ": " << include.name;
    }
  }
}

}  // namespace
}  // namespace passo
