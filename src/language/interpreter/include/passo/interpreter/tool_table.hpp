// ToolTable: the data of all tools. The interpreter looks tools up, and changes them with G10 L1, L10 and L11.
//
// Lengths are in millimetres, angles in degrees. A tool has a number (T word, 1 to 99999) and a pocket, which is its
// storage position in the machine. read_tool_table() (tool_table_file.hpp) reads LinuxCNC's format.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

inline constexpr std::int32_t highest_tool_orientation = 9;  // the center of the nose

struct Tool {
  std::int32_t number = 0;  // 0: no tool
  std::int32_t pocket = 0;
  std::int32_t place = 0;  // index in the tool table, from 1, in the order of the file
  Point offset = {};
  Mm diameter{0};                // a negative diameter swaps G41 and G42
  double front_angle_deg = 0;    // lathe tools
  double back_angle_deg = 0;     // lathe tools
  std::int32_t orientation = 0;  // lathe tools, 1 to 9: the side of the nose with the tool point; 0: a mill
  friend bool operator==(const Tool&, const Tool&) = default;
};

class ToolTable {
 public:
  static constexpr std::size_t most_tools = 1000;

  // Returns the tool with this number, or null. The pointer is valid until the table changes.
  const Tool* find(std::int32_t number) const {
    const auto found = tools_.find(number);
    return found == tools_.end() ? nullptr : &found->second;
  }
  Tool* find(std::int32_t number) {
    const auto found = tools_.find(number);
    return found == tools_.end() ? nullptr : &found->second;
  }
  // Returns false if there is already a tool with this number, or if there is no room.
  [[nodiscard]] bool add(const Tool& tool) {
    if (tools_.size() >= most_tools || !tools_.try_emplace(tool.number, tool).second) return false;
    tools_[tool.number].place = static_cast<std::int32_t>(tools_.size());
    return true;
  }
  const std::map<std::int32_t, Tool>& all() const { return tools_; }

  friend bool operator==(const ToolTable&, const ToolTable&) = default;

  // The source of the table, for messages. Empty: no table was given.
  std::string name;
  // Comments about tools in the table.
  std::map<std::int32_t, std::string> remarks;

 private:
  std::map<std::int32_t, Tool> tools_;
};

// Returns the three example tools that LinuxCNC's rs274 has without a table. Their table has no name.
ToolTable example_tools();

}  // namespace passo
