// EagleItem: the elements of an EAGLE board (XML) as a tree. Private to cam/.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"

namespace passo {

struct EagleItem {
  std::string name = {};
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::vector<EagleItem> children = {};
  std::uint32_t line = 0;

  // Returns the value of an attribute; empty if it is missing.
  std::string_view text(std::string_view attribute) const;
  // Returns the first child with this name; null if there is none.
  const EagleItem* child(std::string_view wanted) const;
};

// Returns the <board>. On failure, reports "eagle.syntax", "eagle.no-board" or "eagle.too-large", and returns nothing.
std::optional<EagleItem> read_eagle_document(const std::string& name, std::string_view text, Diagnostics& diagnostics);

}  // namespace passo
