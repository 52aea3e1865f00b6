// The program `passo`: reads the command line and calls the command.
//
// Only this file, command_table.cpp, command_words.cpp and the files *_options.cpp know CLI11, because CLI11 compiles
// slowly. Each command is in a file of its own.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <utility>
#include <vector>

#include "board_options.hpp"
#include "cam_options.hpp"
#include "command_table.hpp"
#include "command_words.hpp"
#include "commands.hpp"
#include "machine_options.hpp"
#include "probing_commands.hpp"
#include "program_input.hpp"
#include "program_options.hpp"
#include "simulate_options.hpp"
#include "study_options.hpp"
#include "tuning_options.hpp"
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
  passo jog -m router.toml X+10 Y-3                           axes moved by hand
  passo home -m router.toml                                   where the machine stands, by its limit switches
  passo serve                                                 a virtual machine for senders: UGS, bCNC, cncjs
  passo check part.ngc -m router.toml                         what is wrong with it, without running it
  passo check part.ngc -m router.toml --motion                peaks of the motion against the limits; the least time
  passo tune --machine router.toml -o tuned.toml              velocities, accelerations and jerks that its motors can do
  passo simulate part.ngc --tool flat:6 --picture part.png    what it cuts, before it is cut
  passo canon part.ngc                                        what it means, as canonical calls
  passo explain part.ngc:12                                   what line 12 does, and under which modes
  passo machine router.toml                                   what a machine file says
  passo probe corner --side front-left -o corner.ngc          a ready program for the probe
  passo level board.ngc --map board.csv -o level.ngc          a program as it is on a surface that was probed
  passo cam drill pads.dxf -o board.ngc                       the holes of a circuit board, as a program
  passo board list                                            what is on this computer's serial lines
  passo interpolate --compare --to 27,10                      how each classic method steps along a line
  passo motor --help                                          what a stepping motor can do at each speed
  passo loop --compare --picture rules.svg                    PID for a motor with an encoder
  passo help run                                              every option of a command
  passo ramp --method exact --clock 1e6 --steps-per-rev 200 --accel 10 --steps 20    when a motor steps
  passo chords --curve arc --from 9,0 --to 0,9 --center 0,0   a curve as chords within a tolerance

Exit codes: 0 done, 1 failed, 2 the program or the command line is wrong, 3 the machine file is wrong, 4 --resume cannot go on.)";

// In the order of the help.
const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands = {
      {"run", "run a program on the virtual machine", options_of<RunArguments, add_run_options, run>},
      {"jog", "move axes by hand, and say where they rest", options_of<JogArguments, add_jog_options, jog>},
      {"home", "find where a machine stands, by its limit switches", options_of<HomeArguments, add_home_options, home>},
      {"serve", "let senders of G-code drive a machine, as a Grbl controller",
       options_of<ServeArguments, add_serve_options, serve>},
      {"check", "find what is wrong with a program, without running it",
       options_of<CheckArguments, add_check_options, check>},
      {"tune", "propose velocity, acceleration and jerk for a machine's motors",
       options_of<TuneArguments, add_tune_options, tune>},
      {"simulate", "cut a piece of stock before it is cut: rapids, depths, what is left",
       options_of<SimulateArguments, add_simulate_options, simulate>},
      {"canon", "print what a program means, as canonical calls", options_of<CanonArguments, add_canon_options, canon>},
      {"explain", "say in words what lines of a program do",
       options_of<ExplainArguments, add_explain_options, explain>},
      {"machine", "check a machine file and say what it describes",
       options_of<MachineArguments, add_machine_options, machine>},
      {"board", "find, flash, ask and watch boards", add_board_help, board_commands()},
      {"probe", "write a program that finds a place with the probe",
       options_of<ProbeArguments, add_probe_options, probe>},
      {"level", "write a program as it is on a surface that is not flat, or show a height map",
       options_of<LevelArguments, add_level_options, level>},
      {"cam", "make programs of drawings and pictures: parts, pockets, circuit boards, reliefs", nullptr,
       cam_commands()},
      {"interpolate", "which axes step, pulse by pulse, by any method",
       options_of<InterpolateArguments, add_interpolate_options, interpolate>},
      {"ramp", "when a motor steps: ramps and whole moves, by any method",
       options_of<RampArguments, add_ramp_options, ramp>},
      {"motor",
       "Torque over speed of a stepping motor: pull-out, pull-in, and what is left to accelerate a load. Prints a "
       "table (CSV), or a picture or a summary instead. Rates are full steps a second.",
       options_of<MotorArguments, add_motor_options, motor>},
      {"loop", "a motor with an encoder and PID: its response to a step",
       options_of<LoopArguments, add_loop_options, loop>},
      {"windings", "which windings carry current in a move, and where the rotors are",
       options_of<WindingsArguments, add_windings_options, windings>},
      {"follower", "the follower: step and direction in, windings out", nullptr, follower_commands()},
      {"chords", "cut a curve into straight pieces within a tolerance",
       options_of<ChordsArguments, add_chords_options, chords>}};
  return commands;
}

int parse_and_run(int argc, char** argv) {
  std::vector<std::string> words = command_words(argc, argv);
  CLI::App app(description, "passo");
  app.footer(examples);
  app.set_version_flag("--version", "passo " PASSO_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  const std::function<int()> chosen = add_commands(app, all_commands(), words);

  if (const std::string refusal = refuse_words(app, words); !refusal.empty()) return fail(exit_bad_program, refusal);
  try {
    std::ranges::reverse(words);  // CLI11 wants the last word first
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_bad_program;
  }
  return chosen();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace passo;
  try {
    const int code = parse_and_run(argc, argv);
    // Every command prints, and its disk may be full. A command that failed has said why.
    const int printed = code == exit_failed ? exit_done : flush_output();
    return code == exit_done ? printed : code;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "passo: %s\n", error.what());
    return exit_failed;
  }
}
