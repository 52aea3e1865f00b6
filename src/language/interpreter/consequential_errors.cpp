#include "consequential_errors.hpp"

#include <algorithm>
#include <iterator>

namespace passo {
namespace {

struct Consequence {
  std::string_view code;
  LetterSet of;  // the words that would have set what is missing
};
constexpr Consequence consequences[] = {
    {"gcode.missing-feed", "F"}, {"grbl.undefined-feed", "F"}, {"gcode.missing-motion", "G"},
    {"gcode.spindle-off", "MS"}, {"gcode.missing-speed", "S"},
};

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

// The character that closes the bracket or comment at `open`, or `open` if none does: words may stand behind one that
// was left open.
std::size_t closing(std::string_view line, std::size_t open, char closer) {
  int depth = 0;
  for (std::size_t at = open; at < line.size(); ++at) {
    if (line[at] == line[open]) ++depth;
    if (line[at] == closer && --depth == 0) return at;
  }
  return open;
}

}  // namespace

// Names are the same in any case and spacing.
std::string ConsequentialErrors::normal(std::string_view name) {
  std::string result;
  for (const char c : name) {
    if (!is_blank(c)) result += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return result;
}

// From the '#' at `at`. Returns where it ends.
std::size_t ConsequentialErrors::scan_parameter(std::string_view line, std::size_t at) {
  const std::size_t close = line.find('>', at);
  const std::size_t next = line.find_first_not_of(" \t", at + 1);
  if (next == std::string_view::npos || line[next] != '<' || close == std::string_view::npos) return at;
  const std::size_t after = line.find_first_not_of(" \t", close + 1);
  if (after != std::string_view::npos && line[after] == '=') names_.insert(normal(line.substr(at, close + 1 - at)));
  return close;
}

void ConsequentialErrors::scan(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == ';') return;
    if (c == '(') i = closing(line, i, ')');
    if (c == '[') i = closing(line, i, ']');
    if (c == '#') i = scan_parameter(line, i);
    if (c == '@' || c == '^') axes_ = axes_ | "XY";
    const char letter = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (letter < 'A' || letter > 'Z') continue;
    letters_.add(letter);
    if (axis_letters.has(letter)) axes_.add(letter);
  }
}

bool ConsequentialErrors::explain(std::string_view code) const {
  if (!letters_.any()) return false;
  const auto* const found = std::ranges::find(consequences, code, &Consequence::code);
  return found != std::end(consequences) && (found->of & letters_).any();
}

}  // namespace passo
