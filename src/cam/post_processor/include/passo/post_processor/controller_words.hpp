// ControllerWords: the words that a controller understands, one row for each controller. `--for`, the PostProcessor and
// the table of the manual are based on these rows. Each row follows the public documentation that it names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace passo {

// How a program calls a tool.
enum class ToolCall : std::uint8_t {
  m6,             // T2 M6
  m6_and_length,  // T2 M6, and G43 H2 with the next move along Z: the controller has a tool table
  pause,          // T2, and M0 for a manual change
};

// Arcs that a controller does not accept are split: into arcs, or into lines if the radius is out of range.
struct ArcLimits {
  double least_radius = 0;    // mm
  double most_radius = 1e9;   // mm
  double most_degrees = 360;  // of one arc
};

// The form of a number.
struct NumberForm {
  int mm_decimals = 4;
  int inch_decimals = 5;
  bool has_point = false;  // a length without a point would be read in the smallest unit
};

// The form of a program as a whole.
struct ProgramForm {
  std::string_view end = "M2";
  std::string_view path_mode = {};  // "G64": added to the modes at the start
  bool has_path_tolerance = false;  // P of `path_mode`
  bool has_frame = false;           // '%' at the start and the end, and a program number
  int line_step = 0;                // step of line numbers; 0: none
  bool dwells_in_ms = false;        // P of G4; otherwise seconds
};

// The form of a comment, and the limits of a line.
struct CommentForm {
  bool has_messages = true;        // (MSG, ...) is shown to the operator
  bool has_capitals_only = false;  // A to Z, digits and a few signs
  bool is_ascii = false;
  std::string_view realtime = {};  // characters on which the controller acts at once, even in comments
  std::size_t longest_line = 0;    // characters; 0: any length
};

struct ControllerWords {
  std::string_view name;           // "grbl", as in --for
  std::string_view title;          // "Grbl 1.1"
  std::string_view documentation;  // where its words are documented
  std::string_view letters;        // of words; empty: all
  std::string_view g_words;        // numbers after G, separated by blanks; empty: all
  std::string_view m_words;        // numbers after M
  ToolCall tool_call = ToolCall::m6;
  ArcLimits arcs = {};
  NumberForm numbers = {};
  ProgramForm form = {};
  CommentForm comments = {};
  bool lacks_mist = false;  // M7 is an option of its build, which is off by default

  bool knows_letter(char letter) const { return letters.empty() || letters.find(letter) != std::string_view::npos; }
  // `number`: "38.2".
  bool knows_g(std::string_view number) const { return g_words.empty() || is_listed(g_words, number); }
  bool knows_m(std::string_view number) const { return m_words.empty() || is_listed(m_words, number); }
  // Whether it accepts every word, as Passo's own row does; `passo check` checks such programs.
  bool knows_all() const { return letters.empty(); }

 private:
  static bool is_listed(std::string_view list, std::string_view number);
};

// The first row is Passo's own.
std::span<const ControllerWords> controllers();
// Null if there is no controller of this name.
const ControllerWords* find_controller(std::string_view name);

}  // namespace passo
