#include <algorithm>

#include "cam_rows.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/operations/cam_arguments.hpp"
#include "passo/operations/cam_operation.hpp"

namespace passo {
namespace {

constexpr const char* profile_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 6mm, 0.3cm, 1/8in.

Examples:
  passo cam profile bracket.dxf --tool 3 --depth -6 --step 2 --tabs 4 -o bracket.ngc
                                                           parts out of a sheet: outside their contours, inside their holes
  passo cam profile logo.svg --side on --tool 1 --depth -0.3 -o logo.ngc
                                                           the cutter's centre follows the lines, also open ones
  passo cam profile window.svg --side inside --tool 2 --ramp 3 --lead 2 -o window.ngc
  passo cam profile sheet.svg --layer cut --zero lower-left -p sheet.png -o sheet.ngc
  passo cam profile bracket.dxf --depth -6 --tool-table tools.toml --tool T1 --material plywood -o bracket.ngc
                                                           feeds, spindle speed and depth of a pass from a tool library
  passo cam profile hook.svg --nest 600,400 --quantity 20 --tool 3 --depth -6 -p hooks.png -o hooks.ngc
                                                           20 copies of each part, close together on as few sheets as possible
  passo cam profile sheet.svg --for linuxcnc -o sheet.ngc  for another controller

All options: docs/manual/parts.md.)";

constexpr const char* pocket_examples =
    R"(Examples:
  passo cam pocket tray.svg --tool 6 --depth -8 --step 2 -o tray.ngc
  passo cam pocket sign.dxf --tool 1.5 --depth -1 --step-over 50 -p sign.png -o sign.ngc
                                                           areas too narrow for the cutter are red in the picture
  passo cam pocket tray.svg --tool 6 --depth -12 --step 12 --engagement 60 -o tray.ngc
                                                           full flute length, never a full slot: for hard materials
  passo cam pocket tray.svg --layer pocket --ramp 3 --conventional -o tray.ngc
  passo cam pocket mask.gbr --tool 0.4 --depth -0.1 --ramp 0 -o mask.ngc       the openings of a board's solder mask
  passo cam pocket tray.svg --depth -8 --tool-table tools.toml --tool T1 --material hardwood --limits router.toml -o tray.ngc

A contour inside another contour is an island, which stays. All options: docs/manual/parts.md.)";

constexpr const char* engrave_examples =
    R"(Examples:
  passo cam engrave --text "Passo" --height 20 --angle 60 -o name.ngc          wider strokes are carved deeper
  passo cam engrave --text "LICEO 1923" --font Serif.otf --around 60 -o plate.ngc     on a circle of 60 mm radius
  passo cam engrave --text "No. 7" --font simplex --depth -0.2 -o no7.ngc      single-line letters
  passo cam engrave --text "Door 7" --font "DejaVu Serif:bold" --height 15 -o door.ngc   an installed font
  passo cam engrave --text "NORTH" --around 60 --arc 150,30 -o dial.ngc        spread from 150 to 30 degrees
  passo cam engrave plot.hpgl --on-line --depth -0.2 -o plot.ngc               the lines that a pen plotter would draw
  passo cam engrave logo.svg --angle 90 --tool 6 --depth -2 --clear 2 -p logo.png -o logo.ngc
                                                           a 2 mm flat cutter clears wide areas first
  passo cam engrave logo.png --trace --width 60 --angle 60 -o logo.ngc         the dark areas of a picture, by potrace
  passo cam engrave sign.svg --angle 60 --tool 12 --step 2 -o sign.ngc         deep letters, in layers of 2 mm
  passo cam engrave star.svg --inlay pocket --clear 3 -o pocket.ngc            an inlay: the pocket, and the plug that fills it
  passo cam engrave star.svg --inlay plug --clear 3 -o plug.ngc

"\n" in the text begins a new line. All options: docs/manual/engraving.md.)";

constexpr const char* job_examples =
    R"(A job file describes all operations on a part: drawings, stock, clamps, tools with feeds, and a table
[[operation]] for each pocket, profile, hole, engraving, chamfer or relief, with the options of its command.

