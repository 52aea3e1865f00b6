// docs/gcode.md against the rows of the codes: each code stands in one of its tables with the words that it takes, and
// nothing else does.
#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "../code_table.hpp"
#include "../predefined_parameters.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

using Words = std::set<std::string>;

constexpr char first_of(const std::string& text) {
  return text.front();
}

CodeNumber number_in(const std::string& spelled) {
  return static_cast<CodeNumber>(std::stod(spelled.substr(1)) * 10 + 0.5);
}

// What a section of the manual says of the codes in the first columns of its tables.
struct ManualSection {
  std::string title;
  Words codes = {};
  std::map<std::string, Words> letters_of_line = {};  // the letters beside the codes of a line, by these codes
  std::string text = {};
};

// "G38.2, G38.3" and "G54 … G59": all codes that the cell names.
Words codes_in(const std::string& cell) {
  static const std::regex pattern("([GM]\\d+(?:\\.\\d)?)(?: … ([GM]\\d+(?:\\.\\d)?))?");
  Words codes;
  for (std::sregex_iterator found(cell.begin(), cell.end(), pattern), end; found != end; ++found) {
    codes.insert((*found)[1]);
    if (!(*found)[2].matched) continue;
    codes.insert((*found)[2]);
    for (const CodeEntry& entry : code_entries()) {
      const bool is_between = entry.number >= number_in((*found)[1]) && entry.number <= number_in((*found)[2]);
      if (entry.letter == first_of((*found)[1]) && is_between) codes.insert(spelling(entry));
    }
  }
  return codes;
}

// "`I J K` or `R`", and "G10 L2": the letters between backticks, and those that tell codes of one number apart.
Words letters_in(const std::string& text) {
  static const std::regex quoted("`([A-Z@^$](?: [A-Z@^$])*)`");
  Words letters;
  for (std::sregex_iterator found(text.begin(), text.end(), quoted), end; found != end; ++found) {
    std::istringstream words((*found)[1]);
    for (std::string letter; words >> letter;) letters.insert(letter);
  }
  static const std::regex behind_code("[GM]\\d+ ([A-Z])\\d");
  for (std::sregex_iterator found(text.begin(), text.end(), behind_code), end; found != end; ++found) {
    letters.insert((*found)[1]);
  }
  return letters;
}

// The sections whose tables list codes: all before lines, comments and parameters.
std::vector<ManualSection> sections_of(std::istream& manual) {
  std::vector<ManualSection> sections;
  Words codes;
  for (std::string line; std::getline(manual, line);) {
    if (line.starts_with("## Lines, comments")) break;
    if (line.starts_with("## ")) sections.push_back({.title = line.substr(3)});
    if (sections.empty()) continue;
    ManualSection& section = sections.back();
    section.text += line + "\n";
    if (!line.starts_with("| ") || line.starts_with("| word")) continue;
    const std::string cell = line.substr(2, line.find(" |", 2) - 2);
    if (!cell.starts_with("…")) codes = codes_in(cell);
    section.codes.insert(codes.begin(), codes.end());
    for (const std::string& code : codes) section.letters_of_line[cell].insert(code);
  }
  return sections;
}

std::vector<ManualSection> manual_sections() {
  std::ifstream manual(PASSO_SOURCE_DIR "/docs/gcode.md");
  return sections_of(manual);
}

const CodeEntry* entry_of(const std::string& spelled) {
  return find_code(first_of(spelled), number_in(spelled));
}

bool takes(const CodeEntry& entry, const std::string& letter) {
  const bool is_axis = (axis_letters | polar_letters).has(first_of(letter));
  return entry.letters.has(first_of(letter)) || (is_axis && entry.axes != AxisUse::none);
}

TEST(Manual, has_each_code_of_the_table) {
  Words described;
  for (const ManualSection& section : manual_sections()) described.insert(section.codes.begin(), section.codes.end());
  EXPECT_GT(described.size(), 100U);
  for (const CodeEntry& entry : code_entries()) EXPECT_TRUE(described.contains(spelling(entry))) << spelling(entry);
}

TEST(Manual, has_no_code_that_there_is_not) {
  for (const ManualSection& section : manual_sections()) {
    for (const std::string& code : section.codes) EXPECT_NE(entry_of(code), nullptr) << section.title << ": " << code;
  }
}

