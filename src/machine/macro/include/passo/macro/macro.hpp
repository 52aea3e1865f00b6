// Macro: a small G-code program with a name and values that a person fills in, e.g. for a button.
//
// A macro is a file NAME.ngc. Its first lines begin with ';' and are its head, as TOML; the title comes first:
//
//   ; title = "Face the stock"
//   ; [value.width]
//   ; unit = "mm"
//   ; least = 1
//   ; most = 400
//   ; default = 100
//   G91 G1 X#<width> F1000
//
// macro_program() makes a program of it: '%', an assignment for each value, and the macro's own lines, with their line
// numbers. The program is checked and run like any other. It ends with '%', so the end moves of the machine file do not
// follow it, unless the macro has M2 or M30 itself.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/base/sentence.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

// A number that the macro asks for.
struct MacroValue {
  std::string name;   // of the named parameter: letters, digits and _
  std::string title;  // for people
  std::string unit;   // "mm", "mm/min", "deg", "rpm", "s", "%" or empty
  double low = 0;     // the range, both ends included
  double high = 0;
  bool is_whole = false;
  std::optional<double> usual = {};  // empty: the person has to give it
};

struct Macro {
  static constexpr std::size_t longest = std::size_t{1} << 20;  // bytes
  static constexpr std::size_t most_values = 20;

  std::string name;  // of its file, without .ngc
  std::string title;
  std::string key;  // "F1" to "F12"; empty: none
  // The button of the board that starts it while the machine is idle: "cycle_start" or "feed_hold"; empty: none.
  std::string input;
  std::vector<MacroValue> values;
  std::string text;              // the whole file
  std::uint32_t head_lines = 0;  // at its beginning
};

// Returns whether the text begins with the head of a macro: a comment with its title.
bool has_macro_head(std::string_view text);
// Reads a macro. `file` names it in diagnostics, whose codes begin with "macro.". Nothing: it has errors.
std::optional<Macro> parse_macro(std::string_view text, const std::string& name, const std::string& file,
                                 Diagnostics& diagnostics);

using MacroValues = std::map<std::string, double>;
// Returns the macro as a program, with its values. The error tells which value is missing, unknown or out of its range.
Result<std::string, Sentence> macro_program(const Macro& macro, const MacroValues& given);

// The macros of a folder, in the order of their names, and what is wrong with the others.
struct MacroFolder {
  static constexpr std::size_t most_macros = 100;

  std::vector<Macro> macros;
  Diagnostics findings;
};
// Reads all files of the folder that have the head of a macro. Other files are subroutines.
MacroFolder read_macro_folder(const std::string& folder);

}  // namespace passo
