#include "passo/grbl/grbl_memory.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::string_view title = "# Settings made by senders, saved by passo serve: $10, $13, $I, $N0, $N1.\n";
constexpr unsigned highest_mask = 255;

bool is_plain(std::string_view text) {
  return text.size() <= GrblMemory::longest && std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

void take(std::string_view key, std::string_view value, GrblMemory& memory) {
  if (!is_plain(value)) return;
  if (key == "$I") memory.build = value;
  if (key == "$N0") memory.startup[0] = value;
  if (key == "$N1") memory.startup[1] = value;
  if (key == "$13") memory.choices.inches = value == "1";
  unsigned mask = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), mask);
  const bool is_mask = error == std::errc() && end == value.data() + value.size() && mask <= highest_mask;
  if (key == "$10" && is_mask) memory.choices.status_mask = mask;
}

}  // namespace

std::string grbl_memory_text(const GrblMemory& memory) {
  return fmt::format("{}$10={}\n$13={:d}\n$I={}\n$N0={}\n$N1={}\n", title, memory.choices.status_mask,
                     memory.choices.inches, memory.build, memory.startup[0], memory.startup[1]);
}

GrblMemory read_grbl_memory(std::string_view text) {
  GrblMemory memory;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t equals = line.find('=');
    if (equals != std::string_view::npos) take(line.substr(0, equals), line.substr(equals + 1), memory);
  }
  return memory;
}

}  // namespace passo
