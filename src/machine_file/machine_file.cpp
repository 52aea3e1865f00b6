// The bytes of a machine file: what cannot be one is refused before a parser sees it.
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
// The depth of a TOML tree grows with the dots of a key: a bound for the line is one for the depth.
constexpr std::size_t longest_line = 4096;
constexpr std::size_t most_errors = 1000;  // kept to be sorted

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

// At most one byte more than a machine file may have.
std::optional<std::string> read_file(const std::string& path, Diagnostics& diagnostics) {
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

bool is_text_of_bounded_lines(const Reporter& reporter) {
  for (std::uint32_t number = 1; number <= reporter.line_count(); ++number) {
    const std::string_view line = reporter.line(number);
    if (const std::size_t zero = line.find('\0'); zero != std::string_view::npos) {
      reporter.error("machine.binary", {.line = number, .column = static_cast<std::uint32_t>(zero + 1)},
                     "this is not text: it has a zero byte", "a text file in UTF-8");
      return false;
    }
    if (line.size() > longest_line) {
      reporter.error("machine.long-line", {.line = number, .column = longest_line + 1},
                     fmt::format("a line of {} bytes", line.size()), fmt::format("at most {} bytes", longest_line));
      return false;
    }
  }
  return true;
}

// A machine file is read by meaning; a person mends it from the top.
void hand_over(const Diagnostics& found, Diagnostics& diagnostics) {
  std::vector<Diagnostic> sorted = found.all();
  std::ranges::stable_sort(sorted, [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  for (Diagnostic& diagnostic : sorted) diagnostics.add(std::move(diagnostic));
}

}  // namespace

std::optional<MachineDescription> load_machine_file(const std::string& path, Diagnostics& diagnostics) {
  const auto text = read_file(path, diagnostics);
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
  const Reporter reporter(text, file, found);
  MachineDescription machine;
  if (is_text_of_bounded_lines(reporter)) machine = read_machine(parse_toml(std::string(text), reporter), reporter);
  hand_over(found, diagnostics);
  if (found.any_error()) return std::nullopt;
  return machine;
}

}  // namespace passo
