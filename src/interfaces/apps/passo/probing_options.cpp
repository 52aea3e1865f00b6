#include "probing_commands.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* probe_examples =
    R"(Each of them writes a program: look at it, run it, or keep it for later. A touch that finds nothing ends the program.

Examples:
  passo probe surface --height 0.5 -o z.ngc              Z0 is half a millimetre below what is touched (a plate)
  passo run z.ngc -m router.toml --parameters work.var   runs it; work.var keeps what is found
  passo probe corner --side front-left | passo run - -m router.toml --touch X-8:40,Y-9:30,Z-50:-11.2
  passo probe bore --ball 2                              the middle of a bore
  passo probe tool --tool 3 --x 10 --y 190 --zero-z -60  a tool's length; passo run --tools FILE keeps it
  passo probe angle --side y+ --along 80                 turns G54 along an edge
  passo probe bores --x 5 --y 20 --second-x 75 --second-y 20   moves and turns G54 as two holes lie
  passo probe map --size-x 80 --size-y 50 --columns 9 --rows 6 -o map.ngc
  passo run map.ngc -m router.toml --log board.csv       the heights of a board, for passo level

See docs/manual/probing.md.)";

constexpr const char* level_examples =
    R"(A map is a file with a line x,y,z for each place of a grid, in the program's own coordinates: what
passo probe map writes, and others too.

Examples:
  passo level --map board.csv                            what the map is like
  passo level board.ngc --map board.csv -o level.ngc     the program as it is on that surface
  passo level board.ngc --map board.csv --holes          what is drilled gets the surface's height too
  passo level board.ngc --map board.csv --zero 10,5      Z0 was touched at X10 Y5

See docs/manual/probing.md.)";

std::string option_of(std::string_view name) {
  std::string option = "--" + std::string(name);
  for (char& c : option) c = c == '_' ? '-' : c;
  return option;
}

}  // namespace

void add_probe_options(CLI::App& command, ProbeArguments& arguments) {
  command.require_subcommand(1);
  command.footer(probe_examples);
  for (const ProbingKind kind : all_probing_kinds()) {
    CLI::App& one = *command.add_subcommand(std::string(name_of(kind)), std::string(purpose_of(kind)));
    one.callback([&arguments, kind] { arguments.cycle.kind = kind; });
    if (kind == ProbingKind::corner) {
      one.add_option("--side", arguments.cycle.side, "front-left, front-right, back-left or back-right")->required();
    } else if (kind == ProbingKind::edge || kind == ProbingKind::angle) {
      one.add_option("--side", arguments.cycle.side, "the way of the touch: x+, x-, y+ or y-")->required();
    }
    for (const ProbingField& field : probing_fields()) {
      if (!field.is_of(kind)) continue;
      one.add_option(option_of(field.name), field.value(arguments.cycle), std::string(field.words))
          ->check(CLI::Range(field.low, field.high))
          ->capture_default_str();
    }
    one.add_option("-o,--output", arguments.output, "the program; without it standard output");
  }
}

void add_level_options(CLI::App& command, LevelArguments& arguments) {
  command.add_option("PROGRAM", arguments.program.program, "G-code file; without it the map is shown");
  command.add_option("--map", arguments.map, "the height map: lines x,y,z")->required();
  command.add_option("--tolerance", arguments.tolerance, "of the height, everywhere on each move, mm")
      ->check(CLI::Range(1e-4, 10.0))
      ->capture_default_str();
  command.add_flag("--holes", arguments.holes, "what is drilled gets the surface's height too; without it depths stay");
  command.add_option("--clear", arguments.clear, "rapids so far above the highest place stay as they are, mm")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command.add_option("--beside", arguments.beside, "feeds may be so far beside the map, mm")
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
  command.add_option("--zero", arguments.zero, "X,Y: there the program's Z0 was set, so there the height is 0");
  command.add_option("--tools", arguments.program.tools, "tool table (.tbl), for programs with G43");
  command.add_option("--parameters", arguments.program.parameters,
                     "numbered parameters (.var) of the run, for programs that change the work system or go home");
  command.add_flag("--inches", arguments.program.inches, "lengths are inches until the program says G20 or G21");
  command.add_option("-o,--output", arguments.output, "the program; without it standard output");
  command.footer(level_examples);
}

}  // namespace passo
