// Counts every allocation of the test program. After the first lines a parser makes none.
#include "kit/allocation_count.hpp"
#include "parsed_line.hpp"

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
  const std::size_t before = test::allocations;
  parse_all();
  EXPECT_EQ(test::allocations, before);
  EXPECT_GT(before, 0U);  // allocations are counted
}

}  // namespace
}  // namespace passo
