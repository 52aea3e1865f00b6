#include "passo/report/output_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "passo/base/nameless_file.hpp"

namespace passo {
namespace {

std::string reason(int error) {
  switch (error) {
    case ENOENT: return "no such directory";
    case ENOTDIR: return "a part of the path is not a directory";
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

// The target of a symbolic link, so that the link itself survives.
std::string resolved(const std::string& path) {
  const std::unique_ptr<char, decltype(&::free)> real(::realpath(path.c_str(), nullptr), &::free);
  return real ? std::string(real.get()) : path;
}

}  // namespace

struct OutputFile::State {
  std::string shown;                       // as the user named it
  std::string path;                        // the path without symbolic links
  std::unique_ptr<NamelessFile> nameless;  // null: the file is written directly
  std::string* text = nullptr;             // takes the bytes instead of a file
  int descriptor = -1;
  int error = 0;  // errno of the first failure
  std::uint64_t size = 0;
  std::string buffer;

  State() { buffer.reserve(buffer_size); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (!nameless && descriptor > STDERR_FILENO) ::close(descriptor);
  }

  OutputError failure(int number) const { return {"cannot write " + shown + ": " + reason(number)}; }

  // Returns 0, or errno.
  int open_directly() {
    descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    return descriptor < 0 ? errno : 0;
  }

  int open_nameless(const struct stat* existing) {
    constexpr mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
    auto opened = NamelessFile::open(path, mode);
    if (!opened) return opened.error();
    nameless = std::move(*opened);
    descriptor = nameless->descriptor();
    // A replaced file keeps its permissions. If that is refused, the usual ones apply.
    if (existing != nullptr) static_cast<void>(::fchmod(descriptor, existing->st_mode & 07777U));
    return 0;
  }

  void flush() {
    if (text != nullptr) text->append(std::exchange(buffer, {}));
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

  // Gives the complete file its name.
  void publish() {
    if (nameless) {
      if (error == 0) error = nameless->publish(path);
      nameless.reset();
    } else if (descriptor > STDERR_FILENO && ::close(descriptor) != 0 && error == 0) {
      error = errno;
    }
    descriptor = -1;
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
    error = errno;  // without this check, publish() would replace a write-protected file
  } else {
    if (exists) state->path = resolved(path);
    error = state->open_nameless(exists ? &existing : nullptr);
  }
  if (error != 0) return Failure{state->failure(error)};
  return OutputFile(std::move(state));
}

OutputFile OutputFile::into(std::string& text) {
  auto state = std::make_unique<State>();
  state->text = &text;
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

}  // namespace passo
