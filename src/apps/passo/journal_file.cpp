#include "journal_file.hpp"

#include <array>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "passo/base/fingerprint.hpp"

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
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::size_t>(written);
  }
  return true;
}

// The most bytes of a journal. Even half of this would be much for a head with two long names, and the lines.
constexpr std::size_t largest_journal = 1 << 20;

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

std::string usual_journal(const std::string& board) {
  const fs::path folder = state_folder();
  if (folder.empty()) return {};
  std::string name;
  for (const char c : board) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return (folder / (name + ".journal")).string();
}

std::optional<std::string> read_journal(const std::string& path) {
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

JournalFile::~JournalFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

// The text must be on the disk before the file gets its name. The board is greeted next, and the hello makes the old
// journal useless.
bool JournalFile::replace(std::string_view text) {
  if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  std::error_code none;
  if (const fs::path folder = fs::path(path_).parent_path(); !folder.empty()) fs::create_directories(folder, none);
  const std::string temporary = path_ + ".new";
  constexpr mode_t mode = S_IRUSR | S_IWUSR | S_IRGRP | S_IROTH;
  descriptor_ = open(temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, mode);
  if (descriptor_ < 0) return false;
  if (write_all(descriptor_, text, 0) && fsync(descriptor_) == 0 && rename(temporary.c_str(), path_.c_str()) == 0) {
    return true;
  }
  unlink(temporary.c_str());
  return false;
}

bool JournalFile::overwrite(std::size_t offset, std::string_view bytes) {
  return descriptor_ >= 0 && write_all(descriptor_, bytes, offset);
}

void JournalFile::remove() {
  unlink(path_.c_str());
}

}  // namespace passo
