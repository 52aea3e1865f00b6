// decimal_text: formats numbers with a fixed number of decimals, with the same result as printf's "%.4f", but faster.
// Canonical calls consist mostly of numbers, so this determines the speed of `passo canon`.
#pragma once

#include <cstddef>
#include <cstdint>

namespace passo {

// Sufficient for any number that these functions write.
inline constexpr std::size_t longest_decimal_text = 352;

// Write at `to` and return the end. `value` is rounded exactly, half to even, like printf.
char* write_decimal_4(char* to, double value);
char* write_decimal_6(char* to, double value);
char* write_whole(char* to, std::uint64_t value);

}  // namespace passo
