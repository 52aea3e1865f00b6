// The bytes of a machine file. What cannot be a machine file is refused before a parser sees it.
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "machine_reader.hpp"
#include <fmt/format.h>

#include "passo/machine_file/machine_description.hpp"

namespace passo {
namespace {

constexpr std::size_t largest_file = 1U << 20U;
constexpr std::size_t longest_line = 4096;
// The TOML library recurses as deep as keys have dots, and limits only the nesting of brackets. A machine file needs a
// dot or two in a line, and numbers have some.
constexpr std::size_t most_dots = 16;
constexpr std::size_t most_errors = 1000;  // kept, so that they can be sorted

struct FileCloser {
  void operator()(std::FILE* file) const { (void)std::fclose(file); }
};

void file_error(Diagnostics& diagnostics, const char* code, const std::string& file, std::string message,
                std::string expected) {
  diagnostics.add({.severity = Severity::error,
                   .code = code,
                   .file = file,
                   .place = {},
                   .message = std::move(message),
                   .expected = std::move(expected),
                   .text = {}});
}

// The number of dots that may belong to keys, without those of comments. Never less than the true number.
std::size_t dots_of(std::string_view line) {
  const bool has_quotes = line.find_first_of("\"'") != std::string_view::npos;
  const std::string_view relevant = has_quotes ? line : line.substr(0, line.find('#'));
  return static_cast<std::size_t>(std::ranges::count(relevant, '.'));
}

// A machine file is checked by meaning, but a person corrects it from top to bottom: so sort by line.
void hand_over(const Diagnostics& found, Diagnostics& diagnostics) {
  std::vector<Diagnostic> sorted = found.all();
  std::ranges::stable_sort(sorted, [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  for (Diagnostic& diagnostic : sorted) diagnostics.add(std::move(diagnostic));
}

}  // namespace

// A text over several lines is refused too: without such texts a comment can be
// recognised from its line alone.
bool is_fit_for_parser(const TomlReporter& reporter) {
  for (std::uint32_t number = 1; number <= reporter.line_count(); ++number) {
    const std::string_view line = reporter.line(number);
    const auto refuse = [&](const char* code, std::size_t offset, std::string message, std::string expected) {
      reporter.error(code, {.line = number, .column = static_cast<std::uint32_t>(offset + 1)}, std::move(message),
                     std::move(expected));
      return false;
    };
    if (const std::size_t zero = line.find('\0'); zero != std::string_view::npos) {
      return refuse("machine.binary", zero, "this is not text: it has a zero byte", "a text file in UTF-8");
    }
    if (line.size() > longest_line) {
      return refuse("machine.long-line", longest_line, fmt::format("a line of {} bytes", line.size()),
                    fmt::format("at most {} bytes", longest_line));
    }
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] == '#') continue;
    const std::size_t triple = std::min(line.find(R"(""")"), line.find("'''"));
    if (triple != std::string_view::npos) {
      return refuse("machine.syntax", triple, "a text over several lines",
                    "a text on one line, as in name = \"Router\"");
    }
    if (const std::size_t dots = dots_of(line); dots > most_dots) {
      return refuse("machine.too-deep", line.find('.'), fmt::format("a line with {} dots", dots),
                    fmt::format("at most {}: keys as in 'clock_hz', tables as in '[axis.X]'", most_dots));
    }
  }
  return true;
}

std::optional<std::string> machine_file_text(const std::string& path, Diagnostics& diagnostics) {
  errno = 0;
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  std::string text(largest_file + 1, '\0');
  if (file != nullptr) text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  if (file == nullptr || std::ferror(file.get()) != 0) {
    file_error(diagnostics, "machine.cannot-read", path, fmt::format("cannot read it: {}", std::strerror(errno)),
               "the path of a machine file");
    return std::nullopt;
  }
  return text;
}

std::optional<MachineDescription> load_machine_file(const std::string& path, Diagnostics& diagnostics) {
  const auto text = machine_file_text(path, diagnostics);
  if (!text) return std::nullopt;
  return parse_machine(*text, path, diagnostics);
}

std::optional<MachineDescription> parse_machine(std::string_view text, const std::string& file,
                                                Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    file_error(diagnostics, "machine.empty", file, "the file is empty", "a machine file: name, [board], [axis.X]...");
    return std::nullopt;
  }
  if (text.size() > largest_file) {
    file_error(diagnostics, "machine.too-big", file, fmt::format("the file has more than {} bytes", largest_file),
               "a machine file is a page of text");
    return std::nullopt;
  }
  Diagnostics found(most_errors);
  const TomlReporter reporter(text, file, found);
  MachineDescription machine;
  if (is_fit_for_parser(reporter)) machine = read_machine(parse_toml(std::string(text), reporter), reporter);
  hand_over(found, diagnostics);
  if (found.any_error()) return std::nullopt;
  return machine;
}

}  // namespace passo
