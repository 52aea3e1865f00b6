#include "passo/gcode/symbols.hpp"

#include <array>

namespace passo {
namespace {

// Writes `name` in the form that is compared, and returns its end.
char* normalise(std::string_view name, char* out) {
  for (const char c : name) {
    if (c == ' ' || c == '\t') continue;
    *out++ = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return out;
}

}  // namespace

SymbolTable::SymbolTable() {
  names_.emplace_back();  // id 0 is no symbol
}

Symbol SymbolTable::intern(std::string_view name) {
  std::array<char, 256> small;
  std::string large;
  char* first = small.data();
  if (name.size() > small.size()) {
    large.resize(name.size());
    first = large.data();
  }
  const std::string_view normal(first, static_cast<std::size_t>(normalise(name, first) - first));

  if (const auto found = ids_.find(normal); found != ids_.end()) return Symbol{found->second};
  const auto id = static_cast<std::uint32_t>(names_.size());
  ids_.emplace(names_.emplace_back(normal), id);
  return Symbol{id};
}

}  // namespace passo