Examples:
  passo cam job plate.toml                       writes the program that the job file names, and a report
  passo cam job plate.toml -p plate.png          also draws a picture of all operations
  passo cam job plate.toml --check               exits with 1 if the program on disk is out of date
  passo cam job plate.toml -o out/plate.ngc --json

  [[operation]]
  kind = "pocket"
  tool = 1
  layer = "pockets"
  depth = -4

The program is written only if all operations succeed and no move enters a clamp. All keys: docs/manual/jobs.md.)";

constexpr const char* thread_examples =
    R"(The bores must be there already: the mill goes down in their middle by a rapid.

Examples:
  passo cam thread holes.svg --thread M6 --tool 4.5 --neck 3 --depth -10 -o m6.ngc
                                                          one tooth, a helix of one pitch per turn, two passes
  passo cam thread holes.dxf --layer M8 --thread M8x1 --tool 6 --neck 4.4 --teeth 12 --depth -12 -o m8.ngc
                                                          a full-form mill: one turn
  passo cam thread holes.svg --thread 1/4-20 --tool 4 --neck 2.6 --passes 3 --oversize 0.05 -o inch.ngc
  passo cam thread boss.svg --thread M20x1.5 --external --tool 10 --neck 7 --depth -15 -o boss.ngc
  passo cam thread holes.svg --diameter 30 --pitch 2 --left-hand --tool 10 --neck 7 -o left.ngc

Climb milling of a right-hand thread in a bore goes from the bottom up. All options: docs/manual/threads.md.)";

constexpr const char* drill_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 2mm, 0.2cm, 30mil, 1/32in.

Examples:
  passo cam drill board.drl -o board.ngc                      one drill for each diameter, changed with M6
  passo cam drill board.drl --tools 0.8,1.0,1.3 -o board.ngc  the available drills; each hole gets the nearest
  passo cam drill board.drl --mill 1 --depth -1.8 -o b.ngc    holes wider than 1 mm, and slots, are milled
  passo cam drill board.drl --zero lower-left -p board.svg -o board.ngc
  passo cam drill pads.dxf --layer Pads --drill 0.8 -o b.ngc  one drill for all holes of one layer
  passo cam drill board.kicad_pcb --mill 1 -o board.ngc       the holes of a KiCad board, without an export
  passo cam drill board.drl --for grbl -o board.nc            for Grbl: no canned cycles, M0 for a tool change
  passo cam drill board.drl --tool-change-text change.txt -o board.ngc       your own lines, e.g. T{tool} M6
  passo cam drill pads.dxf --scale 0.1 --units cm --drill 0.075 --clearance 0.2 --depth -0.3 -o fori.gc
                                                              drawing in mm, program in cm

All options and file formats: docs/manual/cam.md.)";

constexpr const char* isolate_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 0.2mm, 0.02cm, 8mil.

Examples:
  passo cam isolate front.gbr --tool 0.2 -o front.ngc                one pass around the copper
  passo cam isolate front.gbr --v 30,0.1 --depth -0.08 -o front.ngc  a V-shaped cutter: 30 degrees, tip 0.1 mm
  passo cam isolate front.gbr --tool 0.2 --width 0.6 -o front.ngc    as many passes as a width of 0.6 mm needs
  passo cam isolate front.gbr --tool 1,0.2 --clear --edge edge.gbr -o front.ngc
                                                          all other copper removed, the wide cutter first
  passo cam isolate front.gbr --v 60,0.1 --voronoi -o front.ngc      one path midway between neighbouring islands
  passo cam isolate back.gbr --tool 0.2 --mirror x --mirror-at 50 -p back.png -o back.ngc
                                                          the back, flipped about X50
  passo cam isolate front.gbr --v 30,0.1 -m router.toml --remember -o front.ngc
                                                          next time, -m router.toml is enough
  passo cam isolate board.kicad_pcb --layer B.Cu --edge board.kicad_pcb --tool 0.2 -o back.ngc
                                                          a layer of a KiCad board, without an export

All options, and the checks: docs/manual/circuit-boards.md.)";

