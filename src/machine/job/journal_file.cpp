#include "passo/job/journal_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "passo/job/state_file.hpp"

namespace passo {

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

std::string JournalFile::text() const {
  return read_state_file(path_).value_or("");
}

FoundJournal JournalFile::find() const {
  using Kind = FoundJournal::Kind;
  const std::optional<std::string> text = read_state_file(path_);
  if (!text) return {};
  if (std::optional<Journal> journal = Journal::read(*text))
    return {.kind = Kind::whole, .journal = std::move(journal)};
  if (Journal::is_journal(*text)) return {.kind = Kind::torn};
  // Of a file that is too long for a journal there is no text.
  std::error_code none;
  return {.kind = std::filesystem::is_empty(path_, none) ? Kind::empty : Kind::foreign};
}

double JournalFile::written_at() const {
  struct stat file {};
  if (stat(path_.c_str(), &file) != 0) return 0;
  return static_cast<double>(file.st_mtim.tv_sec) + static_cast<double>(file.st_mtim.tv_nsec) * 1e-9;
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
