// FreeCAD's tool bits: {"name", "shape": "endmill.fcstd", "parameter": {"Diameter": "6.0 mm", …}, "attribute": {…}},
// and libraries: {"tools": [{"nr": 1, "path": "6mm.fctb"}]}.
//
// A quantity is a text with its unit; some versions write a comma, as the system's language has it. Angles include both
// sides.
#include <cmath>
#include <cstdlib>

#include "format_readers.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using Json = JsonSource::Json;

struct FreecadUnit {
  std::string_view name;
  double factor;  // to mm or degrees
  bool is_angle;
};
constexpr FreecadUnit known_units[] = {{"mm", 1, false},     {"cm", 10, false},    {"m", 1000, false},
                                       {"um", 0.001, false}, {"µm", 0.001, false}, {"in", 25.4, false},
                                       {"\"", 25.4, false},  {"deg", 1, true},     {"°", 1, true}};

// "6.35 mm", "2,00 mm", "60 °". A length without a unit is not understood.
std::optional<double> quantity_of(std::string text, bool is_angle) {
  constexpr std::size_t longest = 40;
  if (text.size() > longest) return std::nullopt;
  if (const std::size_t comma = text.find(','); comma != std::string::npos) text[comma] = '.';
  const std::size_t end = text.find_first_not_of("+-.0123456789eE");
  const std::string digits = text.substr(0, end);
  char* rest = nullptr;
  const double value = std::strtod(digits.c_str(), &rest);
  if (digits.empty() || *rest != '\0' || !std::isfinite(value) || end == std::string::npos) return std::nullopt;
  const std::size_t from = text.find_first_not_of(' ', end);
  if (from == std::string::npos) return std::nullopt;
  for (const FreecadUnit& unit : known_units) {
    if (unit.is_angle == is_angle && text.substr(from, text.find_last_not_of(' ') - from + 1) == unit.name) {
      return value * unit.factor;
    }
  }
  return std::nullopt;
}

// The name of a shape: "shape-type" of newer files, otherwise the name of the shape's file. Without its case, and
// without '-', '_' and blanks.
std::string shape_name(JsonSource& source, const Json& bit) {
  std::string name = source.text(bit, "shape").value_or("");
  name.resize(std::min(name.size(), name.find('.')));
  if (const auto type = source.text(bit, "shape-type"); type && name.empty()) name = *type;
  std::string plain;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') {
      plain += static_cast<char>(c - 'A' + 'a');
    } else if (c != '-' && c != '_' && c != ' ') {
      plain += c;
    }
  }
  return plain;
}

class FreecadBit {
 public:
  FreecadBit(JsonSource& source, const Json& bit, std::string place, ToolCollector& tools)
      : source_(source), bit_(bit), place_(std::move(place)), tools_(tools) {}

  void read(std::optional<std::int32_t> number) {
    const std::string why = set_shape(shape_name(source_, bit_));
    if (!why.empty()) {
      source_.use(bit_);
      return tools_.leave_out(place_, why);
    }
    if (const auto name = source_.text(bit_, "name")) tools_.name(draft_, *name, place_);
    if (const auto height = quantity("CuttingEdgeHeight", false); height && *height > 0)
      draft_.set("flute_length_mm", *height);
    if (const auto stick_out = quantity("Stickout", false); stick_out && *stick_out > 0)
      draft_.set("stick_out_mm", *stick_out);
    if (const auto flutes = count("Flutes"); flutes && *flutes > 0) draft_.set("flutes", *flutes);
    set_material();
    tools_.add(draft_, number, place_);
  }

