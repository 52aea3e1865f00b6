// ToolLibrary: the tools of a workshop, read from a TOML file with a table for each tool. Simulation, checks, CAM and
// job files all use this reader.
//
//     [tool.1]                    # T1 in the program
//     name = "roughing"           # optional, like every key except shape and diameter_mm, unless stated otherwise
//     shape = "taper"             # flat, ball, bull, vee, taper, drill
//     diameter_mm = 6             # largest diameter
//     tip_diameter_mm = 1         # vee: diameter of the flat tip (default: 0); taper: diameter of the ball, required
//     angle_deg = 12              # vee, taper: included angle, required; drill: point angle (default: 118)
//     corner_radius_mm = 0.5      # bull: corner radius, required
//     flutes = 2                  # 1 to 12
//     flute_length_mm = 22
//     stick_out_mm = 28           # from the tip to the holder; also named holder_from_mm
//     holder_diameter_mm = 30     # needs stick_out_mm
//     centre_cutting = false      # the tool must not plunge (default: true)
//     material = "carbide"        # or hss
//     max_rpm = 24000
//     life_m = 300                # how far the tool may cut,
//     life_min = 120              # and for how long, whichever comes first (default: no limit)
//     [tool.1.chip_load_mm]       # own chip loads, mm per tooth, instead of those of the tables
//     plywood = 0.08
//
// Errors are diagnostics "tools.…" with line, column and key.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/tooling/cutting_tool.hpp"

namespace passo {

class TableReader;
class TomlReporter;

class ToolLibrary {
 public:
  // Empty: the file has errors, which are in `diagnostics`. At most 1 MiB.
  static std::optional<ToolLibrary> read(const std::string& path, Diagnostics& diagnostics);
  static std::optional<ToolLibrary> parse(std::string_view text, const std::string& file, Diagnostics& diagnostics);

  const std::string& file() const { return file_; }
  // In ascending order of their numbers; at least one.
  const std::vector<CuttingTool>& tools() const { return tools_; }
  // Returns null if there is no such tool. The pointer is valid as long as the library.
  const CuttingTool* find(std::int32_t number) const;
  // Returns the tool numbers for a message: "T1, T2, T7".
  std::string numbers() const;
  // Returns the shapes by tool number, for the stock simulation.
  std::map<std::int32_t, ToolShape> shapes() const;

 private:
  std::string file_;
  std::vector<CuttingTool> tools_;
};

// Reads the keys of a tool from its table, for files whose tools have other keys, too. The caller calls finish(), and
// checks flaw_of(shape_of()), which is meaningless after errors. `is_complete`: the whole file could be read.
CuttingTool read_cutting_tool(TableReader& reader, const TomlReporter& reporter, bool is_complete);

// A key of a tool, for forms.
struct ToolKey {
  enum class Kind : std::uint8_t { text, choice, flag, number, whole_number };
  std::string_view name;
  Kind kind = Kind::number;
  std::vector<CuttingShape> shapes = {};       // that have it; empty: all
  std::vector<std::string_view> choices = {};  // the first one is the default, unless the key is needed
  double least = 0;                            // of a number
  double most = 0;
  bool is_needed = false;  // by one of the shapes
};
std::vector<ToolKey> tool_keys();

// Parses "3" or "T3". Empty: neither.
std::optional<std::int32_t> parse_tool_number(std::string_view text);

}  // namespace passo
