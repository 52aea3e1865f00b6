#include "cam_options.hpp"

#include <array>

#include "command_table.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* drill_examples =
    R"(Lengths: a number in the unit of --units, or with a unit of its own: 2mm, 0.2cm, 30mil, 1/32in.

Examples:
  passo cam drill board.drl -o board.ngc                      a drill for each diameter, changed with M6
  passo cam drill board.drl --tools 0.8,1.0,1.3 -o board.ngc  the drills at hand, each hole to the nearest
  passo cam drill board.drl --mill 1 --depth -1.8 -o b.ngc    holes wider than 1 mm, and slots, are milled
  passo cam drill board.drl --zero lower-left -p board.svg -o board.ngc
  passo cam drill pads.dxf --layer Pads --drill 0.8 -o b.ngc  one drill for all, of one layer
  passo cam drill board.kicad_pcb --mill 1 -o board.ngc       the holes of a KiCad board, without an export
  passo cam drill pads.dxf --scale 0.1 --units cm --drill 0.075 --clearance 0.2 --depth -0.3 -o fori.gc
                                                              drawn in mm, made in cm: the classic chain

Every option, and what is read: docs/manual/cam.md.)";

constexpr const char* show_examples =
    R"(Examples:
  passo cam show board.zip                     what the layout program has exported, a line for each layer
  passo cam show gerbers/ -p board.png         a folder, and how the board will look from above and from below
  passo cam show board.GTL board.GKO board.TXT --json
  passo cam show board.kicad_pcb               a board of KiCad, without an export

Layers are known by their attributes or by their names: docs/manual/cam.md.)";

void add_show_options(CLI::App& show, CamShowArguments& arguments) {
  show.add_option("FILE", arguments.files, "Gerber and drill files, KiCad boards, folders and zip archives of them")
      ->required();
  show.add_option("-p,--picture", arguments.picture, "draw the board from above and from below (FILE.svg or FILE.png)");
  show.add_flag("--json", arguments.json, "the same for scripts");
  show.footer(show_examples);
}

// The options of a command whose options can be remembered for a machine. `part` is where they are filled in.
template <auto part, void (*add)(CLI::App&, CamArguments&), auto run>
std::function<int()> remembered_options_of(CLI::App& command) {
  const auto all = std::make_shared<CamArguments>();
  add(command, *all);
  return [all, &command] {
    const int code = use_remembered(command, *all);
    return code == exit_done ? run((*all).*part, nullptr, nullptr) : code;
  };
}

int make_board_job(const CamArguments& given) {
  CamArguments all = given;
  if (const int code = read_profile(all); code != exit_done) return code;
  if (!all.board.join.empty()) all.outline.join = all.board.join;
  return cam_board(all.board, all.drill, all.isolate, all.outline);
}

}  // namespace

