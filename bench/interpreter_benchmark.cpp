// Lines of G-code a second, from text to operations.
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "passo/interpreter/canon.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {
namespace {

constexpr int program_lines = 50'000;

std::string straight_lines(bool modal) {
  std::string text = "G21 G90 F1000\nG1 X0\n";
  for (int i = 0; i < program_lines; ++i) {
    const double x = i % 997 * 0.1037;
    const double y = i % 463 * 0.2071;
    text += modal ? fmt::format("X{:.4f} Y{:.4f}\n", x, y)
                  : fmt::format("G1 X{:.4f} Y{:.4f} Z{:.3f}\n", x, y, -0.001 * (i % 50));
  }
  return text + "M2\n";
}

std::string arcs() {
  std::string text = "G21 G17 G90 F1000\nG0 X0 Y0\n";
  for (int i = 0; i < program_lines; ++i) {
    text += i % 2 == 0 ? "G2 X10.0000 Y0.0000 I5.0000 J0.0000\n" : "G3 X0.0000 Y0.0000 I-5.0000 J0.0000\n";
  }
  return text + "M2\n";
}

// Four lines a pass.
std::string loop_with_trigonometry() {
  return fmt::format(
      "G21 G90 F1000\n#1 = 0\no100 while [#1 LT {}]\n#1 = [#1 + 1]\nG1 X[50 * cos[#1 / 10]] Y[50 * sin[#1 / 10]]\n"
      "o100 endwhile\nM2\n",
      program_lines / 4);
}

// Five lines a call.
std::string sub_calls() {
  return fmt::format(
      "G21 G90 F1000\no<hop> sub\nG1 X#1 Y#2\no<hop> endsub\no100 repeat [{}]\no<hop> call [1.5] [2.5]\no100 "
      "endrepeat\n"
      "M2\n",
      program_lines / 5);
}

void interpret(benchmark::State& state, const std::string& text, bool print) {
  std::size_t operations = 0;
  std::string canon;
  for (auto _ : state) {
    Diagnostics diagnostics;
    InterpreterOptions options;
    Interpreter interpreter(ProgramReader::from_text("benchmark.ngc", text), options, diagnostics);
    CanonPrinter printer;
    Operation operation;
    while (interpreter.next(operation)) {
      ++operations;
      if (!print) continue;
      canon.clear();
      printer.print(operation, canon);
    }
    if (diagnostics.any_error()) state.SkipWithError(diagnostics.all().front().message.c_str());
  }
  benchmark::DoNotOptimize(operations);
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * program_lines);
}

BENCHMARK_CAPTURE(interpret, g1_xyz, straight_lines(false), false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(interpret, modal_xy, straight_lines(true), false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(interpret, arcs, arcs(), false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(interpret, loop_with_trigonometry, loop_with_trigonometry(), false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(interpret, sub_calls, sub_calls(), false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(interpret, g1_xyz_printed, straight_lines(false), true)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace passo