constexpr const char* outline_examples =
    R"(Examples:
  passo cam outline edge.gbr --tool 2 --depth -1.8 --step 0.6 -o cut.ngc     in three passes
  passo cam outline edge.gbr --tabs 4 --tab-width 3 --tab-height 0.5 -o cut.ngc
  passo cam outline edge.dxf --join 0.5 --ramp 5 -o cut.ngc                  ends up to 0.5 mm apart are joined
  passo cam outline edge.dxf --tab 10,0 --tab 40,30 --lead 2 -o cut.ngc

All options: docs/manual/circuit-boards.md.)";

constexpr const char* board_examples =
    R"(Examples:
  passo cam board gerbers/ -o job                    programs with pictures, and job/board.html: the steps in order
  passo cam board board.kicad_pcb -o job             the same for a KiCad board, without an export
  passo cam board board.brd -o job                   and for one of EAGLE; board.json: one of EasyEDA
  passo cam board board.zip --profile mine.toml -m router.toml -o job      with your options, and estimated times
  passo cam board gerbers/ --probe-holes --heights 9x6 -o job
                                     probing finds the flipped board, and measures its height map
  passo cam board gerbers/ --copies 3x4 --gap 6 -o job         twelve boards on one blank, tool by tool
  passo cam board gerbers/ --mask 0.4 --stencil 0.3 -o job     also the solder mask's openings and a paste stencil
  passo cam board gerbers/ --for grbl --tool-table tools.toml --material fr4 -o job    for Grbl, with your own drills

A profile has a table for each command: [drill], [isolate], [outline], with the options as keys:

  [isolate]
  tool = "1,0.2"
  clear = true

All options: docs/manual/circuit-boards.md.)";

constexpr const char* relief_examples =
    R"(Cutters: ball:3, flat:6, bull:6:1 (corner radius), vee:60:6 or vee:60:6:0.2 (angle, diameter, tip),
taper:1:5:6 (ball at the tip, degrees per side, diameter). Lengths: mm, or with a unit: 0.2cm, 30mil, 1/8in.

Examples:
  passo cam relief face.png --width 80 --depth -4 -o face.ngc      rows with a 3 mm ball, scallops of 0.02 mm
  passo cam relief face.png --width 80 --depth -4 --rough flat:6 --cutter ball:3 --rest ball:1 -o face.ngc
                                                                   three cutters, changed with M6
  passo cam relief seal.png --mirror --invert --cutter vee:40:3:0.1 --scallop 0.01 -o seal.ngc
  passo cam relief part.stl --cutter ball:2 --way both --step 0.3 -p part.png -o part.ngc
  passo cam relief case.stl --up y --input-units inch --cutter flat:3 -o case.ngc
                                                                   the model's Y axis points up
  passo cam relief wall.stl --cutter bull:6:1 --way contours --rough flat:8 --rough-way offsets -o wall.ngc
                                                                   contours on steep areas; roughing by offsets on each level
  passo cam relief face.png --rough flat:6 --rough-removal 3000 --removal 150 --feed-most 2500 -o face.ngc
                                                                   feed rates from target removal rates, mm3/min
  passo cam relief photo.jpg --smooth 0.3 --gamma 1.5 --background 10 --cutter ball:2 -o photo.ngc
                                                                   a photograph; its dark background is not carved
  passo cam relief face.3mf --within oval.svg --angle 45 --lowest-z -6 -o face.ngc
                                                                   rows at 45 degrees within a curve, at most 6 mm deep
  passo cam relief duck.stl --two-sided x --rough flat:6 --cutter ball:3 -o duck
                                                                   both sides of a model, with dowel holes and instructions
  passo cam relief map.png --origin center --margin 5 --margin-level top --spindle 18000 -o map.ngc

All options, and what is guaranteed: docs/manual/relief.md.)";

constexpr const char* plot_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 6mm, 0.3cm, 1/8in.

Examples:
  passo cam plot drawing.svg --pen-up 2 --pen-down -0.5 -o drawing.ngc     Z moves the pen
  passo cam plot plot.hpgl --servo 90,30 --layer "pen 1" -o plot.ngc       M3 S90 lowers the pen, M3 S30 raises it
  passo cam plot sticker.svg --knife 0.25 --overcut 0.5 --pen-down -0.3 -p sticker.png -o sticker.ngc
                                                                           a drag knife, whose blade trails by 0.25 mm

