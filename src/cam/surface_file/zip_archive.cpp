// The only file of the module that uses minizip.
#include "zip_archive.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include <minizip/unzip.h>

namespace passo {
namespace {

// A file in memory, as minizip's callbacks see it. Both pointers are the same object.
struct MemoryFile {
  std::string_view bytes;
  std::size_t at = 0;
};

MemoryFile& memory_of(voidpf stream) {
  return *static_cast<MemoryFile*>(stream);
}

voidpf open_memory(voidpf memory, const void*, int) {
  return memory;
}
uLong read_memory(voidpf, voidpf stream, void* to, uLong size) {
  MemoryFile& file = memory_of(stream);
  const std::size_t count = std::min<std::size_t>(size, file.bytes.size() - file.at);
  std::memcpy(to, file.bytes.data() + file.at, count);
  file.at += count;
  return static_cast<uLong>(count);
}
uLong write_memory(voidpf, voidpf, const void*, uLong) {
  return 0;
}
ZPOS64_T tell_memory(voidpf, voidpf stream) {
  return memory_of(stream).at;
}
long seek_memory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
  MemoryFile& file = memory_of(stream);
  const std::uint64_t from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                             : origin == ZLIB_FILEFUNC_SEEK_CUR ? file.at
                                                                : file.bytes.size();
  const std::uint64_t to = from + offset;  // an offset below zero wraps
  if (to > file.bytes.size()) return -1;
  file.at = static_cast<std::size_t>(to);
  return 0;
}
int close_memory(voidpf, voidpf) {
  return 0;
}
int error_of_memory(voidpf, voidpf) {
  return 0;
}

}  // namespace

struct ZipArchive::Reading {
  MemoryFile file;
};

void ZipArchive::Close::operator()(void* file) const {
  unzClose(file);
}

ZipArchive::ZipArchive(std::string_view bytes) : reading_(std::make_unique<Reading>(Reading{{bytes, 0}})) {
  zlib_filefunc64_def functions{};
  functions.zopen64_file = open_memory;
  functions.zread_file = read_memory;
  functions.zwrite_file = write_memory;
  functions.ztell64_file = tell_memory;
  functions.zseek64_file = seek_memory;
  functions.zclose_file = close_memory;
  functions.zerror_file = error_of_memory;
  functions.opaque = &reading_->file;
  file_.reset(unzOpen2_64("memory", &functions));
}

ZipArchive::~ZipArchive() = default;

bool ZipArchive::has(const std::string& name) const {
  constexpr int any_case = 2;
  return file_ && unzLocateFile(file_.get(), name.c_str(), any_case) == UNZ_OK;
}

std::string ZipArchive::read(const std::string& name, std::size_t most,
                             const std::function<bool(std::string_view)>& take) const {
  if (!has(name)) return "'" + name + "' is missing";
  unz_file_info64 info{};
  if (unzGetCurrentFileInfo64(file_.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK) {
    return "the archive is damaged";
  }
  constexpr uLong stored = 0;
  constexpr uLong deflated = 8;
  if ((info.flag & 1U) != 0) return "'" + name + "' needs a password";
  if (info.compression_method != stored && info.compression_method != deflated) {
    return "'" + name + "' uses an unsupported compression method";
  }
  if (unzOpenCurrentFile(file_.get()) != UNZ_OK) return "'" + name + "' is damaged";
  // The sizes that the archive states may be wrong, so the bytes that are read are counted.
  std::array<char, 65'536> piece{};
  std::size_t bytes = 0;
  int got = 0;
  bool goes_on = true;
  while (goes_on && (got = unzReadCurrentFile(file_.get(), piece.data(), static_cast<unsigned>(piece.size()))) > 0) {
    bytes += static_cast<std::size_t>(got);
    if (bytes > most) break;
    goes_on = take({piece.data(), static_cast<std::size_t>(got)});
  }
  const int closed = unzCloseCurrentFile(file_.get());
  if (!goes_on) return "";
  if (bytes > most) return "'" + name + "' is too large when unpacked";
  return got < 0 || closed != UNZ_OK ? "'" + name + "' is damaged" : "";
}

}  // namespace passo
