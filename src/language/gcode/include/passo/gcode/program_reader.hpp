// ProgramReader: reads a G-code file line by line, in constant memory.
//
// Accepts LF, CR LF and CR line ends, and a UTF-8 byte order mark. Rejects the following, with a diagnostic: a file
// that cannot be opened or read, an empty file, a directory, binary content (NUL bytes, with line and column), a
// drawing, picture, model or archive (the diagnostic names its kind), a line over `longest_line` bytes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"
#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

inline constexpr std::size_t longest_line = std::size_t{64} * 1024;

// A position in the program to which loops and subroutines return.
struct ReaderPosition {
  std::uint64_t offset = 0;  // offset of the line's first byte
  std::uint32_t line = 1;    // the line's number
};

class ProgramReader {
 public:
  // Opens a file; `path` "-" reads standard input, whose bytes are stored in an unnamed temporary file, because loops
  // jump back.
  static Result<ProgramReader, Diagnostic> open(const std::string& path);
  // Reads a program in memory, for tests and for manual data input. `name` is used as file name in diagnostics.
  static ProgramReader from_text(std::string name, std::string text);
  // Reads a program whose lines arrive one by one, with push_line(). Lines are not stored, so the program cannot jump
  // back.
  static ProgramReader from_lines(std::string name);

  ProgramReader(ProgramReader&&) noexcept;
  ProgramReader& operator=(ProgramReader&&) noexcept;
  ~ProgramReader();

  // Reads the next line, without its end; the text is valid until the next call. Returns false at the end of the file
  // and after an error. The error is then in `diagnostics`. A line that is too long or has NUL bytes is reported and
  // skipped.
  [[nodiscard]] bool next_line(std::string_view& text, std::uint32_t& line, Diagnostics& diagnostics);

  // Only for from_lines(): adds the line that the next call of next_line() returns. All earlier lines must have been
  // read. `text` has no line end.
  void push_line(std::string_view text);

  // Returns another reader of the same program, at its start. This also works for standard input.
  ProgramReader again() const;

  // Returns the start of the next line.
  ReaderPosition position() const;
  // Moves to a position. The file is accessed only when the next line is read.
  void seek(ReaderPosition position);

  const std::string& name() const;
  std::uint64_t size() const;  // bytes

 private:
  struct State;
  explicit ProgramReader(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace passo
