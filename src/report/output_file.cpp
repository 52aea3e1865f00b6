#include "passo/report/output_file.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace passo {
namespace {

// The temporary names now in use. A signal handler reads them, so there is no lock and no heap. A file that finds no
// free place here is written as usual. But it is not removed when the program is interrupted.
constexpr std::size_t most_unfinished = 32;
std::array<std::atomic<const char*>, most_unfinished> unfinished{};

void remember(const char* path) {
  for (auto& place : unfinished) {
    const char* none = nullptr;
    if (place.compare_exchange_strong(none, path)) return;
  }
}

void forget(const char* path) {
  for (auto& place : unfinished) {
    const char* expected = path;
    if (place.compare_exchange_strong(expected, nullptr)) return;
  }
}

std::string reason(int error) {
  switch (error) {
    case ENOENT: return "no such directory";
    case ENOTDIR: return "a part of the path is no directory";
    case EISDIR: return "it is a directory";
    case EACCES:
    case EPERM: return "permission denied";
    case ENOSPC:
    case EDQUOT: return "the disk is full";
    case EROFS: return "the file system is read-only";
    case ENAMETOOLONG: return "the name is too long";
    default: return std::generic_category().message(error);
  }
}

// A name in the same directory, so that rename() stays inside one file system. The name is short, so that it is not too
// long for the file system.
std::string temporary_name(const std::string& path, unsigned attempt) {
  const std::size_t slash = path.rfind('/');
  const std::string directory = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  return directory + ".passo-" + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".part";
}

// The target of a symbolic link, so that the link itself survives.
std::string resolved(const std::string& path) {
  const std::unique_ptr<char, decltype(&::free)> real(::realpath(path.c_str(), nullptr), &::free);
  return real ? std::string(real.get()) : path;
}

}  // namespace

struct OutputFile::State {
  std::string shown;      // as the user named it
  std::string path;       // the path without symbolic links
  std::string temporary;  // empty: the file is written directly
  int descriptor = -1;
  int error = 0;  // errno of the first failure
  std::uint64_t size = 0;
  std::string buffer;

  State() { buffer.reserve(buffer_size); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (descriptor > STDERR_FILENO) ::close(descriptor);
    discard();
  }

  OutputError failure(int number) const { return {"cannot write " + shown + ": " + reason(number)}; }

  // Returns 0, or errno.
  int open_directly() {
    descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    return descriptor < 0 ? errno : 0;
  }

  int open_temporary(const struct stat* existing) {
    constexpr unsigned most_attempts = 1000;
    for (unsigned attempt = 0; attempt < most_attempts; ++attempt) {
      temporary = temporary_name(path, attempt);
      constexpr mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
      descriptor = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
      if (descriptor >= 0) {
        remember(temporary.c_str());
        // A replaced file keeps its permissions. If that is refused, the usual ones apply.
        if (existing != nullptr) static_cast<void>(::fchmod(descriptor, existing->st_mode & 07777U));
        return 0;
      }
      if (errno != EEXIST) break;
    }
    temporary.clear();
    return errno;
  }

  void flush() {
    const char* next = buffer.data();
    std::size_t left = buffer.size();
    while (left > 0 && error == 0) {
      const ssize_t written = ::write(descriptor, next, left);
      if (written >= 0) {
        next += written;
        left -= static_cast<std::size_t>(written);
      } else if (errno != EINTR) {
        error = errno;
      }
    }
    buffer.clear();
  }

  void discard() {
    if (temporary.empty()) return;
    ::unlink(temporary.c_str());
    forget(temporary.c_str());
    temporary.clear();
  }

  // Makes the complete temporary file the file itself.
  void publish() {
    if (descriptor > STDERR_FILENO && ::close(descriptor) != 0 && error == 0) error = errno;
    descriptor = -1;
    if (error == 0 && !temporary.empty()) {
      if (::rename(temporary.c_str(), path.c_str()) == 0) {
        forget(temporary.c_str());
        temporary.clear();
      } else {
        error = errno;
      }
    }
    if (error != 0) discard();
  }
};

Result<OutputFile, OutputError> OutputFile::open(const std::string& path) {
  auto state = std::make_unique<State>();
  state->shown = path == "-" ? "to standard output" : path;
  state->path = path;
  if (path == "-") {
    state->descriptor = STDOUT_FILENO;
    return OutputFile(std::move(state));
  }
  if (path.empty()) return Failure{OutputError{"cannot write a file without a name"}};

  struct stat existing {};
  const bool exists = ::stat(path.c_str(), &existing) == 0;
  int error = 0;
  if (exists && S_ISDIR(existing.st_mode)) {
    error = EISDIR;
  } else if (exists && !S_ISREG(existing.st_mode)) {
    error = state->open_directly();
  } else if (exists && ::access(path.c_str(), W_OK) != 0) {
    error = errno;  // without this check, rename() would replace a write-protected file
  } else {
    if (exists) state->path = resolved(path);
    error = state->open_temporary(exists ? &existing : nullptr);
  }
  if (error != 0) return Failure{state->failure(error)};
  return OutputFile(std::move(state));
}

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

void OutputFile::write(std::string_view bytes) {
  State& state = *state_;
  state.size += bytes.size();
  while (!bytes.empty() && state.error == 0) {
    const std::size_t part = std::min(bytes.size(), buffer_size - state.buffer.size());
    state.buffer.append(bytes.substr(0, part));
    bytes.remove_prefix(part);
    if (state.buffer.size() == buffer_size) state.flush();
  }
}

bool OutputFile::failed() const {
  return state_->error != 0;
}

std::uint64_t OutputFile::size() const {
  return state_->size;
}

Status<OutputError> OutputFile::commit() {
  state_->flush();
  state_->publish();
  if (state_->error != 0) return Failure{state_->failure(state_->error)};
  return Unit{};
}

void OutputFile::remove_unfinished() noexcept {
  for (auto& place : unfinished) {
    if (const char* path = place.exchange(nullptr)) ::unlink(path);
  }
}

}  // namespace passo
