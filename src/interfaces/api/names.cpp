// Names that people give: of programs and drawings in a query, and of clients.
#include <algorithm>
#include <optional>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/base/utf8.hpp"

namespace passo {
namespace {

constexpr std::size_t longest_name = 200;  // bytes: with what is added to it, a file's name has at most 255

// Characters that do something to a line instead of standing in it: controls, line ends, and what turns the direction
// of text, so that "cgn.exe" looks like "exe.ngc".
bool is_control(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
}

struct NameFault {
  std::string_view finer;  // of the code http.bad-name
  std::string_view why;
};

// Why it is no name. Empty: it is one.
std::optional<NameFault> fault_of(std::string_view name) {
  if (name.size() > longest_name) return NameFault{"length", "it is longer than 200 bytes"};
  if (name.front() == '.') return NameFault{"dot", "it begins with a dot"};
  if (name.find('/') != std::string_view::npos || name.find('\\') != std::string_view::npos) {
    return NameFault{"slash", "it contains / or \\"};
  }
  while (!name.empty()) {
    const CodePoint first = first_code_point(name);
    if (first.length == 0) return NameFault{"encoding", "it is not UTF-8"};
    if (is_control(first.value)) return NameFault{"control", "it contains control characters"};
    name.remove_prefix(first.length);
  }
  return {};
}

}  // namespace

Result<std::string, WebAnswer> name_from(std::string_view query, std::string_view otherwise) {
  const std::string_view written = query_value(query, "name");
  if (written.empty()) return std::string(otherwise);
  const auto refused = [](const NameFault& fault) {
    return Failure{error_answer(400, "http.bad-name",
                                Sentence{.code = fmt::format("http.bad-name.{}", fault.finer),
                                         .text = fmt::format("invalid name: {}", fault.why)})};
  };
  auto name = percent_decoded(written);
  if (!name) return refused({"percent", "a % in it is not followed by two hexadecimal digits; write % as %25"});
  if (const auto fault = fault_of(*name)) return refused(*fault);
  return std::move(*name);
}

std::string words_from(std::string_view text, std::string_view otherwise) {
  std::string words;
  while (!text.empty()) {
    const CodePoint first = first_code_point(text);
    if (words.size() + first.length > longest_name) break;
    if (!is_control(first.value)) words += text.substr(0, first.length);
    text.remove_prefix(std::max(first.length, std::size_t{1}));  // of what is no UTF-8, one byte
  }
  return words.empty() ? std::string(otherwise) : words;
}

}  // namespace passo
