// The part of the style that clang-format and clang-tidy do not know.
#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <regex>
#include <sstream>

#include "source_tree.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

TEST(Style, no_source_file_is_longer_than_500_lines) {
  for (const fs::path& file : files_below("src", {".hpp", ".cpp", ".inc"})) {
    EXPECT_LE(lines_of(file).size(), 500U) << file;
  }
}

TEST(Style, a_file_is_named_after_what_it_holds) {
  const std::set<std::string> empty_words = {"util",   "utils",   "utilities", "manager",
                                             "helper", "helpers", "common",    "misc"};
  for (const char* directory : {"src", "tests", "bench", "scripts"}) {
    for (const fs::path& file : files_below(directory, {".hpp", ".cpp", ".h", ".sh", ".py", ".cmake"})) {
      std::string name = file.stem().string();
      std::ranges::replace(name, '-', '_');
      std::istringstream words(name);
      for (std::string word; std::getline(words, word, '_');) EXPECT_FALSE(empty_words.contains(word)) << file;
    }
  }
}

// "grbl_controller" of "GrblController".
std::string file_name_of(const std::string& type) {
  std::string name;
  for (const char c : type) {
    if (std::isupper(static_cast<unsigned char>(c)) != 0 && !name.empty()) name += '_';
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

// How many functions of other places' classes a source defines: "GrblController" -> 17.
std::map<std::string, int> members_in(const fs::path& file) {
  static const std::regex member(R"(^(?:[\w:<>,&* ]+ )?[*&]?(\w+)::~?\w+\()");
  std::map<std::string, int> members;
  for (const std::string& line : lines_of(file)) {
    std::smatch found;
    if (line.empty() || line[0] == ' ' || line.find("::") == std::string::npos) continue;
    if (std::regex_search(line, found, member)) ++members[found[1]];
  }
  return members;
}

// A class that has grown beyond one file: each of its files begins with its name. A file that is the source of a header
// has that header's name.
TEST(Style, a_file_that_holds_a_part_of_a_class_is_named_after_the_class) {
  constexpr int worth_a_name = 3;
  for (const fs::path& file : files_below("src", {".cpp"})) {
    const std::string stem = file.stem().string();
    if (text_of(file).find(stem + ".hpp\"") != std::string::npos) continue;
    for (const auto& [type, count] : members_in(file)) {
      const std::string home = file_name_of(type);
      if (count < worth_a_name || !fs::exists(project_root() / file.parent_path() / (home + ".cpp"))) continue;
      EXPECT_TRUE(stem.starts_with(home)) << file << " holds a part of " << type;
    }
  }
}

TEST(Style, every_public_header_opens_with_a_comment_and_guards_itself) {
  std::size_t checked = 0;
  for (const fs::path& file : files_below("src", {".hpp"})) {
    if (file.string().find("/include/passo/") == std::string::npos) continue;
    EXPECT_FALSE(opening_comment(file).empty()) << file;
    EXPECT_NE(text_of(file).find("\n#pragma once\n"), std::string::npos) << file;
    ++checked;
  }
  EXPECT_GT(checked, 15U);
}

// "1 tools" was found in one message after the other. passo/base/counted.hpp knows it once.
TEST(Style, one_place_forms_plurals) {
  for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
    if (file.filename() == "counted.hpp") continue;
    EXPECT_EQ(text_of(file).find("\"\" : \"s\""), std::string::npos) << file;
    EXPECT_EQ(text_of(file).find("\"s\" : \"\""), std::string::npos) << file;
  }
}

std::vector<fs::path> documents() {
  std::vector<fs::path> files = {"README.md", "CONTRIBUTING.md", "CHANGELOG.md"};
  std::ranges::copy(files_below("docs", {".md"}), std::back_inserter(files));
  return files;
}

// Characters of UTF-8 text, not bytes: all bytes but those that continue a character.
std::size_t characters_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

TEST(Style, no_line_of_a_document_is_longer_than_160_characters) {
  static const std::regex only_a_url(R"(\s*([-*]\s+)?<?https?://\S+\s*)");
  std::size_t checked = 0;
  for (const fs::path& file : documents()) {
    const std::vector<std::string> lines = lines_of(file);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      ++checked;
      if (characters_of(lines[i]) <= 160 || std::regex_match(lines[i], only_a_url)) continue;
      ADD_FAILURE() << file.string() << ":" << i + 1 << " has " << characters_of(lines[i]) << " characters";
    }
  }
  EXPECT_GT(checked, 1000U);
}

// A path of the machine where something was written means nothing to those who clone it.
TEST(Style, no_tracked_file_names_a_place_of_the_machine_it_was_made_on) {
  const std::vector<fs::path> files = tracked_files();
  if (files.empty()) GTEST_SKIP() << "not a git checkout";
  for (const fs::path& file : files) {
    const std::string text = text_of(file);
    for (const std::string directory : {"work", "root"}) {
      const std::string path = "/" + directory + "/";
      for (std::size_t i = text.find(path); i != std::string::npos; i = text.find(path, i + 1)) {
        // Only where the path begins here: docs/work/... is none of it.
        const bool inside = i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) != 0 ||
                                      std::string("_-.}~)").find(text[i - 1]) != std::string::npos);
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
        EXPECT_TRUE(inside) << file.string() << ":" << line << ": " << text.substr(i, 40);
      }
    }
  }
}

}  // namespace
}  // namespace passo
