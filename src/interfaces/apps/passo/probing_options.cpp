#include "probing_commands.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* probe_examples =
    R"(Each command generates a program to look at, run or keep. A probe move that touches nothing ends the program.

Examples:
  passo probe surface --height 0.5 -o z.ngc              Z0 is 0.5 mm below the touched surface, e.g. a touch plate
  passo run z.ngc -m router.toml --parameters work.var   run it; work.var stores the result
  passo probe corner --side front-left | passo run - -m router.toml --touch X-8:40,Y-9:30,Z-50:-11.2
  passo probe bore --ball 2                              centre of a bore
  passo probe tool --tool 3 --x 10 --y 190 --zero-z -60  tool length; passo run --tools FILE stores it
  passo probe angle --side y+ --along 80                 align G54 with an edge
  passo probe bores --x 5 --y 20 --second-x 75 --second-y 20   align G54 with two bores
  passo probe map --size-x 80 --size-y 50 --columns 9 --rows 6 -o map.ngc
  passo run map.ngc -m router.toml --log board.csv       height map of a board, for passo level

See docs/manual/probing.md.)";

constexpr const char* level_examples =
    R"(A height map is a file with a line x,y,z for each point of a grid, in work coordinates. passo probe map
writes one, and so do other programs.

Examples:
  passo level --map board.csv                            show the map
  passo level board.ngc --map board.csv -o level.ngc     apply the map to the program
  passo level board.ngc --map board.csv --holes          apply it to drilled holes too
  passo level board.ngc --map board.csv --zero 10,5      Z0 was probed at X10 Y5

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
      one.add_option("--side", arguments.cycle.side, "corner: front-left, front-right, back-left or back-right")
          ->required();
    } else if (kind == ProbingKind::edge || kind == ProbingKind::angle) {
      one.add_option("--side", arguments.cycle.side, "probe direction: x+, x-, y+ or y-")->required();
    }
    for (const ProbingField& field : probing_fields()) {
      if (!field.is_of(kind)) continue;
      one.add_option(option_of(field.name), field.value(arguments.cycle), std::string(field.words))
          ->check(CLI::Range(field.low, field.high))
          ->capture_default_str();
    }
    one.add_option("-o,--output", arguments.output, "file for the program (default: standard output)");
  }
}

void add_level_options(CLI::App& command, LevelArguments& arguments) {
  command.add_option("PROGRAM", arguments.program.program, "G-code file (default: none, only show the map)");
  command.add_option("--map", arguments.map, "height map: a file with lines x,y,z")->required();
  command.add_option("--tolerance", arguments.tolerance, "height tolerance along each move, mm")
      ->check(CLI::Range(1e-4, 10.0))
      ->capture_default_str();
  command.add_flag("--holes", arguments.holes,
                   "apply the map to the depth of drilled holes too (default: depths stay)");
  command.add_option("--clear", arguments.clear, "rapids at least this far above the highest point stay unchanged, mm")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  command.add_option("--beside", arguments.beside, "distance that feed moves may leave the area of the map, mm")
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
  command.add_option("--zero", arguments.zero,
                     "X,Y: position at which Z0 was set; the map is shifted to height 0 there");
  command.add_option("--tools", arguments.program.tools, "tool table (.tbl), for programs with G43");
  command.add_option("--parameters", arguments.program.parameters,
                     "file of numbered parameters (.var), for programs that change work offsets or move home");
  command.add_flag("--inches", arguments.program.inches,
                   "unit of lengths before the first G20 or G21: inch (default: mm)");
  command.add_option("-o,--output", arguments.output, "file for the program (default: standard output)");
  command.footer(level_examples);
}

}  // namespace passo
