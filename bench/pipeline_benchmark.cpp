// The whole street against the clock: text to counted steps, memory, and how long the program takes to start.
//
//   pipeline_benchmark [PROGRAM…]      programs of one's own instead of the examples; on the router
//
// Prints figures; decides nothing.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cost.hpp"
#include <unistd.h>

#include "passo/controller/job.hpp"

namespace {

using namespace passo;
namespace fs = std::filesystem;

const fs::path source_dir = PASSO_SOURCE_DIR;
const std::string router = (source_dir / "examples" / "machines" / "router.toml").string();

void measure(const std::string& path, const MachineDescription& machine) {
  Diagnostics diagnostics;
  auto program = ProgramReader::open(path);
  if (!program) {
    std::printf("%-28s cannot be read\n", fs::path(path).filename().c_str());
    return;
  }
  const double start = cpu_seconds(RUSAGE_SELF);
  Job job(std::move(*program), machine, InterpreterOptions(), diagnostics);
  while (job.advance()) {
  }
  const double seconds = cpu_seconds(RUSAGE_SELF) - start;
  if (diagnostics.any_error()) {
    std::printf("%-28s has errors\n", fs::path(path).filename().c_str());
    return;
  }
  const MachineCounts counts = job.machine().counts();
  std::int64_t steps = 0;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) steps += counts.motors[m].total;
  const double machine_time = static_cast<double>(job.machine().now().count) / machine.board.clock.value();
  std::printf("%-28s %10.1f s %12lld %9.3f s %9.2f M/s %9.1f %10.1f kB/s\n", fs::path(path).filename().c_str(),
              machine_time, static_cast<long long>(steps), seconds, static_cast<double>(steps) / seconds / 1e6,
              static_cast<double>(counts.events) / static_cast<double>(job.link().frames_sent()),
              static_cast<double>(job.link().bytes_sent()) / machine_time / 1e3);
}

void measure_memory() {
  const fs::path path = fs::temp_directory_path() / ("passo-two-million-" + std::to_string(getpid()) + ".ngc");
  {
    std::ofstream file(path);
    file << "G21 G90 F3000\n";
    for (int i = 0; i < 2'000'000; ++i) {
      file << "G1 X" << (i % 2000) * 0.01 << " Y" << (i / 2000) * 0.05 << " Z" << -((i * 7) % 13) * 0.01 << "\n";
    }
    file << "M2\n";
  }
  const Cost cost = cost_of({PASSO_PROGRAM, "run", path.string(), "-m", router, "-q"});
  std::printf("\ntwo million lines            %10.1f s wall, %.1f MiB at most\n", cost.seconds, cost.mebibytes);
  fs::remove(path);
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
  const auto machine = load_machine_file(router, diagnostics);
  if (!machine) return 1;
  std::vector<std::string> programs(argv + 1, argv + argc);
  if (programs.empty()) {
    for (const char* name : {"engrave.ngc", "drill-board.ngc", "pocket.ngc"}) {
      programs.push_back((source_dir / "examples" / name).string());
    }
    const fs::path chips = source_dir / ".." / "shared" / "peers" / "linuxcnc" / "programs" / "3D_Chips.ngc";
    if (fs::exists(chips)) programs.push_back(chips.string());
  }
  std::printf("%-28s %12s %12s %11s %13s %9s %15s\n", "on the router, one core", "machine", "steps", "CPU", "steps",
              "events", "on the wire");
  std::printf("%-28s %12s %12s %11s %13s %9s %15s\n", "", "time", "", "", "a CPU second", "a frame", "");
  for (const std::string& program : programs) measure(program, *machine);
  measure_memory();
  measure_start();
  return 0;
}
