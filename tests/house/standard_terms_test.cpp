// Texts that users see (messages, help, manual) use the terms of the field, not the words that this project once made
// up for them: docs/glossary.md. A phrase is here only if it has no other meaning in such a text.
#include <algorithm>
#include <cctype>
#include <iterator>
#include <utility>

#include "source_tree.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

struct HomeMade {
  std::vector<std::string_view> phrases;  // whole words, in lower case
  std::string_view instead;
};
const HomeMade home_made[] = {
    {{"broken off"}, "interrupted"},
    {{"turned over", "turned round", "turn it over", "turn the board over"}, "flipped, mirrored, reversed"},
    {{"in mid-run"}, "while the program runs"},
    {{"turns a minute", "revolutions a minute"}, "rpm"},
    {{"mm a minute", "mm2 a minute", "mm3 a minute", "inches a minute", "degrees a minute"}, "mm/min"},
    {{"events a second", "ticks a second", "pulses a second", "counts a second", "bytes a second"}, "events/s, Hz"},
    {{"steps a turn", "steps a revolution", "counts a turn", "mm a turn", "inches a turn"}, "per revolution"},
    {{"steps a millimetre", "counts a millimetre"}, "steps/mm"},
    {{"limit of jerk", "limits of jerk", "limit of acceleration", "limits of acceleration"}, "jerk limit"},
    {{"limit of velocity", "limits of velocity"}, "velocity limit"},
    {{"has the motion", "have the motion"}, "is in control"},
    {{"hold what is cut", "hold what it cuts"}, "target removal rate"},
    {{"free ground"}, "isolation width"},
    {{"surely there", "sure torque"}, "guaranteed torque"},
    {{"height of rapids", "height of the rapids"}, "clearance height"},
    {{"ridges"}, "scallops"},
    {{"from row to row", "from loop to loop", "distance of rows"}, "stepover"},
    {{"the way of the touch"}, "probe direction"},
    {{"nobody", "somebody"}, "the role: the operator, another client"},
    {{"amid"}, "during"},
    {{"be given again"}, "can be repeated"},
    {{"; without it"}, "(default: X)"},
    {{"a virtual machine", "the virtual machine", "a virtual board", "the virtual probe"}, "simulated machine"},
};

// What is between quotes, and has several words. Pieces of one text are joined.
std::vector<std::string> quoted_texts(const std::string& source) {
  std::vector<std::string> texts;
  bool continues = false;
  for (std::size_t i = 0; i < source.size();) {
    if (source.compare(i, 2, "//") == 0 || source[i] == '#') {
      i = std::min(source.find('\n', i), source.size());
    } else if (source.compare(i, 2, "R\"") == 0) {
      const std::size_t open = source.find('(', i);
      const std::string close = ")" + source.substr(i + 2, open - i - 2) + "\"";
      const std::size_t end = std::min(source.find(close, open), source.size());
      texts.push_back(source.substr(open + 1, end - open - 1));
      i = end + close.size();
      continues = false;
    } else if (source[i] == '\'' && (i == 0 || std::isalnum(static_cast<unsigned char>(source[i - 1])) == 0)) {
      i = std::min(source.find('\'', source[i + 1] == '\\' ? i + 3 : i + 1), source.size()) + 1;
      continues = false;
    } else if (source[i] == '"') {
      std::size_t end = i + 1;
      while (end < source.size() && source[end] != '"') end += source[end] == '\\' ? 2 : 1;
      if (!continues) texts.emplace_back();
      texts.back() += source.substr(i + 1, end - i - 1);
      continues = true;
      i = end + 1;
    } else {
      if (std::isspace(static_cast<unsigned char>(source[i])) == 0) continues = false;
      ++i;
    }
  }
  std::erase_if(texts, [](const std::string& text) { return text.find(' ') == std::string::npos; });
  return texts;
}

// Without fenced code, what is between backticks (names of files, keys and options), and the targets of links.
std::string prose_of(std::string line) {
  for (const auto& [open, close] : {std::pair{"`", "`"}, std::pair{"](", ")"}}) {
    for (std::size_t at = line.find(open); at != std::string::npos; at = line.find(open, at)) {
      const std::size_t end = line.find(close, at + 1);
      if (end == std::string::npos) break;
      line.erase(at, end + 1 - at);
    }
  }
  return line;
}

bool has_words(const std::string& text, std::string_view phrase) {
  const auto ends_word = [&](std::size_t i) {
    return i >= text.size() || std::isalnum(static_cast<unsigned char>(text[i])) == 0;
  };
  for (std::size_t i = text.find(phrase); i != std::string::npos; i = text.find(phrase, i + 1)) {
    if ((i == 0 || ends_word(i - 1)) && ends_word(i + phrase.size())) return true;
  }
  return false;
}

// The home-made words in the text, and what to write instead; empty: none.
std::string home_made_in(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const auto& [phrases, instead] : home_made) {
    for (const std::string_view phrase : phrases) {
      if (has_words(text, phrase)) return "'" + std::string(phrase) + "', instead of: " + std::string(instead);
    }
  }
  return {};
}

TEST(StandardTerms, are_told_from_home_made_words) {
  EXPECT_NE(home_made_in("the feed is in mm a minute"), "");
  EXPECT_NE(home_made_in("Nobody may be near"), "");
  EXPECT_EQ(home_made_in("a minute later the axis turns over the table's bridges"), "");
  EXPECT_EQ(quoted_texts("// \"no text\"\nf(1'000, '\"', \"one \"\n  \"text\", \"name\");\n"),
            std::vector<std::string>{"one text"});
  EXPECT_EQ(prose_of("see `a b` and [this](a/b.md)"), "see  and [this");
}

TEST(StandardTerms, are_those_of_help_and_messages) {
  std::size_t checked = 0;
  for (const fs::path& file : files_below("src", {".cpp", ".hpp"})) {
    const bool is_of_users = !is_test(file) && file.string().find("/fuzz/") == std::string::npos;
    if (!is_of_users || file.string().starts_with("src/board/chip/")) continue;
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
    bool is_code = false;
    for (const std::string& line : lines_of(document)) {
      if (line.find("```") != std::string::npos) is_code = !is_code;
      if (is_code) continue;
      EXPECT_EQ(home_made_in(prose_of(line)), "") << document << ": " << line;
      ++checked;
    }
  }
  EXPECT_GT(checked, 5000U);
}

}  // namespace
}  // namespace passo
