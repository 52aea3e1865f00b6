// Symbols: names (of parameters, of O-word labels) as small numbers, so that looking one up is an index.
//
// Names are compared as RS274/NGC does: lower case, white space taken out. One table serves a whole job.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace passo {

struct Symbol {
  std::uint32_t id = 0;  // 0: none
  explicit operator bool() const { return id != 0; }
  friend bool operator==(Symbol, Symbol) = default;
};

class SymbolTable {
 public:
  SymbolTable();
  // `name` in any case and spacing.
  Symbol intern(std::string_view name);
  std::string_view name(Symbol symbol) const { return names_[symbol.id]; }
  std::size_t size() const { return names_.size(); }

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
  };
  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>> ids_;
};

}  // namespace passo
