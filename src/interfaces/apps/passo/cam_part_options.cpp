// The options of `passo cam profile`, `passo cam pocket` and `passo cam engrave`.
#include "cam_options.hpp"
#include "number_range.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* profile_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 6mm, 0.3cm, 1/8in.

Examples:
  passo cam profile bracket.dxf --tool 3 --depth -6 --step 2 --tabs 4 -o bracket.ngc
                                                           parts out of a sheet: around outside, inside in holes
  passo cam profile logo.svg --side on --tool 1 --depth -0.3 -o logo.ngc
                                                           the cutter's middle on the lines, open ones too
  passo cam profile window.svg --side inside --tool 2 --ramp 3 --lead 2 -o window.ngc
  passo cam profile sheet.svg --layer cut --zero lower-left -p sheet.png -o sheet.ngc

Every option: docs/manual/parts.md.)";

constexpr const char* pocket_examples =
    R"(Examples:
  passo cam pocket tray.svg --tool 6 --depth -8 --step 2 -o tray.ngc
  passo cam pocket sign.dxf --tool 1.5 --depth -1 --step-over 50 -p sign.png -o sign.ngc
                                                           what the cutter cannot reach is red in the picture
  passo cam pocket tray.svg --tool 6 --depth -12 --step 12 --engagement 60 -o tray.ngc
                                                           all of the flutes, and never a slot: hard material
  passo cam pocket tray.svg --layer pocket --ramp 3 --conventional -o tray.ngc

A loop in a loop is an island, which stays. Every option: docs/manual/parts.md.)";

constexpr const char* engrave_examples =
    R"(Examples:
  passo cam engrave --text "Passo" --height 20 --angle 60 -o name.ngc          depth follows the width of the strokes
  passo cam engrave --text "LICEO 1923" --font Serif.otf --around 60 -o plate.ngc     on a circle of 60 mm radius
  passo cam engrave --text "No. 7" --font simplex --depth -0.2 -o no7.ngc      letters of single lines, on the line
  passo cam engrave --text "NORTH" --around 60 --arc 150,30 -o dial.ngc        spread from 150 to 30 degrees
  passo cam engrave plot.hpgl --on-line --depth -0.2 -o plot.ngc               what a pen plotter would draw
  passo cam engrave logo.svg --angle 90 --tool 6 --depth -2 --clear 2 -p logo.png -o logo.ngc
                                                           wide areas get a flat floor by a cutter of 2 mm first
  passo cam engrave sign.svg --angle 60 --tool 12 --step 2 -o sign.ngc         deep letters in layers of 2 mm
  passo cam engrave star.svg --inlay pocket --clear 3 -o pocket.ngc            an inlay: the hole, and what fills it
  passo cam engrave star.svg --inlay plug --clear 3 -o plug.ngc

"\n" in the text begins a new line. Every option: docs/manual/engraving.md.)";

void add_sheet_option(CLI::App& command, CamMillArguments& arguments) {
  command.add_option("--sheet", arguments.sheet,
                     "W,H of the material, from X0 Y0 on: a drawing beyond it is refused, the picture shows it");
}

}  // namespace

void add_profile_options(CLI::App& profile, CamProfileArguments& arguments) {
  profile.add_option("FILE", arguments.files, "drawings: SVG, DXF or HPGL")->required();
  profile
      .add_option("--side", arguments.side,
                  "part: outside of what is drawn, inside in its holes; outside, inside: of each loop; on: the line")
      ->check(CLI::IsMember({"part", "outside", "inside", "on"}))
      ->capture_default_str();
  add_edge_options(profile, arguments);
  add_mill_options(profile, arguments);
  add_sheet_option(profile, arguments);
  profile.footer(profile_examples);
}

