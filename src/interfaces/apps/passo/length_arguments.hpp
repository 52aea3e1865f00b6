// LengthArguments: parses the lengths of a command line, and keeps the first error message.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "passo/cam/drawing.hpp"
#include "passo/operations/length_text.hpp"

namespace passo {

class LengthArguments {
 public:
  explicit LengthArguments(double unit_mm) : unit_mm_(unit_mm) {}

  Nanometres any(const char* option, const std::string& text) {
    const Result<Mm, std::string> length = parse_length(option, text, unit_mm_);
    if (length) return to_nanometres(*length);
    refuse(length.error());
    return {};
  }
  Nanometres above_0(const char* option, const std::string& text) {
    const Nanometres length = any(option, text);
    if (length.count <= 0) refuse(fmt::format("{}: expected a length above 0, found '{}'", option, text));
    return length;
  }
  std::optional<Nanometres> perhaps(const char* option, const std::string& text) {
    if (text.empty()) return std::nullopt;
    return above_0(option, text);
  }
  std::vector<Nanometres> list(const char* option, const std::string& text) {
    const Result<std::vector<Mm>, std::string> lengths = parse_lengths(option, text, unit_mm_);
    std::vector<Nanometres> all;
    if (!lengths) {
      refuse(lengths.error());
    } else {
      for (const Mm length : *lengths) all.push_back(to_nanometres(length));
    }
    return all;
  }
  // Parses "X,Y".
  DrawnPoint place(const char* option, const std::string& text) {
    const std::vector<Nanometres> both = list(option, text);
    if (both.size() == 2) return {both[0], both[1]};
    refuse(fmt::format("{}: expected X,Y, found '{}'", option, text));
    return {};
  }
  Nanometres below_0(const char* option, const std::string& text, const char* example) {
    const Nanometres length = any(option, text);
    if (length.count >= 0) {
      refuse(fmt::format("{}: expected a length below 0, e.g. {}, found '{}'", option, example, text));
    }
    return length;
  }
  void refuse(const std::string& message) {
    if (message_.empty()) message_ = message;
  }
  const std::string& message() const { return message_; }

 private:
  double unit_mm_;
  std::string message_;
};

}  // namespace passo
