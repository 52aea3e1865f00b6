// Fusion's tool library: {"data": [{"type", "unit", "geometry": {…}, "post-process": {…}, "start-values": {…}}]}.
//
// Lengths and feeds are in the unit of each tool, angles in degrees: TA is that of one side, SIG that of both. DC is
// the largest diameter, except for a tapered mill, whose cone has it at the height of the tip.
#include <cmath>
#include <numbers>

#include "format_readers.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using Json = JsonSource::Json;

double tangent_of(double degrees) {
  return std::tan(degrees * std::numbers::pi / 180);
}

class FusionTool {
 public:
  FusionTool(JsonSource& source, const Json& tool, std::string place, ToolCollector& tools)
      : source_(source), tool_(tool), place_(std::move(place)), tools_(tools) {
    if (const Json* const geometry = JsonSource::find(tool, "geometry")) geometry_ = geometry;
  }

  void read() {
    const std::string why = refusal();
    if (!why.empty()) {
      source_.use(tool_);
      return tools_.leave_out(place_, why);
    }
    if (const auto name = source_.text(tool_, "description")) tools_.name(draft_, *name, place_);
    const auto flutes = source_.number(*geometry_, "NOF");
    if (flutes && *flutes > 0) draft_.set("flutes", *flutes);
    set_length("flute_length_mm", "LCF");
    set_length("stick_out_mm", "LB");
    set_material();
    read_presets(flutes.value_or(0));
    const Json* const post = JsonSource::find(tool_, "post-process");
    const auto number = post != nullptr ? source_.tool_number(*post, "number") : std::nullopt;
    tools_.add(draft_, number == 0 ? std::nullopt : number, place_);
  }

 private:
  // Reads unit and shape. Returns why the tool is left out; empty: it is not.
  std::string refusal() {
    const auto unit = source_.text(tool_, "unit");
    if (!unit || (*unit != "millimeters" && *unit != "inches")) {
      return "its unit is neither millimeters nor inches";
    }
    unit_ = *unit == "inches" ? mm_in_inch : 1;
    const auto type = source_.text(tool_, "type");
    if (!type) return "it has no type";
    const auto diameter = source_.number(*geometry_, "DC");
    if (!diameter) return "it has no diameter DC";
    return set_shape(*type, *diameter * unit_);
  }

  std::string set_shape(const std::string& type, double diameter) {
    if (type == "tapered mill") return set_tapered(diameter);
    draft_.set("diameter_mm", diameter);
    if (type == "flat end mill") {
      draft_.set_shape(CuttingShape::flat);
    } else if (type == "ball end mill") {
      draft_.set_shape(CuttingShape::ball);
      source_.number(*geometry_, "RE");  // half the diameter
    } else if (type == "bull nose end mill") {
      draft_.set_shape(CuttingShape::bull);
      set_length("corner_radius_mm", "RE");
    } else if (type == "chamfer mill") {
      set_vee(source_.number(*geometry_, "TA"), 2);
    } else if (type == "spot drill") {
      set_vee(source_.number(*geometry_, "SIG"), 1);
    } else if (type == "drill") {
      is_drill_ = true;
      draft_.set_shape(CuttingShape::drill);
      const auto angle = source_.number(*geometry_, "SIG");
      if (!angle) return "it has no point angle SIG";
      draft_.set("angle_deg", *angle);
    } else {
      return fmt::format("there is no counterpart of the type \"{}\"", type.substr(0, 60));
    }
    return {};
  }

  void set_vee(std::optional<double> angle, double sides) {
    draft_.set_shape(CuttingShape::vee);
    if (angle) draft_.set("angle_deg", *angle * sides);
    if (const auto tip = source_.number(*geometry_, "tip-diameter")) draft_.set("tip_diameter_mm", *tip * unit_);
  }