All options: docs/manual/plotting.md.)";

constexpr const char* laser_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 6mm, 0.3cm, 1/8in.

Examples:
  passo cam laser box.svg --kerf 0.15 --power 100 --feed 400 --passes 2 -p box.png -o box.ngc
                                                           cuts half a kerf outside parts and inside holes, twice
  passo cam laser sign.svg --score-color blue --score-power 15 --score-feed 2000 --feed 300 --for grbl -o sign.nc
                                                           blue lines are scored, then all others are cut
  passo cam laser photo.jpg --width 80 --feed 3000 --power 40 --least-power 8 --gamma 0.8 -p burned.png -o photo.ngc
                                                           grey tones: the power follows the picture
  passo cam laser photo.png --width 80 --mode dither --line-distance 0.12 --feed 4000 --power 30 -o photo.ngc
                                                           dots of full power, by Floyd and Steinberg
  passo cam laser logo.png --mode threshold --scan y --acceleration 2000 --max-s 255 -o logo.ngc
  passo cam laser --grid 5x6 --grid-power 10,50 --grid-feed 1000,6000 -p grid.png -o grid.ngc
                                                           a test grid: power from left to right, feed from top to bottom
  passo cam laser plate.dxf --layer cut --focus 5 --passes 3 --step 1 --air flood -o plate.ngc

The program needs a machine in laser mode. All options: docs/manual/laser.md.)";

constexpr const char* wire_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 6mm, 0.3cm, 1/8in.

Examples:
  passo cam wire letter.svg --kerf 1.2 --feed 300 -o letter.ngc      two axes: both ends of the wire move together
  passo cam wire root.dat tip.dat --chord 220,140 --span 900 --width 600 --kerf 1.2 -o wing.ngc -p wing.png
                                                 a tapered wing: X Y at its root, U V at its tip
  passo cam wire root.dat tip.dat --chord 220,140 --right-at 60,0 --right-turn 2 --span 900 --width 600 -o wing.ngc
                                                 the tip 60 mm further back, with 2 degrees of washout
  passo cam wire box.dxf lid.dxf --kerf 1.6@100,1.0@200,0.8@400 --span 900 --width 600 -o box.ngc
                                                 kerfs measured at three speeds

All options: docs/manual/hot-wire.md.)";

constexpr std::array board_parts = {"drill", "isolate", "outline"};

