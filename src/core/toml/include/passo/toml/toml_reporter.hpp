// TomlReporter: converts a position in the text of a machine file into a diagnostic with line and caret. For other TOML
// files, the codes begin with their own area: "tools.unknown-key" instead of "machine.unknown-key".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct TomlFileKind {
  std::string area = "machine";
  std::string words = "a machine file";  // for messages
};

class TomlReporter {
 public:
  // `text` must outlive the reporter.
  TomlReporter(std::string_view text, std::string file, Diagnostics& diagnostics, TomlFileKind kind = {});

  void error(std::string_view code, const SourceLocation& place, const FindingWords& message,
             const FindingWords& expected) const;

  const std::string& kind_in_words() const { return kind_.words; }
  std::size_t line_count() const { return lines_.size(); }
  // The line without its line end. Lines count from 1.
  std::string_view line(std::uint32_t number) const;
  // Converts columns in characters, as used by the TOML parser, to columns in bytes.
  SourceLocation place(std::uint32_t line, std::uint32_t first_character, std::uint32_t end_character) const;

 private:
  std::vector<std::string_view> lines_;
  std::string file_;
  TomlFileKind kind_;
  Diagnostics& diagnostics_;
};

}  // namespace passo
