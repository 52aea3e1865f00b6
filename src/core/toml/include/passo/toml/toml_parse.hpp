// parsed_toml(): toml++ as a Result. Its compiled library throws; without exceptions, as in WebAssembly, it returns.
#pragma once

#include <string_view>
#include <utility>

#include <toml++/toml.h>

#include "passo/base/result.hpp"

namespace passo {

inline Result<toml::table, toml::parse_error> parsed_toml(std::string_view text) {
#if TOML_EXCEPTIONS
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    return Failure{error};
  }
#else
  toml::parse_result result = toml::parse(text);
  if (!result) return Failure{std::move(result).error()};
  return std::move(result).table();
#endif
}

}  // namespace passo
