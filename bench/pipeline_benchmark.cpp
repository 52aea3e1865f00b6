// The speed of the whole street: from text to counted steps, memory, and the start-up time of the program.
//
//   pipeline_benchmark [MACHINE.toml] [PROGRAM…]      uses these programs instead of the examples, and this machine
//                                                     instead of the router
//
// The benchmark prints figures and decides nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cost.hpp"
#include "kit/driven.hpp"
#include "relief.hpp"
#include <unistd.h>

namespace {

using namespace passo;
namespace fs = std::filesystem;

const fs::path source_dir = PASSO_SOURCE_DIR;
const std::string router = (source_dir / "examples" / "machines" / "router.toml").string();

// CPU seconds from text to frames that nobody plays.
double time_to_the_wire(const std::string& path, const MachineDescription& machine) {
  Diagnostics diagnostics;
  auto program = ProgramReader::open(path);
  const double start = cpu_seconds(RUSAGE_SELF);
  const PathOptions path_as = path_options(machine, program->name());
  Interpreter interpreter(std::move(*program), InterpreterOptions(), diagnostics);
  PathBuilder builder(interpreter, path_as, diagnostics);
  PathSmoother smoother(builder);
  Planner planner(smoother, motion_limits(machine));
  StepGenerator steps(planner, step_options(machine));
  const auto motors = static_cast<std::uint8_t>(machine.axes.size());
  std::uint8_t frame[largest_frame];
  std::uint8_t sequence = 0;
  for (BoardItem item; steps.next(item);) {
    if (const auto* segment = std::get_if<BoardSegment>(&item)) encode(*segment, motors, sequence++, frame);
  }
  return cpu_seconds(RUSAGE_SELF) - start;
}

void measure(const std::string& path, const MachineDescription& machine) {
  const std::string name = fs::path(path).filename();
  Diagnostics diagnostics;
  auto program = ProgramReader::open(path);
  if (!program) {
    std::printf("%-28s cannot be read\n", name.c_str());
    return;
  }
  const double start = cpu_seconds(RUSAGE_SELF);
  test::DrivenProgram job(std::move(*program), machine, InterpreterOptions(), diagnostics);
  while (job.advance()) {
  }
  const double whole = cpu_seconds(RUSAGE_SELF) - start;
  if (diagnostics.any_error()) {
    std::printf("%-28s has errors\n", name.c_str());
    return;
  }
  const double to_wire = time_to_the_wire(path, machine);
  const MachineCounts counts = job.machine().counts();
  std::int64_t sum = 0;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) sum += counts.motors[m].total;
  const auto steps = static_cast<double>(sum);
  const double machine_time = static_cast<double>(job.machine().now().count) / machine.board.clock.value();
  std::printf("%-28s %9.1f s %10.0f %9.3f s %6.1f M/s %9.3f s %6.1f M/s %8.1f %8.1f kB/s\n", name.c_str(), machine_time,
              steps, to_wire, steps / to_wire / 1e6, whole, steps / whole / 1e6,
              static_cast<double>(counts.events) / static_cast<double>(job.link().frames_sent()),
              static_cast<double>(job.link().bytes_sent()) / machine_time / 1e3);
}

// Writes waves of half circles of about 1.5 mm, to the left and to the right by turns. As in a CAM program the places
// are rounded, so that the radius at an arc's end is not quite the radius at its start.
void write_arcs(GeneratedProgram& program, int arcs) {
  constexpr int a_row = 60;
  constexpr double one_in = 1e4;  // four decimals
  const auto rounded = [](double place) { return std::round(place * one_in) / one_in; };
  double x = 0;
  for (int i = 0; i < arcs; ++i) {
    if (i % a_row == 0) {
      x = 0;
      program.line() << " X0 Y" << i / a_row * 0.1 << "\n";
    }
    const double radius = 1.5 + 0.1 * std::sin(i * 0.7);
    const double end = rounded(x + 2 * radius);
    program.text() << (i % 2 == 0 ? "G2" : "G3") << " X" << end << " I" << rounded(radius) << "\n";
    x = end;
  }
}

void measure_generated(const MachineDescription& machine) {
  std::printf("\nthe same with 400 steps/mm\n");
  GeneratedProgram relief("relief of 200000 moves");
  write_relief(relief, 200'000);
  measure(relief.finish(), machine);
  GeneratedProgram long_moves("long moves");
  for (int i = 0; i < 1000; ++i) {
    long_moves.line() << " X" << (i % 2 == 0 ? 200 : 0) << " Y" << i * 0.03 << " Z" << -(i % 7) * 0.5 << "\n";
  }
  measure(long_moves.finish(), machine);
  GeneratedProgram arcs("20000 small arcs");
  write_arcs(arcs, 20'000);
  measure(arcs.finish(), machine);
}

void measure_memory() {
  GeneratedProgram program("two million");
  write_relief(program, 2'000'000);
  const Cost cost = cost_of({PASSO_PROGRAM, "run", program.finish(), "-m", router, "-q"});
  std::printf("\ntwo million lines            %10.1f s wall, %.1f MiB at most\n", cost.seconds, cost.mebibytes);
}

void measure_start() {
  std::vector<double> times;
  const std::string program =
      (fs::temp_directory_path() / ("passo-empty-" + std::to_string(getpid()) + ".ngc")).string();
  std::ofstream(program) << "M2\n";
  for (int i = 0; i < 21; ++i) times.push_back(cost_of({PASSO_PROGRAM, "run", program, "-m", router, "-q"}).seconds);
  std::sort(times.begin(), times.end());
  std::printf("start, an empty program      %10.1f ms median, %.1f ms at most, of %zu\n", times[times.size() / 2] * 1e3,
              times.back() * 1e3, times.size());
  fs::remove(program);
}

}  // namespace

int main(int argc, char** argv) {
  Diagnostics diagnostics;
  std::vector<std::string> programs(argv + 1, argv + argc);
  const bool with_machine = !programs.empty() && fs::path(programs.front()).extension() == ".toml";
  const auto machine = load_machine_file(with_machine ? programs.front() : router, diagnostics);
  if (!machine) return 1;
  if (with_machine) programs.erase(programs.begin());
  if (programs.empty()) {
    for (const char* name : {"engrave.ngc", "drill-board.ngc", "pocket.ngc"}) {
      programs.push_back((source_dir / "examples" / name).string());
    }
    const fs::path chips = source_dir / ".." / "shared" / "peers" / "linuxcnc" / "programs" / "3D_Chips.ngc";
    if (fs::exists(chips)) programs.push_back(chips.string());
  }
  std::printf("%-28s %11s %10s %22s %22s %8s %13s\n", "one core", "machine", "steps", "text to wire, CPU",
              "and the board, CPU", "events", "on the wire");
  std::printf("%-28s %11s %10s %11s %10s %11s %10s %8s\n", "", "time", "", "", "steps", "", "steps", "a frame");
  for (const std::string& program : programs) measure(program, *machine);
  if (argc > 1) return 0;
  const auto bench = load_machine_file((source_dir / "examples" / "machines" / "bench.toml").string(), diagnostics);
  if (!bench) return 1;
  measure_generated(*bench);
  measure_memory();
  measure_start();
  return 0;
}
