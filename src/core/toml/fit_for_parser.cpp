#include "passo/toml/fit_for_parser.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t longest_line = 4096;
// The TOML library recurses as deep as keys have dots, and limits only the nesting of brackets. A machine file needs a
// dot or two in a line, and numbers have some.
constexpr std::size_t most_dots = 16;

// The number of dots that may belong to keys, without those of comments. Never less than the true number.
std::size_t dots_of(std::string_view line) {
  const bool has_quotes = line.find_first_of("\"'") != std::string_view::npos;
  const std::string_view relevant = has_quotes ? line : line.substr(0, line.find('#'));
  return static_cast<std::size_t>(std::ranges::count(relevant, '.'));
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
