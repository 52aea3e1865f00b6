// Texts that users see (messages, help, manual) use the terms of the field, not the words that this project once made
// up for them: docs/glossary.md. A pattern is here only if it has no other meaning in such a text.
#include <algorithm>
#include <cctype>
#include <iterator>
#include <regex>

#include "source_tree.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

struct HomeMade {
  const char* pattern;
  const char* instead;
};
constexpr HomeMade home_made[] = {
    {R"(\bbroken off\b)", "interrupted"},
    {R"(\b(turned (over|round)|turn (it|the board) over)\b)", "flipped, mirrored, reversed"},
    {R"(\bin mid-run\b)", "while the program runs"},
    {R"(\b(turns|mm|mm2|mm3|inches|degrees|revolutions) a minute\b)", "rpm, mm/min"},
    {R"(\b(events|ticks|pulses|counts|bytes) a second\b)", "events/s, Hz"},
    {R"(\b(steps|counts|mm|inches|degrees) a (turn|revolution)\b)", "per revolution"},
    {R"(\b(steps|counts) a millimetre\b)", "steps/mm"},
    {R"(\blimits? of (jerk|acceleration|velocity)\b)", "jerk limit, acceleration limit"},
    {R"(\bha(s|ve) the motion\b)", "is in control"},
    {R"(\bhold what (is|it) cuts?\b)", "target removal rate"},
    {R"(\bfree ground\b)", "isolation width"},
    {R"(\b(surely there|sure torque)\b)", "guaranteed torque"},
    {R"(\bheight of (the )?rapids\b)", "clearance height"},
    {R"(\bridges\b)", "scallops"},
    {R"(\b(from row to row|from loop to loop|distance of rows)\b)", "stepover"},
    {R"(\bthe way of the touch\b)", "probe direction"},
    {R"(\b(nobody|somebody)\b)", "the role: the operator, another client"},
    {R"(\bamid\b)", "during"},
    {R"(\b(may be|be) given again\b)", "can be repeated"},
    {R"(; without it )", "(default: X)"},
    {R"(\b(a|the|this) virtual (machine|board|probe)\b)", "simulated machine"},
};

// The page finds these sentences by their text; they change together with it.
bool is_translated_by_text(const fs::path& file) {
  static const std::set<std::string> modules = {"session", "job", "journal", "activity", "api", "link"};
  return modules.contains(module_of(file));
}

// The insides of the quotes, without comments, includes, assembler and names. Pieces of one text are joined.
std::vector<std::string> quoted_texts(const std::string& source) {
  static const std::regex between_pieces(R"("\s*\n\s*")");
  static const std::regex quoted(R"re(R"\(([^]*?)\)"|"((?:[^"\\\n]|\\.)*)")re");
  std::string code;
  for (std::size_t at = 0; at < source.size();) {
    const std::size_t end = std::min(source.find('\n', at), source.size());
    const std::string line = source.substr(at, end - at);
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos && !line.substr(begin).starts_with("//") && line[begin] != '#') code += line + '\n';
    at = end + 1;
  }
  code = std::regex_replace(code, between_pieces, "");
  std::vector<std::string> texts;
  for (std::sregex_iterator found(code.begin(), code.end(), quoted), none; found != none; ++found) {
    std::string text = (*found)[1].matched ? (*found)[1].str() : (*found)[2].str();
    if (text.find(' ') != std::string::npos) texts.push_back(std::move(text));
  }
  return texts;
}

// Without fenced code, what is between backticks (names of files, keys and options), and the targets of links.
std::vector<std::string> prose_of(const fs::path& document) {
  static const std::regex code(R"(`[^`]*`|\]\([^)]*\))");
  std::vector<std::string> prose;
  bool fenced = false;
  for (const std::string& line : lines_of(document)) {
    if (line.find("```") != std::string::npos) {
      fenced = !fenced;
    } else if (!fenced) {
      prose.push_back(std::regex_replace(line, code, ""));
    }
  }
  return prose;
}

// The home-made word in the text, and what to write instead; empty: none.
std::string home_made_in(const std::string& text) {
  static const auto words = [] {
    std::vector<std::pair<std::regex, std::string>> list;
    for (const auto& [pattern, instead] : home_made) list.emplace_back(std::regex(pattern, std::regex::icase), instead);
    return list;
  }();
  for (const auto& [word, instead] : words) {
    std::smatch found;
    if (std::regex_search(text, found, word)) return "'" + found.str() + "', instead of: " + instead;
  }
  return {};
}

TEST(StandardTerms, are_told_from_home_made_words) {
  EXPECT_NE(home_made_in("the feed is in mm a minute"), "");
  EXPECT_NE(home_made_in("Nobody may be near"), "");
  EXPECT_EQ(home_made_in("a minute later the axis turns over the table's bridges"), "");
  EXPECT_EQ(quoted_texts("// \"no text\"\nf(\"one \"\n  \"text\", \"name\");\n"), std::vector<std::string>{"one text"});
}

TEST(StandardTerms, are_those_of_help_and_messages) {
  std::size_t checked = 0;
  for (const fs::path& file : files_below("src", {".cpp", ".hpp"})) {
    if (is_test(file) || is_translated_by_text(file) || file.string().starts_with("src/board/chip/") ||
        file.string().find("/fuzz/") != std::string::npos) {
      continue;
    }
    for (const std::string& text : quoted_texts(text_of(file))) {
      EXPECT_EQ(home_made_in(text), "") << file << ": " << text;
      ++checked;
    }
  }
  EXPECT_GT(checked, 2000U);
}

TEST(StandardTerms, are_those_of_the_documents) {
  std::vector<fs::path> documents = {"README.md", "CONTRIBUTING.md"};
  std::ranges::copy(files_below("docs", {".md"}), std::back_inserter(documents));
  std::size_t checked = 0;
  for (const fs::path& document : documents) {
    // The glossary names what it replaces; a decision is not rewritten.
    if (document == "docs/glossary.md" || document.string().starts_with("docs/decisions/")) continue;
    for (const std::string& line : prose_of(document)) {
      EXPECT_EQ(home_made_in(line), "") << document << ": " << line;
      ++checked;
    }
  }
  EXPECT_GT(checked, 5000U);
}

}  // namespace
}  // namespace passo
