// The program `passo`: reads the command line and calls the command.
//
// Only this file, command_documents.cpp, command_table.cpp, command_words.cpp and the files *_options.cpp know CLI11,
// because CLI11 compiles slowly. Each command is in a file of its own.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "board_options.hpp"
#include "cam_options.hpp"
#include "command_documents.hpp"
#include "command_table.hpp"
#include "command_words.hpp"
#include "commands.hpp"
#include "going_commands.hpp"
#include "grade_options.hpp"
#include "machine_options.hpp"
#include "pendant_options.hpp"
#include "probing_commands.hpp"
#include "program_input.hpp"
#include "program_options.hpp"
#include "simulate_options.hpp"
#include "spindle_options.hpp"
#include "study_options.hpp"
#include "tools_options.hpp"
#include <CLI/CLI.hpp>

#include "passo/operations/study_arguments.hpp"

namespace {

using namespace passo;

constexpr const char* description =
    "Passo is a motion controller for stepper-driven CNC machines: it plans smooth motion from G-code and drives a "
    "board, or a simulated machine.";

constexpr const char* examples = R"(Examples:
  passo run part.ngc --machine router.toml                    run a program on the simulated machine: time, extents, steps
  passo run part.ngc -m router.toml --picture part.png        draw the toolpath too, coloured by speed
  passo run part.ngc -m router.toml --trace part.vcd          record every step of every motor, for GTKWave
  passo run part.ngc -m router.toml --json | jq .time_s       print the summary as JSON, for scripts
  passo jog -m router.toml X+10 Y-3                           move axes by hand
  passo home -m router.toml                                   home the machine
  passo serve                                                 web interface, and a Grbl port for UGS, bCNC and cncjs
  passo check part.ngc -m router.toml                         report all errors of a program, without running it
  passo check part.ngc -m router.toml --motion                also compare its planned motion with all limits
  passo tune --machine router.toml -o tuned.toml              propose limits that suit the motors
  passo simulate part.ngc --tool flat:6 --picture part.png    cut simulated stock
  passo canon part.ngc                                        print a program as canonical calls
  passo explain part.ngc:12                                   explain line 12, with the modes that are active there
  passo machine router.toml                                   describe a machine file
  passo probe corner --side front-left -o corner.ngc          generate a probing program
  passo frame part.ngc -m router.toml -v work.var             generate a program that moves around the job
  passo go park -m router.toml                                generate a program that parks the tool
  passo level board.ngc --map board.csv -o level.ngc          apply a height map to a program
  passo cam drill pads.dxf -o board.ngc                       generate a program for the holes of a circuit board
  passo tools feeds tools.toml -t 3 --material plywood        calculate feeds and speeds of a cutter
  passo board list                                            list the boards on this computer's serial ports
  passo pendant watch                                         show what is done at a pendant (handwheel on USB)
  passo spindle show -m router.toml                           show what a spindle's drive on RS-485 reports
  passo interpolate --compare --to 27,10                      compare how interpolation methods step along a line
  passo motor --help                                          calculate the torque of a stepper motor at each speed
  passo loop --compare --picture rules.svg                    compare PID rules for a motor with an encoder
  passo grade lines ./anna                                    grade a student's program
  passo help run                                              list all options of a command
  passo ramp --method exact --clock 1e6 --steps-per-rev 200 --accel 10 --steps 20    calculate step times of a ramp
  passo chords --curve arc --from 9,0 --to 0,9 --center 0,0   divide a curve into chords within a tolerance

Exit codes: 0 success; 1 failure; 2 error in the program or the command line; 3 error in the machine file; 4 --resume cannot continue.)";

// CLI11 writes a default as "NUMBER=600". Here it follows the description: "(default: 600)". A command's description
// becomes a sentence.
class HelpFormat : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* command) const override {
    std::string text = CLI::Formatter::make_description(command);
    if (text.size() < 2) return text;
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    if (text[text.size() - 2] != '.') text.insert(text.size() - 1, ".");
    return text;
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = CLI::Formatter::make_option_opts(option);
    if (const std::string value = "=" + option->get_default_str(); value.size() > 1)
      text.erase(text.find(value), value.size());
    return text;
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    const std::string value = option->get_default_str();
    return option->get_description() + (value.empty() ? "" : " (default: " + value + ")");
  }
};

