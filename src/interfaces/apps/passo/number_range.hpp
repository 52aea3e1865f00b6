// number_range: checks that an option is a number within a range. CLI::Range would accept "nan".
#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace passo {

inline CLI::Validator number_range(double low, double high) {
  const auto refusal = [low, high](const std::string& text) -> std::string {
    double number = 0;
    if (CLI::detail::lexical_cast(text, number) && number >= low && number <= high) return {};
    return fmt::format("expected a number from {:g} to {:g}, found '{}'", low, high, text);
  };
  return {[refusal](std::string& text) { return refusal(text); }, CLI::Range(low, high).get_description()};
}

}  // namespace passo
