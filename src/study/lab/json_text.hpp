// JsonText: writes one JSON object, field by field. The lab also runs in browsers, where a complete JSON library would
// be half of the download.
#pragma once

#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace passo {

class JsonText {
 public:
  // Numbers are written with as many digits as distinguish them from their neighbours. JSON has no infinity: null is
  // written instead.
  void number(std::string_view name, double value) {
    key(name);
    append(value);
  }
  void number(std::string_view name, std::optional<double> value) { number(name, value.value_or(HUGE_VAL)); }
  void flag(std::string_view name, bool value) {
    key(name);
    text_ += value ? "true" : "false";
  }
  void words(std::string_view name, std::string_view value) {
    key(name);
    append(value);
  }
  // Writes a list of numbers or texts.
  template <class T>
  void list(std::string_view name, const std::vector<T>& values) {
    key(name);
    append(values);
  }
  // `json` is a complete JSON text.
  void raw(std::string_view name, std::string_view json) {
    key(name);
    text_ += json;
  }
  std::string take() { return std::move(text_) + "}"; }

 private:
  void key(std::string_view name) {
    text_ += text_.size() > 1 ? "," : "";
    append(name);
    text_ += ':';
  }
  void append(double value) {
    if (std::isfinite(value)) {
      fmt::format_to(std::back_inserter(text_), "{}", value);
    } else {
      text_ += "null";
    }
  }
  void append(std::string_view value) {
    text_ += '"';
    for (const char character : value) {
      if (character == '"' || character == '\\') text_ += '\\';
      text_ += character;
    }
    text_ += '"';
  }
  template <class T>
  void append(const std::vector<T>& values) {
    text_ += '[';
    bool first = true;
    for (const T& value : values) {
      if (!first) text_ += ',';
      first = false;
      if constexpr (std::is_integral_v<T>) {
        fmt::format_to(std::back_inserter(text_), "{}", value);
      } else if constexpr (std::is_same_v<T, std::string>) {
        append(std::string_view(value));
      } else {
        append(value);
      }
    }
    text_ += ']';
  }

  std::string text_ = "{";
};

}  // namespace passo
