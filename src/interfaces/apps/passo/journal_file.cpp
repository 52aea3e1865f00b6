#include "journal_file.hpp"

#include <array>
#include <cctype>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "passo/base/fingerprint.hpp"
#include "passo/report/nameless_file.hpp"

namespace passo {

namespace fs = std::filesystem;

namespace {

fs::path state_folder() {
  // https://specifications.freedesktop.org/basedir-spec: a relative path is to be ignored.
  const char* const state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return fs::path(state) / "passo";
  const char* const home = std::getenv("HOME");
  if (home != nullptr && *home == '/') return fs::path(home) / ".local" / "state" / "passo";
  return {};
}

bool write_all(int descriptor, std::string_view bytes, std::size_t offset) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written == 0) errno = ENOSPC;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::size_t>(written);
  }
  return true;
}

// The most bytes of a journal. A head with two long names and the lines need some ten thousand, each probe move two
// hundred.
constexpr std::size_t largest_journal = 1 << 24;

// Hands the file to `take`, piece by piece, until `take` returns false. Returns false if the file cannot be read.
template <typename Take>
bool read_pieces(const std::string& path, const Take& take) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return false;
  std::array<char, 1 << 16> piece;
  do {
    file.read(piece.data(), piece.size());
  } while (take(std::string_view(piece.data(), static_cast<std::size_t>(file.gcount()))) && file);
  return !file.bad();
}

}  // namespace

std::string state_file(const std::string& board, std::string_view ending) {
  const fs::path folder = state_folder();
  if (folder.empty()) return {};
  std::string name;
  for (const char c : board) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return (folder / name.append(ending)).string();
}

std::optional<std::string> read_state_file(const std::string& path) {
  std::string text;
  if (!read_pieces(path, [&text](std::string_view piece) {
        text += piece;
        return text.size() <= largest_journal;
      })) {
    return {};
  }
  if (text.size() > largest_journal) text.clear();  // this file is no journal
  return text;
}

// The text must be on the disk before the file gets its name. The board is greeted next, and the hello makes the old
// file useless.
int replace_state_file(const std::string& path, std::string_view text) {
  std::error_code none;
  if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) fs::create_directories(folder, none);
  constexpr mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH;
  auto file = NamelessFile::open(path, mode);
  if (!file) return -file.error();
  const int descriptor = fcntl((*file)->descriptor(), F_DUPFD_CLOEXEC, 0);
  const bool written = descriptor >= 0 && write_all(descriptor, text, 0) && fsync(descriptor) == 0;
  const int error = written ? (*file)->publish(path) : errno;
  if (error == 0) return descriptor;
  if (descriptor >= 0) close(descriptor);
  return -error;
}

FileStamp stamp_of(const std::string& path) {
  std::error_code none;
  if (path == "-" || !fs::is_regular_file(path, none)) return {};
  FileStamp stamp;
  Fingerprint fingerprint;
  (void)read_pieces(path, [&](std::string_view piece) {
    stamp.size += piece.size();
    fingerprint.add(piece);
    return true;
  });
  stamp.name = fs::absolute(path, none).string();
  stamp.fingerprint = fingerprint.value();
  return stamp;
}

FileStamp stamp_of_text(const std::string& path, std::string_view text) {
  std::error_code none;
  Fingerprint fingerprint;
  fingerprint.add(text);
  return {.name = path.empty() ? path : fs::absolute(path, none).string(),
          .size = text.size(),
          .fingerprint = fingerprint.value()};
}

JournalFile::~JournalFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

// A journal that is written is locked, and so is each journal that takes its place.
Status<int> JournalFile::claim() {
  if (descriptor_ >= 0) return Unit{};
  const int descriptor = open(path_.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR)) return Unit{};  // there is none yet
  if (descriptor < 0) return Failure{errno};
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const int error = errno;
    close(descriptor);
    return Failure{error};
  }
  descriptor_ = descriptor;
  return Unit{};
}

std::string JournalFile::trouble() const {
  return std::strerror(error_);
}

bool JournalFile::replace(std::string_view text) {
  const int descriptor = replace_state_file(path_, text);
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = descriptor;
  if (descriptor < 0) error_ = -descriptor;
  return descriptor_ >= 0;
}

bool JournalFile::overwrite(std::size_t offset, std::string_view bytes) {
  if (descriptor_ < 0) return false;
  const bool written = write_all(descriptor_, bytes, offset);
  if (!written) error_ = errno;
  return written;
}

bool JournalFile::append(std::string_view bytes) {
  struct stat file {};
  if (descriptor_ < 0) return false;
  const bool written = fstat(descriptor_, &file) == 0 &&
                       write_all(descriptor_, bytes, static_cast<std::size_t>(file.st_size)) &&
                       fdatasync(descriptor_) == 0;
  if (!written) error_ = errno;
  return written;
}

void JournalFile::remove() {
  unlink(path_.c_str());
}

}  // namespace passo
