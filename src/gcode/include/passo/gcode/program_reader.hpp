// ProgramReader: the bytes of a G-code file, line by line, in constant memory.
//
// Accepts LF, CR LF and CR line ends and a UTF-8 byte order mark. Refuses, with a diagnostic: what cannot be opened
// or read, an empty file, a directory, binary content (NUL bytes, with line and column), a line over `longest_line`
// bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

inline constexpr std::size_t longest_line = std::size_t{64} * 1024;

// A place to come back to, for loops and subroutines.
struct ReaderPosition {
  std::uint64_t offset = 0;  // of the line's first byte
  std::uint32_t line = 1;    // its number
};

class ProgramReader {
 public:
  // `path` "-" reads standard input (spooled to an unnamed temporary file, since loops go back).
  static Result<ProgramReader, Diagnostic> open(const std::string& path);
  // A program that is in memory, for tests and the manual data input. `name` stands for the file in diagnostics.
  static ProgramReader from_text(std::string name, std::string text);

  ProgramReader(ProgramReader&&) noexcept;
  ProgramReader& operator=(ProgramReader&&) noexcept;
  ~ProgramReader();

  // The next line, without its end; valid until the next call. False at the end of the file and after an error, which
  // is then in `diagnostics`; a line that is too long or has NUL bytes is reported and skipped.
  [[nodiscard]] bool next_line(std::string_view& text, std::uint32_t& line, Diagnostics& diagnostics);

  // Another reader of the same program, at its beginning. Standard input too can be read as often as wanted.
  ProgramReader again() const;

  // Where the line that comes next begins.
  ReaderPosition position() const;
  // Costs nothing before the next line is read.
  void seek(ReaderPosition position);

  const std::string& name() const;
  std::uint64_t size() const;  // bytes

 private:
  struct State;
  explicit ProgramReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace passo
