#include "cam_options.hpp"
#include "number_range.hpp"
#include <CLI/CLI.hpp>

namespace passo {
namespace {

constexpr const char* relief_examples =
    R"(Cutters: ball:3, flat:6, bull:6:1 (corner radius), vee:60:6 or vee:60:6:0.2 (angle, diameter, tip),
taper:1:5:6 (ball at the tip, degrees a side, diameter). Lengths: mm, or with a unit: 0.2cm, 30mil, 1/8in.

Examples:
  passo cam relief face.png --width 80 --depth 4 -o face.ngc       rows with a 3 mm ball, ridges of 0.02 mm
  passo cam relief face.png --width 80 --depth 4 --rough flat:6 --cutter ball:3 --rest ball:1 -o face.ngc
                                                                   three cutters, changed with M6
  passo cam relief seal.png --mirror --invert --cutter vee:40:3:0.1 --scallop 0.01 -o seal.ngc
  passo cam relief part.stl --cutter ball:2 --way both --step 0.3 -p part.png -o part.ngc
  passo cam relief wall.stl --cutter bull:6:1 --way contours --rough flat:8 --rough-way offsets -o wall.ngc
                                                                   constant heights where it is steep, offsets on each level
  passo cam relief face.png --rough flat:6 --rough-removal 3000 --removal 150 --feed-most 2500 -o face.ngc
                                                                   the feed holds what is cut, mm3 a minute
  passo cam relief map.png --origin center --margin 5 --margin-level top --spindle 18000 -o map.ngc

Every option, and what is promised: docs/manual/relief.md.)";

void add_shape(CLI::App& relief, CamReliefArguments& arguments) {
  relief.add_option("--width", arguments.width, "in X; the other side follows. Without it 100 mm, or as the body is");
  relief.add_option("--length", arguments.length, "in Y; the other side follows");
  relief.add_option("--depth", arguments.depth, "of black below white. Without it 3 mm, or as the body is");
  relief.add_option("--gamma", arguments.gamma, "height = brightness^gamma")
      ->check(number_range(0.05, 20.0))
      ->capture_default_str();
  relief.add_flag("--invert", arguments.invert, "black is high, white is deep");
  relief.add_flag("--mirror", arguments.mirror, "left becomes right, as for stamps and moulds");
  relief.add_option("--channel", arguments.channel, "what of a pixel is its brightness: luminance or alpha")
      ->check(CLI::IsMember({"luminance", "alpha"}))
      ->capture_default_str();
  relief.add_option("--margin", arguments.margin, "width of a flat rim around the relief")->capture_default_str();
  relief.add_option("--margin-level", arguments.margin_level, "where the rim lies: bottom or top")
      ->check(CLI::IsMember({"bottom", "top"}))
      ->capture_default_str();
  relief.add_option("--pitch", arguments.pitch, "the distance of nodes at most; without it as the cutters need");
  relief
      .add_option("--origin", arguments.origin,
                  "where X0 Y0 is: lower-left, lower-right, upper-left, upper-right, center; or X,Y of the lower left")
      ->capture_default_str();
}

void add_finishing(CLI::App& relief, CamReliefArguments& arguments) {
  relief.add_option("--cutter", arguments.cutter, "the cutter that finishes")->capture_default_str();
  relief.add_option("--way", arguments.way, "rows (along X), columns (along Y), both, spiral or contours")
      ->check(CLI::IsMember({"rows", "columns", "both", "spiral", "contours"}))
      ->capture_default_str();
  relief.add_option("--steep", arguments.steep, "contours: where it is steeper, degrees; rows on the rest")
      ->check(number_range(10.0, 80.0))
      ->capture_default_str();
  relief.add_option("--moves", arguments.moves, "arcs: lines and arcs, whichever are fewer; or lines only")
      ->check(CLI::IsMember({"arcs", "lines"}))
      ->capture_default_str();
  relief.add_option("--step", arguments.step, "between rows; without it as --scallop says");
  relief.add_option("--scallop", arguments.scallop, "height of the ridges between rows, on a flat")
      ->capture_default_str();
  relief.add_option("--tolerance", arguments.tolerance, "how far lines may be above the exact path")
      ->capture_default_str();
  relief.add_option("--clearance", arguments.clearance, "height of the rapids above the stock")->capture_default_str();
  relief.add_option("--overrun", arguments.overrun,
                    "how far cutters go beyond the edge; without it their radius, 0 with a rim at the top");
  relief.add_option("--entry", arguments.entry, "how cutters go into the stock: ramp or plunge")
      ->check(CLI::IsMember({"ramp", "plunge"}))
      ->capture_default_str();
  relief.add_option("--ramp-angle", arguments.ramp_angle, "of a ramp, degrees")
      ->check(number_range(0.5, 45.0))
      ->capture_default_str();
  relief.add_option("--feed", arguments.feed, "a minute")->capture_default_str();
  relief.add_option("--plunge", arguments.plunge, "the most that a tip goes down, a minute")->capture_default_str();
  relief
      .add_option("--removal", arguments.removal,
                  "hold what is cut, mm3 a minute: slower where it would be more, and see --feed-most")
      ->check(number_range(0.0, 1e7));
  relief.add_option("--feed-most", arguments.feed_most, "up to this feed where less than the removal is cut");
  relief.add_option("--spindle", arguments.spindle, "turns a minute; 0: the program leaves the spindle alone")
      ->capture_default_str();
}

}  // namespace

void add_relief_options(CLI::App& relief, CamReliefArguments& arguments) {
  relief
      .add_option("FILE", arguments.file, "a PNG or TIFF picture (bright is high), an STL file or a height map x,y,z")
      ->required();
  relief.add_option("-o,--output", arguments.output, "write the program to a file; without it to standard output");
  relief.add_option("-p,--picture", arguments.picture, "draw the finished surface (FILE.png)");
  add_shape(relief, arguments);
  add_finishing(relief, arguments);
  relief.add_option("--rough", arguments.rough, "this cutter roughs first, level by level");
  relief.add_option("--rough-way", arguments.rough_way, "rows, or offsets of what a level takes off")
      ->check(CLI::IsMember({"rows", "offsets"}))
      ->capture_default_str();
  relief.add_option("--rough-step", arguments.rough_step, "between its rows; without it 0.4 of its diameter");
  relief.add_option("--rough-down", arguments.rough_down, "the height of a level")->capture_default_str();
  relief.add_option("--rough-stock", arguments.rough_stock, "what it leaves, each way")->capture_default_str();
  relief.add_option("--rough-feed", arguments.rough_feed, "a minute; without it --feed");
  relief.add_option("--rough-removal", arguments.rough_removal, "hold what it cuts, mm3 a minute")
      ->check(number_range(0.0, 1e7));
  relief.add_option("--rest", arguments.rest, "this cutter finishes where the other one is too large");
  relief.add_option("--rest-step", arguments.rest_step, "between its rows; without it as --scallop says");
  relief.add_option("--rest-least", arguments.rest_least, "what the other cutter may leave")->capture_default_str();
  relief.add_option("--rest-feed", arguments.rest_feed, "a minute; without it --feed");
  relief.add_option("--rest-removal", arguments.rest_removal, "hold what it cuts, mm3 a minute")
      ->check(number_range(0.0, 1e7));
  relief.footer(relief_examples);
}

}  // namespace passo
