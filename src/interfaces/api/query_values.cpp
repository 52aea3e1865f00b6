// What the query of a request says: a dialect, or a place in a program.
#include <charconv>
#include <cmath>

#include "api_json.hpp"

namespace passo {

Result<Dialect, WebAnswer> dialect_from(std::string_view query) {
  const std::string_view dialect = query_value(query, "dialect");
  if (dialect == "grbl") return Dialect::grbl;
  if (dialect.empty() || dialect == "linuxcnc") return Dialect::linuxcnc;
  return Failure{bad_body("the dialect is linuxcnc or grbl")};
}

std::string_view dialect_name(Dialect dialect) {
  return dialect == Dialect::grbl ? "grbl" : "linuxcnc";
}

std::optional<LinePlace> place_from(std::string_view query) {
  const auto read = [query](const char* key, auto& value) {
    const std::string_view text = query_value(query, key);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  const auto is_given = [query](const char* key) { return !query_value(query, key).empty(); };
  LinePlace place;
  double after = 0;
  if (!read("from_line", place.line) || place.line == 0) return {};
  if (is_given("pass") && (!read("pass", place.pass) || place.pass == 0)) return {};
  if (is_given("after") && (!read("after", after) || !std::isfinite(after) || after < 0)) return {};
  place.after = Mm(after);
  return place;
}

}  // namespace passo
