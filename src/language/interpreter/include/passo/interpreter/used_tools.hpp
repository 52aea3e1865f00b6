// index_of_tool(): for lists of the tools that a program uses, in order of first use. A program may use any number of
// tools, but memory is bounded: beyond the first `most`, the last entry represents all others.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace passo {

// Returns the index of the tool in `used`. Adds a new one by make(), if there is room. `number`: member or function of
// an entry that returns the tool's number. `most`: at least 1.
template <class Entry, class Number, class Make>
std::size_t index_of_tool(std::vector<Entry>& used, std::int32_t tool, Number number, std::size_t most, Make make) {
  const auto found = std::ranges::find(used, tool, number);
  if (found == used.end() && used.size() < most) {
    used.push_back(make());
    return used.size() - 1;
  }
  return std::min(static_cast<std::size_t>(found - used.begin()), most - 1);
}

}  // namespace passo
