// The project's own files, for tests that read them.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

std::filesystem::path project_root();

// Files below `directory` (relative to the root) with one of the extensions (".hpp"), sorted, relative to the root.
// What is hidden or built is left out.
std::vector<std::filesystem::path> files_below(const std::string& directory, const std::set<std::string>& extensions);

// What git tracks, relative to the root; empty where this is no git checkout.
std::vector<std::filesystem::path> tracked_files();

std::string text_of(const std::filesystem::path& relative);
std::vector<std::string> lines_of(const std::filesystem::path& relative);

// The comment that a source file opens with.
std::string opening_comment(const std::filesystem::path& relative);
// "wire" for src/board/wire/...
std::string module_of(const std::filesystem::path& relative);
bool is_test(const std::filesystem::path& relative);

// Whether the text has the word as a whole and then, after blanks, `next`. Regular expressions take ten times as long.
bool has_word(std::string_view text, std::string_view word, std::string_view next = {});

struct Include {
  std::size_t line = 0;
  std::string name;     // as between the quotes or brackets
  bool quoted = false;  // "name" and not <name>
};
std::vector<Include> includes_of(const std::filesystem::path& relative);

// docs/layers.txt in its order.
struct Layer {
  std::string module;
  std::filesystem::path folder;  // src/motion/path
  bool portable = false;
  std::vector<std::string> uses;
};
std::vector<Layer> layers();

}  // namespace passo
