// The cost of a line of G-code: reading, parsing, evaluating, and all of it over a file of a million lines.
#include <filesystem>
#include <fstream>
#include <string>

#include <benchmark/benchmark.h>

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/expression.hpp"
#include "passo/gcode/program_reader.hpp"

namespace passo {
namespace {

void parse_line(benchmark::State& state, const char* text) {
  SymbolTable symbols;
  const BlockParser parser("bench.ngc", symbols);
  Diagnostics diagnostics;
  Block block;
  for (auto _ : state) {
    benchmark::DoNotOptimize(text);
    const bool good = parser.parse(text, 1, block, diagnostics);
    benchmark::DoNotOptimize(good);
    benchmark::ClobberMemory();
  }
  if (diagnostics.any_error()) state.SkipWithError("the line is wrong");
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK_CAPTURE(parse_line, short_move, "G1 X12.345 Y-3.21 Z0.5");
BENCHMARK_CAPTURE(parse_line, modal_move, "X12.345 Y-3.21");
BENCHMARK_CAPTURE(parse_line, arc, "N1250 G2 X101.2345 Y-33.2101 I-12.5 J0.1234 F1200");
BENCHMARK_CAPTURE(parse_line, seventeen_digits, "G1 X12.345678901234567 Y-3.2101234567890123");
BENCHMARK_CAPTURE(parse_line, comment, "(MSG, tool change)");
BENCHMARK_CAPTURE(parse_line, expression, "#1=[#2 + 3 * SIN[#<angle>] / 2]");
BENCHMARK_CAPTURE(parse_line, control, "o<pocket> call [#1] [10] [#3 / 2]");

class OneParameter final : public ParameterValues {
 public:
  bool numbered(std::int64_t /*number*/, double& value) const override {
    value = 2;
    return true;
  }
  bool named(Symbol /*name*/, double& value) const override {
    value = 30;
    return true;
  }
};

void evaluate_expression(benchmark::State& state, const char* text) {
  SymbolTable symbols;
  Diagnostics diagnostics;
  Block block;
  if (!BlockParser("bench.ngc", symbols).parse(text, 1, block, diagnostics)) {
    state.SkipWithError("the line is wrong");
    return;
  }
  const OneParameter parameters;
  for (auto _ : state) {
    const Evaluation value = evaluate(block, block.words[0].value, parameters);
    benchmark::DoNotOptimize(value);
  }
}
BENCHMARK_CAPTURE(evaluate_expression, number, "X1.5");
BENCHMARK_CAPTURE(evaluate_expression, polynomial, "X[#1 * 2 + #3 / 4 - 1]");
BENCHMARK_CAPTURE(evaluate_expression, sine, "X[#2 + 3 * SIN[#<angle>] / 2]");

// Reads and parses a job of a million lines from disk (page cache).
void read_and_parse_file(benchmark::State& state) {
  const std::string path = (std::filesystem::temp_directory_path() / "passo-gcode-benchmark.ngc").string();
  constexpr int lines = 1'000'000;
  std::size_t bytes = 0;
  {
    std::ofstream out(path);
    for (int i = 0; i < lines; ++i) out << "G1 X" << i / 1000.0 << " Y-" << i / 3000.0 << " Z0.5\n";
    bytes = static_cast<std::size_t>(out.tellp());
  }
  for (auto _ : state) {
    SymbolTable symbols;
    const BlockParser parser(path, symbols);
    auto reader = ProgramReader::open(path);
    Diagnostics diagnostics;
    Block block;
    std::string_view text;
    std::uint32_t line = 0;
    while (reader->next_line(text, line, diagnostics)) {
      if (!parser.parse(text, line, block, diagnostics)) state.SkipWithError("the line is wrong");
    }
    benchmark::DoNotOptimize(line);
  }
  state.SetItemsProcessed(state.iterations() * lines);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes));
  std::filesystem::remove(path);
}
BENCHMARK(read_and_parse_file)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace passo
