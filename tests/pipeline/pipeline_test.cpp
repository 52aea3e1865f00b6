// The whole street, from the text of a program to the counts of the virtual motors.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>

#include "canon_end.hpp"
#include "kit/driven.hpp"
#include "kit/example_machine.hpp"
#include "kit/stage_test.hpp"
#include "kit/step_oracle.hpp"

#include "passo/interpreter/canon.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;
using test::example_machine;

const fs::path source_dir = PASSO_SOURCE_DIR;
const fs::path peers = source_dir / ".." / "shared" / "peers";

MachineDescription machine_from(const fs::path& path) {
  Diagnostics diagnostics;
  auto machine = load_machine_file(path.string(), diagnostics);
  EXPECT_TRUE(machine) << render(diagnostics, false);
  return machine.value_or(MachineDescription());
}

ProgramReader open(const fs::path& path) {
  auto reader = ProgramReader::open(path.string());
  EXPECT_TRUE(reader) << path;
  return std::move(*reader);
}

struct Ending {
  std::vector<std::int64_t> steps;  // net, by motor, in the sense of the axis
  std::string errors;
  double seconds = 0;
};

Ending run(ProgramReader program, const MachineDescription& machine) {
  Diagnostics diagnostics;
  test::DrivenProgram job(std::move(program), machine, InterpreterOptions(), diagnostics);
  while (job.advance()) {
  }
  Ending ending;
  const MachineCounts counts = job.machine().counts();
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const std::int64_t net = counts.motors[m].position;
    ending.steps.push_back(machine.axes[m].inverted ? -net : net);
  }
  if (diagnostics.any_error()) ending.errors = render(diagnostics, false);
  ending.seconds = static_cast<double>(job.machine().now().count) / machine.board.clock.value();
  return ending;
}

oracle::CanonEnd canon_end(ProgramReader program) {
  Diagnostics diagnostics;
  Interpreter interpreter(std::move(program), InterpreterOptions(), diagnostics);
  CanonPrinter printer;
  oracle::CanonEnd end;
  Operation operation;
  std::string line;
  while (interpreter.next(operation)) {
    line.clear();
    printer.print(operation, line);
    end.read(line);
  }
  return end;
}

// The steps counted are those of the place where the canonical text ends: to the step, but for the text's four
// decimals.
void expect_ends_where_canon_says(const fs::path& program, const MachineDescription& machine) {
  SCOPED_TRACE(program.string());
  const Ending ending = run(open(program), machine);
  ASSERT_EQ(ending.errors, "");
  const oracle::CanonEnd canon = canon_end(open(program));
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    const AxisDescription& axis = machine.axes[m];
    if (index_of(axis.axis) >= 6) continue;  // canonical text has no U V W
    const double end = canon.machine_end()[index_of(axis.axis)];
    const double printed_to = 0.5e-4 * canon.scale() * axis.steps_per_unit;
    EXPECT_LE(std::fabs(static_cast<double>(ending.steps[m]) - end * axis.steps_per_unit), 0.5 + printed_to + 1e-6)
        << letter_of(axis.axis);
  }
}

TEST(Pipeline, every_example_ends_where_its_canonical_text_says_on_every_example_machine) {
  for (const char* program : {"engrave.ngc", "drill-board.ngc", "pocket.ngc"}) {
    for (const char* machine : {"pantograph", "forty-eight", "router"}) {
      SCOPED_TRACE(machine);
      expect_ends_where_canon_says(source_dir / "examples" / program, example_machine(machine));
    }
  }
}

// The motion of a program as the planner hands it to the step generator.
std::vector<MotionItem> motion_of(const fs::path& program, const MachineDescription& machine) {
  Diagnostics diagnostics;
  Interpreter interpreter(open(program), InterpreterOptions(), diagnostics);
  const PathOptions options = path_options(machine, program.string());
  PathBuilder path(interpreter, options, diagnostics);
  Planner planner(path, motion_limits(machine));
  std::vector<MotionItem> items = test::drain(planner);
  EXPECT_FALSE(diagnostics.any_error()) << render(diagnostics, false);
  return items;
}

TEST(Pipeline, every_step_of_the_examples_falls_where_and_when_its_phases_put_it) {
  // With 48 steps a millimetre no coordinate of three decimals lies just between two steps: nothing depends on how
  // such a half is rounded.
  const MachineDescription machine = example_machine("forty-eight");
  for (const char* program : {"engrave.ngc", "drill-board.ngc", "pocket.ngc"}) {
    SCOPED_TRACE(program);
    oracle::expect_exact(motion_of(source_dir / "examples" / program, machine), step_options(machine));
  }
}

TEST(Pipeline, a_square_takes_the_time_that_physics_takes) {
  // 100 mm at 50 mm/s and 800 mm/s²: 50/800 s to speed up, as much to stop, and what they cost in way is made up for.
  const MachineDescription router = example_machine("router");
  const Ending ending = run(ProgramReader::from_text("t", "G21 G90 G1 X100 F3000\nM2\n"), router);
  EXPECT_EQ(ending.errors, "");
  EXPECT_NEAR(ending.seconds, 100.0 / 50 + 50.0 / 800, 1e-6);
  EXPECT_EQ(ending.steps[0], 64000);
}

TEST(Pipeline, the_same_program_gives_the_same_bytes) {
  const MachineDescription router = example_machine("router");
  const auto bytes = [&] {
    Diagnostics diagnostics;
    test::DrivenProgram job(open(source_dir / "examples" / "pocket.ngc"), router, InterpreterOptions(), diagnostics);
    while (job.advance()) {
    }
    return std::pair(job.link().bytes_sent(), job.machine().now().count);
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST(Pipeline, an_inverted_motor_turns_the_other_way_by_as_many_steps) {
  MachineDescription router = example_machine("router");
  const std::string program = "G21 G90\nG1 X10.003 Y-4.1 F1200\nM2\n";
  const Ending plain = run(ProgramReader::from_text("t", program), router);
  router.axes[0].inverted = true;
  const Ending inverted = run(ProgramReader::from_text("t", program), router);
  EXPECT_EQ(plain.steps, inverted.steps);
}

TEST(PeerPrograms, the_chips_of_3d_chips_end_where_canon_says) {
  if (!fs::exists(peers)) GTEST_SKIP() << "no ../shared/peers beside this checkout";
  expect_ends_where_canon_says(peers / "linuxcnc" / "programs" / "3D_Chips.ngc", example_machine("router"));
}

TEST(PeerPrograms, all_of_linuxcncs_motion_programs_run_to_the_end) {
  if (!fs::exists(peers)) GTEST_SKIP() << "no ../shared/peers beside this checkout";
  const MachineDescription machine = machine_from(source_dir / "tests" / "machines" / "linuxcnc-motion.toml");
  int programs = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(peers / "linuxcnc" / "motion")) {
    if (entry.path().extension() != ".ngc") continue;
    ++programs;
    if (entry.path().filename().string().starts_with("bad_")) {  // wrong on purpose: LinuxCNC refuses it too
      EXPECT_NE(run(open(entry.path()), machine).errors, "") << entry.path();
      continue;
    }
    expect_ends_where_canon_says(entry.path(), machine);
  }
  std::printf("%d programs\n", programs);
  EXPECT_GT(programs, 90);
}

}  // namespace
}  // namespace passo
