#include "grade_options.hpp"

#include <array>

#include "grade_command.hpp"
#include <CLI/CLI.hpp>

#include "passo/grading/board_case.hpp"

namespace passo {
namespace {

void add_grade_outputs(CLI::App& command, GradeOutputs& outputs) {
  command.add_option("--csv", outputs.csv, "table with a row for each student (FILE.csv)")->group("Output");
  command.add_option("--report", outputs.report, "page with all faults of each student (FILE.html)")->group("Output");
  command.add_flag("--json", outputs.json, "print all results as JSON")->group("Output");
}

void add_grade_lines_options(CLI::App& command, GradeLinesArguments& arguments) {
  command
      .add_option(
          "PROGRAM", arguments.program,
          "a program; a command line in quotes; or the folder of a class: each file or folder in it is a student")
      ->required();
  command
      .add_option("--motors", arguments.motors,
                  "number of motors that a program must ask for: 2 to 8, or any (default: as many as it asks for)")
      ->check(CLI::IsMember({"2", "3", "4", "5", "6", "7", "8", "any"}));
  command.add_flag("--signs", arguments.signs, "also moves in the negative direction");
  command.add_flag("--count-first", arguments.count_first, "programs first ask for the number of motors");
  command.add_option("--run", arguments.run, "command line that runs each program; {} stands for its file");
  command.add_option("--readable", arguments.readable, "another folder that programs may read, e.g. of an interpreter")
      ->group("Confinement");
  command.add_option("--memory", arguments.memory, "memory of a program, MB")
      ->check(CLI::Range(16U, 65'536U))
      ->capture_default_str()
      ->group("Confinement");
  command
      .add_flag("--unconfined", arguments.unconfined,
                "run programs with access to your files and the network; only for programs that you trust")
      ->group("Confinement");
  add_grade_outputs(command, arguments.outputs);
  command.footer(
      R"(A program asks for the steps of motor 1, 2, ... and prints a line with all positions after each pulse. It is compared with
master and slaves by rounding, halves away from zero. The first wrong pulse of each move is reported.
A program gets 5 s of processor time for each move, 256 MB, 1 MB of output, no network and no file outside its own folder.

Examples:
  passo grade lines ./anna                                        one program
  passo grade lines 'python3 anna.py' --motors any                a script; it must ask for any number of motors
  passo grade lines class --csv marks.csv --report marks.html     a class
  passo grade lines class --run 'python3 {}' --signs              a class that writes Python, with negative steps

The manual: docs/manual/grading.md.)");
}

void add_grade_board_options(CLI::App& command, GradeBoardArguments& arguments) {
  command
      .add_option("PROGRAM", arguments.program,
                  "an Intel HEX file (.hex); or the folder of a class: each file or folder in it is a student")
      ->required();
  command
      .add_option("--board", arguments.board,
                  "board: first_board or a variant (4 MHz); at 20 MHz pic_two_on, pic_wave or pic_half_step")
      ->check(CLI::IsMember(graded_boards()))
      ->capture_default_str();
  add_grade_outputs(command, arguments.outputs);
  command.footer(
      R"(Plays the follower's conformance vectors to a program for the PIC16F877A in gpsim: steps, directions, the relay, keys,
the emergency button. The first output that is wrong is reported, with its time.

Examples:
  passo grade board anna.hex                                      one program, on the first board
  passo grade board anna.hex --board pic_two_on                   the same on the follower's own pins, at 20 MHz
  passo grade board class --csv marks.csv --report marks.html     a class

The manual: docs/manual/grading.md. The pins: docs/follower.md.)");
}

}  // namespace

std::span<const Command> grade_commands() {
  static constexpr std::array<Command, 2> commands{
      {{"lines", "grade programs that interpolate lines",
        options_of<GradeLinesArguments, add_grade_lines_options, grade_lines_command>},
       {"board", "grade programs for a board with a PIC16F877A",
        options_of<GradeBoardArguments, add_grade_board_options, grade_board_command>}}};
  return commands;
}

}  // namespace passo
