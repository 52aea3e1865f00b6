// Counts every allocation of the test program: a warm interpreter makes none a line.
#include "interpreted.hpp"
#include "kit/allocation_count.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(Interpreting, allocates_nothing_a_line_once_warm) {
  std::string program = "G21 G90 F1000 M3 S1000\no1 sub\n#<a>=[#1+1]\nG1 X#<a>\no1 endsub\n";
  const std::string pass =
      "N10 G1 X12.345 Y-3.21 Z0.5 (comment)\nX1\nG2 X5 Y0 R10\nG3 X1 Y0 I-2 J0\no2 if [#5420 GT 0]\n#5=[#5+SIN[30]]\n"
      "o2 endif\no1 call [4]\no3 repeat [3]\nG0 X2 Y2\no3 endrepeat\n(debug,at #5420 and #<_x>)\nG55 G91 G0 X1\nG54 "
      "G90\nG41.1 D1\nG1 X20 Y9\nZ3 (held)\nX15\n(held too)\nG3 X19 I2\nG1 X30\nG40\nX2 Y2 Z0\n"
      "G90\nG98 G83 X1 Z-2 R1 Q.5\nX2 Y3\nG80\n"
      "G90\nG5 X3 Y3 I1 J1 P1 Q1\nG5.1 X1 Y1 I1 J1\nG5.2 X1 Y1 P1 L4\nX2 Y2 P1\nX2 Y3 P2\nG5.3\nG51 P2\nG0 X1\nG50\n";
  for (int i = 0; i < 50; ++i) program += pass;
  program += "M2\n";

  Diagnostics diagnostics;
  const InterpreterOptions options;
  Interpreter interpreter(ProgramReader::from_text("test.ngc", program), options, diagnostics);
  Operation operation;
  std::size_t operations = 0;
  std::size_t warm = 0;
  while (interpreter.next(operation)) {
    if (++operations == 200) warm = test::allocations;
  }
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  EXPECT_GT(operations, 800U);
  EXPECT_EQ(test::allocations - warm, 0U);
}

}  // namespace
}  // namespace passo
