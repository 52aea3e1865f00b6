// Every mistake of the language names the chapter of its rule, and that chapter exists.
#include "../rules.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "../grbl_dialect.hpp"
#include "interpreted.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// The codes in the sources of the two modules that read programs. file.* is about files, not about the language.
std::set<std::string> codes_in_the_sources() {
  const std::regex code_pattern("\"((?:gcode|grbl|tools|parameters|settings)\\.[a-z][a-z0-9-]*)\"");
  std::set<std::string> codes;
  for (const char* const module : {"src/language/gcode", "src/language/interpreter"}) {
    for (const auto& entry : fs::directory_iterator(fs::path(PASSO_SOURCE_DIR) / module)) {
      if (entry.path().extension() != ".cpp" || entry.path().filename() == "rules.cpp") continue;
      std::istringstream lines(contents(entry.path().string()));
      for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("#include")) continue;
        for (std::sregex_iterator found(line.begin(), line.end(), code_pattern), end; found != end; ++found) {
          codes.insert((*found)[1]);
        }
      }
    }
  }
  return codes;
}

std::string rule_of_code(const std::string& code) {
  Diagnostic diagnostic;
  diagnostic.code = code;
  return rule_of(diagnostic);
}

TEST(Rules, every_code_has_one) {
  const std::set<std::string> codes = codes_in_the_sources();
  EXPECT_GT(codes.size(), 100U);
  for (const std::string& code : codes) {
    EXPECT_FALSE(code.starts_with("grbl.") ? grbl_error(code).empty() : rule_of_code(code).empty()) << code;
  }
}

TEST(Rules, there_are_none_for_codes_that_are_gone) {
  const std::set<std::string> codes = codes_in_the_sources();
  for (const Rule& rule : rules()) EXPECT_TRUE(codes.contains(std::string(rule.code))) << rule.code;
}

// The rules of all codes, and those of each G and M code.
std::set<std::string> all_rules() {
  std::set<std::string> all;
  for (const Rule& rule : rules()) all.emplace(rule.chapter);
  for (const char letter : {'G', 'M'}) {
    for (int tenths = 0; tenths < 2000; ++tenths) {
      Diagnostic diagnostic;
      diagnostic.code = "gcode.missing-word";
      diagnostic.text = letter + std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
      diagnostic.place = {1, 1, static_cast<std::uint32_t>(diagnostic.text.size())};
      all.insert(rule_of(diagnostic));
    }
  }
  return all;
}

// From the contents of NIST IR 6556.
const std::map<std::string, std::string> chapters_of_nist = {
    {"3.1", "overview"},
    {"3.2.1", "parameters"},
    {"3.3", "format of a line"},
    {"3.3.2", "word"},
    {"3.3.2.1", "number"},
    {"3.3.2.2", "parameter value"},
    {"3.3.2.3", "expressions and binary operations"},
    {"3.3.2.4", "unary operation value"},
    {"3.3.4", "comments and messages"},
    {"3.3.5", "item repeats"},
    {"3.3.7", "commands and machine modes"},
    {"3.4", "modal groups"},
    {"3.5", "G codes"},
    {"3.5.1", "rapid linear motion"},
    {"3.5.2", "linear motion at feed rate"},
    {"3.5.3", "arc at feed rate"},
    {"3.5.3.1", "radius format arc"},
    {"3.5.3.2", "center format arc"},
    {"3.5.4", "dwell"},
    {"3.5.5", "set coordinate system data"},
    {"3.5.8", "return to home"},
    {"3.5.9", "straight probe"},
    {"3.5.12", "move in absolute coordinates"},
    {"3.5.16", "canned cycles"},
    {"3.5.16.2", "G81 cycle"},
    {"3.5.16.3", "G82 cycle"},
    {"3.5.16.4", "G83 cycle"},
    {"3.5.16.5", "G84 cycle"},
    {"3.5.16.6", "G85 cycle"},
    {"3.5.16.7", "G86 cycle"},
    {"3.5.16.10", "G89 cycle"},
    {"3.5.18", "coordinate system offsets"},
    {"3.5.19", "set feed rate mode"},
    {"3.6", "input M codes"},
    {"3.6.3", "tool change"},
    {"3.7", "other input codes"},
    {"3.7.1", "set feed rate"},
    {"3.7.3", "select tool"},
    {"3.8", "order of execution"},
};

TEST(Rules, name_chapters_that_are_there) {
  const std::string language = contents((fs::path(PASSO_SOURCE_DIR) / "docs/gcode.md").string());
  const std::string ours = "Passo, docs/gcode.md: ";
  const std::regex nist_pattern("(3(?:\\.[0-9]+)+), ([^,]+)");
  for (const std::string& rule : all_rules()) {
    if (rule.starts_with(ours)) {
      EXPECT_THAT(language, testing::HasSubstr("\n## " + rule.substr(ours.size()) + "\n"));
    } else if (rule.starts_with("RS274/NGC ")) {
      std::size_t named = 0;
      for (std::sregex_iterator found(rule.begin(), rule.end(), nist_pattern), end; found != end; ++found, ++named) {
        const auto chapter = chapters_of_nist.find((*found)[1]);
        ASSERT_NE(chapter, chapters_of_nist.end()) << rule;
        EXPECT_EQ((*found)[2], chapter->second);
      }
      EXPECT_GT(named, 0U) << rule;
    } else {
      EXPECT_TRUE(rule.starts_with("LinuxCNC manual, ") || rule.starts_with("grblHAL, ")) << rule;
    }
  }
}

std::string first_rule(const std::string& program, Dialect dialect = Dialect::linuxcnc) {
  InterpreterOptions options;
  options.dialect = dialect;
  const Interpreted result = interpret_text(program, options);
  return result.diagnostics.all().empty() ? std::string() : result.diagnostics.all().front().rule;
}

TEST(Rules, are_those_of_the_code_that_is_used_in_a_wrong_way) {
  EXPECT_EQ(first_rule("G4\nM2\n"), "RS274/NGC 3.5.4, dwell");
  EXPECT_EQ(first_rule("F1 g082 X1 R1 Z-1\nM2\n"), "RS274/NGC 3.5.16.3, G82 cycle");
  EXPECT_EQ(first_rule("M66\nM2\n"), "LinuxCNC manual, M-codes: M66 Wait on Input");
  EXPECT_EQ(first_rule("G#1 X#2 P\nM2\n"), "RS274/NGC 3.3.2, word");
  EXPECT_EQ(first_rule("G17 G18\nM2\n"), "RS274/NGC 3.4, modal groups");
  EXPECT_EQ(first_rule("G17 G18\nM2\n", Dialect::grbl), "grbl error:21, modal group violation");
}

}  // namespace
}  // namespace passo
