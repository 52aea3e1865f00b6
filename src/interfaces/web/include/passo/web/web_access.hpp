// WebAccess: access control of a web server.
//
// Any web page in a browser can make that browser send requests to any server, including one on the same computer.
// Therefore the name in Host must be one of the server's own names, and an Origin must be the server itself: pages of
// other sites are refused, whatever name they have assigned to the server's address. Clients on other computers must
// also know the token.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

// Headers as received; empty: the header is missing.
struct WebCaller {
  std::string_view host = {};
  std::string_view origin = {};
  std::string_view authorization = {};
  std::string_view query = {};  // query of the target, without "?"
};

struct WebAccess {
  std::vector<std::string> names = {};  // the server's names in Host: without the port, in lower case
  std::string token = {};               // empty: not required

  // Returns the status with which the caller is refused: 400, 401 or 403. Empty: access is allowed.
  std::optional<unsigned> refuse(const WebCaller& caller) const;
};

// Decodes percent-encoding such as %41 (RFC 3986); a "+" stays a plus. Empty if a "%" lacks two hexadecimal digits.
std::optional<std::string> percent_decoded(std::string_view text);

// Returns the value of a key in "a=1&b=2", without decoding. Empty if it is missing or empty.
std::string_view query_value(std::string_view query, std::string_view key);

// Compares in constant time: the time does not depend on where two texts of equal length differ.
bool equal_in_steady_time(std::string_view a, std::string_view b);

}  // namespace passo
