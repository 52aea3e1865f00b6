// Counts every allocation of the test program: a warm parser makes none.
#include <cstdlib>
#include <new>

#include "parsed_line.hpp"

namespace {
std::size_t allocations = 0;
}  // namespace

// Not inlined, since g++ takes new and free in one function for a mistake.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* const memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

namespace passo {
namespace {

TEST(Parsing, allocates_nothing_once_warm) {
  const std::string lines[] = {
      "/N10 G1 X12.345 Y-3.21 Z0.5 (comment) ; another",
      "X12.3456789012345678901234567890 #1=[#2 + 3 * SIN[#<angle>] / 2]",
      "O<a rather long name of a subroutine> CALL [1] [2] [3] [4]",
      "O123456 WHILE [#1 LT EXISTS[#<another rather long name>]]",
      "",
  };
  SymbolTable symbols;
  const BlockParser parser("part.ngc", symbols);
  Diagnostics diagnostics;
  Block block;
  const auto parse_all = [&] {
    for (const std::string& line : lines) ASSERT_TRUE(parser.parse(line, 1, block, diagnostics));
  };
  parse_all();
  const std::size_t before = allocations;
  parse_all();
  EXPECT_EQ(allocations, before);
  EXPECT_GT(before, 0U);  // they are counted
}

}  // namespace
}  // namespace passo
