// FieldReader: reads the lines of a small settings file (tools, parameters, ini) as fields between blanks. Errors are
// reported with line, column and caret.
//
// The files come from anywhere, so a line of any length, any byte and any number must do no harm. ProgramReader refuses
// lines over 64 KiB and NUL bytes. Numbers must be finite and below a million million.
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

  // Reads the next line. False: the file has ended, or has too many errors.
  bool next_line();
  // Reads the line's next field. False: the line has ended.
  bool next_field(Field& field);
  // The rest of the line, without blanks at its ends.
  Field rest() const;

  const std::string& file() const { return file_; }
  void error(std::string_view code, const Field& field, FindingWords message, FindingWords expected) {
    report(Severity::error, code, field, std::move(message), std::move(expected));
  }
  void report(Severity severity, std::string_view code, const Field& field, FindingWords message,
              FindingWords expected);
  // Reports an error of the whole line.
  void error(std::string_view code, FindingWords message, FindingWords expected);

 private:
  ProgramReader reader_;
  std::string file_;
  Diagnostics& diagnostics_;
  std::string_view line_;
  std::uint32_t number_ = 0;
  std::size_t at_ = 0;
};

// The whole of `text` as a finite number. A plus sign is allowed.
std::optional<double> number_of(std::string_view text);
std::optional<std::int32_t> whole_number_of(std::string_view text);
// `text` for a message: shortened, and without control characters for terminals.
std::string quoted(std::string_view text);

}  // namespace passo
