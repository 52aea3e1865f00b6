#include "simulate_options.hpp"

#include "number_range.hpp"
#include "program_options.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* simulate_examples =
    R"(Tools: flat:D, ball:D, bull:D:CORNER (radius), vee:ANGLE:D[:TIP] (between the sides), taper:TIP:ANGLE:D (of the ball, degrees a
side); D and TIP are diameters. 2=ball:3 is tool 2, ball:3 every tool that has no shape of its own.

Examples:
  passo simulate part.ngc --tool flat:6                        what it takes off, and what is wrong; the stock as it needs it
  passo simulate part.ngc --tool ball:3 --picture part.png     and how it looks
  passo simulate part.ngc --stock X0:100,Y0:80,Z-12:0 --tool 1=flat:6 --tool 2=vee:60:6 --stl part.stl
  passo simulate part.ngc --tool-table tools.toml --clamp X-20:5,Y30:50,Z12
  passo simulate finish.ngc --tool ball:3 --compare part.stl --picture left.png      material left and gouges, in colour
  passo simulate part.ngc --tool flat:6 -m router.toml         along the curves that this machine drives at corners
  passo simulate part.ngc --tool flat:6 --json | jq .removed_mm3
  passo simulate wing.ngc --wire 1.6@100,1.0@200,0.8@400 --span 900 --stock Z150:750 --picture wing.png --stl wing.stl

Exit code 1: the cut would go wrong (a rapid through the stock, the holder, a clamp, the flutes, a gouge).
See docs/manual/simulate.md.)";

}  // namespace

void add_stock(CLI::App& command, StockArguments& arguments) {
  command.add_option("--stock", arguments.block,
                     "the block, as X0:100,Y0:80,Z-10:0; axes that are not named reach as far as the feeds need");
  command.add_option("--cell", arguments.cell,
                     "of the height field, mm; without it some million cells: 0.1 on 100 x 100 mm");
  command.add_option("--tool", arguments.tools, "[NUMBER=]SHAPE:NUMBERS, see below; may be given again")->take_all();
  command.add_option("--tool-table", arguments.tool_table, "the tools' shapes, flutes and holders (TOML)");
  command.add_option("--clamp", arguments.clamps, "what stands in the way, as X0:10,Y0:20,Z15; may be given again")
      ->take_all();
}

void add_cut(CLI::App& command, CheckArguments& arguments) {
  command
      .add_option("--cutting-force", arguments.cutting_force,
                  "of the material, N/mm2: cut a piece of stock, and let the motors feel the force (aluminium: 700)")
      ->check(number_range(0.1, 20000.0));
  command
      .add_option("--spindle-speed", arguments.spindle_speed,
                  "turns a minute, of a spindle that the program does not command; without it the program's S")
      ->check(number_range(1.0, 1e6));
  add_stock(command, arguments.stock);
}

void add_simulate_options(CLI::App& command, SimulateArguments& arguments) {
  add_stock(command, arguments.stock);
  command.add_option("-m,--machine", arguments.machine,
                     "machine file (TOML): cut along its path, corners rounded within the tolerance");
  command.add_option("-p,--picture", arguments.pictures,
                     "draw the stock, and with --compare the differences (.png, .svg)");
  command.add_option("--stl", arguments.stl, "write the stock as a closed body (binary STL)");
  command
      .add_option("--stl-step", arguments.stl_step,
                  "one cell of so many in each direction goes into the STL file; without it a million cells at most")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1000}));
  command.add_option("--compare", arguments.compare,
                     "the part as it should be: a body (.stl), a height map (.csv), or a program that makes it");
  command.add_option("--tolerance", arguments.tolerance, "differences up to this count for nothing, mm")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--threads", arguments.threads, "how many cut; without it as many as there are processors")
      ->check(CLI::Range(1U, 64U));
  auto* const wire = command.add_option("--wire", arguments.wire,
                                        "a hot wire cuts, and melts so much: W, or W@V,W@V as measured at mm a minute");
  command
      .add_option("--span", arguments.span, "of the wire, from the left tower (Z 0) to the right one; where U V move")
      ->needs(wire);
  command
      .add_option("--slices", arguments.slices,
                  "of the foam, from its left face to its right one; without it as its taper needs")
      ->check(CLI::Range(std::size_t{2}, std::size_t{2000}))
      ->needs(wire);
  for (const char* const option : {"--tool", "--tool-table", "--clamp"}) wire->excludes(command.get_option(option));
  command.add_flag("--json", arguments.json, "print it as JSON");
  command.footer(simulate_examples);
  add_program(command, arguments.program);
  add_files(command, arguments.program, false);
}

}  // namespace passo
