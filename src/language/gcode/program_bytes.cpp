#include "program_bytes.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace passo {
namespace {

constexpr std::size_t spooled_at_once = std::size_t{256} * 1024;

// A file descriptor that closes itself.
class File {
 public:
  File() = default;
  explicit File(int descriptor) : descriptor_(descriptor) {}
  File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  File& operator=(File&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

Diagnostic unreadable(const std::string& name, int error) {
  return about_whole_file("file.unreadable", name, fmt::format("cannot be read: {}", std::strerror(error)), "");
}

// read() that repeats calls interrupted by a signal. Negative: errno tells why.
ssize_t read_some(int descriptor, char* to, std::size_t size) {
  for (;;) {
    const ssize_t count = ::read(descriptor, to, size);
    if (count >= 0 || errno != EINTR) return count;
  }
}

ssize_t read_from(int descriptor, char* to, std::size_t size, std::uint64_t offset) {
  for (;;) {
    const ssize_t count = ::pread(descriptor, to, size, static_cast<off_t>(offset));
    if (count >= 0 || errno != EINTR) return count;
  }
}

bool write_all(int descriptor, const char* from, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::write(descriptor, from, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    from += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

// Loops and subroutines go back, which a pipe cannot do. So its bytes first go to a file without a name.
Result<File, Diagnostic> spool(int source, const std::string& name) {
  std::FILE* const temporary = std::tmpfile();
  if (temporary == nullptr) return Failure{unreadable(name, errno)};
  File file(::fcntl(::fileno(temporary), F_DUPFD_CLOEXEC, 0));
  const int error = errno;
  std::fclose(temporary);
  if (!file.is_open()) return Failure{unreadable(name, error)};

  std::vector<char> buffer(spooled_at_once);
  for (;;) {
    const ssize_t count = read_some(source, buffer.data(), buffer.size());
    if (count < 0) return Failure{unreadable(name, errno)};
    if (count == 0) return file;
    if (!write_all(file.get(), buffer.data(), static_cast<std::size_t>(count))) return Failure{unreadable(name, errno)};
  }
}

Result<File, Diagnostic> open_file(const std::string& path) {
  File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) {
    const int error = errno;
    if (error == ENOENT || error == ENOTDIR) {
      return Failure{about_whole_file("file.not-found", path, "there is no such file", "the path of a G-code file")};
    }
    return Failure{unreadable(path, error)};
  }
  struct stat status = {};
  if (::fstat(file.get(), &status) != 0) return Failure{unreadable(path, errno)};
  if (S_ISDIR(status.st_mode)) {
    return Failure{about_whole_file("file.is-directory", path, "is a directory", "the path of a G-code file")};
  }
  if (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode)) return spool(file.get(), path);
  if (!S_ISREG(status.st_mode)) {
    return Failure{about_whole_file("file.unreadable", path, "is a device, not a file", "the path of a G-code file")};
  }
  return file;
}

class FileBytes final : public ProgramBytes {
 public:
  FileBytes(File file, std::uint64_t size) : file_(std::move(file)), size_(size) {}
  std::int64_t read_at(char* to, std::size_t size, std::uint64_t offset) const override {
    return read_from(file_.get(), to, size, offset);
  }
  std::uint64_t size() const override { return size_; }

 private:
  File file_;
  std::uint64_t size_;
};

}  // namespace

Diagnostic unreadable_program(const std::string& name) {
  return unreadable(name, errno);
}

Result<std::shared_ptr<const ProgramBytes>, Diagnostic> ProgramBytes::open(const std::string& path) {
  const bool is_standard_input = path == "-";
  const std::string name = is_standard_input ? "standard input" : path;
  Result<File, Diagnostic> opened = is_standard_input ? spool(STDIN_FILENO, name) : open_file(path);
  if (!opened) return Failure{opened.error()};
  struct stat status = {};
  if (::fstat(opened->get(), &status) != 0) return Failure{unreadable(name, errno)};
  return std::shared_ptr<const ProgramBytes>(
      std::make_shared<const FileBytes>(std::move(*opened), static_cast<std::uint64_t>(status.st_size)));
}

}  // namespace passo
