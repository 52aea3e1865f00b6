#include "passo/api/deleted_lines.hpp"

#include <algorithm>

namespace passo {
namespace {

// Calls `use` with each line, its line end included.
template <class Use>
void for_each_line(std::string_view text, const Use& use) {
  while (!text.empty()) {
    const std::size_t length = std::min(text.find('\n'), text.size() - 1) + 1;
    use(text.substr(0, length));
    text.remove_prefix(length);
  }
}

bool is_deleted(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t");
  return at != std::string_view::npos && line[at] == '/';
}

}  // namespace

std::uint64_t count_deleted_lines(std::string_view text) {
  std::uint64_t count = 0;
  for_each_line(text, [&](std::string_view line) { count += is_deleted(line) ? 1 : 0; });
  return count;
}

std::string with_deleted_lines_as_comments(std::string_view text) {
  std::string all;
  for_each_line(text, [&](std::string_view line) {
    if (is_deleted(line)) all += ';';
    all += line;
  });
  return all;
}

}  // namespace passo
