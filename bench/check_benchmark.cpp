// How long `passo check` takes, and its memory: with and without motors, on a dense relief, on arcs and corners, and on
// programs.
//
//   build/release/bench/check_benchmark [PROGRAM...]      these programs instead of the relief
//
// The benchmark prints figures and decides nothing.
#include <cstdio>
#include <string>
#include <vector>

#include "cost.hpp"
#include "relief.hpp"

namespace {

using namespace passo;
namespace fs = std::filesystem;

const fs::path examples = fs::path(PASSO_SOURCE_DIR) / "examples";

void measure(const char* name, const std::string& program) {
  for (const char* machine : {"router.toml", "strong-router.toml"}) {
    const double before = cpu_seconds(RUSAGE_CHILDREN);
    const Cost cost = cost_of({PASSO_PROGRAM, "check", program, "-m", (examples / "machines" / machine).string()});
    std::printf("%-28s %-20s %8.2f s wall %8.2f s CPU %8.1f MiB\n", name, machine, cost.seconds,
                cpu_seconds(RUSAGE_CHILDREN) - before, cost.mebibytes);
  }
}

void measure_relief(const char* name, int moves) {
  GeneratedProgram program(name);
  program.text() << "M3 S9000\n";
  write_relief(program, moves);
  measure(name, program.finish());
}

// Back and forth in rows of 40 steps of half a millimetre, each step a half circle or a line of a zigzag.
void measure_rows(const char* name, int steps, bool arcs) {
  constexpr int in_row = 40;
  GeneratedProgram program(name);
  program.text() << "G21 G90 G17 M3 S9000 F1200\nG0 X0 Y0\n";
  double x = 0;
  for (int i = 0; i < steps; ++i) {
    const double way = i / in_row % 2 == 0 ? 0.5 : -0.5;
    x += way;
    if (arcs) {
      program.text() << (i % 2 == 0 ? "G2 X" : "G3 X") << x << " Y0 I" << way / 2 << " J0\n";
    } else {
      program.text() << "G1 X" << x << " Y" << (i % 2 == 0 ? 0 : 0.5) << "\n";
    }
  }
  measure(name, program.finish());
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> programs(argv + 1, argv + argc);
  for (const std::string& program : programs) measure(fs::path(program).filename().c_str(), program);
  if (!programs.empty()) return 0;
  measure("pocket.ngc", (examples / "pocket.ngc").string());
  measure_rows("20,000 half circles", 20'000, true);
  measure_rows("20,000 like corners", 20'000, false);
  measure_relief("relief, 200,000 lines", 200'000);
  measure_relief("relief, 2 million lines", 2'000'000);
  return 0;
}
