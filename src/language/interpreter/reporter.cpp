#include "reporter.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

// What a function or an operation of the language takes. `text` is where it stands in the program.
std::string_view domain_of(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (c == '[') break;
    if (c >= 'a' && c <= 'z') name += static_cast<char>(c - 'a' + 'A');
    if (c >= 'A' && c <= 'Z') name += c;
  }
  if (name == "SQRT") return "SQRT of 0 or more";
  if (name == "LN") return "LN of more than 0";
  if (name == "ASIN") return "ASIN of -1 to 1";
  if (name == "ACOS") return "ACOS of -1 to 1";
  return "a whole-number exponent, because the base is negative";
}

SourceLocation place_of(std::uint32_t line, Span span) {
  return {line, span.column, span.length == 0 ? 1 : span.length};
}

}  // namespace

void Reporter::error(std::string_view code, Span span, FindingWords message, FindingWords expected) {
  const bool is_consequence = doubts_.explain(code);
  doubt();
  if (is_consequence) return meet_again();
  add(Severity::error, code, block_->line, block_->text, span, std::move(message), std::move(expected));
}

void Reporter::warning(std::string_view code, Span span, FindingWords message, FindingWords expected) {
  add(Severity::warning, code, block_->line, block_->text, span, std::move(message), std::move(expected));
}

void Reporter::error_at(std::string_view code, std::uint32_t line, std::string_view text, Span span,
                        FindingWords message, FindingWords expected) {
  add(Severity::error, code, line, text, span, std::move(message), std::move(expected));
}

void Reporter::warning_at(std::string_view code, std::uint32_t line, std::string_view text, Span span,
                          FindingWords message, FindingWords expected) {
  add(Severity::warning, code, line, text, span, std::move(message), std::move(expected));
}

void Reporter::error(const EvaluationError& error) {
  using Kind = EvaluationError::Kind;
  const std::string what = quote(error.span);
  const std::string operand = plain_number(error.operand);
  switch (error.kind) {
    case Kind::unknown_parameter:
      if (doubts_.explain_parameter(what)) {
        doubt();
        return meet_again();
      }
      if (what.find("_hal[") != std::string::npos || what.find("_HAL[") != std::string::npos) {
        return this->error("gcode.no-hal", error.span, fmt::format("{} is a HAL pin, and Passo has no HAL", what),
                           "a parameter of the program; EXISTS[] of a HAL pin is 0");
      }
      return this->error("gcode.unknown-parameter", error.span, interpreter_says::no_value.with({{"what", what}}),
                         "a parameter that was set before: #1 to #5601, #<name>, or a predefined #<_name>");
    case Kind::bad_parameter_number:
      return this->error("gcode.bad-parameter-number", error.span, fmt::format("{} is not a parameter number", operand),
                         "a whole number, 1 to 5601");
    case Kind::division_by_zero:
      return this->error("gcode.division-by-zero", error.span, interpreter_says::divides_by_zero.with({{"what", what}}),
                         "a divisor that is not zero");
    case Kind::domain:
      return this->error("gcode.bad-operand", error.span, fmt::format("{} is not defined for {}", what, operand),
                         std::string(domain_of(what)));
    case Kind::not_finite:
      return this->error("gcode.overflow", error.span, fmt::format("{} is too large to compute", what), {});
    case Kind::too_deep:
      return this->error("gcode.too-deep", error.span, "the expression is nested too deeply",
                         fmt::format("at most {} pending operands", deepest_expression));
  }
}

void Reporter::warn_of(const UnsetParameter& unset) {
  if (is_kept("gcode.unset-parameter", block_->line, unset.span)) return;
  const std::string number = std::to_string(unset.number);
  warning("gcode.unset-parameter", unset.span, interpreter_says::never_set.with({{"number", number}}),
          interpreter_says::set_before.with({{"number", number}}));
}

// RS274/NGC allows blanks in a number. It is nearly always the letter of a word that is missing.
void Reporter::warn_of_blank(Span number) {
  if (is_kept("gcode.blank-in-number", block_->line, number)) return;
  const std::string written = quote(number);
  std::string read = written;
  std::erase_if(read, [](char c) { return c == ' ' || c == '\t'; });
  warning("gcode.blank-in-number", number, interpreter_says::read_as.with({{"written", written}, {"read", read}}),
          interpreter_says::no_blank.with({{"read", read}}));
}

std::string Reporter::quote(Span span) const {
  constexpr std::size_t longest_quote = 40;
  if (span.column == 0 || span.column > block_->text.size()) return {};
  const std::string_view text = block_->text.substr(span.column - 1, span.length);
  return text.size() <= longest_quote ? std::string(text) : std::string(text.substr(0, longest_quote)) + "...";
}

// A wrong line in a loop is wrong in every pass, but is reported once.
bool Reporter::is_kept(std::string_view code, std::uint32_t line, Span span) const {
  const SourceLocation place = place_of(line, span);
  return std::ranges::any_of(diagnostics_.all(), [&](const Diagnostic& kept) {
    return kept.place == place && kept.code == code && kept.file == *file_;
  });
}

void Reporter::add(Severity severity, std::string_view code, std::uint32_t line, std::string_view text, Span span,
                   FindingWords message, FindingWords expected) {
  if (severity == Severity::error) ++errors_;
  if (is_kept(code, line, span)) return;
  diagnostics_.add({.severity = severity,
                    .code = std::string(code),
                    .file = *file_,
                    .place = place_of(line, span),
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(text),
                    .calls = calls()});
}

void Reporter::pass_on(Diagnostics& faults) {
  for (Diagnostic fault : faults.all()) {
    if (fault.severity == Severity::error) ++errors_;
    fault.calls = calls();
    diagnostics_.add_certain(std::move(fault));
  }
  faults = Diagnostics();
}

std::vector<CallLocation> Reporter::calls() const {
  return stack_ == nullptr ? std::vector<CallLocation>() : stack_->calls();
}

// Six decimals, as LinuxCNC prints, and ten digits at most. What is smaller keeps six digits.
std::string plain_number(double value) {
  const double size = std::abs(value);
  if (size > 0 && size < 1e-3) return fmt::format("{:.6g}", value);
  if (size < 1e9) value = std::round(value * 1e6) / 1e6;
  return fmt::format("{:.10g}", value);
}

std::string number_and_noun(double value, std::string_view noun) {
  const std::string number = plain_number(value);
  return fmt::format("{} {}{}", number, noun, plural_end(number == "1" || number == "-1"));
}

}  // namespace passo
