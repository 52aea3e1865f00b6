// The speed of interpretation. If rs274 (Debian: linuxcnc-uspace) is installed, it runs beside it for comparison.
//
//   language_benchmark
//
// Six kinds of programs of 200,000 executed lines: lines a second of CPU time, interpreted with operations dropped,
// checked by `passo check`, and printed as canonical calls by `passo canon` and by `rs274 -g`, both to /dev/null. Then
// the highest memory of `passo canon` for two million lines of each kind. The benchmark prints figures and decides
// nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>

#include "cost.hpp"
#include <fmt/format.h>
#include <unistd.h>

#include "passo/interpreter/interpreter.hpp"

namespace {

using namespace passo;
namespace fs = std::filesystem;

constexpr int timed_lines = 200'000;
constexpr int many_lines = 2'000'000;
constexpr int rounds = 3;  // the best one counts, because other programs run at the same time

// A kind of program, and the function that writes one with so many lines to execute.
struct Kind {
  const char* name;
  void (*write)(std::FILE* file, int lines);
};

void write_moves(std::FILE* file, int lines) {
  fmt::print(file, "G21 G90 F1000\n");
  for (int i = 0; i < lines; ++i) {
    fmt::print(file, "G1 X{:.4f} Y{:.4f} Z{:.3f}\n", i % 997 * 0.1037, i % 463 * 0.2071, -0.001 * (i % 50));
  }
  fmt::print(file, "M2\n");
}

void write_modal(std::FILE* file, int lines) {
  fmt::print(file, "G21 G90 F1000\nG1 X0\n");
  for (int i = 0; i < lines; ++i) fmt::print(file, "X{:.4f} Y{:.4f}\n", i % 997 * 0.1037, i % 463 * 0.2071);
  fmt::print(file, "M2\n");
}

void write_arcs(std::FILE* file, int lines) {
  fmt::print(file, "G21 G17 G90 F1000\nG0 X10 Y0\n");
  double angle = 0;
  for (int i = 0; i < lines; ++i) {
    const double next = angle + 0.3 + 0.01 * (i % 150);
    fmt::print(file, "G3 X{:.5f} Y{:.5f} I{:.5f} J{:.5f}\n", 10 * std::cos(next), 10 * std::sin(next),
               -10 * std::cos(angle), -10 * std::sin(angle));
    angle = std::fmod(next, 2 * std::numbers::pi);
  }
  fmt::print(file, "M2\n");
}

// Lines with as many words and digits as those of write_arcs(), and without a bend: what of an arc's cost is reading.
void write_long_moves(std::FILE* file, int lines) {
  fmt::print(file, "G21 G17 G90 F1000\nG0 X10 Y0\n");
  double angle = 0;
  for (int i = 0; i < lines; ++i) {
    const double next = angle + 0.3 + 0.01 * (i % 150);
    fmt::print(file, "G1 X{:.5f} Y{:.5f} Z{:.5f} F{:.5f}\n", 10 * std::cos(next), 10 * std::sin(next),
               -10 * std::cos(angle), 15 + 10 * std::sin(angle));
    angle = std::fmod(next, 2 * std::numbers::pi);
  }
  fmt::print(file, "M2\n");
}

// Six lines a pass.
void write_loop(std::FILE* file, int lines) {
  fmt::print(file,
             "G21 G90 F1000 G1\n#1 = 0\no1 while [#1 LT {}]\n#2 = [10 * cos[#1]]\n#3 = [10 * sin[#1]]\n"
             "X#2 Y#3\n#1 = [#1 + 1]\no1 endwhile\nM2\n",
             lines / 6);
}

// Six lines a call.
void write_subs(std::FILE* file, int lines) {
  fmt::print(file,
             "G21 G90 F1000 G1\no<hop> sub\n#<end> = [#1 * 2]\nX#<end> Y#2\no<hop> endsub\n#<i> = 0\n"
             "o2 repeat [{}]\no<hop> call [#<i>] [#<i> + 1]\n#<i> = [#<i> + 1]\no2 endrepeat\nM2\n",
             lines / 6);
}

void write(const Kind& kind, const std::string& path, int lines) {
  std::FILE* const file = std::fopen(path.c_str(), "w");
  if (file == nullptr) std::exit(1);
  kind.write(file, lines);
  std::fclose(file);
}

// Lines a second of this process, with operations dropped.
double interpret(const std::string& path) {
  double best = 1e9;
  for (int round = 0; round < rounds; ++round) {
    const double start = cpu_seconds(RUSAGE_SELF);
    Diagnostics diagnostics;
    auto reader = ProgramReader::open(path);
    if (!reader) return 0;
    Interpreter interpreter(std::move(*reader), InterpreterOptions(), diagnostics);
    Operation operation;
    while (interpreter.next(operation)) {
    }
    if (diagnostics.any_error()) return 0;
    best = std::min(best, cpu_seconds(RUSAGE_SELF) - start);
  }
  return timed_lines / best;
}

// Lines a second of a command; 0 if it fails, as where it is not installed.
double run(const std::string& command) {
  double best = 1e9;
  for (int round = 0; round < rounds; ++round) {
    const double start = cpu_seconds(RUSAGE_CHILDREN);
    const int status = std::system((command + " >/dev/null 2>&1").c_str());
    // rs274 fails now and then where another one runs in the same home. Such a round does not count.
    if (status == 0) best = std::min(best, cpu_seconds(RUSAGE_CHILDREN) - start);
  }
  return best < 1e9 ? timed_lines / best : 0;
}

std::string thousands(double rate) {
  return rate > 0 ? fmt::format("{:.0f} k", rate / 1000) : "-";
}

}  // namespace

int main() {
  const Kind kinds[] = {{"G1 X Y Z", write_moves},
                        {"modal X Y", write_modal},
                        {"G1 as long as a G3", write_long_moves},
                        {"G3 with I J", write_arcs},
                        {"while with trigonometry", write_loop},
                        {"subs, named parameters", write_subs}};
  const std::string path = (fs::temp_directory_path() / fmt::format("passo-language-{}.ngc", getpid())).string();
  std::printf(
      "lines a CPU second            dropped   passo check   passo canon   rs274 -g   canon : rs274   two million\n");
  for (const Kind& kind : kinds) {
    write(kind, path, timed_lines);
    const double dropped = interpret(path);
    const double checked =
        run(fmt::format("{} check -m {}/examples/machines/router.toml {}", PASSO_PROGRAM, PASSO_SOURCE_DIR, path));
    const double printed = run(fmt::format("{} canon {}", PASSO_PROGRAM, path));
    const double other = run(fmt::format("rs274 -g {}", path));
    write(kind, path, many_lines);
    const Cost cost = cost_of({PASSO_PROGRAM, "canon", path});
    std::printf("%-27s %9s %13s %13s %10s %15s %9.1f MiB\n", kind.name, thousands(dropped).c_str(),
                thousands(checked).c_str(), thousands(printed).c_str(), thousands(other).c_str(),
                other > 0 ? fmt::format("{:.1f}", printed / other).c_str() : "-", cost.mebibytes);
  }
  fs::remove(path);
}
