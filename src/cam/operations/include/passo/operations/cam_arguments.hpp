// The arguments of the operations of `passo cam`, one struct each. A member's initial value is the default of its
// option, and is defined only here. cam_options_of() describes the members.
//
// Lengths are texts with a unit, or without one in `units`; lists are separated by commas.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/operations/cam_option.hpp"

namespace passo {

// How a program is written.
struct CamProgramArguments {
  std::string controller = "passo";  // a name of controllers() in post_processor/
  std::string start_text;            // files with lines of the operator; empty: none
  std::string tool_change_text;      // replaces the words of a tool change
  std::string end_text;
  std::string change_height = "20mm";  // Z at the start, at tool changes and at the end
  double spindle_delay = 2;            // seconds
  std::string coolant = "off";         // mist or flood
};

// The feed of a drill of the library.
struct CamDrillFeed {
  double diameter_mm = 0;
  double feed_mm = 0;         // per minute; 0: that of the other drills
  std::uint32_t spindle = 0;  // rpm; 0: that of the other drills
  std::string words = {};     // for the head of the program
};

// The tools of a library. Options for a cutter then take its number: T3.
struct CamToolArguments {
  std::string tool_table;  // tool library (TOML); empty: none
  std::string material;    // of the stock; empty: feeds are those of the options
  std::string limits;      // machine file; its speeds limit those of the tables; empty: none
  // Not options: remarks from the library, for the head of the program and for the summary.
  std::vector<std::string> tool_remarks = {};
  std::string tool_warnings_json = {};
  std::vector<CamDrillFeed> drill_feeds = {};  // of the drills in CamDrillArguments::tools that the library knows
};

// The shapes of SVG drawings to read, in addition to layers.
struct CamShapeSelection {
  std::vector<std::string> colors;  // colours of the shapes; empty: all
  std::vector<std::string> names;   // ids or labels of the shapes or groups; empty: all
};

// The summary of an operation.
struct CamSummaryArguments {
  bool json = false;  // as JSON on standard output
};

struct CamDrillArguments : CamProgramArguments, CamToolArguments, CamShapeSelection, CamSummaryArguments {
  std::vector<std::string> files;   // DXF or Excellon
  std::string output;               // empty: standard output
  std::string picture;              // .svg or .png; empty: none
  std::string units = "mm";         // unit of the program, and of lengths without a unit: mm, cm or inch
  std::optional<double> scale;      // scale factor for the numbers in DXF files
  std::string input;                // unit of the numbers in the files; empty: as the files state; with --scale as
                                    // `units`
  std::string zeros;                // suppressed zeros in drill files: leading or trailing; empty: as the files state
  std::vector<std::string> layers;  // layers of DXF files; empty: all layers that are on
  std::string zero = "file";        // position of X0 Y0: file, lower-left or X,Y
  std::string mirror;               // x or y; empty: the board is not flipped
  std::string mirror_at;            // position of the mirror line; empty: X0 or Y0
  std::string align;                // X,Y,X,Y: two alignment holes; empty: none
  std::string align_drill = "3mm";  // diameter of the alignment holes
  std::string tools;                // the rack: comma-separated diameters or tool numbers, or "all" drills of the
                                    // library; empty: one drill per diameter
  std::string tolerance = "0.05mm";
  std::string drill;    // a single drill for all holes; empty: none
  std::string mill;     // diameter of the milling cutter; empty: none
  bool in_job = false;  // an operation of a job file, which chooses the holes for its tool: see DrillOptions
  std::string mill_step = "0.5mm";
  std::string clearance = "2mm";
  std::string feed_height = "0.5mm";  // at most `clearance`
  std::string depth = "-2mm";
  std::string peck;  // empty: none
  std::string feed = "100mm";
  std::string mill_feed = "150mm";
  std::string park = "0,0";
  std::uint32_t spindle = 12000;            // rpm; 0: no spindle commands
  std::uint64_t route_steps = 200'000'000;  // maximum number of steps of shorten_route()
  bool plain = false;                       // uses no canned cycles
};
std::vector<CamOption> cam_options_of(CamDrillArguments& arguments);

// The arguments of every milling operation.
struct CamMillArguments : CamProgramArguments, CamToolArguments, CamShapeSelection {
  std::vector<std::string> files;   // Gerber or DXF
  std::string output;               // empty: standard output
  std::string picture;              // .svg or .png; empty: none
  bool json = false;                // prints a summary as JSON on standard output
  std::string units = "mm";         // unit of the program, and of lengths without a unit: mm, cm or inch
  std::optional<double> scale;      // scale factor for the numbers in DXF files
  std::string input;                // unit of the numbers in the files; empty: as the files state; with --scale as
                                    // `units`
  std::vector<std::string> layers;  // layers of DXF files; empty: all layers that are on
  std::string zero = "file";        // position of X0 Y0: file, lower-left or X,Y
  std::string mirror;               // x or y; empty: the board is not flipped
  std::string mirror_at;            // position of the mirror line; empty: X0 or Y0
  std::string align;                // X,Y,X,Y: two holes; the mirror line runs midway between them
  std::string sheet;                // W,H of the material, whose lower left corner is X0 Y0; empty: unknown
  bool conventional = false;        // conventional instead of climb milling
  std::string clearance = "2mm";
  std::string feed = "200mm";
  std::string plunge_feed = "60mm";
  std::string park = "0,0";
  std::uint32_t spindle = 12000;  // rpm; 0: no spindle commands
};

// The default for a board whose options specify no cutter.
inline constexpr const char* usual_isolation_tool = "0.2mm";

struct CamIsolateArguments : CamMillArguments {
  std::string edge;  // file with the board's edge; empty: none
  std::string join = "0.1mm";
  std::string tools;  // comma-separated cutter widths
  std::string v;      // V-bit, given as ANGLE,TIP
  std::string depth = "-0.05mm";
  std::uint32_t passes = 1;
  std::string width;    // isolation width; empty: given by the number of passes
  double overlap = 50;  // percent
  bool clear = false;
  bool voronoi = false;  // mills midway between the islands
  std::string tolerance = "0.004mm";
  std::string allow_loss = "0.03mm";
  std::string least_trace = "0.1mm";
  bool accept_joined = false;  // nets that stay joined are no failure
};
std::vector<CamOption> cam_options_of(CamIsolateArguments& arguments);

struct CamOutlineArguments : CamMillArguments {
  std::string tool = "2mm";
  std::string depth = "-1.8mm";
  std::string step = "0.5mm";
  std::string join = "0.1mm";
  std::uint32_t tabs = 4;
  bool no_tabs = false;
  std::vector<std::string> tab_places;  // positions of tabs, X,Y each
  std::string tab_width = "2mm";
  std::string tab_height = "0.6mm";
  double ramp = 0;   // degrees
  std::string lead;  // empty: none
  bool dog_bones = false;
};
std::vector<CamOption> cam_options_of(CamOutlineArguments& arguments);

// Roughing with an allowance, and finishing.
struct CamFinishArguments {
  std::string allowance;  // stock on walls; empty: 5 % of the cutter's diameter with `finish_pass`, otherwise none
  bool finish_pass = false;
  std::string finish_feed;  // empty: as `feed`
  std::uint32_t spring_passes = 0;
};

// Copies of the parts of a drawing, nested on sheets.
struct CamNestArguments {
  std::string nest;            // W,H of the sheets; empty: no nesting
  std::uint32_t quantity = 1;  // copies of each part
  std::string gap;             // between two parts; empty: what the cutter needs, and 1 mm
  std::string nest_margin;     // at the edge of the sheet; empty: as `gap`
  std::uint32_t rotations = 4;
  std::uint32_t most_sheets = 1000;  // more are refused
};

struct CamProfileArguments : CamOutlineArguments, CamFinishArguments, CamNestArguments {
  std::string side = "part";  // outside, inside or on
  std::string chamfer;        // width; empty: no chamfer
  double angle = 90;          // included angle of the chamfer's V-bit, degrees
  std::string tip = "0mm";    // its tip width
};
std::vector<CamOption> cam_options_of(CamProfileArguments& arguments);

struct CamPocketArguments : CamMillArguments, CamFinishArguments {
  std::string tool = "3mm";
  std::string depth = "-3mm";
  std::string step = "1mm";
  std::string join = "0.1mm";
  double step_over = 40;  // stepover, percent of the cutter diameter
  double engagement = 0;  // maximum engagement, degrees; 0: loops
  double ramp = 5;        // degrees
  std::string floor_allowance = "0mm";
  std::string lead;       // radius, with `finish_pass`; empty: a quarter of the cutter's diameter
  std::string link_feed;  // empty: usual_link_feed()
};
std::vector<CamOption> cam_options_of(CamPocketArguments& arguments);

// Threads in bores or on bosses, at the circles of a drawing.
struct CamThreadArguments : CamMillArguments {
  std::string thread;    // "M6", "M8x1", "1/4-20"; empty: `diameter` and `pitch`
  std::string diameter;  // major diameter
  std::string pitch;
  std::string tool = "4mm";  // diameter over the teeth
  std::string neck;          // diameter of the neck; required
  std::string reach;         // length of teeth and neck; empty: unknown
  std::string tooth_tip;     // width of a tooth's tip; empty: unknown
  std::uint32_t teeth = 1;
  std::string depth = "-8mm";
  std::string hole;  // diameter of the bore or the boss; empty: by the thread
  std::string oversize = "0mm";
  std::uint32_t passes = 2;
  bool external = false;
  bool left_hand = false;
  // Not an option: the distance of the teeth of a library's tool; empty: unknown.
  std::string tooth_pitch = {};
};
std::vector<CamOption> cam_options_of(CamThreadArguments& arguments);

// Pictures whose outlines are traced.
struct CamTraceArguments {
  bool trace = false;           // the files are pictures, whose dark areas are carved
  double threshold = 50;        // percent of white; what is darker is carved
  bool invert = false;          // the bright areas are carved
  double turdsize = 2;          // pixels; smaller spots are ignored
  std::string width = "100mm";  // of the picture
};

struct CamEngraveArguments : CamMillArguments, CamTraceArguments {
  std::string text;  // empty: the files are carved
  std::string font = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  std::string height = "10mm";      // capital letter height
  std::string text_align = "left";  // middle or right
  std::string around;               // radius; empty: straight text
  std::string arc;                  // FROM,TO in degrees: the range on the circle; empty: the natural length of the
                                    // text
  double turn = 0;                  // degrees
  bool on_line = false;             // the cutter follows the lines of the drawing
  double line_space = 1.6;
  double angle = 60;  // included angle of the V-bit, degrees
  std::string tip = "0mm";
  std::string tool = "6mm";
  std::string depth;  // maximum; empty: limited by the cutter's width
  std::string step;   // depth per layer; empty: a single layer
  std::string clear;  // diameter of an end mill for wide areas; empty: none
  std::string clear_step = "1mm";
  std::string inlay;                // pocket or plug; empty: neither
  std::string inlay_depth = "4mm";  // depth of the pocket
  std::string glue_gap = "0.5mm";   // glue gap below the plug
  std::string saw_gap = "1mm";      // gap for the saw cut between the two surfaces
  std::string margin = "5mm";       // margin around the plug
  std::string join = "0.1mm";
};
std::vector<CamOption> cam_options_of(CamEngraveArguments& arguments);

// Generates a program for several operations, from a job file.
struct CamJobArguments {
  std::vector<std::string> files;  // one job file
  std::string output;              // empty: as in the job file
  std::string picture;             // .svg or .png; empty: none
  bool check = false;              // only checks whether the programs on disk are up to date
  bool json = false;               // prints the report as JSON on standard output
  bool force = false;              // overwrites programs that were edited after the last run
  bool only_folder = false;        // for untrusted job files: reads only files in their folder
};
std::vector<CamOption> cam_options_of(CamJobArguments& arguments);

struct CamPlotArguments : CamMillArguments {
  CamPlotArguments() {
    feed = "1500mm";
    plunge_feed = "600mm";
  }
  std::string pen_up = "3mm";
  std::string pen_down = "0mm";
  std::string servo;         // DOWN or DOWN,UP: S words; empty: Z moves the pen
  double servo_delay = 0.2;  // seconds
  double dot = 0.1;          // seconds
  std::string knife;         // offset of the blade; empty: a pen
  double swivel = 20;        // degrees
  std::string overcut = "1mm";
  std::string join = "0.1mm";
};
std::vector<CamOption> cam_options_of(CamPlotArguments& arguments);

// The beam of a laser.
struct CamBeamArguments {
  double power = 80;             // percent of the highest power
  std::uint32_t max_s = 1000;    // S word of the highest power
  std::string beam = "dynamic";  // M4; or constant, M3
  std::uint32_t passes = 1;
  std::string step;              // how much lower each pass is; empty: all have the same Z
  std::string focus;             // Z; empty: the program has no Z
  std::string air = "off";       // mist or flood
  double acceleration = 1000;    // mm/s², for overscan and time
  std::string rapid = "6000mm";  // for the time
};

// Drawings that a laser cuts or scores.
struct CamLaserLineArguments {
  std::string side = "part";  // outside, inside or on
  std::string kerf = "0mm";
  std::string lead;  // empty: none
  std::vector<std::string> score_layers;
  std::vector<std::string> score_colors;
  double score_power = 20;  // percent
  std::string score_feed;   // empty: as `feed`
  std::string join = "0.1mm";
};

// Pictures that a laser engraves line by line.
struct CamLaserPictureArguments {
  std::string width = "100mm";
  std::string line_distance = "0.1mm";
  std::string mode = "grey";  // dither, ordered or threshold
  double threshold = 50;      // percent of white
  double gamma = 1;
  double least_power = 0;  // percent
  std::string scan = "x";  // or y
  bool invert = false;
  bool one_way = false;
  std::string overscan;  // empty: as the feed requires
};

// A test grid of power and feed.
struct CamLaserGridArguments {
  std::string grid;  // COLUMNSxROWS; empty: none
  std::string grid_power = "20,100";
  std::string grid_feed = "500mm,3000mm";
  std::string cell = "8mm";
  bool grid_outlines = false;
};

struct CamLaserArguments : CamMillArguments,
                           CamBeamArguments,
                           CamLaserLineArguments,
                           CamLaserPictureArguments,
                           CamLaserGridArguments {
  CamLaserArguments() { feed = "1000mm"; }
};
std::vector<CamOption> cam_options_of(CamLaserArguments& arguments);

struct CamWireArguments : CamMillArguments {
  std::string axes;             // XY or XYUV; empty: as the profiles require
  std::string keep = "inside";  // outside or line
  std::string kerf = "1mm";     // or WIDTH@SPEED,...
  std::string most_feed;        // empty: three times the feed
  std::string span;
  std::string width;
  std::string block_at;  // empty: centred
  std::string chord;     // chord length of airfoils: one value, or LEFT,RIGHT
  std::string right_at = "0,0";
  double right_turn = 0;           // degrees
  std::string skin = "0mm";        // thickness of the skin around the core
  std::vector<std::string> spars;  // AT,WIDTH,DEPTH or AT,WIDTH,DEPTH,below; AT: X, or LEFT:RIGHT, or in percent
  bool straight = false;           // lines between the points of airfoils
  std::string block;               // X,Y,X,Y; empty: not drawn
  std::string lead = "10mm";
  std::string tolerance = "0.01mm";
  std::string join = "0.1mm";
  std::optional<std::uint32_t> heat;
};
std::vector<CamOption> cam_options_of(CamWireArguments& arguments);

// A board several times on one blank.
struct CamPanelArguments {
  std::string copies;       // COLUMNSxROWS boards; empty: one
  std::string gap = "5mm";  // between two copies
};

// Runs the three commands on all files of a board.
// The options of the controller and of the tools apply to all three.
struct CamBoardArguments : CamProgramArguments, CamToolArguments, CamPanelArguments {
  std::vector<std::string> paths;    // Gerber and drill files, folders, or a zip archive
  std::string output = ".";          // folder for programs, pictures and the web page
  std::string profile;               // options of the three commands (TOML); empty: none
  std::string machine;               // machine file, for the time estimates; empty: none
  std::string turn = "x";            // how the board is flipped: x or y
  std::string margin = "10mm";       // distance of the board's lower left corner from X0 and from Y0
  std::string pin_distance = "5mm";  // distance of the alignment holes from the board's edge; 0: no holes
  bool probe_holes = false;          // the holes are for probing the position of the flipped board
  std::string park;                  // X,Y at tool changes and ends, or "last"; empty: as in the profile
  std::string mask;                  // diameter of the cutter for the solder mask's openings; empty: none
  std::string mask_depth = "-0.05mm";
  std::string stencil;  // diameter of the cutter for a paste stencil; empty: none
  std::string stencil_depth = "-0.15mm";
  std::string heights;            // COLUMNSxROWS probe points of a height map of each side; empty: none
  std::string join;               // maximum gap between ends of the edge; empty: as in the outline's options
  std::vector<std::string> told;  // FILE=LAYER: corrections of the detected layers
  bool accept_joined = false;     // nets that stay joined are no failure
  bool json = false;              // prints a summary as JSON on standard output
  bool remember = false;          // saves the options of the profile for the machine
};
std::vector<CamOption> cam_options_of(CamBoardArguments& arguments);

// Cutters are in the format of parse_cutter().
struct CamReliefArguments : CamProgramArguments, CamToolArguments, CamSummaryArguments {
  std::string file;     // PNG, TIFF, STL or height map
  std::string output;   // empty: standard output
  std::string picture;  // .png; empty: none
  std::string width;    // empty: derived from `length`, otherwise 100 mm or the size of the model
  std::string length;
  std::string depth;               // a negative Z; empty: 3 mm below the top, or the height of the model
  std::string lowest_z;            // a negative Z below which nothing is cut; empty: the depth
  std::string up = "z";            // axis of the model that points up: z, -z, x, -x, y or -y
  std::string input_units = "mm";  // unit of the model: mm, cm, m or inch
  std::string area = "all";        // or model: only where the model stands
  std::string within;              // a drawing: the tips stay within its closed curves; empty: everywhere
  double gamma = 1;
  std::string smooth = "0mm";  // radius of the smoothing of a picture
  double background = 0;       // percent; darker parts of a picture are not carved
  bool invert = false;
  bool mirror = false;
  std::string channel = "luminance";  // or alpha
  std::string margin = "0mm";
  std::string margin_level = "bottom";  // or top
  std::string pitch;                    // empty: as fine as the cutters require
  std::string origin = "lower-left";    // a corner, center or X,Y
  std::string cutter = "ball:3";
  std::string way = "rows";      // columns, both, spiral or contours
  double angle = 0;              // degrees; of rows, from X
  std::string one_way = "no";    // or climb, conventional
  std::string spacing = "even";  // or slope: closer rows on slopes
  double steep = 45;             // degrees; slope limit of contours
  std::string moves = "arcs";    // or lines
  std::string step;              // stepover; empty: derived from `scallop`
  std::string scallop = "0.02mm";
  std::string tolerance = "0.01mm";
  std::string clearance = "5mm";
  std::string overrun;         // empty: the cutter's radius
  std::string entry = "ramp";  // or plunge
  double ramp_angle = 5;       // degrees
  std::string feed = "1000mm";
  std::string plunge = "300mm";
  std::optional<double> removal;        // target removal rate, mm³/min; empty: constant feed
  std::string feed_most;                // maximum feed; empty: as `feed`
  std::string rough;                    // a cutter; empty: no roughing
  std::string rough_strategy = "rows";  // or offsets
  std::string rough_step;
  std::string rough_down = "2mm";
  std::string rough_stock = "0.3mm";
  std::string rough_feed;  // empty: as `feed`
  std::optional<double> rough_removal;
  std::string rest;  // a cutter; empty: no rest finishing
  std::string rest_step;
  std::string rest_least = "0.05mm";
  std::string rest_feed;  // empty: as `feed`
  std::optional<double> rest_removal;
  std::string two_sided = "no";  // or how the stock is flipped: x, left to right; y, front to back
  std::string tab_width = "6mm";
  std::string tab_height = "2mm";
  std::string parting;        // a negative Z; empty: from the part's edge
  std::string pins = "10mm";  // distance of the dowel holes from the milled area; 0: none
  std::string align_drill = "6mm";
  bool pencil = false;            // the last cutter also cuts along inner edges
  std::uint32_t spindle = 12000;  // rpm; 0: no spindle commands
  std::string units = "mm";       // unit of the program, and of lengths without a unit: mm or inch
  std::string park = "0,0";
};
std::vector<CamOption> cam_options_of(CamReliefArguments& arguments);

}  // namespace passo
