// OutputFile: a file that is created either completely or not at all. All output of the program uses OutputFile.
//
// Bytes go to an unnamed file (NamelessFile), which commit() names in one atomic step. Readers therefore never see a
// partial file, and an existing file stays until the new one is complete. Without commit() nothing remains, even if the
// program is killed. "-" is standard output. A path that is not a regular file (a device, a pipe) is written directly.
//
// write() never reports an error. The first error is kept, all bytes after it are dropped, and commit() returns it.
// Code that writes gigabytes should check failed() from time to time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "passo/base/result.hpp"

namespace passo {

struct OutputError {
  std::string message;  // "cannot write out/part.svg: no such directory"
};

class OutputFile {
 public:
  static constexpr std::size_t buffer_size = 262'144;

  static Result<OutputFile, OutputError> open(const std::string& path);
  // Appends the bytes to a string, which becomes part of another file. `text` must outlive the file. Cannot fail.
  static OutputFile into(std::string& text);

  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  ~OutputFile();

  void write(std::string_view bytes);
  bool failed() const;
  // Returns the number of bytes written so far, including buffered ones.
  std::uint64_t size() const;
  // Writes the remaining bytes and names the file. May be called once.
  Status<OutputError> commit();

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace passo
