// The only file that sees minizip.
#include "zip_files.hpp"

#include <array>
#include <memory>

#include <minizip/unzip.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

struct CloseZip {
  void operator()(void* file) const { unzClose(file); }
};

}  // namespace

bool looks_like_zip(std::string_view bytes) {
  return bytes.starts_with("PK\x03\x04") || bytes.starts_with("PK\x05\x06");
}

std::vector<NamedBytes> read_zip(const std::string& path, Diagnostics& diagnostics) {
  std::vector<NamedBytes> files;
  const auto refuse = [&](const char* code, std::string message, std::string expected) {
    diagnostics.add(of_file(code, path, std::move(message), std::move(expected)));
    return std::vector<NamedBytes>();
  };
  const auto is_broken = [&](const std::string& what) {
    return refuse("board.bad-zip", what + " is damaged", "a zip file that other programs can open");
  };
  const std::unique_ptr<void, CloseZip> zip(unzOpen64(path.c_str()));
  if (!zip) return is_broken("the archive");
  std::size_t bytes = 0;
  std::size_t count = 0;
  int state = unzGoToFirstFile(zip.get());
  for (; state == UNZ_OK; state = unzGoToNextFile(zip.get())) {
    std::array<char, 1024> name{};
    unz_file_info64 info{};
    if (unzGetCurrentFileInfo64(zip.get(), &info, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) != UNZ_OK) {
      return is_broken("the archive");
    }
    NamedBytes file{name.data(), {}};
    if (file.name.empty() || file.name.ends_with('/') || file.name.starts_with("__MACOSX/")) continue;
    if (++count > most_board_files) return refuse("board.too-large", "the archive has over 1,000 files", "one board");
    if ((info.flag & 1U) != 0)
      return refuse("board.bad-zip", "'" + file.name + "' needs a password", "an archive without a password");
    constexpr uLong stored = 0;
    constexpr uLong deflated = 8;
    if (info.compression_method != stored && info.compression_method != deflated) {
      return refuse("board.bad-zip", "'" + file.name + "' uses an unsupported compression method",
                    "files compressed with deflate, or uncompressed");
    }
    if (unzOpenCurrentFile(zip.get()) != UNZ_OK) return is_broken("'" + file.name + "'");
    // What the archive says of sizes may be wrong: what comes is counted.
    std::array<char, 65'536> piece{};
    int got = 0;
    while ((got = unzReadCurrentFile(zip.get(), piece.data(), static_cast<unsigned>(piece.size()))) > 0) {
      bytes += static_cast<std::size_t>(got);
      if (bytes > most_board_bytes)
        return refuse("board.too-large", "the unpacked archive is too large", "at most 256 MiB");
      file.bytes.append(piece.data(), static_cast<std::size_t>(got));
    }
    if (got < 0 || unzCloseCurrentFile(zip.get()) != UNZ_OK) return is_broken("'" + file.name + "'");
    files.push_back(std::move(file));
  }
  if (state != UNZ_END_OF_LIST_OF_FILE) return is_broken("the archive");
  return files;
}

}  // namespace passo
