// NamelessFile: a file on disk that has no name until it is complete. If the program is killed, the operating system
// deletes the file.
//
// Linux supports such files with O_TMPFILE. On a file system without this support, the file is named
// `.passo-PID-N.part`, in the same folder. The same name is used for an instant when an older file is replaced. A file
// with that name is locked (flock) while its program runs, so that the next NamelessFile in the folder can detect and
// remove an abandoned one.
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
    named,  // for tests: as on a file system without O_TMPFILE
  };
  // Opens a file in the folder of `path`, for reading and writing. The error is errno.
  static Result<std::unique_ptr<NamelessFile>, int> open(const std::string& path, mode_t mode,
                                                         Kind kind = Kind::nameless);

  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;
  // Deletes the file, unless publish() has succeeded.
  ~NamelessFile();

  int descriptor() const { return descriptor_; }
  // Gives the file its name, atomically replacing an older file. Closes the file. Returns 0, or errno; in that case the
  // older file stays, and the new one is deleted. Call it once.
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
