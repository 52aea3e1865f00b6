// What the two text formats, ini and $$, have in common: lines, and refusals of texts that are too large.
#pragma once

#include <string_view>

#include "passo/machine_import/machine_import.hpp"

namespace passo {

// Without blanks at both ends.
std::string_view without_blanks(std::string_view text);

// One line of a text. Returns false at the end.
class SourceLines {
 public:
  explicit SourceLines(std::string_view text);
  bool next(std::string_view& line);
  std::uint32_t number() const { return number_; }
  // The column of a part of the current line, from 1.
  std::uint32_t column_of(std::string_view part) const;

 private:
  std::string_view rest_;
  std::string_view line_;
  std::uint32_t number_ = 0;
};

void add_import_error(const ImportSource& source, Diagnostics& diagnostics, const char* code, SourceLocation place,
                      std::string message, std::string expected, std::string_view line = {});

// False, with a diagnostic: more than most_source_bytes, or not a text.
bool is_source_text(const ImportSource& source, Diagnostics& diagnostics);

}  // namespace passo