constexpr std::array operations = {
    CamOperation{.name = "profile",
                 .purpose = "cut parts out along the contours of a drawing, or cut on its lines",
                 .accepts = ".svg,.dxf,.hpgl,.plt,.toml",
                 .examples = profile_examples,
                 .options = options_with_defaults<CamProfileArguments>},
    CamOperation{.name = "pocket",
                 .purpose = "clear the areas inside the closed contours of a drawing",
                 .accepts = ".svg,.dxf,.hpgl,.plt,.gbr,.gts,.gbs,.gtp,.gbp,.gtl,.gbl,.toml",
                 .examples = pocket_examples,
                 .options = options_with_defaults<CamPocketArguments>},
    CamOperation{.name = "engrave",
                 .purpose = "carve text, drawings and traced pictures with a V-shaped cutter",
                 .accepts = ".svg,.dxf,.hpgl,.plt,.ttf,.otf,.lff,.jhf,.png,.tif,.tiff,.toml",
                 .examples = engrave_examples,
                 .options = options_with_defaults<CamEngraveArguments>,
                 .instead_of_files = "text"},
    CamOperation{
        .name = "drill",
        .purpose = "drill the holes of DXF drawings, Excellon drill files and boards of KiCad, EAGLE or EasyEDA",
        .accepts = ".drl,.xln,.exc,.txt,.dxf,.kicad_pcb,.brd,.json,.toml",
        .examples = drill_examples,
        .options = options_with_defaults<CamDrillArguments>},
    CamOperation{.name = "thread",
                 .purpose = "mill threads in bores or on bosses with a thread mill",
                 .accepts = ".svg,.dxf,.hpgl,.plt,.drl,.xln,.exc,.toml",
                 .examples = thread_examples,
                 .options = options_with_defaults<CamThreadArguments>},
    CamOperation{.name = "isolate",
                 .purpose = "isolation milling: mill around the tracks and pads of a copper layer",
                 .accepts = ".gbr,.gtl,.gbl,.dxf,.top,.bot,.kicad_pcb,.brd,.json",
                 .examples = isolate_examples,
                 .options = options_with_defaults<CamIsolateArguments>},
    CamOperation{.name = "outline",
                 .purpose = "cut out circuit boards and their openings along the outline",
                 .accepts = ".gbr,.gko,.gm1,.dxf,.svg,.kicad_pcb,.brd,.json",
                 .examples = outline_examples,
                 .options = options_with_defaults<CamOutlineArguments>},
    CamOperation{
        .name = "board",
        .purpose = "generate all programs of a circuit board (drill, isolate, outline), with step-by-step instructions",
        .accepts = ".zip,.gbr,.gtl,.gbl,.gko,.gm1,.gts,.gbs,.gto,.gbo,.gtp,.gbp,.top,.bot,.drl,.xln,.exc,.txt,.kicad_"
                   "pcb,.brd,.json",
        .examples = board_examples,
        .options = options_with_defaults<CamBoardArguments>,
        .parts = board_parts},
    CamOperation{.name = "relief",
                 .purpose = "carve a relief from a picture, or from a model seen from above",
                 .accepts = ".png,.jpg,.jpeg,.tif,.tiff,.stl,.3mf,.csv,.xyz,.toml",
                 .examples = relief_examples,
                 .options = options_with_defaults<CamReliefArguments>,
                 .picture_ending = ".png"},
    CamOperation{.name = "job",
                 .purpose = "make a program for several operations with several tools from a job file",
                 .accepts = ".toml",
                 .examples = job_examples,
                 .options = options_with_defaults<CamJobArguments>},
    CamOperation{.name = "plot",
                 .purpose = "draw with a pen, or cut foil with a drag knife, along the lines of a drawing",
                 .accepts = ".svg,.dxf,.hpgl,.plt",
                 .examples = plot_examples,
                 .options = options_with_defaults<CamPlotArguments>},
    CamOperation{.name = "laser",
                 .purpose = "cut and score drawings, or engrave pictures, with a laser",
                 .accepts = ".svg,.dxf,.hpgl,.plt,.png,.jpg,.jpeg,.tif,.tiff",
                 .examples = laser_examples,
                 .options = options_with_defaults<CamLaserArguments>,
                 .instead_of_files = "grid",
                 .picture_ending = ".png"},
    CamOperation{.name = "wire",
                 .purpose = "cut foam with a hot wire along one profile, or along one for each end of the wire",
                 .accepts = ".svg,.dxf,.hpgl,.plt,.dat",
                 .examples = wire_examples,
                 .options = options_with_defaults<CamWireArguments>},
};

std::string describe(const std::string& value) {
  return value;
}
std::string describe(const std::vector<std::string>& values) {
  return fmt::format("{}", fmt::join(values, " "));
}
std::string describe(bool is_set) {
  return is_set ? "true" : "";
}
template <class Number>
std::string describe(Number number) {
  return fmt::format("{}", number);
}
template <class Number>
std::string describe(const std::optional<Number>& number) {
  return number ? describe(*number) : "";
}

}  // namespace

std::string text_of(const CamOption& option) {
  return std::visit([](const auto* value) { return describe(*value); }, option.value);
}

std::span<const CamOperation> cam_operations() {
  return operations;
}

const CamOperation* find_cam_operation(std::string_view name) {
  const auto* const found = std::ranges::find(operations, name, &CamOperation::name);
  return found == operations.end() ? nullptr : found;
}

const CamOption* find_option(std::span<const CamOption> options, std::string_view name) {
  const auto found = std::ranges::find(options, name, &CamOption::name);
  return found == options.end() ? nullptr : &*found;
}

}  // namespace passo
