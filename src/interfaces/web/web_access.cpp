#include "passo/web/web_access.hpp"

#include <algorithm>
#include <cstddef>

#include "passo/base/lower_case.hpp"

namespace passo {
namespace {

constexpr unsigned bad_request = 400;
constexpr unsigned unauthorized = 401;
constexpr unsigned forbidden = 403;
constexpr std::string_view bearer = "Bearer ";

// "[::1]:7080" → "[::1]", "localhost:7080" → "localhost"
std::string_view without_port(std::string_view host) {
  const std::size_t colon = host.rfind(':');
  const std::size_t bracket = host.rfind(']');
  const bool is_port = colon != std::string_view::npos && (bracket == std::string_view::npos || bracket < colon);
  return is_port ? host.substr(0, colon) : host;
}

int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char low = static_cast<char>(c | 0x20);
  return low >= 'a' && low <= 'f' ? low - 'a' + 10 : -1;
}

}  // namespace

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const int high = text.size() - i > 2 ? digit_of(text[i + 1]) : -1;
    const int low = high >= 0 ? digit_of(text[i + 2]) : -1;
    if (low < 0) return {};
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

bool equal_in_steady_time(std::string_view a, std::string_view b) {
  unsigned differing = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    differing |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return differing == 0;
}

std::string_view query_value(std::string_view query, std::string_view key) {
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    if (part.size() > key.size() && part.starts_with(key) && part[key.size()] == '=')
      return part.substr(key.size() + 1);
    query.remove_prefix(std::min(query.size(), part.size() + 1));
  }
  return {};
}

std::optional<unsigned> WebAccess::refuse(const WebCaller& caller) const {
  if (caller.host.empty()) return bad_request;
  const std::string host = lower_case(std::string(caller.host));
  if (std::ranges::find(names, std::string(without_port(host))) == names.end()) return forbidden;
  if (!caller.origin.empty()) {
    const std::string origin = lower_case(std::string(caller.origin));
    if (origin != "http://" + host && origin != "https://" + host) return forbidden;
  }
  if (token.empty()) return {};
  // As it was written into the query, or encoded.
  const std::string_view written = query_value(caller.query, "token");
  const std::string decoded = percent_decoded(written).value_or(std::string());
  std::string_view given = equal_in_steady_time(decoded, token) ? decoded : written;
  if (caller.authorization.starts_with(bearer)) given = caller.authorization.substr(bearer.size());
  if (!equal_in_steady_time(given, token)) return unauthorized;
  return {};
}

}  // namespace passo
