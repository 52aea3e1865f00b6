// FieldReader: the lines of a small settings file (tools, parameters, ini) as fields between blanks, and what is wrong
// with them, with line, column and caret.
//
// The files come from anywhere: a line of any length, any byte, any number must do no harm. Lines over 64 KiB and NUL
// bytes are refused by ProgramReader; numbers must be finite and below a million million.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/gcode/program_reader.hpp"

namespace passo {

struct Field {
  std::string_view text;
  std::uint32_t column = 1;
};

class FieldReader {
 public:
  FieldReader(ProgramReader reader, Diagnostics& diagnostics)
      : reader_(std::move(reader)), file_(reader_.name()), diagnostics_(diagnostics) {}

  // The next line; false at the end of the file, and when enough is wrong with it.
  bool next_line();
  // The line's next field; false at its end.
  bool next_field(Field& field);
  // What is left of the line, without blanks at its ends.
  Field rest() const;

  const std::string& file() const { return file_; }
  void error(std::string_view code, const Field& field, std::string message, std::string expected);
  // About the line as a whole.
  void error(std::string_view code, std::string message, std::string expected);

 private:
  ProgramReader reader_;
  std::string file_;
  Diagnostics& diagnostics_;
  std::string_view line_;
  std::uint32_t number_ = 0;
  std::size_t at_ = 0;
};

// The whole of `text` as a finite number; a sign of plus is allowed.
std::optional<double> number_of(std::string_view text);
std::optional<std::int32_t> whole_number_of(std::string_view text);
// For a message: shortened, without what steers a terminal.
std::string quoted(std::string_view text);

}  // namespace passo
