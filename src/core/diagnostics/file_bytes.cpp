#include "passo/diagnostics/file_bytes.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace passo {

Diagnostic of_file(std::string code, const std::string& path, std::string message, std::string expected) {
  return {.code = std::move(code),
          .file = path,
          .place = {},
          .message = std::move(message),
          .expected = std::move(expected),
          .text = ""};
}

std::optional<std::string> read_bytes(const std::string& path, const FileKind& kind, Diagnostics& diagnostics) {
  const auto refuse = [&](const char* why, std::string message, std::string expected) {
    diagnostics.add(of_file(fmt::format("{}.{}", kind.area, why), path, std::move(message), std::move(expected)));
  };
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    refuse("unreadable", "is a directory", kind.expected);
    return std::nullopt;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) {
    refuse("unreadable", fmt::format("cannot be read: {}", std::strerror(errno)), "");
    return std::nullopt;
  }
  std::string bytes;
  constexpr std::size_t at_once = 1 << 20;
  // A file tells its size; with one byte more its end is seen at once. What a pipe will hold nobody knows.
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  std::size_t next = none ? at_once : static_cast<std::size_t>(std::min<std::uintmax_t>(size, kind.most)) + 1;
  for (std::size_t filled = 0;; next = at_once) {
    bytes.resize(filled + next);
    const std::size_t count = std::fread(bytes.data() + filled, 1, next, file.get());
    filled += count;
    bytes.resize(filled);
    if (std::ferror(file.get()) != 0) {
      refuse("unreadable", fmt::format("cannot be read: {}", std::strerror(errno)), "");
      return std::nullopt;
    }
    if (filled > kind.most) {
      refuse("too-large", "the file is too large", fmt::format("at most {} MiB", kind.most >> 20U));
      return std::nullopt;
    }
    if (count < next) return bytes;
  }
}

}  // namespace passo
