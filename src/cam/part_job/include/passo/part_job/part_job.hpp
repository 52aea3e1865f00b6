// PartJob: a job file, which describes how a part is machined: drawings, stock, clamps, tools and a list of operations.
//
//     [job]
//     drawing = "plate.svg"
//     output = "plate.ngc"
//     clearance = 5                # an option of operations: default for all that have it
//
//     [stock]
//     size = [120, 80]
//     thickness = 8
//
//     [nest]                       # copies of the part on sheets as large as the stock
//     quantity = 12
//
//     [[clamp]]
//     from = [-30, 20]
//     to = [6, 50]
//     height = 15                  # above Z0
//
//     [tool.1]                     # as in a tool library, with feeds and speed
//     shape = "flat"
//     diameter_mm = 6
//     feed_mm_min = 900
//
//     [[operation]]
//     kind = "pocket"
//     tool = 1
//     layer = "pockets"
//     depth = -4                   # an option of passo cam pocket
//
// The options of an operation are those of its command: the reader fills in the rows of cam_options_of(), so it knows
// every option of every command. Numbers without a unit are in `units`. Every key keeps its position in the file, for
// later findings "job.…". TomlText edits the file.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/geometry/tool_shape.hpp"
#include "passo/operations/cam_arguments.hpp"
#include "passo/tooling/cutting_tool.hpp"

namespace passo {

// face: the whole top of the stock. bore: circles wider than the cutter, along a helix. chamfer: a V-bit whose tip
// follows the edge, or whose flank cuts it. thread_mill: threads in bores or on bosses.
enum class PartKind : std::uint8_t { face, profile, pocket, drill, bore, engrave, chamfer, relief, thread_mill };
std::string_view name_of(PartKind kind);

struct PartTool {
  CuttingTool tool = {};
  ToolShape shape = {};
  // From the job file, or else from the chip load for the stock's material. Empty: neither.
  std::optional<double> feed = {};            // mm/min
  std::optional<double> plunge = {};          // mm/min
  std::optional<std::uint32_t> spindle = {};  // rpm
  std::string feeds_from = {};                // e.g. "chip load 0.05 mm for plywood"; empty: the job file
};

// A key of an operation, and its position.
struct PartKey {
  std::string name;
  SourceLocation place;    // of the value
  bool is_of_job = false;  // given in [job], for all operations
};

using PartArguments = std::variant<CamProfileArguments, CamPocketArguments, CamDrillArguments, CamEngraveArguments,
                                   CamReliefArguments, CamThreadArguments>;

struct PartOperation {
  PartKind kind = PartKind::profile;
  std::string title = {};               // the user's, or kind and layers
  SourceLocation place = {};            // of its kind
  std::int32_t tool = 0;                // a key of PartJob::tools
  std::int32_t first_tool = 0;          // engrave: clears wide areas; relief: roughs; 0: none
  std::vector<std::string> files = {};  // its drawings, or the model of a relief; empty: none
  // The shapes of its drawings that it cuts; empty: all.
  std::vector<std::string> layers = {};
  std::vector<std::string> colors = {};
  std::vector<std::string> names = {};
  std::optional<std::array<double, 2>> at = {};  // engrave: X and Y of the text, mm, from the job's zero
  PartArguments arguments = {};
  std::vector<PartKey> keys = {};  // the given options, in the order of the file

  bool has(std::string_view key) const;
};

// Rectangles in X and Y, in mm.
struct PartStock {
  double x = 0;  // the lower left corner
  double y = 0;
  double width = 0;
  double length = 0;
  double thickness = 0;  // Z0 is the top
  std::string material = {};
  std::optional<WorkMaterial> known_material = {};  // for feeds and chip loads
  double margin_below = 0.5;                        // how far cuts may go below the stock, into the waste board
};

struct PartClamp {
  std::string name = {};
  std::array<double, 2> x = {};  // from, to
  std::array<double, 2> y = {};
  double height = 0;  // of its top, above Z0
};

// Copies of the part, close together on sheets as large as the stock. Lengths in mm.
struct PartNesting {
  std::uint32_t quantity = 1;
  std::optional<double> gap = {};     // between two copies; empty: what the cutters need, and 1 mm
  std::optional<double> margin = {};  // at the edge of the sheet; empty: as `gap`
  std::uint32_t rotations = 4;
  SourceLocation place = {};
};

struct PartJob {
  std::string file = {};
  std::string name = {};
  std::string folder = {};  // of the job file; relative names begin there. Empty, or ends with '/'
  std::string units = "mm";
  std::vector<std::string> drawings = {};
  std::string zero = "file";
  std::string output = {};  // empty: the job file's name with .ngc
  // The controller that runs the programs, and the operator's texts in them. Those of the operations are not used.
  CamProgramArguments program = {};
  bool one_program = true;  // otherwise one for each tool
  bool keeps_order = false;
  std::optional<PartStock> stock = {};
  std::optional<PartNesting> nesting = {};
  std::vector<PartClamp> clamps = {};
  std::string library = {};  // the tool library; empty: none
  std::map<std::int32_t, PartTool> tools = {};
  std::vector<PartOperation> operations = {};
  std::vector<PartKey> defaults = {};   // the options in [job] for all operations that have them
  std::vector<std::string> lines = {};  // of the file, for findings

  // A finding about a position in the file.
  Diagnostic finding(const char* code, const SourceLocation& place, std::string message, std::string expected) const;
};

inline constexpr std::size_t most_part_operations = 200;

// Empty: there are errors "job.…" in `diagnostics`.
std::optional<PartJob> parse_part_job(std::string_view text, const std::string& file, Diagnostics& diagnostics);
std::optional<PartJob> read_part_job(const std::string& path, Diagnostics& diagnostics);

// The options of an operation, as in its command.
std::vector<CamOption> cam_options_of(PartOperation& operation);

}  // namespace passo