void add_pocket_options(CLI::App& pocket, CamPocketArguments& arguments) {
  pocket.add_option("FILE", arguments.files, "drawings: SVG, DXF or HPGL")->required();
  pocket.add_option("--tool", arguments.tool, "diameter of the cutter")->capture_default_str();
  pocket.add_option("--depth", arguments.depth, "of the pocket, below 0")->capture_default_str();
  pocket.add_option("--step", arguments.step, "how deep a layer is, at most")->capture_default_str();
  pocket.add_option("--step-over", arguments.step_over, "from loop to loop, percent of the cutter's diameter")
      ->check(number_range(1.0, 95.0))
      ->capture_default_str();
  pocket
      .add_option("--engagement", arguments.engagement,
                  "never more than this angle of the cutter in the stock, degrees (constant engagement); 0: loops")
      ->check(number_range(0.0, 150.0))
      ->capture_default_str();
  pocket.add_option("--join", arguments.join, "ends of lines that are no farther apart are joined")
      ->capture_default_str();
  pocket.add_option("--ramp", arguments.ramp, "go down along the way, this steep in degrees; 0: straight down")
      ->check(number_range(0.0, 60.0))
      ->capture_default_str();
  add_mill_options(pocket, arguments);
  add_sheet_option(pocket, arguments);
  pocket.footer(pocket_examples);
}

void add_engrave_options(CLI::App& engrave, CamEngraveArguments& arguments) {
  engrave.add_option("FILE", arguments.files, "drawings: SVG, DXF or HPGL; what closed lines enclose is carved");
  engrave.add_option("--text", arguments.text, "letters instead of a drawing");
  engrave
      .add_option(
          "--font", arguments.font,
          "font of outlines (.ttf, .otf) or of single lines (.lff, .jhf), or simplex: such a one that is built in")
      ->capture_default_str();
  engrave.add_option("--height", arguments.height, "of a capital letter")->capture_default_str();
  engrave.add_option("--text-align", arguments.text_align, "where X0 is in a line of text: left, middle or right")
      ->check(CLI::IsMember({"left", "middle", "right"}))
      ->capture_default_str();
  engrave.add_option("--around", arguments.around,
                     "the text stands on a circle of this radius about X0 Y0; below 0 inside, at the bottom");
  engrave.add_option("--arc", arguments.arc,
                     "FROM,TO: spread the text on this part of the circle, in degrees from X on, counterclockwise");
  engrave.add_option("--turn", arguments.turn, "the whole text about X0 Y0, degrees counterclockwise")
      ->check(number_range(-3600.0, 3600.0))
      ->capture_default_str();
  engrave.add_flag("--on-line", arguments.on_line, "follow the lines of the drawing, open ones too, --depth deep");
  engrave.add_option("--line-space", arguments.line_space, "from line to line, in heights")
      ->check(number_range(0.1, 100.0))
      ->capture_default_str();
  engrave.add_option("--angle", arguments.angle, "between the flanks of the cutter, degrees")
      ->check(number_range(5.0, 170.0))
      ->capture_default_str();
  engrave.add_option("--tip", arguments.tip, "width of its tip")->capture_default_str();
  engrave.add_option("--tool", arguments.tool, "its diameter, the widest that it carves")->capture_default_str();
  engrave.add_option("--depth", arguments.depth,
                     "the deepest, below 0; without it as the cutter's width allows, on lines -0.3mm");
  engrave.add_option("--step", arguments.step, "how much deeper it goes at a time; without it to the depth at once");
  engrave.add_option("--clear", arguments.clear, "diameter of a flat cutter that clears what is wider, before");
  engrave.add_option("--clear-step", arguments.clear_step, "how deep a layer of it is, at most")->capture_default_str();
  engrave
      .add_option("--inlay", arguments.inlay,
                  "pocket: carve the hole of an inlay; plug: its mirrored counterpart, which stays")
      ->check(CLI::IsMember({"pocket", "plug"}));
  engrave.add_option("--inlay-depth", arguments.inlay_depth, "of the pocket")->capture_default_str();
  engrave.add_option("--glue-gap", arguments.glue_gap, "room below the plug, for glue")->capture_default_str();
  engrave.add_option("--saw-gap", arguments.saw_gap, "between the faces of both, for the saw")->capture_default_str();
  engrave.add_option("--margin", arguments.margin, "cleared around the plug")->capture_default_str();
  engrave.add_option("--join", arguments.join, "ends of lines that are no farther apart are joined")
      ->capture_default_str();
  add_mill_options(engrave, arguments);
  add_sheet_option(engrave, arguments);
  engrave.footer(engrave_examples);
}

}  // namespace passo
