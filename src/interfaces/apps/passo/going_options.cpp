#include "going_commands.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* frame_examples =
    R"(The command generates a program that moves around a job with the spindle off, to show where it lies. Z rises to the
clearance height first; it is never lowered before X and Y move. Run the program to see the outline on
the machine.

Examples:
  passo frame part.ngc -m router.toml --parameters work.var -o frame.ngc     the extents, at the highest Z of the job
  passo run frame.ngc -m router.toml -b serial:/dev/ttyACM0                   run it
  passo frame part.ngc -m router.toml -v work.var --hull --height 2 | passo run - -m router.toml -b grbl:/dev/ttyUSB0
  passo frame part.ngc -m router.toml --machine-zero                          no work zero: the job lies at machine zero

See docs/manual/running.md.)";

constexpr const char* go_examples =
    R"(Each command generates a program that moves the machine to a known position. Z always moves first, to the top of its
travel; only g28 and g30 lower it again at the end.

Examples:
  passo go park -m router.toml | passo run - -m router.toml                   the park position of the machine file
  passo go zero -m router.toml -v work.var | passo run - -m router.toml       above X0 Y0 of the work
  passo go g28 -m router.toml -v work.var -o home.ngc                         the position that G28.1 has stored

See docs/manual/running.md.)";

constexpr const char* macro_examples =
    R"(A macro is a program whose first lines are comments with its title and its values.

Examples:
  passo macro face.ngc width=120 feed=900 | passo run - -m router.toml        generate the program, and run it
  passo macro face.ngc width=120 -o face-120.ngc                              values that are not given have their defaults
  passo serve --macros FOLDER                                                 macros as buttons of the web interface

See docs/manual/page.md.)";

}  // namespace

void add_frame_options(CLI::App& command, FrameArguments& arguments) {
  command.add_option("PROGRAM", arguments.program.program, "G-code file, or - for standard input")->required();
  command.add_option("-m,--machine", arguments.machine, "machine file (.toml)")->required();
  command.add_flag("--hull", arguments.framing.hull,
                   "follow the convex hull of the feed moves (default: the rectangle of their extents)");
  for (const FramingField& field : framing_fields()) {
    command.add_option("--" + std::string(field.name), arguments.framing.*field.value, std::string(field.words))
        ->check(CLI::Range(field.low, field.high));
  }
  command.add_flag("--machine-zero", arguments.machine_zero,
                   "accept that no work zero is set, so that the job lies at machine zero");
  command.add_option("-t,--tools", arguments.program.tools, "tool table (.tbl), for programs with G43");
  command.add_option("-v,--parameters", arguments.program.parameters,
                     "file of numbered parameters (.var): work offsets, home positions");
  command.add_flag("--inches", arguments.program.inches,
                   "unit of lengths before the first G20 or G21: inch (default: mm)");
  command.add_option("-o,--output", arguments.output, "file for the program (default: standard output)");
  command.footer(frame_examples);
}

void add_go_options(CLI::App& command, GoArguments& arguments) {
  command.require_subcommand(1);
  command.footer(go_examples);
  for (const Destination destination : all_destinations()) {
    CLI::App& one = *command.add_subcommand(std::string(name_of(destination)), std::string(purpose_of(destination)));
    one.callback([&arguments, destination] { arguments.destination = destination; });
    one.add_option("-m,--machine", arguments.machine, "machine file (.toml)")->required();
    one.add_option("-v,--parameters", arguments.files.parameters,
                   "file of numbered parameters (.var): work offsets, home positions");
    one.add_option("-o,--output", arguments.output, "file for the program (default: standard output)");
  }
}

void add_macro_options(CLI::App& command, MacroArguments& arguments) {
  command.add_option("MACRO", arguments.macro, "file with the macro (.ngc)")->required();
  command.add_option("VALUES", arguments.values, "NAME=VALUE for each value of the macro (default: its default)");
  command.add_option("-o,--output", arguments.output, "file for the program (default: standard output)");
  command.footer(macro_examples);
}

}  // namespace passo
