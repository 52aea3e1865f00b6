// decimal_text: numbers as text with a fixed number of decimals, the same characters as printf's "%.4f", without its
// cost. Canonical calls are mostly numbers, so their printing decides how fast `passo canon` is.
#pragma once

#include <cstddef>
#include <cstdint>

namespace passo {

// Room for any number that these functions write.
inline constexpr std::size_t longest_decimal_text = 352;

// Write at `to` and return the end. `value` is rounded exactly, half to even, as printf does it.
char* write_decimal_4(char* to, double value);
char* write_decimal_6(char* to, double value);
char* write_whole(char* to, std::uint64_t value);

}  // namespace passo
