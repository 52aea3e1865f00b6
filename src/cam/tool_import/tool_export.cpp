#include <algorithm>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/interpreter/tool_table_file.hpp"
#include "passo/tool_import/tool_import.hpp"
#include "passo/tooling/tool_library_text.hpp"

namespace passo {
namespace {

using ExportJson = nlohmann::ordered_json;

constexpr double degrees_in_radian = 180 / std::numbers::pi;

ExportJson known(double value) {
  return value > 0 ? ExportJson(as_written(value)) : ExportJson();
}

ExportJson json_of(const CuttingTool& tool) {
  ExportJson json = {{"number", tool.number},
                     {"name", tool.name},
                     {"shape", name_of(tool.shape)},
                     {"diameter_mm", tool.diameter.value()}};
  if (tool.shape == CuttingShape::bull) json["corner_radius_mm"] = tool.corner_radius.value();
  if (tool.angle.value > 0) json["angle_deg"] = as_written(tool.angle.value * degrees_in_radian);
  if (tool.shape == CuttingShape::vee || tool.shape == CuttingShape::taper) json["tip_diameter_mm"] = tool.tip.value();
  if (tool.shape == CuttingShape::thread_mill) {
    json["neck_diameter_mm"] = tool.neck_diameter.value();
    json["teeth"] = tool.teeth;
    json["pitch_mm"] = known(tool.tooth_pitch.value());
    json["tooth_tip_mm"] = known(tool.tooth_tip.value());
    json["reach_mm"] = known(tool.reach.value());
  }
  json["flutes"] = tool.flutes;
  json["flute_length_mm"] = known(tool.flute_length.value());
  json["stick_out_mm"] = known(tool.stick_out.value());
  json["holder_diameter_mm"] = known(tool.holder_diameter.value());
  json["centre_cutting"] = tool.centre_cutting;
  json["material"] = name_of(tool.material);
  json["max_rpm"] = tool.most_rpm ? ExportJson(*tool.most_rpm) : ExportJson();
  json["life_m"] = known(tool.life.length.value() / mm_in_metre);
  json["life_min"] = known(tool.life.time.value() / seconds_per_minute);
  ExportJson loads = ExportJson::object();
  for (const auto& [material, load] : tool.chip_loads) loads[std::string(name_of(material))] = load.value();
  json["chip_load_mm"] = loads;
  return json;
}

}  // namespace

std::string tool_library_json(std::span<const CuttingTool> tools, std::string_view file) {
  ExportJson json = ExportJson::object();
  if (!file.empty()) json["file"] = file;
  json["format"] = "passo-tool-library";
  json["version"] = 1;
  json["units"] = "mm";
  json["tools"] = ExportJson::array();
  for (const CuttingTool& tool : tools) json["tools"].push_back(json_of(tool));
  return json.dump(2, ' ', false, ExportJson::error_handler_t::replace) + "\n";
}

// LinuxCNC ends a remark at the end of the line.
std::string linuxcnc_tool_table(std::span<const CuttingTool> tools, LengthUnits units) {
  std::string lines;
  ToolTable table;
  for (const CuttingTool& tool : tools) {
    Tool entry{.number = tool.number, .pocket = tool.number};
    entry.diameter = tool.diameter;
    if (tool.number == 0 || !table.add(entry)) continue;
    std::string remark = describe(tool);
    remark.erase(0, std::min(remark.find(' ') + 1, remark.size()));  // the number
    lines += fmt::format("T{} P{} ; {}\n", tool.number, tool.number, remark);
  }
  return tool_table_text(lines, units, table);
}

}  // namespace passo
