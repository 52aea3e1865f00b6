// NamelessFile: a file on the disk that has no name until it is complete. If the program dies, by whatever signal, the
// system takes the file back.
//
// Linux makes such files with O_TMPFILE. A file system without them gets a file `.passo-PID-N.part` in the same folder.
// The same name serves for an instant where an older file is replaced. A file of that name is locked (flock) as long as
// its program lives, so that the next NamelessFile in the folder can tell a left-over and remove it.
#pragma once

#include <memory>
#include <string>

#include <sys/types.h>

#include "passo/base/result.hpp"

namespace passo {

class NamelessFile {
 public:
  enum class Kind : unsigned char {
    nameless,
    named,  // as on a file system without nameless files; for tests
  };
  // Opens a file in the folder of `path`, for reading and writing. The error is errno.
  static Result<std::unique_ptr<NamelessFile>, int> open(const std::string& path, mode_t mode,
                                                         Kind kind = Kind::nameless);

  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;
  // Without publish() nothing remains.
  ~NamelessFile();

  int descriptor() const { return descriptor_; }
  // Gives the file its name, in one step, in the place of an older file. Closes the file. Returns 0, or errno; then the
  // older file stays, and nothing else remains. Call it once.
  [[nodiscard]] int publish(const std::string& path);

  // For a signal handler that ends the program: removes all files that have a temporary name. Async-signal-safe.
  static void remove_unfinished() noexcept;

 private:
  NamelessFile() = default;
  bool open_nameless(const std::string& folder, mode_t mode);
  int open_named(const std::string& path, mode_t mode);
  int link_to(const std::string& path) const;
  int link_to_temporary_name(const std::string& path);
  void discard();

  int descriptor_ = -1;
  std::string temporary_;  // empty: the file has no name yet
};

}  // namespace passo
