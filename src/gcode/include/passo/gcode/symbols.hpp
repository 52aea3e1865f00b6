// Symbols: names (of parameters, of O-word labels) as small numbers, so that looking one up is an index.
//
// Names are compared as RS274/NGC does: lower case, white space taken out. One table serves a whole job.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

namespace passo {

struct Symbol {
  std::uint32_t id = 0;  // 0: none
  explicit operator bool() const { return id != 0; }
  friend bool operator==(Symbol, Symbol) = default;
};

class SymbolTable {
 public:
  SymbolTable();
  SymbolTable(const SymbolTable&) = delete;
  SymbolTable& operator=(const SymbolTable&) = delete;

  // `name` in any case and spacing.
  Symbol intern(std::string_view name);
  // As it is compared. The view lives as long as the table.
  std::string_view name(Symbol symbol) const { return names_[symbol.id]; }
  std::size_t size() const { return names_.size(); }

 private:
  std::deque<std::string> names_;  // by id; a deque, since ids_ and our callers hold views into it
  std::unordered_map<std::string_view, std::uint32_t> ids_;
};

}  // namespace passo
