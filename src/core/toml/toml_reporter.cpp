#include "passo/toml/toml_reporter.hpp"

#include <algorithm>
#include <utility>

namespace passo {
namespace {

// The number of bytes before the character with this number (from 1). Past the end of the line each character counts as
// one byte.
std::size_t bytes_before(std::string_view line, std::uint32_t character) {
  std::size_t byte = 0;
  for (std::uint32_t i = 1; i < character; ++i) {
    ++byte;
    while (byte < line.size() && (static_cast<unsigned char>(line[byte]) & 0xC0U) == 0x80U) ++byte;
  }
  return std::min(byte, line.size());
}

// Messages quote keys and values of the file. Their control characters must not reach a terminal.
void make_printable(std::string& text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) c = '?';
  }
}

FindingWords printable(const FindingWords& words) {
  Sentence sentence = words.sentence();
  make_printable(sentence.text);
  for (auto& [name, value] : sentence.arguments) make_printable(value);
  return sentence;
}

}  // namespace

TomlReporter::TomlReporter(std::string_view text, std::string file, Diagnostics& diagnostics, TomlFileKind kind)
    : file_(std::move(file)), kind_(std::move(kind)), diagnostics_(diagnostics) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines_.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

void TomlReporter::error(std::string_view code, const SourceLocation& place, const FindingWords& message,
                         const FindingWords& expected) const {
  diagnostics_.add({.severity = Severity::error,
                    .code = kind_.area + std::string(code.substr(std::min(code.find('.'), code.size()))),
                    .file = file_,
                    .place = place,
                    .message = printable(message),
                    .expected = printable(expected),
                    .text = std::string(line(place.line))});
}

std::string_view TomlReporter::line(std::uint32_t number) const {
  return number == 0 || number > lines_.size() ? std::string_view() : lines_[number - 1];
}

SourceLocation TomlReporter::place(std::uint32_t line, std::uint32_t first_character,
                                   std::uint32_t end_character) const {
  const std::size_t first = bytes_before(this->line(line), first_character);
  const std::size_t end = bytes_before(this->line(line), std::max(first_character + 1, end_character));
  return {.line = line,
          .column = static_cast<std::uint32_t>(first + 1),
          .length = static_cast<std::uint32_t>(std::max<std::size_t>(1, end - first))};
}

}  // namespace passo
