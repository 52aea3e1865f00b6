// passo: from a drawing to motor phases, on the command line.
//
// The only place that knows CLI11 (it compiles slowly). What the commands do is in a file each.
#include <cstdio>
#include <exception>

#include "commands.hpp"
#include <CLI/CLI.hpp>

namespace {

using namespace passo;

constexpr const char* description =
    "Passo takes a stepper-driven machine from G-code to motor steps. Everything runs on a virtual machine.";

constexpr const char* examples = R"(Examples:
  passo run part.ngc --machine router.toml                    time, extents, steps; progress while it runs
  passo run part.ngc -m router.toml --picture part.png        and a picture of the path, coloured by speed
  passo run part.ngc -m router.toml --trace part.vcd          every step of every motor, for GTKWave
  passo run part.ngc -m router.toml --json | jq .time_s       for scripts
  passo check part.ngc -m router.toml                         what is wrong with it, without running it
  passo canon part.ngc                                        what it means, as canonical calls
  passo machine router.toml                                   what a machine file says
  passo ramp --limit --table-size 256 --steps-per-rev 200 --max-rate 1000      what a ramp table can do

Exit codes: 0 done, 1 failed, 2 the program or the command line is wrong, 3 the machine file is wrong.)";

void add_program(CLI::App& command, ProgramArguments& arguments) {
  command.add_option("PROGRAM", arguments.program, "G-code file; - reads standard input")->required();
  command.add_flag("--block-delete", arguments.block_delete, "skip lines that start with /");
  command.add_flag("--inches", arguments.inches, "lengths are inches until the program says G20 or G21");
}

void add_machine(CLI::App& command, std::string& machine) {
  command.add_option("-m,--machine", machine, "machine file (TOML), see docs/manual/machine-file.md")->required();
}

void add_ramp(CLI::App& command, RampArguments& arguments) {
  command.add_option("--method", arguments.method, "exact, recursive or table")
      ->check(CLI::IsMember({"exact", "recursive", "table"}));
  command.add_option("--clock", arguments.clock, "the timer's clock, Hz");
  command.add_option("--steps-per-rev", arguments.steps_per_turn, "of the motor");
  command.add_option("--accel", arguments.acceleration, "rad/s\u00B2");
  command.add_option("--max-rate", arguments.max_rate, "the wanted rate, steps/s; without it: as fast as it gets");
  command.add_option("--start-rate", arguments.start_rate, "what the motor starts and stops with at once, steps/s");
  command.add_option("--steps", arguments.steps, "the first N intervals of the ramp up");
  command.add_option("--move", arguments.move, "a whole move of N steps, from rest to rest");
  command.add_option("--stop-after", arguments.stop_after, "the --move is told to stop after N steps");
  command.add_option("--jerk", arguments.jerk, "bounds the jerk of a --move, rad/s\u00B3");
  command.add_option("--table-size", arguments.table_size, "entries of the table; without it: as many as needed");
  command.add_flag("--whole-ticks", arguments.whole_ticks, "exact, recursive: as the chip plays it");
  command.add_flag("--limit", arguments.limit,
                   "what a table can do: the acceleration --max-rate needs, the rate --accel"
                   " reaches");
  command.add_option("-p,--picture", arguments.picture, "draw all methods (FILE.svg or FILE.png)");
  command.add_option("-o,--output", arguments.output, "write the intervals to a file");
  command.add_flag("--json", arguments.json, "the answer of --limit as JSON");
  command.footer(
      R"(Prints a line a step: its number, the timer counts to the next step, and the counts from rest to there.

Examples:
  passo ramp --method exact --clock 1000000 --steps-per-rev 200 --accel 10 --steps 20
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --max-rate 1500 --move 1000
  passo ramp --method exact --clock 1e6 --steps-per-rev 200 --accel 50 --max-rate 1500 --move 1000 --jerk 500
  passo ramp --method table --clock 250000 --steps-per-rev 400 --accel 50 --move 1000 --stop-after 40
  passo ramp --clock 250000 --steps-per-rev 400 --accel 50 --steps 24 --picture ramp.svg
  passo ramp --limit --table-size 256 --steps-per-rev 100 --max-rate 280      the acceleration that it takes
  passo ramp --limit --table-size 256 --steps-per-rev 100 --accel 20          the rate that is reached)");
}

int parse_and_run(int argc, char** argv) {
  CLI::App app(description, "passo");
  app.footer(examples);
  app.set_version_flag("--version", "passo " PASSO_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);

  RunArguments run_arguments;
  CLI::App& run_command = *app.add_subcommand("run", "run a program on the virtual machine");
  add_program(run_command, run_arguments.program);
  add_machine(run_command, run_arguments.machine);
  run_command.add_option("-p,--picture", run_arguments.pictures, "draw the path (FILE.svg or FILE.png)");
  run_command.add_option("-t,--trace", run_arguments.traces, "write every step (FILE.vcd or FILE.csv)");
  run_command.add_option("-r,--report", run_arguments.report, "write the summary (FILE.json, else text)");
  run_command.add_flag("--json", run_arguments.json, "print the summary as JSON");
  run_command.add_flag("-q,--quiet", run_arguments.quiet, "no progress and no summary");
  run_command.footer(
      "Example:\n  passo run examples/engrave.ngc -m examples/machines/pantograph.toml --picture engrave.png");

  CheckArguments check_arguments;
  CLI::App& check_command = *app.add_subcommand("check", "find what is wrong with a program, without running it");
  add_program(check_command, check_arguments.program);
  add_machine(check_command, check_arguments.machine);
  check_command.add_flag("--json", check_arguments.json, "print the findings as JSON");

  CanonArguments canon_arguments;
  CLI::App& canon_command = *app.add_subcommand("canon", "print what a program means, as canonical calls");
  add_program(canon_command, canon_arguments.program);
  canon_command.add_option("-o,--output", canon_arguments.output, "write to a file");

  MachineArguments machine_arguments;
  CLI::App& machine_command = *app.add_subcommand("machine", "check a machine file and say what it describes");
  machine_command.add_option("MACHINE", machine_arguments.machine, "machine file (TOML)")->required();

  RampArguments ramp_arguments;
  CLI::App& ramp_command = *app.add_subcommand("ramp", "when a motor steps: ramps and whole moves, by any method");
  add_ramp(ramp_command, ramp_arguments);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_bad_program;
  }
  if (run_command.parsed()) return run(run_arguments);
  if (check_command.parsed()) return check(check_arguments);
  if (canon_command.parsed()) return canon(canon_arguments);
  if (ramp_command.parsed()) return ramp(ramp_arguments);
  return machine(machine_arguments);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "passo: %s\n", error.what());
    return passo::exit_failed;
  }
}
