#include "passo/toml/fit_for_parser.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t longest_line = 4096;
// The TOML library recurses as deep as keys have dots, and limits only the nesting of brackets. A machine file needs a
// dot or two in a line.
constexpr std::size_t most_dots = 16;

bool is_digit(char c) {
  return (c >= '0' && c <= '9') || c == '_';
}

// Whether the dot can only be that of a number: 1.5, but neither 1.5.2 nor 1.5 = 2.
bool is_dot_of_number(std::string_view line, std::size_t dot) {
  std::size_t first = dot;
  while (first > 0 && is_digit(line[first - 1])) --first;
  std::size_t end = dot + 1;
  while (end < line.size() && is_digit(line[end])) ++end;
  constexpr std::string_view starts = " \t,[-+=";
  constexpr std::string_view ends = " \t,]}";
  if (first == dot || end == dot + 1) return false;
  if (first > 0 && starts.find(line[first - 1]) == std::string_view::npos) return false;
  if (end < line.size() && ends.find(line[end]) == std::string_view::npos) return false;
  const std::size_t before = line.substr(0, first).find_last_not_of(" \t");
  const std::size_t after = line.find_first_not_of(" \t", end);
  const bool follows_dot = before != std::string_view::npos && line[before] == '.';
  return !follows_dot && (after == std::string_view::npos || (line[after] != '.' && line[after] != '='));
}

// The number of dots that may belong to keys, without those of comments and numbers. Never less than the true number.
std::size_t dots_of(std::string_view line) {
  const bool has_quotes = line.find_first_of("\"'") != std::string_view::npos;
  const std::string_view relevant = has_quotes ? line : line.substr(0, line.find('#'));
  std::size_t dots = 0;
  for (std::size_t i = 0; i < relevant.size(); ++i)
    dots += relevant[i] == '.' && !is_dot_of_number(relevant, i) ? 1 : 0;
  return dots;
}

// The offset of the first byte outside of strings and comments that is not ASCII, or npos. TOML has none there. The
// library is undefined for some of them (its test for spaces ends in TOML_UNREACHABLE), and accepts three as spaces.
std::size_t bare_letter(std::string_view line) {
  constexpr std::string_view spaces[] = {"\xC2\xA0", "\xE3\x80\x80", "\xEF\xBB\xBF"};
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == '\\' && quote == '"') ++i;
      if (c == quote) quote = 0;
    } else if (c == '#') {
      break;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (static_cast<unsigned char>(c) >= 0x80) {
      const auto* const space =
          std::ranges::find_if(spaces, [&](std::string_view one) { return line.substr(i).starts_with(one); });
      if (space == std::end(spaces)) return i;
      i += space->size() - 1;
    }
  }
  return std::string_view::npos;
}

}  // namespace

bool is_fit_for_parser(const TomlReporter& reporter) {
  for (std::uint32_t number = 1; number <= reporter.line_count(); ++number) {
    const std::string_view line = reporter.line(number);
    const auto refuse = [&](const char* code, std::size_t offset, std::string message, std::string expected) {
      reporter.error(code, {.line = number, .column = static_cast<std::uint32_t>(offset + 1)}, std::move(message),
                     std::move(expected));
      return false;
    };
    if (const std::size_t zero = line.find('\0'); zero != std::string_view::npos) {
      return refuse("machine.binary", zero, "this is not text: it contains a NUL byte", "a text file in UTF-8");
    }
    if (line.size() > longest_line) {
      return refuse("machine.long-line", longest_line, fmt::format("a line of {} bytes", line.size()),
                    fmt::format("at most {} bytes", longest_line));
    }
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] == '#') continue;
    const std::size_t triple = std::min(line.find(R"(""")"), line.find("'''"));
    if (triple != std::string_view::npos) {
      return refuse("machine.syntax", triple, "a string over several lines",
                    "a string on one line, e.g. name = \"Router\"");
    }
    if (const std::size_t letter = bare_letter(line); letter != std::string_view::npos) {
      return refuse("machine.syntax", letter, "a character outside of quotes that is not ASCII",
                    "keys of plain letters; other characters only in a text, e.g. name = \"Fräse\"");
    }
    if (const std::size_t dots = dots_of(line); dots > most_dots) {
      return refuse("machine.too-deep", line.find('.'), fmt::format("a line with {} dots", dots),
                    fmt::format("at most {}; keys like 'clock_hz', tables like '[axis.X]'", most_dots));
    }
  }
  return true;
}

void hand_over(const Diagnostics& found, Diagnostics& diagnostics) {
  std::vector<Diagnostic> sorted = found.all();
  std::ranges::stable_sort(sorted, [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  for (Diagnostic& diagnostic : sorted) diagnostics.add(std::move(diagnostic));
}

}  // namespace passo
