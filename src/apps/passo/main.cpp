// The program `passo`: reads the command line and calls the command.
//
// Only this file, command_words.cpp, board_options.cpp, cam_options.cpp, cam_mill_options.cpp, cam_relief_options.cpp,
// probing_options.cpp, simulate_options.cpp, study_options.cpp and tuning_options.cpp know CLI11, because CLI11
// compiles slowly. Each command is in a file of its own.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <utility>

#include "board_options.hpp"
#include "cam_options.hpp"
#include "command_words.hpp"
#include "commands.hpp"
#include "probing_commands.hpp"
#include "program_input.hpp"
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

void add_program(CLI::App& command, ProgramArguments& arguments,
                 const char* what = "G-code file; - reads standard input") {
  command.add_option("PROGRAM", arguments.program, what)->required();
  CLI::Option& block_delete =
      *command.add_flag("--block-delete", arguments.block_delete, "skip lines that start with /");
  command.add_option("--dialect", arguments.dialect, "whose G-code: linuxcnc (the default), or grbl, version 1.1")
      ->check([&block_delete](const std::string& name) -> std::string {
        if (name != "linuxcnc" && name != "grbl") return name + " is no dialect: expected linuxcnc or grbl";
        return name == "grbl" && block_delete.count() > 0 ? "grbl knows no --block-delete: it runs such lines" : "";
      });
  command.add_flag("--inches", arguments.inches, "lengths are inches until the program says G20 or G21");
  command.add_flag("--user-codes", arguments.user_codes, "allow M100 to M199; no program is run for them");
  command.add_option("--loop-limit", arguments.loop_limit, "passes of a loop that does nothing before it is an error")
      ->check(refuse_count)
      ->capture_default_str();
  command
      .add_option("--step-limit", arguments.step_limit,
                  "passes, calls and operations of one loop, call or cycle, with all inside, before it is an error")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

// Adds the options for the machine's files on which a program depends. With `letters`, the options have LinuxCNC's
// short names too. Not every command can have these names: `run` has a -t of its own.
void add_files(CLI::App& command, ProgramArguments& arguments, bool letters) {
  const auto name = [letters](const char* letter, const char* word) {
    return letters ? std::string(letter) + "," + word : std::string(word);
  };
  command.add_option(name("-t", "--tools"), arguments.tools, "tool table (.tbl): T1 P1 Z0.5 D3, a line a tool");
  command.add_option(name("-v", "--parameters"), arguments.parameters, "numbered parameters (.var): offsets, homes");
  command.add_option("-i,--settings", arguments.settings, "settings (.ini): subroutine path, #<_ini[section]name>");
  command.add_option("--subs", arguments.sub_folders, "a folder where subs in files are looked for");
  command
      .add_option("--machine-units", arguments.machine_units,
                  std::string("of lengths in these files and in #5161 to #5410; without it as the settings say, or ") +
                      arguments.default_units)
      ->check(CLI::IsMember({"mm", "inch"}));
}

void add_machine(CLI::App& command, std::string& machine) {
  command.add_option("-m,--machine", machine, "machine file (TOML), see docs/manual/machine-file.md")->required();
}

void add_board(CLI::App& command, std::string& board) {
  command.add_option("-b,--board", board,
                     "serial:DEVICE[@BAUD], tcp:HOST:PORT, sim:uno or sim:mega, see passo board; grbl:DEVICE: a "
                     "machine with Grbl, for "
                     "run and home; without it the virtual machine");
}

CLI::App& add_jog(CLI::App& app, const std::vector<std::string>& words, JogArguments& arguments) {
  CLI::App& command = *app.add_subcommand("jog", "move axes by hand, and say where they rest");
  if (!is_named(command, words)) return command;
  command.add_option("MOVES", arguments.moves,
                     "X+10 Y-3: by so much; X+: as far as the travel goes; none, on a terminal: by keys");
  add_machine(command, arguments.machine);
  add_board(command, arguments.board);
  command.add_option("-F,--feed", arguments.feed, "along the way, mm/min")->capture_default_str();
  command.add_option("--lease", arguments.lease, "SECONDS: not renewed for so long, the machine brakes")
      ->capture_default_str();
  command.add_option("--held", arguments.held, "SECONDS: how long the button is held; without it to the end");
  command.add_flag("--json", arguments.json, "print it as JSON");
  command.footer(
      "Examples:\n  passo jog -m router.toml X+10 -F 600          10 mm to the right\n"
      "  passo jog -m router.toml X-3 Y+4              straight to both\n"
      "  passo jog -m router.toml Z+                   up to the end of the travel\n"
      "  passo jog -m router.toml X- --held 1.5        let go after 1.5 s: it rests a lease later\n"
      "  passo jog -m uno.toml --board serial:/dev/ttyACM0      by keys, on a real machine: arrows, Page Up and Down");
  return command;
}

CLI::App& add_home(CLI::App& app, const std::vector<std::string>& words, HomeArguments& arguments) {
  CLI::App& command = *app.add_subcommand("home", "find where a machine stands, by its limit switches");
  if (!is_named(command, words)) return command;
  add_machine(command, arguments.machine);
  add_board(command, arguments.board);
  command
      .add_option("--repeat", arguments.repeat,
                  "home so many times, and tell how well the places of each axis agree (mean, spread)")
      ->check(CLI::Range(1, 1000));
  command.add_flag("--json", arguments.json, "print it as JSON");
  command.add_flag("-q,--quiet", arguments.quiet, "only errors");
  command.footer(
      "Examples:\n  passo home -m router.toml                              the virtual machine, from machine zero\n"
      "  passo home -m uno.toml --repeat 10                     how well the switches repeat\n"
      "  passo home -m uno.toml --board serial:/dev/ttyACM0     a real one\n"
      "  passo home -m router.toml --board grbl:/dev/ttyUSB0    a machine with Grbl\n"
      "Errors end in a stable code: [home.not-met], [home.still-closed], [home.unsteady], [home.stopped], "
      "[home.board],\n"
      "[home.no-switch], [home.interrupted]; see docs/manual/homing.md");
  return command;
}

CLI::App& add_serve(CLI::App& app, const std::vector<std::string>& words, ServeArguments& arguments) {
  CLI::App& command = *app.add_subcommand("serve", "let senders of G-code drive a machine, as a Grbl controller");
  if (!is_named(command, words)) return command;
  command.add_option("-m,--machine", arguments.machine, "machine file (TOML); without it an example");
  add_board(command, arguments.board);
  command.add_option("--grbl-tcp", arguments.grbl_tcp,
                     "HOST:PORT for senders; without any line 127.0.0.1:7071, and browsers at 127.0.0.1:7080. Port 0: "
                     "any that is free");
  command.add_option("--grbl-pty", arguments.grbl_pty,
                     "LINK: a pseudo-terminal for senders that know serial ports alone");
  command.add_option("--grbl-serial", arguments.grbl_serial,
                     "DEVICE[@BAUD]: a serial port for senders, at 115200 baud if nothing else is said");
  command.add_flag("--anybody-may-drive", arguments.anybody_may_drive,
                   "allow a HOST that other computers reach: the protocol has no password");
  command.add_option("--mqtt", arguments.mqtt,
                     "HOST[:PORT] of an MQTT broker that is told the status; it moves nothing");
  command.add_option("--mqtt-topic", arguments.mqtt_topic, "what all its topics begin with")->capture_default_str();
  command.add_option("--mqtt-login", arguments.mqtt_login, "FILE whose first line is USER:PASSWORD for the broker");
  command.add_flag("--check", arguments.check,
                   "only say whether the machine file and the options are good; nothing is opened, nothing moves");
  command.add_option("--http", arguments.http, "HOST:PORT for programs and browsers: HTTP and WebSocket");
  command.add_option("--http-token", arguments.http_token,
                     "FILE with a token that HTTP then asks for; needed where other computers reach HOST");
  command.add_option("--http-name", arguments.http_names, "a NAME by which browsers know this server, as a proxy's");
  command.add_option("--data", arguments.data, "DIR for the queue of jobs, their history and alarms");
  command.add_option("--touch", arguments.touches,
                     "what the probe of the virtual machine touches, as Z:-1.5 or X10:60,Y10:50,Z:-2; as of run");
  command.add_option("--page", arguments.page, "DIR with the page for browsers; without it the one beside the program");
  command.footer(
      "Examples:\n  passo serve                                    a virtual machine: try a sender on it\n"
      "  passo serve -m router.toml                     your machine file, still virtual\n"
      "  passo serve -m uno.toml -b serial:/dev/ttyACM0     a real machine\n"
      "  passo serve --grbl-pty /tmp/ttyPasso           for senders that open a serial port\n"
      "  passo serve --http 127.0.0.1:7080              for programs: curl 127.0.0.1:7080/api/v1/status\n"
      "  printf '?\\n$G\\n' | nc -q1 127.0.0.1 7071       what a sender sees\n"
      "In UGS: connection TCP, host 127.0.0.1, port 7071. In bCNC: port socket://127.0.0.1:7071. See "
      "docs/manual/serve.md");
  return command;
}

CLI::App& add_run(CLI::App& app, const std::vector<std::string>& words, RunArguments& arguments) {
  CLI::App& command = *app.add_subcommand("run", "run a program on the virtual machine");
  if (!is_named(command, words)) return command;
  add_program(command, arguments.program);
  add_machine(command, arguments.machine);
  add_files(command, arguments.program, false);
  arguments.program.parameters_may_lack = true;
  command.add_option("-p,--picture", arguments.pictures, "draw the path (FILE.svg or FILE.png)");
  command.add_option("--colour-by", arguments.colour_by, "of the feeds in pictures: speed, depth or tool")
      ->check(CLI::IsMember({"speed", "depth", "tool"}))
      ->capture_default_str();
  command.add_option("--view", arguments.view, "the flat view of pictures: auto, top, front, side or lathe")
      ->check(CLI::IsMember({"auto", "top", "front", "side", "lathe"}))
      ->capture_default_str();
  command.add_flag("--no-rapids", arguments.no_rapids, "pictures show the feeds alone");
  command.add_option("-t,--trace", arguments.traces, "write every step (FILE.vcd or FILE.csv)");
  command.add_option("-r,--report", arguments.report, "write the summary (FILE.json, else text)");
  command.add_option("--log", arguments.log, "write what the program logs by (LOG,…): a probed height map");
  command.add_option("--passes", arguments.passes, "how often a program that ends with M99 runs")
      ->check(refuse_count)
      ->capture_default_str();
  command.add_option("--hold-at", arguments.holds, "hold at SECONDS and end; SECONDS:PAUSE goes on again");
  command.add_option("--override", arguments.overrides, "PERCENT@SECONDS: feed override from then on");
  command.add_option("--touch", arguments.touches,
                     "what the probe touches, as Z:-1.5, X10:60,Y10:50,Z:-2 or part.stl@X100,Y80,Z-20 (a block, an "
                     "STL file, a height map)");
  add_board(command, arguments.board);
  command.add_flag("--home", arguments.home, "the machine is homed first, and the program begins where it then stands");
  command.add_flag("--from-here", arguments.from_here,
                   "over a line: the machine stands at machine zero, as you see to; else its place must be known");
  command.add_flag("--resume", arguments.resume,
                   "over a line: goes on where this program was broken off on that board");
  command
      .add_option("--from-line", arguments.from_line,
                  "N: begins at the first motion of line N, with all that the lines before have set: up, spindle on, "
                  "over, down; shows these steps and asks")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--pass", arguments.pass,
                  "K: with --from-line, the K-th time that the path comes to that line, in a loop or a subprogram")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--after", arguments.after,
                  "MM: with --from-line, so far along the path after that line's motion has begun")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--journal", arguments.journal,
                     "FILE: where a run over a line notes what --resume needs; without it "
                     "$XDG_STATE_HOME/passo/BOARD.journal or ~/.local/state/passo/BOARD.journal");
  command.add_option("--cut-cable-at", arguments.cable_cut,
                     "SECONDS:MISSING: over a serial line, which is cut then and back after MISSING seconds");
  command.add_flag("--physics", arguments.physics,
                   "the motors obey physics, from the machine file's [axis.X.torque], and may lose steps");
  command.add_option("--disturb", arguments.disturbances,
                     "AXIS:NM@FROM:SECONDS: with --physics, what holds an axis for a time, as X:0.8@1.5:0.2");
  command.add_flag("-y,--yes", arguments.yes, "go on at M0, M1 and M6 without asking");
  command.add_flag("--json", arguments.json, "print the summary as JSON");
  command.add_flag("-q,--quiet", arguments.quiet, "no progress and no summary");
  command.footer(
      "Examples:\n  passo run examples/engrave.ngc -m examples/machines/pantograph.toml --picture engrave.png\n"
      "  passo run examples/drill-board.ngc -m examples/machines/forty-eight.toml -p board.svg --colour-by tool "
      "--no-rapids\n"
      "  passo run examples/pocket.ngc -m examples/machines/router.toml --hold-at 10:1 --override 50@20\n"
      "  passo run examples/probe-corner.ngc -m examples/machines/router.toml --touch X42.3:90,Y31.75:70,Z-50:-11.2");
  return command;
}

