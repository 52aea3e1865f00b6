#include "simulate_options.hpp"

#include "number_range.hpp"
#include "program_options.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* simulate_examples =
    R"(Tools: flat:D, ball:D, bull:D:CORNER (radius), vee:ANGLE:D[:TIP] (included angle), taper:TIP:ANGLE:D (ball, degrees per
side); D and TIP are diameters. 2=ball:3 is tool 2; ball:3 is every tool without a shape of its own.

Examples:
  passo simulate part.ngc --tool flat:6                        removed volume and collisions; stock as large as needed
  passo simulate part.ngc --tool ball:3 --picture part.png     with a picture of the result
  passo simulate part.ngc --stock X0:100,Y0:80,Z-12:0 --tool 1=flat:6 --tool 2=vee:60:6 --stl part.stl
  passo simulate part.ngc --tool-table tools.toml --clamp X-20:5,Y30:50,Z12
  passo simulate finish.ngc --tool ball:3 --compare part.stl --picture left.png      material left and gouges, in colour
  passo simulate part.ngc --tool flat:6 -m router.toml         with the corners as this machine rounds them
  passo simulate part.ngc --tool flat:6 --json | jq .removed_mm3
  passo simulate wing.ngc --wire 1.6@100,1.0@200,0.8@400 --span 900 --stock Z150:750 --picture wing.png --stl wing.stl

Exit code 1: the cut has errors (a rapid through the stock, a collision with holder or clamp, a cut above the flutes, a gouge).
See docs/manual/simulate.md.)";

}  // namespace

void add_stock(CLI::App& command, StockArguments& arguments) {
  command.add_option("--stock", arguments.block,
                     "stock, e.g. X0:100,Y0:80,Z-10:0; axes that are not given extend as far as the feed moves");
  command.add_option(
      "--cell", arguments.cell,
      "cell size of the height field, mm (default: for about a million cells, e.g. 0.1 mm for 100 x 100 mm)");
  command.add_option("--tool", arguments.tools, "tool: [NUMBER=]SHAPE:SIZES, see below; can be repeated")->take_all();
  command.add_option("--tool-table", arguments.tool_table, "file with the shapes, flutes and holders of tools (TOML)");
  command.add_option("--clamp", arguments.clamps, "clamp or other obstacle, e.g. X0:10,Y0:20,Z15; can be repeated")
      ->take_all();
}

void add_cut(CLI::App& command, CheckArguments& arguments) {
  command
      .add_option("--cutting-force", arguments.cutting_force,
                  "specific cutting force of the material, N/mm2 (aluminium: 700); adds the simulated cutting force to "
                  "the motor loads")
      ->check(number_range(0.1, 20000.0));
  command
      .add_option("--spindle-speed", arguments.spindle_speed,
                  "spindle speed, rpm, if the program does not set it (default: the program's S)")
      ->check(number_range(1.0, 1e6));
  add_stock(command, arguments.stock);
}

void add_simulate_options(CLI::App& command, SimulateArguments& arguments) {
  add_stock(command, arguments.stock);
  command.add_option(
      "-m,--machine", arguments.machine,
      "machine file (TOML): cut along the path of this machine, with corners rounded within the tolerance");
  command.add_option("-p,--picture", arguments.pictures,
                     "picture of the stock; with --compare, of the differences (FILE.png or FILE.svg)");
  command.add_option("--stl", arguments.stl, "file for the stock as a solid model (binary STL)");
  command
      .add_option("--stl-step", arguments.stl_step,
                  "resolution of the STL file: every Nth cell in each direction (default: at most a million cells)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000}));
  command.add_option("--compare", arguments.compare,
                     "target part: a model (.stl), a height map (.csv), or a program that cuts it");
  command.add_option("--tolerance", arguments.tolerance, "differences up to this size are ignored, mm")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--threads", arguments.threads, "number of threads (default: one per processor core)")
      ->check(CLI::Range(1U, 64U));
  auto* const wire = command.add_option(
      "--wire", arguments.wire, "hot wire instead of a tool: kerf W in mm, or W@V,W@V,... as measured at V mm/min");
  command
      .add_option("--span", arguments.span,
                  "distance from the left tower (Z0) to the right one, where U and V move, mm")
      ->needs(wire);
  command
      .add_option("--slices", arguments.slices,
                  "number of slices from the left to the right face of the foam (default: as the taper needs)")
      ->check(CLI::Range(std::size_t{2}, std::size_t{2000}))
      ->needs(wire);
  for (const char* const option : {"--tool", "--tool-table", "--clamp"}) wire->excludes(command.get_option(option));
  command.add_flag("--json", arguments.json, "print the result as JSON");
  command.footer(simulate_examples);
  add_program(command, arguments.program);
  add_files(command, arguments.program, false);
}

}  // namespace passo