void add_drill_options(CLI::App& drill, CamArguments& all) {
  CamDrillArguments& arguments = all.drill;
  drill
      .add_option("FILE", arguments.files,
                  "DXF drawings, drill files, KiCad boards; the kind is seen from what is in them")
      ->required();
  drill.add_option("-o,--output", arguments.output, "write the program to a file; without it to standard output");
  drill.add_option("-p,--picture", arguments.picture, "draw holes, tools and rapids (FILE.svg or FILE.png)");
  drill.add_option("--units", arguments.units, "of the program, and of lengths without a unit: mm, cm or inch")
      ->check(CLI::IsMember({"mm", "cm", "inch"}))
      ->capture_default_str();
  drill.add_option("--input", arguments.input, "unit of the files' numbers: mm, cm or inch; without it as they say")
      ->check(CLI::IsMember({"mm", "cm", "inch"}));
  drill.add_option("--scale", arguments.scale,
                   "DXF: the numbers times this are in the unit of --input, without it of --units");
  drill.add_option("--zeros", arguments.zeros, "drill files: which zeros are left out, leading or trailing")
      ->check(CLI::IsMember({"leading", "trailing"}));
  drill.add_option("--layer", arguments.layers, "DXF: read this layer; may be given again. Without it all that are on")
      ->take_all();
  drill.add_option("--zero", arguments.zero, "where X0 Y0 is: file, lower-left of all holes, or X,Y")
      ->capture_default_str();
  drill
      .add_option("--mirror", arguments.mirror, "the board is turned over: x from left to right, y from top to bottom")
      ->check(CLI::IsMember({"x", "y"}));
  drill.add_option("--mirror-at", arguments.mirror_at, "about this X or Y of the drawing; without it 0");
  drill.add_option("--align", arguments.align, "X,Y,X,Y: drill two more holes, for pins that hold the board");
  drill.add_option("--align-drill", arguments.align_drill, "diameter of these holes")->capture_default_str();
  drill.add_option("--tools", arguments.tools, "the drills at hand, as 0.8,1.0,1.3; without it one for each diameter");
  drill.add_option("--tolerance", arguments.tolerance, "how far a drill of --tools may be off")->capture_default_str();
  drill.add_option("--drill", arguments.drill, "this one drill makes every hole");
  drill.add_option("--mill", arguments.mill, "a milling cutter of this diameter makes wider holes, and slots");
  drill.add_option("--mill-step", arguments.mill_step, "how deep a turn of the cutter goes")->capture_default_str();
  drill.add_option("--clearance", arguments.clearance, "height of the rapids above the board")->capture_default_str();
  drill.add_option("--depth", arguments.depth, "of the holes, below 0")->capture_default_str();
  drill.add_option("--peck", arguments.peck, "drill in pecks of this depth, and clear the hole after each");
  drill.add_option("--feed", arguments.feed, "a minute, down into a hole")->capture_default_str();
  drill.add_option("--mill-feed", arguments.mill_feed, "a minute, of the cutter")->capture_default_str();
  drill.add_option("--spindle", arguments.spindle, "turns a minute; 0: the program leaves the spindle alone")
      ->capture_default_str();
  drill.add_option("--park", arguments.park, "X,Y at the start, at tool changes and at the end")->capture_default_str();
  drill.add_flag("--plain", arguments.plain, "plain moves (G0, G1), not canned cycles (G81, G83)");
  drill.add_option("--route-steps", arguments.route_steps, "work on the order of each tool's holes")
      ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{10'000'000'000}))
      ->capture_default_str();
  add_remember_options(drill, all);
  drill.footer(drill_examples);
}

std::span<const Command> cam_commands() {
  static constexpr std::array<Command, 10> commands{
      {{"show", "say and draw which layers a circuit board's files have",
        options_of<CamShowArguments, add_show_options, cam_show>},
       {"drill", "drill the holes of DXF drawings, Excellon drill files and KiCad boards",
        remembered_options_of<&CamArguments::drill, add_drill_options, cam_drill>},
       {"isolate", "mill the copper of a layer free of the copper around it",
        remembered_options_of<&CamArguments::isolate, add_isolate_options, cam_isolate>},
       {"outline", "cut boards out along their edge, and the openings in them",
        remembered_options_of<&CamArguments::outline, add_outline_options, cam_outline>},
       {"board", "everything for a board: drill, isolate and cut out, and what to do when",
        options_of<CamArguments, add_board_job_options, make_board_job>},
       {"profile", "cut along the lines of a drawing: around parts, or on the line",
        options_of<CamProfileArguments, add_profile_options, cam_profile>},
       {"pocket", "clear what the closed lines of a drawing enclose",
        options_of<CamPocketArguments, add_pocket_options, cam_pocket>},
       {"engrave", "carve texts and drawings with a V-shaped cutter",
        options_of<CamEngraveArguments, add_engrave_options, cam_engrave>},
       {"wire", "cut foam with a hot wire: one profile, or one for each end of the wire",
        options_of<CamWireArguments, add_wire_options, cam_wire>},
       {"relief", "carve a picture, or a body seen from above",
        options_of<CamReliefArguments, add_relief_options, cam_relief>}}};
  return commands;
}

}  // namespace passo
