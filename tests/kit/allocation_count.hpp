// Counts every allocation of a test program. Include this file in only one file of the program, because it replaces
// operator new.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace passo::test {
inline std::size_t allocations = 0;
}  // namespace passo::test

// Not inlined, because g++ warns about new and free in one function.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++passo::test::allocations;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