CLI::App& add_check(CLI::App& app, const std::vector<std::string>& words, CheckArguments& arguments) {
  CLI::App& command = *app.add_subcommand("check", "find what is wrong with a program, without running it");
  if (!is_named(command, words)) return command;
  add_program(command, arguments.program);
  add_machine(command, arguments.machine);
  add_files(command, arguments.program, false);
  command.add_flag("--motion", arguments.motion,
                   "plan it too, and prove that the motion keeps every limit; how fast it could be at best");
  command.add_option("-p,--picture", arguments.picture,
                     "draw the motion: path and tolerance, speed over the way, acceleration and jerk (.svg or .png)");
  command.add_option("--colour-by", arguments.colour_by,
                     "margin: the picture shows the path instead, dark where the motors have little torque left");
  command.add_option("-r,--report", arguments.report,
                     "all of it as one page to read and to print, with pictures (FILE.html)");
  command.add_option("--loads", arguments.loads,
                     "write what each line needs of the motors' torque: line,load; 1 is all that is surely there");
  add_cut(command, arguments);
  command.add_flag("--json", arguments.json, "print the findings as JSON");
  command.footer(
      "Examples:\n  passo check part.ngc -m router.toml             what is wrong with it\n"
      "  passo check part.ngc -m router.toml --motion    peaks, deviation, time and the least time there can be;\n"
      "                                                  exit code 1 if a limit is broken\n"
      "  passo check part.ngc -m router.toml --report part.html    one page with pictures, for the screen and for "
      "paper\n"
      "  passo check part.ngc -m router.toml --picture margin.svg --colour-by margin    where torque is short\n"
      "  passo check part.ngc -m router.toml --tool flat:6 --cutting-force 700    with the force of the cut, in "
      "aluminium\n"
      "  passo check corner.ngc -m router.toml --picture corner.svg    its speeds, accelerations and jerks; plans, "
      "too");
  return command;
}

