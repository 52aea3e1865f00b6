// Counts every allocation of the test program. A warm interpreter makes none for a line.
#include "../kept_blocks.hpp"
#include "interpreted.hpp"
#include "kit/allocation_count.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

// How often the interpreter allocates after a number of operations, and how many operations there are.
struct Run {
  std::size_t operations = 0;
  std::size_t allocations = 0;
};
Run run(const std::string& program, std::size_t warm_after) {
  Diagnostics diagnostics;
  const InterpreterOptions options;
  Interpreter interpreter(ProgramReader::from_text("test.ngc", program), options, diagnostics);
  Operation operation;
  Run run;
  std::size_t warm = 0;
  while (interpreter.next(operation)) {
    if (++run.operations == warm_after) warm = test::allocations;
  }
  run.allocations = test::allocations - warm;
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  return run;
}

void expect_warm_after_half(const std::string& program) {
  const Run whole = run(program, 0);
  EXPECT_GT(whole.operations, 1000U);
  EXPECT_GT(whole.allocations, 0U);  // they are counted
  EXPECT_EQ(run(program, whole.operations / 2).allocations, 0U) << program.substr(0, 200);
}

// The five kinds of the benchmark (bench/language_benchmark.cpp).
TEST(Interpreting, allocates_nothing_a_line_of_moves) {
  std::string lines = "G21 G90 F1000\n";
  std::string modal = "G21 G90 F1000 G1\n";
  std::string arcs = "G21 G90 F1000\nG0 X10\n";
  for (int i = 0; i < 1000; ++i) {
    lines += fmt::format("G1 X{}.1037 Y{}.2071 Z-0.{:03}\n", i % 97, i % 46, i % 50);
    modal += fmt::format("X{}.1037 Y{}.2071\n", i % 97, i % 46);
    arcs += i % 2 == 0 ? "G3 X-10.00000 Y0 I-10 J0.00000\n" : "G2 X10 Y0 I10 J0\n";
  }
  expect_warm_after_half(lines + "M2\n");
  expect_warm_after_half(modal + "M2\n");
  expect_warm_after_half(arcs + "M2\n");
}

TEST(Interpreting, allocates_nothing_a_pass_of_a_loop) {
  expect_warm_after_half(
      "G21 G90 F1000 G1\n#1 = 0\no1 while [#1 LT 1000]\n#2 = [10 * cos[#1]]\n#3 = [10 * sin[#1]]\nX#2 Y#3\n"
      "#1 = [#1 + 1]\no1 endwhile\nM2\n");
}

TEST(Interpreting, allocates_nothing_a_call_of_a_sub) {
  expect_warm_after_half(
      "G21 G90 F1000 G1\no<hop> sub\n#<end> = [#1 * 2]\nX#<end> Y#2\no<hop> endsub\n#<i> = 0\no2 repeat [1000]\n"
      "o<hop> call [#<i>] [#<i> + 1]\n#<i> = [#<i> + 1]\no2 endrepeat\nM2\n");
}

// All that a program may hold, one after the other. The interpreter is warm when each place for a kept line has held
// each of them.
TEST(Interpreting, allocates_nothing_a_line_once_warm) {
  std::string program =
      "G21 G90 F1000 M3 S1000\no1 sub\n#<a>=[#1+1]\no2 if [#5420 GT 0]\n#5=[#5+SIN[30]]\n"
      "o2 endif\nG1 X#<a>\no1 endsub\n";
  const std::string pass =
      "N10 G1 X12.345 Y-3.21 Z0.5 (comment)\nX1\nG2 X5 Y0 R10\nG3 X1 Y0 I-2 J0\no1 call [4]\no3 repeat [3]\nG0 X2 "
      "Y2\no3 endrepeat\n(debug,at #5420 and #<_x>)\nG55 G91 G0 X1\nG54 "
      "G90\nG41.1 D1\nG1 X20 Y9\nZ3 (held)\nX15\n(held too)\nG3 X19 I2\nG1 X30\nG40\nX2 Y2 Z0\n"
      "G90\nG98 G83 X1 Z-2 R1 Q.5\nX2 Y3\nG80\n"
      "G90\nG5 X3 Y3 I1 J1 P1 Q1\nG5.1 X1 Y1 I1 J1\nG5.2 X1 Y1 P1 L4\nX2 Y2 P1\nX2 Y3 P2\nG5.3\nG51 P2\nG0 X1\nG50\n";
  for (std::size_t i = 0; i < 2 * KeptBlocks::places; ++i) program += pass;
  expect_warm_after_half(program + "M2\n");
}

}  // namespace
}  // namespace passo
