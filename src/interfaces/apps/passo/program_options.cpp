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
  command
      .add_option(
          "--dialect", arguments.dialect,
          "G-code dialect: linuxcnc, grbl (version 1.1) or grblhal, which is read like linuxcnc (default: linuxcnc)")
      ->check([&block_delete](const std::string& name) -> std::string {
        if (name != "linuxcnc" && name != "grbl" && name != "grblhal") {
          return "'" + name + "' is not a dialect: expected linuxcnc, grbl or grblhal";
        }
        return name == "grbl" && block_delete.count() > 0
                   ? "--block-delete does not work with --dialect grbl: Grbl executes lines that start with /"
                   : "";
      });
  command.add_flag("--inches", arguments.inches, "unit of lengths before the first G20 or G21: inch (default: mm)");
  command.add_flag("--user-codes", arguments.user_codes, "accept M100 to M199, without running a program for them");
  command
      .add_option("--loop-limit", arguments.loop_limit,
                  "largest number of passes of a loop that causes no action of the machine")
      ->check(refuse_count)
      ->capture_default_str();
  command
      .add_option("--step-limit", arguments.step_limit,
                  "largest number of passes, calls and operations inside one loop, call or cycle")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

void add_files(CLI::App& command, ProgramArguments& arguments, bool letters) {
  const auto name = [letters](const char* letter, const char* word) {
    return letters ? std::string(letter) + "," + word : std::string(word);
  };
  command.add_option(name("-t", "--tools"), arguments.tools,
                     "tool table (.tbl) with one line per tool, e.g. T1 P1 Z0.5 D3");
  command.add_option(name("-v", "--parameters"), arguments.parameters,
                     "file of numbered parameters (.var): work offsets, home positions");
  command.add_option("-i,--settings", arguments.settings,
                     "settings file (.ini): subroutine path, #<_ini[section]name>");
  command.add_option("--subs", arguments.sub_folders, "folder with subroutine files; can be repeated");
  command
      .add_option(
          "--machine-units", arguments.machine_units,
          std::string(
              "unit of lengths in these files and in #5161 to #5410 (default: as in the settings file, or else ") +
              arguments.default_units + ")")
      ->check(CLI::IsMember({"mm", "inch"}));
}

namespace {

void add_tool_records(CLI::App& command, std::string& records) {
  command.add_option("--tool-records", records,
                     "file that counts what each tool cuts (default: $XDG_STATE_HOME/passo/tools.sqlite or "
                     "~/.local/state/passo/tools.sqlite)");
}

void add_tool_life(CLI::App& command, std::string& library, std::string& records) {
  command.add_option("--tool-table", library,
                     "tool library (TOML) with the lives of tools; warns where the program exceeds one");
  add_tool_records(command, records);
}

}  // namespace

