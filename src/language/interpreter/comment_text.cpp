#include "comment_text.hpp"

#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double shown_as_zero = 1e-6;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The parameter that is named at the start of `text`: its value, and the length of its name with the '#'. Length 0:
// this '#' names no parameter.
struct Found {
  std::size_t length = 0;
  bool known = false;
  double value = 0;
};

Found find_parameter(std::string_view text, const ParameterValues& parameters, SymbolTable& symbols) {
  Found found;
  if (text.size() > 1 && is_digit(text[1])) {
    std::int64_t number = 0;
    const auto [end, problem] = std::from_chars(text.data() + 1, text.data() + text.size(), number);
    found.length = static_cast<std::size_t>(end - text.data());
    found.known = problem == std::errc{} && parameters.numbered(number, found.value);
  } else if (text.size() > 1 && text[1] == '<') {
    const std::size_t close = text.find('>');
    if (close == std::string_view::npos) return found;
    found.length = close + 1;
    found.known = parameters.named(symbols.intern(text.substr(2, close - 2)), found.value);
  }
  return found;
}

// Reads how the values after this place are written: %d, %f or %.3f, as in LinuxCNC. Returns the length of what was
// read.
std::size_t read_format(std::string_view text, int& decimals) {
  constexpr int decimals_of_f = 4;
  if (text.starts_with("%d")) return decimals = 0, 2;
  if (text.starts_with("%f")) return decimals = decimals_of_f, 2;
  if (!text.starts_with("%.")) return 0;
  if (text.size() < 4 || !is_digit(text[2]) || text[3] != 'f') return 1;  // only the '%' is dropped
  return decimals = text[2] - '0', 4;
}

}  // namespace

void fill_in_parameters(std::string_view text, const ParameterValues& parameters, SymbolTable& symbols,
                        std::string& out) {
  out.clear();
  int decimals = 6;
  while (!text.empty()) {
    if (const std::size_t format = text.front() == '%' ? read_format(text, decimals) : 0; format != 0) {
      text.remove_prefix(format);
      continue;
    }
    const Found found = text.front() == '#' ? find_parameter(text, parameters, symbols) : Found{};
    if (found.length == 0) {
      out += text.front();
      text.remove_prefix(1);
      continue;
    }
    if (found.known) {
      fmt::format_to(std::back_inserter(out), "{:.{}f}", std::abs(found.value) < shown_as_zero ? 0 : found.value,
                     decimals);
    } else {
      out += "######";
    }
    text.remove_prefix(found.length);
  }
}

}  // namespace passo
