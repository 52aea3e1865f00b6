// Every relative link in a document leads to a file, and to a heading where it names one.
#include <cctype>
#include <regex>

#include "source_tree.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// Without fenced blocks and `code`, where brackets are no links.
std::vector<std::string> prose_of(const fs::path& document) {
  static const std::regex code("`[^`]*`");
  std::vector<std::string> lines = lines_of(document);
  bool fenced = false;
  for (std::string& line : lines) {
    const bool fence = line.starts_with("```");
    if (fence) fenced = !fenced;
    if (fenced || fence) line.clear();
    if (line.find('`') != std::string::npos) line = std::regex_replace(line, code, "code");
  }
  return lines;
}

// As GitHub makes them: "What may be left out" -> "what-may-be-left-out".
std::set<std::string> anchors_of(const fs::path& document) {
  std::set<std::string> anchors;
  bool fenced = false;
  for (const std::string& line : lines_of(document)) {
    if (line.starts_with("```")) fenced = !fenced;
    if (fenced || !line.starts_with('#')) continue;
    std::string anchor;
    for (const char c : line.substr(std::min(line.find_first_not_of("# "), line.size()))) {
      const auto byte = static_cast<unsigned char>(c);
      if (c == ' ') anchor += '-';
      if (std::isalnum(byte) != 0 || byte >= 0x80 || c == '-' || c == '_') {
        anchor += static_cast<char>(std::tolower(byte));
      }
    }
    anchors.insert(anchor);
  }
  return anchors;
}

void check_link(const fs::path& document, std::size_t line, const std::string& link) {
  const std::size_t hash = std::min(link.find('#'), link.size());
  const std::string path = link.substr(0, hash);
  const fs::path target = path.empty() ? document : (document.parent_path() / path).lexically_normal();
  const std::string where = document.string() + ":" + std::to_string(line) + ": " + link;
  EXPECT_TRUE(fs::exists(project_root() / target)) << where << " leads nowhere";
  if (hash < link.size() && target.extension() == ".md" && fs::exists(project_root() / target)) {
    EXPECT_TRUE(anchors_of(target).contains(link.substr(hash + 1))) << where << ": no such heading";
  }
}

TEST(Links, in_documents_lead_to_files_and_headings_that_exist) {
  static const std::regex link_pattern(R"(\]\(([^()\s]+)(\s+"[^"]*")?\))");
  static const std::regex foreign("[a-zA-Z][a-zA-Z0-9+.-]*:.*");
  std::size_t checked = 0;
  for (const fs::path& document : files_below(".", {".md"})) {
    const std::vector<std::string> lines = prose_of(document);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].find("](") == std::string::npos) continue;
      for (std::sregex_iterator it(lines[i].begin(), lines[i].end(), link_pattern), end; it != end; ++it) {
        const std::string link = (*it)[1];
        if (std::regex_match(link, foreign)) continue;
        check_link(document, i + 1, link);
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 5U);
}

}  // namespace
}  // namespace passo
