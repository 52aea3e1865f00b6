// docs/life-of-a-move.md leads through the code by names: every one of them exists.
//
// Names are what stands in `backticks` and looks like one: `Class::function` (with or without parentheses, the class
// or namespace may be nested), `function()`, and `module/file.hpp` or another path of a file.
#include <algorithm>
#include <regex>
#include <sstream>

#include "source_tree.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

struct Code {
  std::vector<std::pair<fs::path, std::string>> files;  // sources of src/ without tests and without comments

  Code() {
    for (const fs::path& file : files_below("src", {".hpp", ".cpp"})) {
      if (is_test(file)) continue;
      std::string text;
      for (const std::string& line : lines_of(file)) text += line.substr(0, line.find("//")) + "\n";
      files.emplace_back(file, text);
    }
  }

  bool has_function(const std::string& name) const {
    return std::ranges::any_of(files, [&](const auto& file) { return has_word(file.second, name, "("); });
  }

  // A file of that name, or with that path's end: "wire/board_segment.hpp".
  bool has_file(const std::string& name) const {
    if (fs::exists(project_root() / name)) return true;
    return std::ranges::any_of(files, [&](const auto& file) {
      const std::string path = file.first.string();
      return path.size() > name.size() && path.ends_with(name) && path[path.size() - name.size() - 1] == '/';
    });
  }

  // `scope` is declared, and `member` stands in a file that declares or defines it.
  bool has_member(const std::string& scope, const std::string& member) const {
    const auto regex = [](const char* before, const std::string& word, const char* after) {
      return std::regex(std::string(before).append(word).append(after));
    };
    const std::regex declares =
        regex(R"(\b(class|struct|namespace|enum|union)\s+(class\s+)?(\[\[nodiscard\]\]\s+)?(\w+::)*)", scope,
              R"(\b(?!\s*;))");
    const std::regex defines = regex("\\b", scope, std::string(R"((<[^>]*>)?::)").append(member).append("\\b").c_str());
    return std::ranges::any_of(files, [&](const auto& file) {
      if (!has_word(file.second, scope) || !has_word(file.second, member)) return false;
      // What names the scope is on one line.
      std::istringstream lines(file.second);
      for (std::string line; std::getline(lines, line);) {
        if (!has_word(line, scope)) continue;
        if (std::regex_search(line, declares) || std::regex_search(line, defines)) return true;
      }
      return false;
    });
  }
};

// The names in backticks that look like code, without their parentheses and arguments.
std::set<std::string> names_in(const std::string& document) {
  static const std::regex quoted("`([^`\n]+)`");
  static const std::regex qualified(R"(((?:\w+::)+~?\w+)(\(.*\))?)");
  static const std::regex function(R"((\w+)\(.*\))");
  static const std::regex path(R"([\w./-]+\.(?:hpp|cpp|txt|toml|ngc|sh|md))");
  std::set<std::string> names;
  for (std::sregex_iterator it(document.begin(), document.end(), quoted), end; it != end; ++it) {
    const std::string text = (*it)[1];
    std::smatch parts;
    if (std::regex_match(text, parts, qualified)) {
      if (!text.starts_with("std::")) names.insert(parts[1]);
    } else if (std::regex_match(text, parts, function)) {
      names.insert(parts[1].str().append("()"));
    } else if (std::regex_match(text, path)) {
      names.insert(text);
    }
  }
  return names;
}

bool exists(const Code& code, const std::string& name) {
  if (const std::size_t colons = name.rfind("::"); colons != std::string::npos) {
    const std::string scopes = name.substr(0, colons);
    const std::size_t outer = scopes.rfind("::");
    return code.has_member(outer == std::string::npos ? scopes : scopes.substr(outer + 2), name.substr(colons + 2));
  }
  if (name.ends_with("()")) return code.has_function(name.substr(0, name.find('(')));
  return code.has_file(name);
}

TEST(LifeOfAMove, names_only_what_exists_and_enough_of_it_to_be_a_way_through_the_code) {
  const fs::path document = "docs/life-of-a-move.md";
  if (!fs::exists(project_root() / document)) GTEST_SKIP() << document << " is not written yet";
  const Code code;
  const std::set<std::string> names = names_in(text_of(document));
  EXPECT_GE(names.size(), 15U);
  for (const std::string& name : names) {
    EXPECT_TRUE(exists(code, name)) << document.string() << " names " << name << ", and src/ does not have it";
  }
}

TEST(LifeOfAMove, the_check_itself_tells_what_exists_from_what_does_not) {
  const Code code;
  EXPECT_EQ(names_in("a `Player::play()` b `play(x)` c `wire/x.hpp` d `G1 X10` e `std::move` f `word`"),
            (std::set<std::string>{"Player::play", "play()", "wire/x.hpp"}));
  EXPECT_TRUE(exists(code, "Player::play"));
  EXPECT_TRUE(exists(code, "passo::Player::load"));
  EXPECT_TRUE(exists(code, "load_machine_file()"));
  EXPECT_TRUE(exists(code, "firmware/player.hpp"));
  EXPECT_FALSE(exists(code, "Player::leap"));
  EXPECT_FALSE(exists(code, "Dancer::play"));
  EXPECT_FALSE(exists(code, "no_such_function()"));
  EXPECT_FALSE(exists(code, "firmware/dancer.hpp"));
}

}  // namespace
}  // namespace passo
