#include "page_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t longest_file = 16 << 20;

// A path of plain names: no "..", nothing hidden, nothing encoded.
bool is_plain(std::string_view path) {
  char before = '/';
  for (const char c : path) {
    const bool is_good = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                         std::string_view("-_./").find(c) != std::string_view::npos;
    if (!is_good || (before == '/' && (c == '.' || c == '/'))) return false;
    before = c;
  }
  return true;
}

std::string type_of(const fs::path& file) {
  static constexpr std::pair<std::string_view, std::string_view> types[] = {{".html", "text/html; charset=utf-8"},
                                                                            {".js", "text/javascript"},
                                                                            {".mjs", "text/javascript"},
                                                                            {".css", "text/css"},
                                                                            {".json", "application/json"},
                                                                            {".svg", "image/svg+xml"},
                                                                            {".png", "image/png"},
                                                                            {".ico", "image/x-icon"},
                                                                            {".wasm", "application/wasm"},
                                                                            {".woff2", "font/woff2"},
                                                                            {".txt", "text/plain; charset=utf-8"}};
  const std::string extension = file.extension().string();
  for (const auto& [name, type] : types) {
    if (name == extension) return std::string(type);
  }
  return "application/octet-stream";
}

}  // namespace

std::optional<WebAnswer> PageFolder::file(std::string_view path) const {
  if (!path.starts_with('/')) return {};
  path.remove_prefix(1);
  if (!is_plain(path)) return {};
  fs::path file = folder_;
  std::error_code error;
  for (const fs::path& part : fs::path(path)) {
    file /= part;
    if (fs::is_symlink(fs::symlink_status(file, error))) return {};
  }
  if (fs::is_directory(file, error)) file /= "index.html";
  if (!fs::is_regular_file(fs::symlink_status(file, error)) || fs::file_size(file, error) > longest_file) return {};
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  return WebAnswer{.status = 200, .type = type_of(file), .body = {std::istreambuf_iterator<char>(in), {}}};
}

}  // namespace passo
