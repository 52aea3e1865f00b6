#include "source_tree.hpp"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>

namespace passo {

namespace fs = std::filesystem;

fs::path project_root() {
  return PASSO_SOURCE_DIR;
}

std::vector<fs::path> files_below(const std::string& directory, const std::set<std::string>& extensions) {
  std::vector<fs::path> found;
  const fs::path start = project_root() / directory;
  if (!fs::exists(start)) return found;
  for (auto it = fs::recursive_directory_iterator(start); it != fs::recursive_directory_iterator(); ++it) {
    const std::string name = it->path().filename().string();
    if (it->is_directory() &&
        (name.starts_with('.') || (name == "build" && it.depth() == 0) || name == "out" || name == "node_modules")) {
      it.disable_recursion_pending();
    } else if (it->is_regular_file() && extensions.contains(it->path().extension().string())) {
      found.push_back(fs::relative(it->path(), project_root()));
    }
  }
  std::ranges::sort(found);
  return found;
}

std::vector<fs::path> tracked_files() {
  std::vector<fs::path> found;
  const std::string command = "git -C '" + project_root().string() + "' ls-files -z 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return found;
  std::string name;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
    if (c != '\0') {
      name += static_cast<char>(c);
    } else {
      if (fs::is_regular_file(project_root() / name)) found.emplace_back(name);
      name.clear();
    }
  }
  pclose(pipe);
  return found;
}

std::string text_of(const fs::path& relative) {
  std::ifstream file(project_root() / relative, std::ios::binary | std::ios::ate);
  if (!file) return {};
  std::string text(static_cast<std::size_t>(file.tellg()), '\0');
  file.seekg(0);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  return text;
}

std::vector<std::string> lines_of(const fs::path& relative) {
  std::vector<std::string> lines;
  std::istringstream text(text_of(relative));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

std::string opening_comment(const fs::path& relative) {
  std::string comment;
  for (const std::string& line : lines_of(relative)) {
    if (!line.starts_with("//")) break;
    comment += line + "\n";
  }
  return comment;
}

std::string module_of(const fs::path& relative) {
  return std::next(relative.begin(), 2)->string();
}

bool has_word(std::string_view text, std::string_view word, std::string_view next) {
  const auto is_of_word = [&](std::size_t i) {
    return i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_');
  };
  for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const std::size_t behind = at + word.size();
    if ((at > 0 && is_of_word(at - 1)) || is_of_word(behind)) continue;
    if (next.empty()) return true;
    if (const std::size_t first = text.find_first_not_of(" \t\n", behind); first != std::string_view::npos) {
      if (text.substr(first).starts_with(next)) return true;
    }
  }
  return false;
}

bool is_test(const fs::path& relative) {
  return std::ranges::find(relative, fs::path("tests")) != relative.end() ||
         std::ranges::find(relative, fs::path("fuzz")) != relative.end();
}

std::vector<Include> includes_of(const fs::path& relative) {
  std::vector<Include> includes;
  const std::vector<std::string> lines = lines_of(relative);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& line = lines[i];
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') continue;
    const std::size_t word = line.find_first_not_of(" \t", hash + 1);
    if (word == std::string::npos || line.compare(word, 7, "include") != 0) continue;
    const std::size_t open = line.find_first_of("\"<", word);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of("\">", open + 1);
    includes.push_back({i + 1, line.substr(open + 1, close - open - 1), line[open] == '"'});
  }
  return includes;
}

std::vector<Layer> layers() {
  std::vector<Layer> all;
  for (const std::string& line : lines_of("docs/layers.txt")) {
    const std::size_t colon = line.find(':');
    if (line.starts_with('#') || colon == std::string::npos) continue;
    Layer layer;
    layer.portable = line[colon - 1] == '*';
    layer.folder = fs::path("src") / line.substr(0, layer.portable ? colon - 1 : colon);
    layer.module = layer.folder.filename().string();
    std::istringstream names(line.substr(colon + 1));
    for (std::string name; names >> name;) layer.uses.push_back(name);
    all.push_back(std::move(layer));
  }
  return all;
}

}  // namespace passo
