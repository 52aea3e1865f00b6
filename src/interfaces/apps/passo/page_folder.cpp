#include "page_folder.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t longest_file = 16 << 20;
// Nothing but what this server gives: no foreign scripts, no styles or scripts within the page's text.
constexpr const char* page_policy =
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self'; font-src 'self'; "
    "connect-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
constexpr std::pair<std::string_view, const char*> compressions[] = {{"br", ".br"}, {"gzip", ".gz"}};

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

// "gzip, deflate, br;q=0.9" accepts "br".
bool accepts(std::string_view encodings, std::string_view encoding) {
  while (!encodings.empty()) {
    std::string_view one = encodings.substr(0, encodings.find(','));
    encodings.remove_prefix(std::min(encodings.size(), one.size() + 1));
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.substr(0, one.find(';')) == encoding) return !one.ends_with(";q=0");
  }
  return false;
}

// Another content has another size or another time.
std::string version_of(const fs::path& file) {
  std::error_code error;
  const auto time = fs::last_write_time(file, error).time_since_epoch().count();
  return fmt::format("\"{:x}-{:x}\"", fs::file_size(file, error), static_cast<std::uint64_t>(time));
}

}  // namespace

std::optional<WebAnswer> PageFolder::answer(const WebRequest& request) const {
  std::string_view path = request.path;
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
  WebAnswer answer{.type = type_of(file), .policy = page_policy};
  // Vite names files in assets/ by their content: such a name never means another content.
  answer.cache = request.path.starts_with("/assets/") ? "public, max-age=31536000, immutable" : "no-cache";
  for (const auto& [encoding, ending] : compressions) {
    const fs::path compressed = fs::path(file) += ending;
    if (!accepts(request.encodings, encoding) || !fs::is_regular_file(fs::symlink_status(compressed, error))) continue;
    answer.encoding = encoding;
    file = compressed;
    break;
  }
  answer.version = version_of(file);
  if (request.known == answer.version) {
    answer.status = 304;
    return answer;
  }
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  answer.body = {std::istreambuf_iterator<char>(in), {}};
  return answer;
}

std::string usual_page_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  for (const char* const folder : {"page", "../page", PASSO_SHARE_FROM_PROGRAM "/page"}) {
    const fs::path page = (program.parent_path() / folder).lexically_normal();
    if (fs::is_regular_file(page / "index.html", error)) return page.string();
  }
  return {};
}

}  // namespace passo