  // With a corner radius, the tip is a ball if the cone touches it.
  std::string set_tapered(double diameter) {
    const auto side = source_.number(*geometry_, "TA");
    const auto height = source_.number(*geometry_, "LCF");
    const double radius = source_.number(*geometry_, "RE").value_or(0) * unit_;
    if (!side || *side <= 0 || *side >= 89 || !height) return "a tapered mill needs TA, one side's angle, and LCF";
    constexpr double equal = 0.02;
    const double a = *side * std::numbers::pi / 180;
    const double touching = 2 * radius * (1 / std::cos(a) - std::tan(a));
    if (radius > 0 && (diameter < touching * (1 - equal) || diameter > 2 * radius * (1 + equal))) {
      return "a tapered mill whose tip is neither flat nor a ball";
    }
    draft_.set_shape(radius > 0 ? CuttingShape::taper : CuttingShape::vee);
    draft_.set("diameter_mm", diameter + 2 * *height * unit_ * tangent_of(*side));
    draft_.set("tip_diameter_mm", radius > 0 ? 2 * radius : diameter);
    draft_.set("angle_deg", 2 * *side);
    return {};
  }

  void set_length(std::string_view key, const char* member) {
    const auto length = source_.number(*geometry_, member);
    if (length && *length > 0) draft_.set(key, *length * unit_);
  }

  void set_material() {
    const auto material = source_.text(tool_, "BMC");
    if (!material) return;
    if (*material == "carbide" || *material == "hss") {
      draft_.set_text("material", *material);
    } else {
      tools_.note_change(place_, fmt::format("its material \"{}\" has no counterpart", material->substr(0, 60)));
    }
  }

  // A preset's material is often only in its name, e.g. "Plywood roughing". The feed of a drill is not per tooth.
  void read_presets(double flutes) {
    const Json* const start = JsonSource::find(tool_, "start-values");
    const Json* const presets = start != nullptr ? JsonSource::find(*start, "presets") : nullptr;
    if (presets == nullptr || !presets->is_array() || is_drill_) return;
    for (const Json& preset : *presets) {
      const auto name = source_.text(preset, "name");
      const Json* const about = JsonSource::find(preset, "material");
      const auto query = about != nullptr ? source_.text(*about, "query") : std::nullopt;
      std::optional<WorkMaterial> material;
      if (query) material = work_material_of(*query);
      if (!material && name) material = work_material_of(*name);
      const auto load = load_of(preset, flutes);
      if (!material || !load) continue;
      if (!draft_.add_chip_load(*material, Mm(*load))) {
        tools_.note_change(place_,
                           fmt::format("it has several presets for {}: the first one is imported", name_of(*material)));
      }
    }
  }

  std::optional<double> load_of(const Json& preset, double flutes) {
    if (const auto load = source_.number(preset, "f_z"); load && *load > 0) return *load * unit_;
    const auto feed = source_.number(preset, "v_f");
    const auto speed = source_.number(preset, "n");
    if (!feed || !speed || *feed <= 0 || *speed <= 0 || flutes <= 0) return std::nullopt;
    return *feed * unit_ / (*speed * flutes);
  }

  JsonSource& source_;
  const Json& tool_;
  std::string place_;
  ToolCollector& tools_;
  const Json* geometry_ = &tool_;
  ToolDraft draft_;
  double unit_ = 1;
  bool is_drill_ = false;
};

}  // namespace

void read_fusion_tools(JsonSource& source, ToolCollector& tools) {
  const Json* const data = JsonSource::find(source.root(), "data");
  if (data == nullptr || !data->is_array()) return;
  for (std::size_t i = 0; i < data->size(); ++i) {
    const Json& tool = (*data)[i];
    if (tools.is_full()) {
      tools.leave_out(fmt::format("/data/{}", i), fmt::format("only {} tools are read", ImportedTools::most_tools));
      return;
    }
    if (const auto type = source.text(tool, "type"); type == "holder") {  // a list of its own
      source.use(tool);
      tools.leave_out(fmt::format("/data/{}", i), "a holder");
      continue;
    }
    FusionTool(source, tool, fmt::format("/data/{}", i), tools).read();
  }
}

}  // namespace passo
