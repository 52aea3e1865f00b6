#include "file_fields.hpp"

#include <charconv>
#include <cmath>

#include "rules.hpp"

#include "passo/base/read_double.hpp"

namespace passo {
namespace {

constexpr std::string_view blanks = " \t\r\f\v";
constexpr double largest_number = 1e12;

// People and LinuxCNC write "+1", but std::from_chars does not accept the plus.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

}  // namespace

bool FieldReader::next_line() {
  at_ = 0;
  line_ = {};
  return !diagnostics_.full() && reader_.next_line(line_, number_, diagnostics_);
}

bool FieldReader::next_field(Field& field) {
  at_ = std::min(line_.find_first_not_of(blanks, at_), line_.size());
  if (at_ == line_.size()) return false;
  const std::size_t end = std::min(line_.find_first_of(blanks, at_), line_.size());
  field = {line_.substr(at_, end - at_), static_cast<std::uint32_t>(at_ + 1)};
  at_ = end;
  return true;
}

Field FieldReader::rest() const {
  const std::size_t first = std::min(line_.find_first_not_of(blanks, at_), line_.size());
  std::string_view text = line_.substr(first);
  while (!text.empty() && blanks.find(text.back()) != std::string_view::npos) text.remove_suffix(1);
  return {text, static_cast<std::uint32_t>(first + 1)};
}

void FieldReader::report(Severity severity, std::string_view code, const Field& field, FindingWords message,
                         FindingWords expected) {
  const auto length = static_cast<std::uint32_t>(std::max<std::size_t>(field.text.size(), 1));
  Diagnostic diagnostic{.severity = severity,
                        .code = std::string(code),
                        .file = file_,
                        .place = {number_, field.column, length},
                        .message = std::move(message),
                        .expected = std::move(expected),
                        .text = std::string(line_)};
  diagnostic.rule = rule_of(diagnostic);
  diagnostics_.add(std::move(diagnostic));
}

void FieldReader::error(std::string_view code, FindingWords message, FindingWords expected) {
  at_ = 0;
  error(code, rest(), std::move(message), std::move(expected));
}

std::optional<double> number_of(std::string_view text) {
  text = without_plus(text);
  double value = 0;
  const auto [end, problem] = read_double(text.data(), text.data() + text.size(), value);
  const bool good = problem == std::errc() && end == text.data() + text.size() && std::abs(value) < largest_number;
  return good ? std::optional(value) : std::nullopt;
}

std::optional<std::int32_t> whole_number_of(std::string_view text) {
  text = without_plus(text);
  std::int32_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string quote(text.substr(0, longest));
  for (char& c : quote) {
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) c = '?';
  }
  return "'" + quote + (text.size() > longest ? "...'" : "'");
}

}  // namespace passo
