// SymbolTable: maps names (of parameters and O-word labels) to small numbers, so that a lookup is an array access.
//
// Names are compared as in RS274/NGC: in lower case, without white space. One table is used for a whole job.
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

  // Returns the symbol of a name, in any case and spacing; adds the name if it is new.
  Symbol intern(std::string_view name);
  // Returns the normalised name. The view is valid as long as the table exists.
  std::string_view name(Symbol symbol) const { return names_[symbol.id]; }
  std::size_t size() const { return names_.size(); }

 private:
  std::deque<std::string> names_;  // by id; a deque, because ids_ and callers hold views into it
  std::unordered_map<std::string_view, std::uint32_t> ids_;
};

}  // namespace passo
