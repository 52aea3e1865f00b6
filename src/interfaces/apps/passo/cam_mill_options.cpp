// The options of `passo cam isolate`, `passo cam outline` and `passo cam board`.
#include "cam_options.hpp"
#include "number_range.hpp"
#include "program_input.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* isolate_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 0.2mm, 0.02cm, 8mil.

Examples:
  passo cam isolate front.gbr --tool 0.2 -o front.ngc                one loop around the copper
  passo cam isolate front.gbr --v 30,0.1 --depth -0.08 -o front.ngc  a V-shaped cutter: 30 degrees, tip 0.1 mm
  passo cam isolate front.gbr --tool 0.2 --width 0.6 -o front.ngc    as many loops as 0.6 mm of free ground need
  passo cam isolate front.gbr --tool 1,0.2 --clear --edge edge.gbr -o front.ngc
                                                          all other copper off, the wide cutter first
  passo cam isolate front.gbr --v 60,0.1 --voronoi -o front.ngc      one way midway between each two islands
  passo cam isolate back.gbr --tool 0.2 --mirror x --mirror-at 50 -p back.png -o back.ngc
                                                          the back, turned over about X50
  passo cam isolate front.gbr --v 30,0.1 -m router.toml --remember -o front.ngc
                                                          next time -m router.toml alone is enough
  passo cam isolate board.kicad_pcb --layer B.Cu --edge board.kicad_pcb --tool 0.2 -o back.ngc
                                                          a layer of a KiCad board, without an export

Every option, and what is proved: docs/manual/circuit-boards.md.)";

constexpr const char* outline_examples =
    R"(Examples:
  passo cam outline edge.gbr --tool 2 --depth -1.8 --step 0.6 -o cut.ngc     in three turns
  passo cam outline edge.gbr --tabs 4 --tab-width 3 --tab-height 0.5 -o cut.ngc
  passo cam outline edge.dxf --join 0.5 --ramp 5 -o cut.ngc                  ends up to 0.5 mm apart are joined
  passo cam outline edge.dxf --tab 10,0 --tab 40,30 --lead 2 -o cut.ngc

Every option: docs/manual/circuit-boards.md.)";

constexpr const char* board_examples =
    R"(Examples:
  passo cam board gerbers/ -o job                    programs, a picture each, and job/board.html: what to do when
  passo cam board board.kicad_pcb -o job             the same of a KiCad board, without an export
  passo cam board board.zip --profile mine.toml -m router.toml -o job      with your options, and times
  passo cam board gerbers/ --probe-holes --heights 9x6 -o job
                                     the probe finds the board that was turned over, and how even it is

A profile has a table for each command: [drill], [isolate], [outline], with the options as keys:

  [isolate]
  tool = "1,0.2"
  clear = true

Every option: docs/manual/circuit-boards.md.)";

}  // namespace

void add_mill_options(CLI::App& command, CamMillArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "write the program to a file; without it to standard output");
  command.add_option("-p,--picture", arguments.picture, "draw what is milled, and the rapids (FILE.svg or FILE.png)");
  command.add_flag("--json", arguments.json, "what was done, for scripts; needs --output");
  command.add_option("--units", arguments.units, "of the program, and of lengths without a unit: mm, cm or inch")
      ->check(CLI::IsMember({"mm", "cm", "inch"}))
      ->capture_default_str();
  command.add_option("--input", arguments.input, "DXF: unit of the file's numbers; without it as the file says")
      ->check(CLI::IsMember({"mm", "cm", "inch"}));
  command.add_option("--scale", arguments.scale,
                     "DXF: the numbers times this are in the unit of --input, without it of --units");
  command
      .add_option("--layer", arguments.layers,
                  "DXF, KiCad: read this layer; may be given again. Without it all that are on")
      ->take_all();
  command.add_option("--zero", arguments.zero, "where X0 Y0 is: file, lower-left of the board, or X,Y")
      ->capture_default_str();
  command
      .add_option("--mirror", arguments.mirror, "the board is turned over: x from left to right, y from top to bottom")
      ->check(CLI::IsMember({"x", "y"}));
  command.add_option("--mirror-at", arguments.mirror_at, "about this X or Y of the drawing; without it 0");
  command.add_option("--align", arguments.align, "X,Y,X,Y: turned over so that these two holes change places");
  command.add_flag("--conventional", arguments.conventional, "conventional milling; without it climb milling");
  command.add_option("--clearance", arguments.clearance, "height of the rapids above the board")->capture_default_str();
  command.add_option("--feed", arguments.feed, "a minute, along the way")->capture_default_str();
  command.add_option("--plunge-feed", arguments.plunge_feed, "a minute, straight down")->capture_default_str();
  command.add_option("--spindle", arguments.spindle, "turns a minute; 0: the program leaves the spindle alone")
      ->capture_default_str();
  command.add_option("--park", arguments.park, "X,Y at the start, at tool changes and at the end")
      ->capture_default_str();
}