CLI::App& add_canon(CLI::App& app, const std::vector<std::string>& words, CanonArguments& arguments) {
  CLI::App& command = *app.add_subcommand("canon", "print what a program means, as canonical calls");
  if (!is_named(command, words)) return command;
  add_program(command, arguments.program);
  arguments.program.default_units = "inch";
  arguments.program.files_of_settings = false;
  add_files(command, arguments.program, true);
  command.add_option("-o,--output", arguments.output, "write to a file");
  command.footer(
      "Examples:\n  passo canon part.ngc                                 the calls, as rs274 -g prints them\n"
      "  passo canon part.ngc -t tool.tbl -v rs274ngc.var     with the machine's tools and offsets\n"
      "  passo canon part.ngc --dialect grbl -o part.canon    a program for grbl, into a file\n"
      "  passo canon - < part.ngc                             from standard input");
  return command;
}

CLI::App& add_explain(CLI::App& app, const std::vector<std::string>& words, ExplainArguments& arguments) {
  CLI::App& command = *app.add_subcommand("explain", "say in words what lines of a program do");
  if (!is_named(command, words)) return command;
  add_program(command, arguments.program, "FILE:LINE, FILE:FROM-TO or FILE; - is standard input");
  add_files(command, arguments.program, true);
  command.add_flag("--json", arguments.json, "print it as JSON");
  command.footer(
      "Examples:\n  passo explain part.ngc:12             what it does, with positions and modes as they are there\n"
      "  passo explain part.ngc:10-20 --json   for scripts\n"
      "  passo explain part.ngc:12 -t tool.tbl -v rs274ngc.var --subs macros     with the machine's files\n"
      "  passo explain -:3 < part.ngc          from standard input");
  return command;
}

