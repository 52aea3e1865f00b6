#include "passo/tooling/tool_library_text.hpp"

#include <algorithm>
#include <cstdlib>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double degrees_in_radian = 180 / std::numbers::pi;

class EntryList {
 public:
  void add(std::string_view key, double value) { entries_.push_back({key, toml_value(value)}); }
  void add_known(std::string_view key, Mm length) {
    if (length > Mm(0)) add(key, length.value());
  }
  void add(std::string_view key, std::string_view text) { entries_.push_back({key, toml_value(text)}); }
  void add_flag(std::string_view key, bool value) { entries_.push_back({key, toml_value(value)}); }
  std::vector<ToolEntry> take() { return std::move(entries_); }

 private:
  std::vector<ToolEntry> entries_;
};

void add_sizes(EntryList& list, const CuttingTool& tool) {
  list.add("shape", name_of(tool.shape));
  list.add("diameter_mm", tool.diameter.value());
  switch (tool.shape) {
    case CuttingShape::flat:
    case CuttingShape::ball: break;
    case CuttingShape::bull: list.add("corner_radius_mm", tool.corner_radius.value()); break;
    case CuttingShape::vee:
    case CuttingShape::taper:
      list.add("angle_deg", tool.angle.value * degrees_in_radian);
      list.add("tip_diameter_mm", tool.tip.value());
      break;
    case CuttingShape::drill: list.add("angle_deg", tool.angle.value * degrees_in_radian); break;
    case CuttingShape::thread_mill:
      list.add("neck_diameter_mm", tool.neck_diameter.value());
      list.add_known("reach_mm", tool.reach);
      list.add("tooth_tip_mm", tool.tooth_tip.value());
      list.add("teeth", tool.teeth);
      list.add_known("pitch_mm", tool.tooth_pitch);
      break;
  }
}

}  // namespace

std::string toml_value(double value) {
  return fmt::format("{:.10g}", value);
}

std::string toml_value(bool value) {
  return value ? "true" : "false";
}

std::string toml_value(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (byte < 0x20U || byte == 0x7fU) {
      quoted += fmt::format("\\u{:04x}", byte);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

double as_written(double value) {
  return std::strtod(toml_value(value).c_str(), nullptr);
}

std::vector<ToolEntry> entries_of(const CuttingTool& tool) {
  EntryList list;
  if (!tool.name.empty()) list.add("name", tool.name);
  add_sizes(list, tool);
  list.add("flutes", tool.flutes);
  list.add_known("flute_length_mm", tool.flute_length);
  list.add_known("stick_out_mm", tool.stick_out);
  list.add_known("holder_diameter_mm", tool.holder_diameter);
  if (!tool.centre_cutting) list.add_flag("centre_cutting", false);
  list.add("material", name_of(tool.material));
  if (tool.most_rpm) list.add("max_rpm", *tool.most_rpm);
  if (tool.life.length > Mm(0)) list.add("life_m", tool.life.length.value() / mm_in_metre);
  if (tool.life.time > Seconds(0)) list.add("life_min", tool.life.time.value() / seconds_per_minute);
  return list.take();
}

std::string tool_table_of(std::int32_t number, std::span<const ToolEntry> entries,
                          const std::map<WorkMaterial, Mm>& chip_loads) {
  std::string text = fmt::format("[tool.{}]\n", number);
  for (const ToolEntry& entry : entries) text += fmt::format("{} = {}\n", entry.key, entry.value);
  if (chip_loads.empty()) return text;
  text += fmt::format("[tool.{}.chip_load_mm]\n", number);
  for (const auto& [material, load] : chip_loads) {
    text += fmt::format("{} = {}\n", name_of(material), toml_value(load.value()));
  }
  return text;
}

std::string tool_library_text(std::span<const CuttingTool> tools, std::string_view head) {
  std::string text;
  while (!head.empty()) {
    const std::size_t end = std::min(head.find('\n'), head.size());
    text += fmt::format("# {}\n", head.substr(0, end));
    head.remove_prefix(std::min(end + 1, head.size()));
  }
  for (const CuttingTool& tool : tools) {
    if (!text.empty()) text += '\n';
    text += tool_table_of(tool.number, entries_of(tool), tool.chip_loads);
  }
  return text;
}

}  // namespace passo
