#include "program_options.hpp"

#include "command_words.hpp"
#include "machine_options.hpp"
#include "simulate_options.hpp"
#include <CLI/CLI.hpp>

namespace passo {

void add_program(CLI::App& command, ProgramArguments& arguments, const char* what) {
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

void add_run_options(CLI::App& command, RunArguments& arguments) {
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
}

void add_check_options(CLI::App& command, CheckArguments& arguments) {
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
}

void add_canon_options(CLI::App& command, CanonArguments& arguments) {
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
}

void add_explain_options(CLI::App& command, ExplainArguments& arguments) {
  add_program(command, arguments.program, "FILE:LINE, FILE:FROM-TO or FILE; - is standard input");
  add_files(command, arguments.program, true);
  command.add_flag("--json", arguments.json, "print it as JSON");
  command.footer(
      "Examples:\n  passo explain part.ngc:12             what it does, with positions and modes as they are there\n"
      "  passo explain part.ngc:10-20 --json   for scripts\n"
      "  passo explain part.ngc:12 -t tool.tbl -v rs274ngc.var --subs macros     with the machine's files\n"
      "  passo explain -:3 < part.ngc          from standard input");
}

}  // namespace passo
