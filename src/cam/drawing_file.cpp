#include "passo/cam/drawing_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace passo {
namespace {

Diagnostic of_file(const char* code, const std::string& path, std::string message, std::string expected) {
  return {.code = code,
          .file = path,
          .place = {},
          .message = std::move(message),
          .expected = std::move(expected),
          .text = ""};
}

std::optional<std::string> bytes_of(const std::string& path, Diagnostics& diagnostics) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    diagnostics.add(of_file("drawing.unreadable", path, "is a directory", "a DXF or drill file"));
    return std::nullopt;
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) {
    diagnostics.add(of_file("drawing.unreadable", path, fmt::format("cannot be read: {}", std::strerror(errno)), ""));
    return std::nullopt;
  }
  std::string bytes;
  constexpr std::size_t at_once = 1 << 20;
  for (std::size_t filled = 0;;) {
    bytes.resize(filled + at_once);
    const std::size_t count = std::fread(bytes.data() + filled, 1, at_once, file.get());
    filled += count;
    bytes.resize(filled);
    if (std::ferror(file.get()) != 0) {
      diagnostics.add(of_file("drawing.unreadable", path, fmt::format("cannot be read: {}", std::strerror(errno)), ""));
      return std::nullopt;
    }
    if (filled > largest_drawing_file) {
      diagnostics.add(of_file("drawing.too-large", path, "the file is larger than what is read",
                              fmt::format("at most {} MiB", largest_drawing_file >> 20U)));
      return std::nullopt;
    }
    if (count == 0) return bytes;
  }
}

}  // namespace

Drawing read_drawing(const std::string& path, const DrawingFileOptions& options, Diagnostics& diagnostics) {
  Drawing nothing;
  nothing.file = path;
  const std::optional<std::string> bytes = bytes_of(path, diagnostics);
  if (!bytes) return nothing;
  if (looks_like_dxf(*bytes)) return read_dxf(path, *bytes, options.dxf, diagnostics);
  if (looks_like_excellon(*bytes)) return read_excellon(path, *bytes, options.excellon, diagnostics);
  diagnostics.add(of_file("drawing.unknown-kind", path, "this is neither a DXF drawing nor a drill file",
                          "a file that begins with SECTION (DXF), or with M48, METRIC, INCH or tools (Excellon)"));
  return nothing;
}

}  // namespace passo