 private:
  std::string set_shape(const std::string& shape) {
    if (shape == "taperedballnose") return "a tapered ball nose: FreeCAD has it in several ways";
    const auto diameter = quantity("Diameter", false);
    if (!diameter) return "it has no Diameter with a unit";
    draft_.set("diameter_mm", *diameter);
    if (shape == "endmill") {
      draft_.set_shape(CuttingShape::flat);
    } else if (shape == "ballend") {
      draft_.set_shape(CuttingShape::ball);
    } else if (shape == "bullnose" || shape == "torus") {
      draft_.set_shape(CuttingShape::bull);
      if (const auto radius = quantity("CornerRadius", false)) draft_.set("corner_radius_mm", *radius);
    } else if (shape == "vbit" || shape == "chamfer") {
      draft_.set_shape(CuttingShape::vee);
      if (const auto angle = quantity("CuttingEdgeAngle", true)) draft_.set("angle_deg", *angle);
      if (const auto tip = quantity("TipDiameter", false)) draft_.set("tip_diameter_mm", *tip);
    } else if (shape == "drill") {
      draft_.set_shape(CuttingShape::drill);
      const auto angle = quantity("TipAngle", true);
      if (!angle) return "a drill without a TipAngle";
      draft_.set("angle_deg", *angle);
    } else {
      return fmt::format("there is no counterpart of the shape \"{}\"", shape.substr(0, 60));
    }
    return {};
  }

  // Newer files have everything in "parameter", older ones some in "attribute".
  const Json* value_of(const char* key) const {
    for (const char* const group : {"parameter", "attribute"}) {
      const Json* const members = JsonSource::find(bit_, group);
      const Json* const value = members != nullptr ? JsonSource::find(*members, key) : nullptr;
      if (value != nullptr) return value;
    }
    return nullptr;
  }
  std::optional<double> quantity(const char* key, bool is_angle) {
    const Json* const value = value_of(key);
    if (value == nullptr || !value->is_string()) return std::nullopt;
    const auto number = quantity_of(value->get<std::string>(), is_angle);
    if (number) source_.use(*value);
    return number;
  }
  std::optional<double> count(const char* key) {
    const Json* const value = value_of(key);
    if (value == nullptr) return std::nullopt;
    double number = 0;
    if (value->is_number()) {
      number = value->get<double>();
    } else if (value->is_string() && value->get_ref<const std::string&>().size() < 4) {
      number = std::strtod(value->get_ref<const std::string&>().c_str(), nullptr);
    }
    if (number < 1 || number > 100 || number != std::floor(number)) return std::nullopt;
    source_.use(*value);
    return number;
  }
  void set_material() {
    const Json* const value = value_of("Material");
    if (value == nullptr || !value->is_string()) return;
    const auto& name = value->get_ref<const std::string&>();
    if (name != "Carbide" && name != "HSS") return;
    source_.use(*value);
    draft_.set_text("material", name == "HSS" ? "hss" : "carbide");
  }

  JsonSource& source_;
  const Json& bit_;
  std::string place_;
  ToolCollector& tools_;
  ToolDraft draft_;
};

// A tool bit's file lies in a known folder: the name must not lead elsewhere.
bool is_file_name(const std::string& name) {
  return name.ends_with(".fctb") && name.size() <= 255 &&
         name.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos;
}

void read_library(JsonSource& source, const Json& list, const ToolImportOptions& options, ToolCollector& tools) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string place = fmt::format("/tools/{}", i);
    if (tools.is_full()) {
      return tools.leave_out(place, fmt::format("only {} tools are read", ImportedTools::most_tools));
    }
    const auto number = source.tool_number(list[i], "nr");
    const auto name = source.text(list[i], "path");
    if (!name || !is_file_name(*name)) {
      tools.leave_out(place, "it does not name a tool bit: the name of a file that ends in .fctb");
      continue;
    }
    const auto text = options.read_tool_bit ? options.read_tool_bit(*name) : std::nullopt;
    if (!text) {
      tools.leave_out(place, fmt::format("{} is missing next to the library, and in ../Bit", *name));
      continue;
    }
    Diagnostics findings;
    auto bit = JsonSource::parse(*text, *name, findings);
    if (!bit) {
      const Diagnostic& first = findings.all().front();
      tools.leave_out(place, fmt::format("{}:{}:{}: {}", *name, first.place.line, first.place.column, first.message));
      continue;
    }
    FreecadBit(*bit, bit->root(), *name, tools).read(number == 0 ? std::nullopt : number);
    tools.add_unused(bit->unused(), *name);
  }
}

}  // namespace

void read_freecad_tools(JsonSource& source, const ToolImportOptions& options, ToolCollector& tools) {
  const Json* const list = JsonSource::find(source.root(), "tools");
  if (list != nullptr && list->is_array()) return read_library(source, *list, options, tools);
  FreecadBit(source, source.root(), "/", tools).read({});
}

}  // namespace passo
