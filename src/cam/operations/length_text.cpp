#include "passo/operations/length_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace passo {

std::optional<double> mm_of_unit(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, double>, 7> units = {
      {{"mm", 1}, {"cm", 10}, {"inch", 25.4}, {"in", 25.4}, {"mil", 0.0254}, {"um", 1e-3}, {"µm", 1e-3}}};
  for (const auto& [unit, mm] : units) {
    if (unit == name) return mm;
  }
  return std::nullopt;
}

namespace {

// The number at the front, which is then cut off. A fraction counts as one.
std::optional<double> take_number(std::string_view& text) {
  const auto take = [&text]() -> std::optional<double> {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
  };
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  const std::optional<double> value = take();
  if (!value || !text.starts_with('/')) return value;
  text.remove_prefix(1);
  const std::optional<double> parts = take();
  if (!parts || *parts == 0) return std::nullopt;
  return *value / *parts;
}

}  // namespace

Result<Mm, std::string> parse_length(const char* option, std::string_view text, double unit_mm) {
  std::string_view rest = text;
  const std::optional<double> value = take_number(rest);
  while (rest.starts_with(' ')) rest.remove_prefix(1);
  const std::optional<double> unit = rest.empty() ? std::optional(unit_mm) : mm_of_unit(rest);
  constexpr double longest = 1e5;  // mm
  if (value && unit && std::abs(*value * *unit) <= longest) return Mm(*value * *unit);
  return Failure{fmt::format("{}: expected a length, e.g. 0.2, 2mm, 0.2cm, 30mil or 1/32in, found '{}'", option, text)};
}

Result<std::vector<Mm>, std::string> parse_lengths(const char* option, std::string_view text, double unit_mm) {
  std::vector<Mm> lengths;
  while (true) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const Result<Mm, std::string> length = parse_length(option, text.substr(0, comma), unit_mm);
    if (!length) return Failure{length.error()};
    lengths.push_back(*length);
    if (comma == text.size()) return lengths;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace passo
