// OutputFile: a file that appears either whole or not at all. Every writer of the program uses OutputFile.
//
// Bytes go to a file without a name (NamelessFile). commit() gives the file its name in one step. So a reader never
// sees half a file, and an older file stays until the new one is complete. Without commit() nothing remains, even if
// the program is killed. "-" is standard output. A path that is no regular file (a device, a pipe) is written to
// directly.
//
// write() never reports an error. The first error is kept, all bytes after the error are dropped, and commit() returns
// the error. A writer of gigabytes should ask failed() now and then.
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
  // The bytes are added to a text, for what is a part of another file. `text` outlives the file. No error is possible.
  static OutputFile into(std::string& text);

  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  ~OutputFile();

  void write(std::string_view bytes);
  bool failed() const;
  // All bytes written so far, including buffered ones.
  std::uint64_t size() const;
  // Hands the last bytes to the system and gives the file its name. Call it once.
  Status<OutputError> commit();

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace passo
