// TomlReporter: the text of a machine file, by lines. It turns a place in the file into a diagnostic with line and
// caret.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

class TomlReporter {
 public:
  // `text` must outlive the reporter.
  TomlReporter(std::string_view text, std::string file, Diagnostics& diagnostics);

  void error(std::string_view code, const SourcePlace& place, std::string message, std::string expected) const;

  std::size_t line_count() const { return lines_.size(); }
  // The line without its line end. Lines count from 1.
  std::string_view line(std::uint32_t number) const;
  // Converts columns in characters, as a TOML parser counts, to columns in bytes.
  SourcePlace place(std::uint32_t line, std::uint32_t first_character, std::uint32_t end_character) const;

 private:
  std::vector<std::string_view> lines_;
  std::string file_;
  Diagnostics& diagnostics_;
};

}  // namespace passo