void add_isolate_options(CLI::App& isolate, CamArguments& all) {
  CamIsolateArguments& arguments = all.isolate;
  isolate
      .add_option("COPPER", arguments.files,
                  "copper layers, which are united: Gerber, a KiCad board, or DXF with filled areas")
      ->required();
  isolate.add_option("--edge", arguments.edge, "the board's edge: nothing beyond it is milled (Gerber, KiCad or DXF)");
  isolate.add_option("--join", arguments.join, "ends of the edge's lines that are no farther apart are joined")
      ->capture_default_str();
  isolate.add_option("--tool", arguments.tools, "widths of the cutters at hand, as 1,0.2: the widest goes first");
  isolate.add_option("--v", arguments.v, "a V-shaped cutter: ANGLE,TIP in degrees and width of the tip");
  isolate.add_option("--depth", arguments.depth, "into the board, below 0")->capture_default_str();
  isolate.add_option("--passes", arguments.passes, "loops around the copper")
      ->check(CLI::Range(1U, 1000U))
      ->capture_default_str();
  isolate.add_option("--width", arguments.width, "free ground around the copper; says how many loops");
  isolate.add_option("--overlap", arguments.overlap, "percent of the cutter's width that two loops have in common")
      ->check(number_range(0.0, 95.0))
      ->capture_default_str();
  isolate.add_flag("--clear", arguments.clear, "take all copper off the board that is not wanted");
  isolate.add_flag("--voronoi", arguments.voronoi, "go midway between islands: each keeps the ground around it");
  isolate.add_option("--tolerance", arguments.tolerance, "how much farther from the copper the cutter stays")
      ->capture_default_str();
  add_mill_options(isolate, arguments);
  add_remember_options(isolate, all);
  isolate.footer(isolate_examples);
}

void add_edge_options(CLI::App& command, CamOutlineArguments& arguments) {
  command.add_option("--tool", arguments.tool, "diameter of the cutter")->capture_default_str();
  command.add_option("--depth", arguments.depth, "of the cut, below 0")->capture_default_str();
  command.add_option("--step", arguments.step, "how deep a turn goes, at most")->capture_default_str();
  command.add_option("--join", arguments.join, "ends of lines that are no farther apart are joined")
      ->capture_default_str();
  command.add_option("--tabs", arguments.tabs, "so many tabs hold each board")
      ->check(CLI::Range(0U, 1000U))
      ->capture_default_str();
  command.add_option("--tab", arguments.tab_places, "a tab near X,Y; may be given again")->take_all();
  command.add_option("--tab-width", arguments.tab_width, "of the tab that stays")->capture_default_str();
  command.add_option("--tab-height", arguments.tab_height, "of the tab, above the full depth")->capture_default_str();
  command.add_option("--ramp", arguments.ramp, "go down along the way, this steep in degrees; 0: straight down")
      ->check(number_range(0.0, 60.0))
      ->capture_default_str();
  command.add_option("--lead", arguments.lead, "come to the edge on a quarter of a circle of this radius");
  command.add_flag("--dog-bones", arguments.dog_bones, "cut inner corners so that a sharp corner fits in");
}

void add_outline_options(CLI::App& outline, CamArguments& all) {
  CamOutlineArguments& arguments = all.outline;
  outline.add_option("EDGE", arguments.files, "drawings of the edge: Gerber, a KiCad board, DXF or SVG")->required();
  add_edge_options(outline, arguments);
  add_mill_options(outline, arguments);
  add_remember_options(outline, all);
  outline.footer(outline_examples);
}

void add_board_job_options(CLI::App& board, CamArguments& all) {
  CamBoardArguments& arguments = all.board;
  board.add_option("JOB", arguments.paths, "Gerber and drill files, folders of them, a zip archive, or a KiCad board")
      ->required();
  board.add_option("-o,--output", arguments.output, "folder for programs, pictures and board.html")
      ->capture_default_str();
  board.add_option("--profile", arguments.profile,
                   "options of drill, isolate and outline (TOML); without it those remembered for\nthe machine of -m");
  board.add_option("-m,--machine", arguments.machine, "machine file (TOML): how long each program takes on it");
  board.add_flag("--remember", all.remember, "remember the options of --profile for the machine of -m");
  board.add_option("--turn", arguments.turn, "the board is turned over: x from left to right, y from top to bottom")
      ->check(CLI::IsMember({"x", "y"}))
      ->capture_default_str();
  board.add_option("--margin", arguments.margin, "the board's lower left corner lies at this X and Y")
      ->capture_default_str();
  board.add_option("--pins", arguments.pin_distance, "distance of two alignment holes from the board's edge; 0: none")
      ->capture_default_str();
  board.add_flag("--probe-holes", arguments.probe_holes,
                 "no pins: after turning over a program finds the two holes with the probe");
  board.add_option("--heights", arguments.heights, "9x6: a program for each side probes its heights at a grid");
  board.add_option("--join", arguments.join,
                   "ends of the edge's lines that are no farther apart are joined; without it as\n[outline] says, "
                   "or 0.1mm");
  board
      .add_option(
          "--as", arguments.told,
          "FILE=LAYER: what a file is, where the guess is wrong: top copper, bottom copper,\noutline, drill, or "
          "nothing; may be given again")
      ->take_all();
  board.add_flag("--json", arguments.json, "what was read, and the steps, for scripts");
  board.footer(board_examples);
}

}  // namespace passo