// A code that only sets a mode is told from others of its group by S alone (G96), which stands for itself.
TEST(Manual, gives_codes_only_words_that_they_take) {
  for (const ManualSection& section : manual_sections()) {
    for (const auto& [cell, codes] : section.letters_of_line) {
      for (const std::string& letter : letters_in(cell)) {
        const bool is_taken = letter == "S" || std::ranges::any_of(codes, [&](const std::string& code) {
                                const CodeEntry* const entry = entry_of(code);
                                return entry != nullptr && takes(*entry, letter);
                              });
        EXPECT_TRUE(is_taken) << section.title << ": " << cell << ": " << letter;
      }
    }
  }
}

TEST(Manual, names_each_word_that_a_code_takes_in_a_section_of_the_code) {
  const std::vector<ManualSection> sections = manual_sections();
  for (const CodeEntry& entry : code_entries()) {
    Words named;
    for (const ManualSection& section : sections) {
      if (section.codes.contains(spelling(entry))) named.merge(letters_in(section.text));
    }
    for (const char letter : std::string("DEHIJKLPQR")) {
      if (!entry.letters.has(letter)) continue;
      EXPECT_TRUE(named.contains(std::string(1, letter))) << spelling(entry) << " takes " << letter;
    }
  }
}

TEST(Manual, has_each_predefined_name) {
  std::ifstream manual(PASSO_SOURCE_DIR "/docs/gcode.md");
  const std::string text{std::istreambuf_iterator<char>(manual), {}};
  for (const PredefinedParameter& parameter : predefined_parameters()) {
    const std::string name(parameter.name);
    const bool is_place = std::regex_match(name, std::regex("_(abs_)?[xyzabcuvw]"));
    EXPECT_TRUE(is_place || std::regex_search(text, std::regex("[ `]" + name + "[ `]"))) << name;
  }
}

// "G0 to G4", "G38.2 to G38.5": what the row of grbl's dialect lists.
Words codes_in_list(const std::string& list) {
  static const std::regex pattern("([GM])(\\d+(?:\\.\\d)?)(?: to [GM](\\d+(?:\\.\\d)?))?");
  Words codes;
  for (std::sregex_iterator found(list.begin(), list.end(), pattern), end; found != end; ++found) {
    const CodeNumber first = number_in((*found)[1].str() + (*found)[2].str());
    const CodeNumber last = (*found)[3].matched ? number_in((*found)[1].str() + (*found)[3].str()) : first;
    for (const CodeEntry& entry : code_entries()) {
      if (entry.letter != first_of((*found)[1]) || entry.number < first || entry.number > last) continue;
      if (entry.number % 10 == 0 || last % 10 != 0) codes.insert(spelling(entry));
    }
  }
  return codes;
}

TEST(Manual, lists_the_codes_of_the_dialect_of_grbl) {
  std::ifstream manual(PASSO_SOURCE_DIR "/docs/gcode.md");
  std::map<GrblUse, Words> listed;
  std::optional<GrblUse> use;
  for (std::string line; std::getline(manual, line);) {
    if (line.starts_with("| executed ")) use = GrblUse::executed;
    if (line.starts_with("| accepted without effect")) use = GrblUse::without_effect;
    if (line.starts_with("| shown") || line.starts_with("| words")) use.reset();
    if (use && line.starts_with("| ")) listed[*use].merge(codes_in_list(line.substr(line.find("| ", 2))));
  }
  std::map<GrblUse, Words> used;
  for (const CodeEntry& entry : code_entries()) {
    if (entry.grbl != GrblUse::refused) used[entry.grbl].insert(spelling(entry));
  }
  EXPECT_EQ(listed[GrblUse::executed], used[GrblUse::executed]);
  EXPECT_EQ(listed[GrblUse::without_effect], used[GrblUse::without_effect]);
}

TEST(Manual, a_cell_of_a_table_is_read_as_people_do) {
  EXPECT_EQ(codes_in("G59.1 … G59.3"), (Words{"G59.1", "G59.2", "G59.3"}));
  EXPECT_EQ(codes_in("M66 `P` `L` `Q`, M66 `E`"), (Words{"M66"}));
  EXPECT_EQ(letters_in("… `I J K` or `R`"), (Words{"I", "J", "K", "R"}));
  EXPECT_EQ(codes_in_list("G28, G38.2 to G38.4, M2 to M4"),
            (Words{"G28", "G38.2", "G38.3", "G38.4", "M2", "M3", "M4"}));
}

}  // namespace
}  // namespace passo
