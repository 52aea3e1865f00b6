// WebAccess: who may ask a web server anything.
//
// A page of the web that a browser shows can make that browser ask any server, also one on the browser's own computer.
// So the name in Host must be one of the server's own, and an Origin must be the server itself: pages of others are
// refused, whatever name they have given to the server's address. Who is not on this computer must know the token
// besides.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace passo {

// Headers as they came; empty: the header is missing.
struct WebCaller {
  std::string_view host = {};
  std::string_view origin = {};
  std::string_view authorization = {};
  std::string_view query = {};  // of the target, without "?"
};

struct WebAccess {
  std::vector<std::string> names = {};  // of the server, in Host: without the port, in lower case
  std::string token = {};               // empty: nobody needs one

  // Why the caller is refused: 400, 401 or 403. Empty: it may ask.
  std::optional<unsigned> refuse(const WebCaller& caller) const;
};

// What %41 stands for (RFC 3986); a "+" is a plus. Empty: a "%" without two hexadecimal digits.
std::optional<std::string> percent_decoded(std::string_view text);

// The value of a key in "a=1&b=2", without decoding. Empty: it is missing or empty.
std::string_view query_value(std::string_view query, std::string_view key);

// Equal, in a time that does not tell where two texts of one length differ.
bool equal_in_steady_time(std::string_view a, std::string_view b);

}  // namespace passo