void add_run_options(CLI::App& command, RunArguments& arguments) {
  add_program(command, arguments.program);
  add_machine(command, arguments.machine);
  add_files(command, arguments.program, false);
  arguments.program.parameters_may_lack = true;
  command.add_option("-p,--picture", arguments.pictures, "picture of the toolpath (FILE.svg or FILE.png)");
  command.add_option("--colour-by", arguments.colour_by, "colours of feed moves in pictures: by speed, depth or tool")
      ->check(CLI::IsMember({"speed", "depth", "tool"}))
      ->capture_default_str();
  command.add_option("--view", arguments.view, "view of the pictures: auto, top, front, side or lathe")
      ->check(CLI::IsMember({"auto", "top", "front", "side", "lathe"}))
      ->capture_default_str();
  command.add_flag("--no-rapids", arguments.no_rapids, "draw only feed moves in pictures");
  command.add_option("-t,--trace", arguments.traces, "file for every step of every motor (FILE.vcd or FILE.csv)");
  command.add_option("-r,--report", arguments.report,
                     "file for the summary: JSON if its name ends in .json, otherwise text");
  command.add_option("--log", arguments.log, "file for the output of (LOG,…) comments, e.g. a probed height map");
  command.add_option("--passes", arguments.passes, "number of runs of a program that ends with M99")
      ->check(refuse_count)
      ->capture_default_str();
  command.add_option(
      "--hold-at", arguments.changes.holds,
      "SECONDS: feed hold at that time, which ends the run; SECONDS:PAUSE: continue after PAUSE seconds");
  command.add_option("--override", arguments.changes.overrides, "PERCENT@SECONDS: feed override from that time on");
  command.add_option("--adaptive-feed", arguments.changes.adaptive_feed,
                     "file with the machine's own feed factor for programs with M52 P1: SECONDS,FACTOR in each line, "
                     "factors 0 to 1");
  command.add_option("--touch", arguments.touches,
                     "object that the simulated probe can touch: a block (e.g. Z:-1.5 or X10:60,Y10:50,Z:-2), an STL "
                     "file or a height map (e.g. part.stl@X100,Y80,Z-20); can be repeated");
  add_board(command, arguments.board);
  command.add_flag("--home", arguments.home,
                   "home the machine first; the program starts from the position after homing");
  command.add_flag("--from-here", arguments.from_here,
                   "board: treat the current position as machine zero (you must have moved it there; default: a known "
                   "position is required)");
  command.add_flag("--resume", arguments.resume, "board: continue this program where it was interrupted");
  command
      .add_option("--from-line", arguments.start.line,
                  "number of the line to start at: set the modes as the earlier lines do, raise the tool, start the "
                  "spindle, move over the start and lower the tool; asks before it moves")
      ->check(CLI::PositiveNumber);
  command
      .add_option(
          "--pass", arguments.start.pass,
          "pass of that line to start at, if a loop or a subroutine repeats it (default: the first); needs --from-line")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--after", arguments.start.after,
                  "distance along the toolpath after the start of that line's move, mm; needs --from-line")
      ->check(CLI::NonNegativeNumber);
  add_ahead(command, arguments.ahead);
  command.add_option("--journal", arguments.journal,
                     "board: file for the data that --resume needs (default: $XDG_STATE_HOME/passo/BOARD.journal or "
                     "~/.local/state/passo/BOARD.journal)");
  command.add_option("--cut-cable-at", arguments.cable_cut,
                     "SECONDS:MISSING: test of a serial link: disconnect it at that time, for MISSING seconds");
  command.add_flag(
      "--physics", arguments.motors.physics,
      "simulate the physics of the motors ([axis.X.torque] in the machine file), so that steps can be lost");
  command.add_option(
      "--disturb", arguments.motors.disturbances,
      "AXIS:NM@FROM:SECONDS: torque that disturbs an axis for a time, e.g. X:0.8@1.5:0.2; needs --physics");
  command.add_option("--true-path", arguments.motors.true_path,
                     "sim:first_board: file for the way that the motors really took, as a program for passo simulate");
  command.add_flag("--anyway", arguments.motors.anyway,
                   "sim:first_board: run even if the pulses are too short for its loop, and show which are lost");
  add_tool_life(command, arguments.program.tool_life.library, arguments.program.tool_life.records);
  command.add_flag("-y,--yes", arguments.yes, "skip the operator prompts at M0, M1 and M6");
  command.add_flag("--json", arguments.json, "print the summary as JSON");
  command.add_flag("-q,--quiet", arguments.quiet, "print neither progress nor summary");
  command.footer(
      "Examples:\n  passo run examples/engrave.ngc -m examples/machines/pantograph.toml --picture engrave.png\n"
      "  passo run examples/drill-board.ngc -m examples/machines/forty-eight.toml -p board.svg --colour-by tool "
      "--no-rapids\n"
      "  passo run examples/pocket.ngc -m examples/machines/router.toml --hold-at 10:1 --override 50@20\n"
      "  passo run part.ngc -m examples/machines/router.toml --adaptive-feed load.csv\n"
      "  passo run examples/probe-corner.ngc -m examples/machines/router.toml --touch X42.3:90,Y31.75:70,Z-50:-11.2\n"
      "  passo run holes.ngc -m examples/machines/first-machine.toml --board sim:first_board --true-path drilled.ngc");
}

