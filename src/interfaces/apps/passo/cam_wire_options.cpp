// The options of `passo cam wire`.
#include "cam_options.hpp"
#include "number_range.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* wire_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 6mm, 0.3cm, 1/8in.

Examples:
  passo cam wire letter.svg --kerf 1.2 --feed 300 -o letter.ngc      two axes: both ends of the wire move alike
  passo cam wire root.dat tip.dat --chord 220,140 --span 900 --width 600 --kerf 1.2 -o wing.ngc -p wing.png
                                                 a tapered wing: X Y at its root, U V at its tip
  passo cam wire root.dat tip.dat --chord 220,140 --right-at 60,0 --right-turn -2 --span 900 --width 600 -o wing.ngc
                                                 the tip 60 mm further back, its nose turned 2 degrees down
  passo cam wire box.dxf lid.dxf --kerf 1.6@100,1.0@200,0.8@400 --span 900 --width 600 -o box.ngc
                                                 kerfs measured at three speeds

Every option: docs/manual/hot-wire.md.)";

}  // namespace

void add_wire_options(CLI::App& wire, CamWireArguments& arguments) {
  wire.add_option("PROFILE", arguments.files, "of the left side, and of the right: SVG, DXF, HPGL, airfoil (.dat)")
      ->required()
      ->expected(1, 2);
  wire.add_option("-o,--output", arguments.output, "write the program to a file; without it to standard output");
  wire.add_option("-p,--picture", arguments.picture, "draw block, profiles and wire (FILE.svg or FILE.png)");
  wire.add_flag("--json", arguments.json, "print what was done as JSON");
  wire.add_option("--axes", arguments.axes, "XY or XYUV; without it XYUV where the two sides differ")
      ->check(CLI::IsMember({"XY", "XYUV"}));
  wire.add_option("--keep", arguments.keep, "what stays: inside of the profile, outside, or line: no kerf")
      ->check(CLI::IsMember({"inside", "outside", "line"}))
      ->capture_default_str();
  wire.add_option("--kerf", arguments.kerf, "width that the wire melts at the feed; or WIDTH@SPEED,... as measured")
      ->capture_default_str();
  wire.add_option("--feed", arguments.feed, "a minute, of the slower end at its profile")->capture_default_str();
  wire.add_option("--most-feed", arguments.most_feed, "a minute, of the faster end; without it three times the feed");
  wire.add_option("--span", arguments.span, "from tower to tower, along the wire");
  wire.add_option("--width", arguments.width, "of the block, from profile to profile");
  wire.add_option("--block-at", arguments.block_at,
                  "from the left tower to the left profile; without it in the middle");
  wire.add_option("--chord", arguments.chord, "of airfoils: one length, or LEFT,RIGHT");
  wire.add_option("--right-at", arguments.right_at, "X,Y: the right profile lies so far from where it is drawn")
      ->capture_default_str();
  wire.add_option("--right-turn", arguments.right_turn, "the right profile is turned about its zero, degrees")
      ->check(number_range(-360.0, 360.0))
      ->capture_default_str();
  wire.add_option("--block", arguments.block,
                  "X,Y,X,Y of the program: corners of the block's face: the wire begins beyond it");
  wire.add_option("--lead", arguments.lead, "the cut begins and ends so far beside the profile")->capture_default_str();
  wire.add_option("--tolerance", arguments.tolerance, "of chords on curves")->capture_default_str();
  wire.add_option("--heat", arguments.heat, "S of M3, which heats the wire; without it the program leaves it alone");
  wire.add_option("--join", arguments.join, "ends of lines that are no farther apart are joined")
      ->capture_default_str();
  wire.add_option("--units", arguments.units, "of the program, and of lengths without a unit: mm, cm or inch")
      ->check(CLI::IsMember({"mm", "cm", "inch"}))
      ->capture_default_str();
  wire.add_option("--input", arguments.input, "unit of a DXF file's numbers: mm, cm or inch; without it as it says")
      ->check(CLI::IsMember({"mm", "cm", "inch"}));
  wire.add_option("--scale", arguments.scale, "drawings: the numbers times this");
  wire.add_option("--layer", arguments.layers, "read this layer; may be given again. Without it all that are on")
      ->take_all();
  wire.add_option("--zero", arguments.zero, "where X0 Y0 is: file, lower-left of the left profile, or X,Y")
      ->capture_default_str();
  wire.footer(wire_examples);
}

}  // namespace passo
