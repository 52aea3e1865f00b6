#include "passo/tooling/cutting_tool.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::array<std::string_view, cutting_shapes> shape_names = {"flat",  "ball",  "bull",       "vee",
                                                                      "taper", "drill", "thread-mill"};

Cutter cutter_of(const CuttingTool& tool) {
  switch (tool.shape) {
    case CuttingShape::flat:
    case CuttingShape::thread_mill: break;
    case CuttingShape::ball: return Cutter::ball(tool.diameter);
    case CuttingShape::bull: return Cutter::bull_nose(tool.diameter, tool.corner_radius);
    case CuttingShape::vee: return Cutter::vee(tool.diameter, tool.angle, tool.tip);
    case CuttingShape::taper: return Cutter::tapered_ball(tool.diameter, tool.tip, {tool.angle.value / 2});
    case CuttingShape::drill: return Cutter::vee(tool.diameter, tool.angle, Mm(0));
  }
  return Cutter::flat_end(tool.diameter);
}

std::string words_of(const CuttingTool& tool) {
  if (tool.shape == CuttingShape::drill) return fmt::format("drill, {:g} mm", tool.diameter.value());
  if (tool.shape == CuttingShape::thread_mill) return fmt::format("thread mill {:g} mm", tool.diameter.value());
  return describe(cutter_of(tool));
}

}  // namespace

std::string_view name_of(CuttingShape shape) {
  return shape_names[static_cast<std::size_t>(shape)];
}

std::string_view name_of(ToolMaterial material) {
  return material == ToolMaterial::carbide ? "carbide" : "hss";
}

ToolShape shape_of(const CuttingTool& tool) {
  return {.cutter = cutter_of(tool),
          .neck_radius = tool.neck_diameter / 2,
          .flute_length = tool.flute_length,
          .holder_radius = tool.holder_diameter / 2,
          .holder_from = tool.stick_out};
}

std::string describe(const CuttingTool& tool) {
  const std::string words = words_of(tool);
  return tool.name.empty() ? fmt::format("T{} {}", tool.number, words)
                           : fmt::format("T{} \"{}\", {}", tool.number, tool.name, words);
}

std::string describe_without_number(const CuttingTool& tool) {
  return tool.name.empty() ? words_of(tool) : fmt::format("{}, {}", tool.name, words_of(tool));
}

Mm diameter_at(const CuttingTool& tool, Mm depth) {
  const Cutter cutter = cutter_of(tool);
  if (cutter.height(cutter.radius) <= depth) return tool.diameter;
  // The height rises with the distance from the axis.
  double low = 0;
  double high = cutter.radius.value();
  constexpr int halvings = 50;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (low + high) / 2;
    (cutter.height(Mm(middle)) <= depth ? low : high) = middle;
  }
  return Mm(2 * low);
}

}  // namespace passo
