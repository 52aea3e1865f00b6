#include "passo/base/http_url.hpp"

#include <algorithm>
#include <charconv>

namespace passo {
namespace {

constexpr std::string_view scheme = "http://";
constexpr std::size_t longest_url = 2000;
constexpr std::size_t longest_host = 253;
constexpr std::uint16_t usual_port = 80;

bool is_in_name(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '.' || c == '_';
}

bool is_in_address(char c) {
  return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F') || c == ':' || c == '.';
}

bool is_in_target(char c) {
  return c > ' ' && c < '\x7f' && c != '#' && c != '"' && c != '<' && c != '>' && c != '\\';
}

// Cuts the host off the text. Returns false if there is none.
bool cut_host(std::string_view& text, std::string& host) {
  const bool is_address = text.starts_with('[');
  if (is_address) text.remove_prefix(1);
  const auto* const end = std::ranges::find_if_not(text, is_address ? is_in_address : is_in_name);
  host.assign(text.begin(), end);
  text.remove_prefix(host.size());
  if (host.empty() || host.size() > longest_host) return false;
  if (!is_address) return true;
  if (!text.starts_with(']')) return false;
  text.remove_prefix(1);
  return true;
}

// The same for ":8080". Without a colon, the port stays as it is.
bool cut_port(std::string_view& text, std::uint16_t& port) {
  if (!text.starts_with(':')) return true;
  text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc() && port > 0;
}

}  // namespace

std::string HttpUrl::host_and_port() const {
  const bool is_address = host.find(':') != std::string::npos;
  return (is_address ? "[" + host + "]" : host) + (port == usual_port ? "" : ":" + std::to_string(port));
}

std::optional<HttpUrl> parse_http_url(std::string_view text) {
  if (text.size() > longest_url || !text.starts_with(scheme)) return {};
  text.remove_prefix(scheme.size());
  HttpUrl url;
  if (!cut_host(text, url.host) || !cut_port(text, url.port)) return {};
  if (text.empty()) return url;
  if ((text[0] != '/' && text[0] != '?') || !std::ranges::all_of(text, is_in_target)) return {};
  url.target = (text[0] == '?' ? "/" : "") + std::string(text);
  return url;
}

}  // namespace passo
