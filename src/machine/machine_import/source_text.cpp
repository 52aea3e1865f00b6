#include "source_text.hpp"

#include <utility>

#include <fmt/format.h>

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

constexpr std::string_view blank_characters = " \t\r\v\f";

}  // namespace

std::string_view without_blanks(std::string_view text) {
  return trimmed(text, blank_characters);
}

SourceLines::SourceLines(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

bool SourceLines::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = rest_.find('\n');
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  ++number_;
  line = line_;
  return true;
}

std::uint32_t SourceLines::column_of(std::string_view part) const {
  return static_cast<std::uint32_t>(part.data() - line_.data() + 1);
}

void add_import_error(const ImportSource& source, Diagnostics& diagnostics, const char* code, SourceLocation place,
                      std::string message, std::string expected, std::string_view line) {
  diagnostics.add({.code = code,
                   .file = source.file,
                   .place = place,
                   .message = std::move(message),
                   .expected = std::move(expected),
                   .text = std::string(line)});
}

bool is_source_text(const ImportSource& source, Diagnostics& diagnostics) {
  if (source.text.size() > most_source_bytes) {
    add_import_error(source, diagnostics, "import.too-large", {},
                     fmt::format("the file has more than {} bytes", most_source_bytes),
                     "the configuration of a controller, usually a few pages of text");
    return false;
  }
  if (source.text.find('\0') != std::string_view::npos) {
    add_import_error(source, diagnostics, "import.binary", {}, "this is not text: it contains a NUL byte",
                     "a text file in UTF-8");
    return false;
  }
  return true;
}

}  // namespace passo