// In the order of the help.
const std::vector<Command>& all_commands() {
  static const std::vector<Command> commands = {
      {"run", "run a program on the simulated machine or on a board", options_of<RunArguments, add_run_options, run>},
      {"jog", "jog: move axes by hand, and report where they stop", options_of<JogArguments, add_jog_options, jog>},
      {"home", "home the machine against its limit switches", options_of<HomeArguments, add_home_options, home>},
      {"serve", "control a machine for the web interface, G-code senders (as a Grbl controller) and programs",
       options_of<ServeArguments, add_serve_options, serve>},
      {"check", "report all errors and warnings of a program, without running it",
       options_of<CheckArguments, add_check_options, check>},
      {tune_study().name, tune_study().purpose, options_of<TuneArguments, add_tune_options, tune>},
      {"simulate", "simulate cutting: collisions, depths of cut, and the material that is left",
       options_of<SimulateArguments, add_simulate_options, simulate>},
      {"canon", "print a program as canonical calls, like rs274", options_of<CanonArguments, add_canon_options, canon>},
      {"explain", "explain lines of a program in words", options_of<ExplainArguments, add_explain_options, explain>},
      {"machine", "check and describe a machine file, or make one from the settings of another controller",
       options_of<MachineArguments, add_machine_options, machine>},
      {"board", "list, flash, query and monitor boards", add_board_help, board_commands()},
      {"pendant", "list pendants (handwheels on USB), and show what is done at one", nullptr, pendant_commands()},
      {"spindle", "set up the drive (VFD) of a spindle on RS-485: show what it reports, run it, look for it", nullptr,
       spindle_commands()},
      {"probe", "generate a probing program", options_of<ProbeArguments, add_probe_options, probe>},
      {"frame", "generate a program that moves around a job, to show where it lies",
       options_of<FrameArguments, add_frame_options, frame>},
      {"go", "generate a program that goes to the park position, a G28 or G30 position, or the work zero, Z first",
       options_of<GoArguments, add_go_options, go>},
      {"macro", "generate a program from a macro and its values", options_of<MacroArguments, add_macro_options, macro>},
      {"level", "apply a height map to a program, or show a height map",
       options_of<LevelArguments, add_level_options, level>},
      {"cam", "generate programs from drawings and pictures: parts, pockets, circuit boards, reliefs", nullptr,
       cam_commands()},
      {"tools", "list, import and export libraries of cutters, and calculate feeds and speeds", nullptr,
       tools_commands()},
      {"interpolate", "show which axes step at each pulse, with any interpolation method",
       options_of<InterpolateArguments, add_interpolate_options, interpolate>},
      {"ramp", "calculate the step times of ramps and whole moves, with any method",
       options_of<RampArguments, add_ramp_options, ramp>},
      {"motor",
       "calculate the torque of a stepper motor over speed: pull-out, pull-in, and the torque left for acceleration",
       options_of<MotorArguments, add_motor_options, motor>},
      {"loop", "simulate the step response of a motor with an encoder and a PID controller",
       options_of<LoopArguments, add_loop_options, loop>},
      {"windings", "show winding currents and rotor angles during a move",
       options_of<WindingsArguments, add_windings_options, windings>},
      {"follower", "run the follower firmware: step and direction in, winding currents out", nullptr,
       follower_commands()},
      {"grade", "grade students' programs: line interpolation, and the PIC of a board", nullptr, grade_commands()},
      {"chords", "divide a curve into chords within a tolerance",
       options_of<ChordsArguments, add_chords_options, chords>}};
  return commands;
}

void set_up(CLI::App& app) {
  app.formatter(std::make_shared<HelpFormat>());
  app.footer(examples);
  app.set_help_flag("-h,--help", "print this help");
  app.set_version_flag("--version", "passo " PASSO_VERSION, "print the version");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
}

// `passo documents FOLDER`, which is in no help: the build calls it.
int write_documents(const std::string& folder) {
  CLI::App app(description, "passo");
  set_up(app);
  add_all_commands(app, all_commands());
  return write_command_documents(app, PASSO_VERSION, folder);
}

int parse_and_run(int argc, char** argv) {
  std::vector<std::string> words = command_words(argc, argv);
  if (words.size() == 2 && words.front() == "documents") return write_documents(words.back());
  CLI::App app(description, "passo");
  set_up(app);
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
