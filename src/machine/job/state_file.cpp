#include "passo/job/state_file.hpp"

#include <cctype>
#include <cerrno>
#include <filesystem>

#include "pieces_of_file.hpp"
#include <fcntl.h>
#include <unistd.h>

#include "passo/base/nameless_file.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// The most bytes of a journal. A head with two long names and the lines need some ten thousand, each probe move two
// hundred.
constexpr std::size_t largest_journal = 1 << 24;

}  // namespace

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

std::string state_file(const std::string& folder, const std::string& board, std::string_view ending) {
  if (folder.empty()) return {};
  std::string name;
  for (const char c : board) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '-';
  return (fs::path(folder) / name.append(ending)).string();
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

}  // namespace passo
