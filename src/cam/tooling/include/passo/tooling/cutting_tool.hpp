// CuttingTool: a milling cutter or a drill of the workshop, as a tool library describes it (tool_library.hpp).
//
// Invariant: the tools of a library are valid: sizes within their ranges, a tip narrower than the cutter, a corner
// radius of at most half the diameter. Lengths that the library does not give are 0 and mean "unknown"; nothing is
// checked against them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "passo/geometry/tool_shape.hpp"
#include "passo/tooling/work_material.hpp"
#include "passo/units/units.hpp"

namespace passo {

// thread_mill: teeth on a narrower neck.
enum class CuttingShape : std::uint8_t { flat, ball, bull, vee, taper, drill, thread_mill };
inline constexpr std::size_t cutting_shapes = 7;

// "flat", "ball", "bull", "vee", "taper", "drill", "thread-mill", as in the file.
std::string_view name_of(CuttingShape shape);

enum class ToolMaterial : std::uint8_t { carbide, hss };
std::string_view name_of(ToolMaterial material);

inline constexpr double mm_in_metre = 1000;  // lives are given in metres

// How long a tool may cut, whichever comes first. 0: no limit.
struct ToolLife {
  Mm length{0};     // path cut
  Seconds time{0};  // time in the cut
};

struct CuttingTool {
  std::int32_t number = 0;  // of the T word, 0 to 99999
  std::string name;         // for the operator, one line; may be empty
  CuttingShape shape = CuttingShape::flat;
  Mm diameter{3};           // at the widest point
  Mm corner_radius{0};      // bull: radius of the corners
  Radians angle{};          // vee, taper, drill: included angle of the tip
  Mm tip{0};                // vee: diameter of the flat at the tip; taper: of the ball
  Mm neck_diameter{0};      // thread_mill
  Mm tooth_pitch{0};        // thread_mill: along the axis, of several teeth
  Mm tooth_tip{0};          // thread_mill: width of the flat at a tooth's tip; 0: unknown
  Mm reach{0};              // thread_mill: length of teeth and neck; 0: unknown
  std::uint32_t teeth = 1;  // thread_mill: along the axis
  std::uint32_t flutes = 2;
  Mm flute_length{0};          // height of the cutting edges above the tip; 0: unknown
  Mm stick_out{0};             // from the tip to the holder or the collet; 0: unknown
  Mm holder_diameter{0};       // 0: unknown
  bool centre_cutting = true;  // the edges reach the axis, so the tool may plunge
  ToolMaterial material = ToolMaterial::carbide;
  std::optional<double> most_rpm = {};  // highest permitted spindle speed
  ToolLife life = {};
  // Chip loads of this tool, mm per tooth. They replace those of the tables.
  std::map<WorkMaterial, Mm> chip_loads = {};
};

// Returns the shape for the stock simulation and for toolpaths. A drill is a cone with its point angle.
ToolShape shape_of(const CuttingTool& tool);

// Describes a tool for comments and messages: "T2 ball nose 3 mm", with its name if it has one:
// "T2 \"finishing\", ball nose 3 mm".
std::string describe(const CuttingTool& tool);
// For tables with a column of numbers: "finishing, ball nose, 3 mm".
std::string describe_without_number(const CuttingTool& tool);

// Returns the diameter of the cut at this depth below the surface: narrower near the tip of a vee, a taper or a ball.
Mm diameter_at(const CuttingTool& tool, Mm depth);

}  // namespace passo
