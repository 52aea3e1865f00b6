// FieldReader: reads the lines of a small settings file (tools, parameters, ini) as fields separated by blanks. Errors
// are reported with line, column and caret.
//
// The files are untrusted: lines of any length, any bytes and any numbers must be handled safely. ProgramReader refuses
// lines over 64 KiB and NUL bytes. Numbers must be finite and below 10^12.
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

  // Reads the next line. Returns false at the end of the file, and after too many errors.
  bool next_line();
  // Reads the next field of the line. Returns false at the end of the line.
  bool next_field(Field& field);
  // Returns the remaining text of the line, trimmed.
  Field rest() const;

  const std::string& file() const { return file_; }
  void error(std::string_view code, const Field& field, FindingWords message, FindingWords expected) {
    report(Severity::error, code, field, std::move(message), std::move(expected));
  }
  void report(Severity severity, std::string_view code, const Field& field, FindingWords message,
              FindingWords expected);
  // Reports an error about the whole line.
  void error(std::string_view code, FindingWords message, FindingWords expected);

 private:
  ProgramReader reader_;
  std::string file_;
  Diagnostics& diagnostics_;
  std::string_view line_;
  std::uint32_t number_ = 0;
  std::size_t at_ = 0;
};

// Parses the whole of `text` as a finite number. Accepts a plus sign.
std::optional<double> number_of(std::string_view text);
std::optional<std::int32_t> whole_number_of(std::string_view text);
// Prepares `text` for a message: shortened, and without control characters.
std::string quoted(std::string_view text);

}  // namespace passo
