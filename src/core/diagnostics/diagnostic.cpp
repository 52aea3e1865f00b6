#include "passo/diagnostics/diagnostic.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/diagnostics/shown_location.hpp"

namespace passo {
namespace {

// A source line may be a megabyte long, so only a window around the place is shown: bytes before and after it.
constexpr std::size_t window_before = 60;
constexpr std::size_t window_after = 40;
// Calls shown at each end of a long stack of calls.
constexpr std::size_t calls_shown = 4;
// Of the lines with the same finding.
constexpr std::size_t lines_shown = 3;

struct Window {
  std::string text;       // without control characters
  std::size_t caret = 0;  // offset of the place in `text`
};

bool is_continuation_byte(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// The caret counts characters, not bytes, so that it stands under what it means.
std::size_t characters(std::string_view bytes) {
  return static_cast<std::size_t>(std::ranges::count_if(bytes, [](char c) { return !is_continuation_byte(c); }));
}

Window window_around(std::string_view line, std::size_t offset, std::size_t length) {
  offset = std::min(offset, line.size());
  std::size_t first = offset > window_before ? offset - window_before : 0;
  std::size_t last = std::min(line.size(), offset + std::max(length, window_after));
  last = std::min(last, offset + window_before + window_after);
  while (first > 0 && is_continuation_byte(line[first])) --first;
  while (last < line.size() && is_continuation_byte(line[last])) ++last;

  Window window;
  if (first > 0) window.text = "...";
  window.caret = characters(window.text) + characters(line.substr(first, offset - first));
  window.text += line.substr(first, last - first);
  if (last < line.size()) window.text += "...";
  for (char& c : window.text) {
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) c = ' ';
  }
  return window;
}

void append_calls(const std::vector<CallLocation>& calls, std::string& out) {
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const std::size_t left_out = calls.size() > 2 * calls_shown ? calls.size() - 2 * calls_shown : 0;
    if (left_out > 1 && i == calls_shown) {
      out += fmt::format("      = ... {} more calls ...\n", left_out);
      i += left_out;
    }
    out += fmt::format("      = in {}, called at {}:{}\n", calls[i].sub, calls[i].file, calls[i].line);
  }
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

SourceLocation shown_location(const Diagnostic& diagnostic) {
  SourceLocation place = diagnostic.place;
  const std::string_view text = diagnostic.text;
  if (place.column == 0 || place.column > text.size()) return place;
  const std::size_t before = place.column - 1;
  place.column = static_cast<std::uint32_t>(characters(text.substr(0, before)) + 1);
  const std::size_t inside = std::min<std::size_t>(place.length, text.size() - before);
  place.length -= static_cast<std::uint32_t>(inside - characters(text.substr(before, inside)));
  return place;
}

void Diagnostic::add_line(std::uint32_t line) {
  if (line == place.line || more_lines.size() >= most_lines) return;
  const auto after = std::ranges::lower_bound(more_lines, line);
  if (after == more_lines.end() || *after != line) more_lines.insert(after, line);
}

std::string more_lines_in_words(const Diagnostic& diagnostic) {
  const std::vector<std::uint32_t>& lines = diagnostic.more_lines;
  if (lines.empty()) return {};
  const std::size_t shown = std::min(lines.size(), lines_shown);
  return fmt::format("and {}{} more, line{} {}{}", lines.size(), lines.size() == Diagnostic::most_lines ? " or" : "",
                     plural_end(lines.size() == 1),
                     fmt::join(lines.begin(), lines.begin() + static_cast<long>(shown), ", "),
                     shown < lines.size() ? ", ..." : "");
}

void Diagnostics::add(Diagnostic diagnostic) {
  if (!doubt_.empty() && diagnostic.severity == Severity::error) {
    diagnostic.severity = Severity::warning;
    diagnostic.message = diagnostic.message + ", " + doubt_;  // other words, which no code stands for
  }
  add_certain(std::move(diagnostic));
}

void Diagnostics::add_certain(Diagnostic diagnostic) {
  // A line in a loop is run often, but its mistake is reported once.
  const auto is_same = [&](const Diagnostic& other) {
    return other.place == diagnostic.place && other.code == diagnostic.code && other.file == diagnostic.file;
  };
  if (diagnostic.place.line > 0 && std::ranges::any_of(all_, is_same)) return;
  if (diagnostic.severity == Severity::warning && diagnostic.place.line > 0) {
    const auto again = std::ranges::find_if(all_, [&](const Diagnostic& other) {
      return other.severity == Severity::warning && other.code == diagnostic.code && other.file == diagnostic.file &&
             other.message == diagnostic.message;
    });
    if (again != all_.end()) return again->add_line(diagnostic.place.line);
  }
  if (diagnostic.severity == Severity::error && ++errors_ > limit_) return;
  if (diagnostic.severity == Severity::warning && all_.size() >= 4 * limit_) return;
  if (diagnostic.rule.empty() && rule_of_ != nullptr) diagnostic.rule = rule_of_(diagnostic);
  all_.push_back(std::move(diagnostic));
}

bool Diagnostics::count_repeated(std::string_view code, std::string_view file, std::uint32_t line) {
  const auto found = std::ranges::find_if(all_, [&](const Diagnostic& kept) {
    return kept.severity == Severity::warning && kept.code == code && kept.file == file;
  });
  if (found == all_.end()) return false;
  found->add_line(line);
  return true;
}

std::string render(const Diagnostic& diagnostic, bool colour) {
  const auto paint = [colour](const char* code, std::string_view text) {
    return colour ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
  };
  const bool is_error = diagnostic.severity == Severity::error;
  const SourceLocation& place = diagnostic.place;

  std::string where = diagnostic.file;
  if (place.line > 0) where += fmt::format(":{}", place.line);
  if (place.line > 0 && place.column > 0) where += fmt::format(":{}", shown_location(diagnostic).column);

  std::string out = where.empty() ? std::string() : paint("1", where) + ": ";
  out += fmt::format("{}: {} [{}]\n", is_error ? paint("1;31", "error") : paint("1;35", "warning"),
                     paint("1", diagnostic.message), diagnostic.code);
  if (place.line > 0 && place.column > 0 && !diagnostic.text.empty()) {
    const Window window = window_around(diagnostic.text, place.column - 1, place.length);
    const std::size_t room = characters(window.text) > window.caret ? characters(window.text) - window.caret : 1;
    const std::size_t length = std::clamp<std::size_t>(shown_location(diagnostic).length, 1, room);
    out += fmt::format("{:>5} | {}\n", place.line, window.text);
    out += fmt::format("      | {}{}\n", std::string(window.caret, ' '),
                       paint("1;32", "^" + std::string(length - 1, '~')));
  }
  if (!diagnostic.expected.empty()) out += fmt::format("      = expected: {}\n", diagnostic.expected);
  if (!diagnostic.rule.empty()) out += fmt::format("      = rule: {}\n", diagnostic.rule);
  append_calls(diagnostic.calls, out);
  if (!diagnostic.more_lines.empty()) out += fmt::format("      = {}\n", more_lines_in_words(diagnostic));
  return out;
}

std::string render(const Diagnostics& diagnostics, bool colour) {
  std::string out;
  for (const Diagnostic& diagnostic : diagnostics.all()) out += render(diagnostic, colour);
  const std::size_t errors = diagnostics.errors();
  if (errors == 0) return out;
  const auto kept = static_cast<std::size_t>(std::ranges::count_if(
      diagnostics.all(), [](const Diagnostic& diagnostic) { return diagnostic.severity == Severity::error; }));
  out += counted(errors, "error");
  if (kept < errors) out += fmt::format(", the first {} shown", kept);
  return out + "\n";
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
  std::string_view best;
  std::size_t best_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string_view candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string_view suggestion(std::string_view word, const std::vector<std::string_view>& known) {
  if (const std::string_view near = nearest(word, known); !near.empty()) return near;
  const auto is_meant = [word](std::string_view candidate) {
    const bool same_start = word.size() >= 3 && (candidate.starts_with(word) || word.starts_with(candidate));
    return same_start || std::ranges::is_permutation(word, candidate);
  };
  const auto found = std::ranges::find_if(known, is_meant);
  return found == known.end() ? std::string_view() : *found;
}

}  // namespace passo