void add_check_options(CLI::App& command, CheckArguments& arguments) {
  add_program(command, arguments.program);
  add_machine(command, arguments.machine);
  add_files(command, arguments.program, false);
  command.add_flag(
      "--motion", arguments.motion,
      "plan the motion too, check it against every limit, and compare its time with the shortest possible");
  command.add_option("--board", arguments.board,
                     "Grbl board whose motion is predicted: grbl (an Uno with the limits of the machine file), "
                     "grbl:DEVICE[@BAUD], grbl:tcp:HOST:PORT or grbl:ws://HOST (with the settings that it reports)");
  command.add_option("-p,--picture", arguments.picture,
                     "picture of the motion: toolpath and tolerance, speed along the path, acceleration and jerk "
                     "(FILE.svg or FILE.png)");
  command.add_option("--colour-by", arguments.colour_by,
                     "margin: show the toolpath instead, darker where the torque margin is small");
  command.add_option("-r,--report", arguments.report, "report with pictures, for screen and print (FILE.html)");
  command.add_option("--loads", arguments.loads,
                     "file for the motor load of each line: line,load; 1 is the guaranteed torque");
  add_cut(command, arguments);
  add_tool_records(command, arguments.program.tool_life.records);
  command.add_flag("--json", arguments.json, "print the findings as JSON");
  command.footer(
      "Examples:\n  passo check part.ngc -m router.toml             all errors and warnings\n"
      "  passo check part.ngc -m router.toml --motion    peaks, deviation, time and the shortest possible time;\n"
      "                                                  exit code 1 if a limit is exceeded\n"
      "  passo check part.ngc -m router.toml --board grbl:/dev/ttyUSB0    duration on this Grbl machine, and whether\n"
      "                                                  its connection is fast enough\n"
      "  passo check part.ngc -m router.toml --report part.html    report with pictures, for screen and "
      "print\n"
      "  passo check part.ngc -m router.toml --picture margin.svg --colour-by margin    where the torque margin is "
      "small\n"
      "  passo check part.ngc -m router.toml --tool flat:6 --cutting-force 700    with the cutting force in aluminium\n"
      "  passo check corner.ngc -m router.toml --picture corner.svg    speed, acceleration and jerk; also plans the "
      "motion");
}

void add_canon_options(CLI::App& command, CanonArguments& arguments) {
  add_program(command, arguments.program);
  arguments.program.default_units = "inch";
  arguments.program.files_of_settings = false;
  add_files(command, arguments.program, true);
  command.add_option("-o,--output", arguments.output, "output file (default: standard output)");
  command.footer(
      "Examples:\n  passo canon part.ngc                                 canonical calls, in the format of rs274 -g\n"
      "  passo canon part.ngc -t tool.tbl -v rs274ngc.var     with the machine's tools and offsets\n"
      "  passo canon part.ngc --dialect grbl -o part.canon    a program for Grbl; write to a file\n"
      "  passo canon - < part.ngc                             from standard input");
}

void add_explain_options(CLI::App& command, ExplainArguments& arguments) {
  add_program(command, arguments.program, "program and lines: FILE:LINE, FILE:FROM-TO or FILE; - is standard input");
  add_files(command, arguments.program, true);
  command.add_option("-m,--machine", arguments.machine,
                     "machine file (TOML); lengths and times then include the surfaces of cylinders (radius_mm)");
  command.add_flag("--json", arguments.json, "print the result as JSON");
  command.footer(
      "Examples:\n  passo explain part.ngc:12             what the line does, with the positions and modes there\n"
      "  passo explain part.ngc:10-20 --json   for scripts\n"
      "  passo explain part.ngc:12 -t tool.tbl -v rs274ngc.var --subs macros     with the machine's files\n"
      "  passo explain part.ngc:12 -m rotary.toml     with the feed on the surface of a cylinder\n"
      "  passo explain -:3 < part.ngc          from standard input");
}

}  // namespace passo
