#include "passo/base/nameless_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// The temporary names now in use. A signal handler reads them, so there is no lock and no heap. A file that finds no
// free place here is written as usual. But it is not removed by the handler.
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

constexpr std::string_view prefix = ".passo-";
constexpr std::string_view suffix = ".part";
constexpr unsigned most_attempts = 1000;

std::string folder_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash + 1);
}

// A name in the same folder, so that rename() stays inside one file system. The name is short, so that it is not too
// long for the file system.
std::string temporary_name(const std::string& path, unsigned attempt) {
  return folder_of(path).append(prefix) + std::to_string(::getpid()) + "-" + std::to_string(attempt) +
         std::string(suffix);
}

std::string name_in_proc(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

bool lock(int descriptor) {
  return ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
}

// A program that lives holds the lock of its file.
void remove_if_left_over(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  if (lock(descriptor)) ::unlink(path.c_str());
  ::close(descriptor);
}

void remove_left_overs(const std::string& folder) {
  std::error_code none;
  fs::directory_iterator entry(folder.empty() ? "." : folder, none);
  for (; !none && entry != fs::directory_iterator(); entry.increment(none)) {
    const std::string name = entry->path().filename().string();
    if (name.starts_with(prefix) && name.ends_with(suffix)) remove_if_left_over(entry->path());
  }
}

}  // namespace

Result<std::unique_ptr<NamelessFile>, int> NamelessFile::open(const std::string& path, mode_t mode, Kind kind) {
  const std::string folder = folder_of(path);
  remove_left_overs(folder);
  std::unique_ptr<NamelessFile> file(new NamelessFile);
  if (kind == Kind::nameless && file->open_nameless(folder, mode)) return file;
  const int error = file->open_named(path, mode);
  if (error != 0) return Failure{error};
  return file;
}

bool NamelessFile::open_nameless(const std::string& folder, mode_t mode) {
  descriptor_ = ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
  if (descriptor_ < 0) return false;
  // Without /proc there would be no way to a name.
  if (::access(name_in_proc(descriptor_).c_str(), F_OK) == 0 && lock(descriptor_)) return true;
  ::close(std::exchange(descriptor_, -1));
  return false;
}

NamelessFile::~NamelessFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  discard();
}

int NamelessFile::open_named(const std::string& path, mode_t mode) {
  for (unsigned attempt = 0; attempt < most_attempts; ++attempt) {
    std::string name = temporary_name(path, attempt);
    descriptor_ = ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (descriptor_ < 0 && errno == EEXIST) continue;
    if (descriptor_ < 0) return errno;
    // Another program may have taken the file for a left-over, before the file was locked.
    struct stat now {};
    if (lock(descriptor_) && ::fstat(descriptor_, &now) == 0 && now.st_nlink > 0) {
      temporary_ = std::move(name);
      remember(temporary_.c_str());
      return 0;
    }
    ::close(std::exchange(descriptor_, -1));
  }
  return EEXIST;
}

// Returns 0, or errno.
int NamelessFile::link_to(const std::string& path) const {
  const std::string name = name_in_proc(descriptor_);
  return ::linkat(AT_FDCWD, name.c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0 : errno;
}

int NamelessFile::link_to_temporary_name(const std::string& path) {
  for (unsigned attempt = 0; attempt < most_attempts; ++attempt) {
    temporary_ = temporary_name(path, attempt);
    remember(temporary_.c_str());
    const int error = link_to(temporary_);
    if (error == 0) return 0;
    forget(temporary_.c_str());
    temporary_.clear();
    if (error != EEXIST) return error;
  }
  return EEXIST;
}

int NamelessFile::publish(const std::string& path) {
  int error = 0;
  if (temporary_.empty()) {
    error = link_to(path);
    // rename() alone replaces a file in one step, and needs a name.
    if (error == EEXIST) error = link_to_temporary_name(path);
  }
  if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) error = errno;
  if (error == 0 && !temporary_.empty()) {
    if (::rename(temporary_.c_str(), path.c_str()) == 0) {
      forget(temporary_.c_str());
      temporary_.clear();
    } else {
      error = errno;
    }
  }
  discard();
  return error;
}

void NamelessFile::discard() {
  if (temporary_.empty()) return;
  ::unlink(temporary_.c_str());
  forget(temporary_.c_str());
  temporary_.clear();
}

void NamelessFile::remove_unfinished() noexcept {
  for (auto& place : unfinished) {
    if (const char* path = place.exchange(nullptr)) ::unlink(path);
  }
}

}  // namespace passo
