#include "option_value.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace passo {
namespace {

// A number or a text as a word of the command line. Empty: it is neither.
std::optional<std::string> word_of(const TomlValue& value) {
  if (const auto* text = std::get_if<std::string>(&value.content)) return *text;
  if (const auto* number = std::get_if<double>(&value.content)) return fmt::format("{}", *number);
  return std::nullopt;
}

// A word, or a list of them: "10,0".
std::optional<std::string> words_of(const TomlValue& value) {
  const auto* list = std::get_if<TomlArray>(&value.content);
  if (list == nullptr) return word_of(value);
  std::vector<std::string> words;
  for (const TomlValue& item : *list) {
    const std::optional<std::string> word = word_of(item);
    if (!word) return std::nullopt;
    words.push_back(*word);
  }
  return fmt::format("{}", fmt::join(words, ","));
}

std::string example_of(const CamOption& option) {
  const std::string_view name = option.name;
  switch (option.kind) {
    case CamKind::length: return fmt::format("a length, e.g. {0} = 2 or {0} = \"2mm\"", name);
    case CamKind::feed: return fmt::format("a feed rate, e.g. {} = 600", name);
    case CamKind::place:
      return fmt::format("{}, or X and Y, e.g. {} = [10, 0]", fmt::join(option.traits.choices, ", "), name);
    default: return fmt::format("a text in quotes, e.g. {} = \"A\"", name);
  }
}

std::string set(const CamOption& option, std::string& member, const TomlValue& value) {
  const std::optional<std::string> words = words_of(value);
  if (!words) return example_of(option);
  const bool is_one_of =
      option.kind != CamKind::choice || std::ranges::find(option.traits.choices, *words) != option.traits.choices.end();
  if (!is_one_of) return fmt::format("{}", fmt::join(option.traits.choices, ", "));
  member = *words;
  return "";
}

// A list of numbers is one value: tab = [10, 0]. A list of lists or texts is several: tab = [[10, 0], [40, 0]].
std::string set(const CamOption& option, std::vector<std::string>& member, const TomlValue& value) {
  const auto* list = std::get_if<TomlArray>(&value.content);
  const bool is_one = list == nullptr || (!list->empty() && std::holds_alternative<double>(list->front().content));
  member.clear();
  if (is_one) {
    const std::optional<std::string> words = words_of(value);
    if (!words) return example_of(option);
    member.push_back(*words);
    return "";
  }
  for (const TomlValue& item : *list) {
    const std::optional<std::string> words = words_of(item);
    if (!words) return example_of(option);
    member.push_back(*words);
  }
  return "";
}

std::string set(const CamOption& option, bool& member, const TomlValue& value) {
  const bool* flag = std::get_if<bool>(&value.content);
  if (flag == nullptr) return fmt::format("{0} = true or {0} = false", option.name);
  member = *flag;
  return "";
}

template <class Number>
std::string set_number(const CamOption& option, Number& member, const TomlValue& value) {
  const CamRange range =
      option.traits.range.value_or(std::is_integral_v<Number> ? CamRange{0, 4e9} : CamRange{-1e9, 1e9});
  const double* number = std::get_if<double>(&value.content);
  const bool is_whole = number != nullptr && *number == std::floor(*number);
  const bool is_good =
      number != nullptr && *number >= range.least && *number <= range.most && (is_whole || !std::is_integral_v<Number>);
  if (!is_good) {
    return fmt::format("a {}number from {:g} to {:g}", std::is_integral_v<Number> ? "whole " : "", range.least,
                       range.most);
  }
  member = static_cast<Number>(*number);
  return "";
}
template <class Number>
std::string set(const CamOption& option, Number& member, const TomlValue& value) requires std::is_arithmetic_v<Number> {
  return set_number(option, member, value);
}
template <class Number>
std::string set(const CamOption& option, std::optional<Number>& member, const TomlValue& value) {
  Number number{};
  std::string expected = set_number(option, number, value);
  if (expected.empty()) member = number;
  return expected;
}

}  // namespace

std::string set_option(const CamOption& option, const TomlValue& value) {
  return std::visit([&](auto* member) { return set(option, *member, value); }, option.value);
}

}  // namespace passo
