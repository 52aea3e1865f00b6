// HttpUrl: the address of a resource on an HTTP server, in its parts (RFC 3986): http://HOST[:PORT][/PATH][?QUERY].
//
// Only plain http, without a user name and without a fragment. No part contains blanks or control characters, so each
// can be put into a request as it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace passo {

struct HttpUrl {
  std::string host;  // a name or an address; without the brackets of an IPv6 address
  std::uint16_t port = 80;
  std::string target = "/";  // path and query

  // Returns the value of the header Host.
  std::string host_and_port() const;
  friend bool operator==(const HttpUrl&, const HttpUrl&) = default;
};

// Empty: the text is not such an address.
std::optional<HttpUrl> parse_http_url(std::string_view text);

}  // namespace passo
