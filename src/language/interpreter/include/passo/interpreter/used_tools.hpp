// place_of_tool(): for lists of the tools that a program uses, in the order of their first use. A program may name any
// number of tools, and memory is bounded: beyond the first `most`, the last one stands for all others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace passo {

// Where the tool stands in `used`. A new one is added as make(), if there is room. `number`: which member of an entry,
// or what of it, is the tool's number. `most`: at least 1.
template <class Entry, class Number, class Make>
std::size_t place_of_tool(std::vector<Entry>& used, std::int32_t tool, Number number, std::size_t most, Make make) {
  const auto found = std::ranges::find(used, tool, number);
  if (found == used.end() && used.size() < most) {
    used.push_back(make());
    return used.size() - 1;
  }
  return std::min(static_cast<std::size_t>(found - used.begin()), most - 1);
}

}  // namespace passo