void add_machine_command(CLI::App& app, const std::vector<std::string>& words, MachineArguments& arguments) {
  CLI::App& command = *app.add_subcommand("machine", "check a machine file and say what it describes");
  if (!is_named(command, words)) return;
  command.add_option("MACHINE", arguments.machine, "machine file (TOML)")->required();
  command.footer(
      "Examples:\n  passo machine examples/machines/router.toml     its axes, board and tool, in numbers\n"
      "  passo machine mine.toml                         what is wrong with a file of your own, and where\n"
      "Every key is explained in docs/manual/machine-file.md");
}

int parse_and_run(int argc, char** argv) {
  std::vector<std::string> words = command_words(argc, argv);
  CLI::App app(description, "passo");
  app.footer(examples);
  app.set_version_flag("--version", "passo " PASSO_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);

  RunArguments run_arguments;
  CLI::App& run_command = add_run(app, words, run_arguments);

  JogArguments jog_arguments;
  CLI::App& jog_command = add_jog(app, words, jog_arguments);

  HomeArguments home_arguments;
  CLI::App& home_command = add_home(app, words, home_arguments);

  ServeArguments serve_arguments;
  CLI::App& serve_command = add_serve(app, words, serve_arguments);

  CheckArguments check_arguments;
  CLI::App& check_command = add_check(app, words, check_arguments);

  TuneArguments tune_arguments;
  CLI::App& tune_command = add_tune_command(app, words, tune_arguments);

  SimulateArguments simulate_arguments;
  CLI::App& simulate_command = add_simulate_command(app, words, simulate_arguments);
  if (is_named(simulate_command, words)) {
    add_program(simulate_command, simulate_arguments.program);
    add_files(simulate_command, simulate_arguments.program, false);
  }

  CanonArguments canon_arguments;
  CLI::App& canon_command = add_canon(app, words, canon_arguments);

  ExplainArguments explain_arguments;
  CLI::App& explain_command = add_explain(app, words, explain_arguments);

  MachineArguments machine_arguments;
  add_machine_command(app, words, machine_arguments);

  BoardArguments board_arguments;
  CLI::App& board_command = add_board_command(app, words, board_arguments);

  ProbeArguments probe_arguments;
  CLI::App& probe_command = add_probe_command(app, words, probe_arguments);
  LevelArguments level_arguments;
  CLI::App& level_command = add_level_command(app, words, level_arguments);
  CamArguments cam_arguments;
  CLI::App& cam_command = add_cam_command(app, words, cam_arguments);

  InterpolateArguments interpolate_arguments;
  CLI::App& interpolate_command = add_interpolate_command(app, words, interpolate_arguments);
  RampArguments ramp_arguments;
  CLI::App& ramp_command = add_ramp_command(app, words, ramp_arguments);
  MotorArguments motor_arguments;
  CLI::App& motor_command = add_motor_command(app, words, motor_arguments);
  LoopArguments loop_arguments;
  CLI::App& loop_command = add_loop_command(app, words, loop_arguments);
  WindingsArguments windings_arguments;
  CLI::App& windings_command = add_windings_command(app, words, windings_arguments);
  FollowerArguments follower_arguments;
  CLI::App& follower_command = add_follower_command(app, words, follower_arguments);
  ChordsArguments chords_arguments;
  CLI::App& chords_command = add_chords_command(app, words, chords_arguments);

  if (const std::string refusal = refuse_words(app, words); !refusal.empty()) return fail(exit_bad_program, refusal);
  try {
    std::ranges::reverse(words);  // CLI11 wants the last word first
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_bad_program;
  }
  if (run_command.parsed()) return run(run_arguments);
  if (jog_command.parsed()) return jog(jog_arguments);
  if (home_command.parsed()) return home(home_arguments);
  if (serve_command.parsed()) return serve(serve_arguments);
  if (check_command.parsed()) return check(check_arguments);
  if (tune_command.parsed()) return tune(tune_arguments);
  if (simulate_command.parsed()) return simulate(simulate_arguments);
  if (canon_command.parsed()) return canon(canon_arguments);
  if (explain_command.parsed()) return explain(explain_arguments);
  if (probe_command.parsed()) return probe(probe_arguments);
  if (level_command.parsed()) return level(level_arguments);
  if (board_command.parsed()) return board_arguments.chosen();
  if (cam_command.parsed()) return cam_arguments.chosen();
  if (interpolate_command.parsed()) return interpolate(interpolate_arguments);
  if (motor_command.parsed()) return motor(motor_arguments);
  if (loop_command.parsed()) return loop(loop_arguments);
  if (ramp_command.parsed()) return ramp(ramp_arguments);
  if (windings_command.parsed()) return windings(windings_arguments);
  if (follower_command.parsed()) return follower_sim(follower_arguments);
  if (chords_command.parsed()) return chords(chords_arguments);
  return machine(machine_arguments);
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
