#include "passo/tooling/tool_library.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <utility>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/toml/fit_for_parser.hpp"
#include "passo/toml/table_reader.hpp"
#include "passo/toml/toml_sentences.hpp"

namespace passo {
namespace {

constexpr NumberKey diameter_key{"diameter_mm", 0.01, 500, "3"};
constexpr NumberKey tip_key{"tip_diameter_mm", 0, 500, "0.2"};
constexpr NumberKey neck_key{"neck_diameter_mm", 0.01, 500, "2.6"};
constexpr NumberKey reach_key{"reach_mm", 0.1, 500, "12"};
constexpr NumberKey teeth_key{"teeth", 1, 100, "1"};
constexpr NumberKey tooth_pitch_key{"pitch_mm", 0.05, 25, "1"};
constexpr NumberKey tooth_tip_key{"tooth_tip_mm", 0, 10, "0.1"};
constexpr NumberKey corner_key{"corner_radius_mm", 1e-3, 250, "0.5"};
constexpr NumberKey angle_key{"angle_deg", 0.5, 179.5, "60"};
constexpr NumberKey flutes_key{"flutes", 1, 12, "2"};
constexpr NumberKey flute_key{"flute_length_mm", 0, 500, "12"};
constexpr NumberKey holder_key{"holder_diameter_mm", 0, 1000, "30"};
constexpr NumberKey stick_out_key{"stick_out_mm", 1e-3, 1000, "25"};
constexpr NumberKey holder_from_key{"holder_from_mm", 1e-3, 1000, "25"};
constexpr NumberKey rpm_key{"max_rpm", 1, 1e6, "24000"};
constexpr NumberKey life_length_key{"life_m", 0.001, 1e6, "300"};
constexpr NumberKey life_time_key{"life_min", 0.01, 1e6, "120"};
constexpr std::string_view shape_key = "shape";
constexpr std::string_view name_key = "name";
constexpr std::string_view loads_key = "chip_load_mm";
constexpr double usual_point_deg = 118;
constexpr std::size_t longest_name = 60;  // bytes
constexpr std::int32_t largest_number = 99'999;
constexpr std::size_t largest_file = 1U << 20U;
constexpr std::array all_shapes = {CuttingShape::flat,       CuttingShape::ball,  CuttingShape::bull,
                                   CuttingShape::vee,        CuttingShape::taper, CuttingShape::drill,
                                   CuttingShape::thread_mill};
static_assert(all_shapes.size() == cutting_shapes);

Radians radians(double degrees) {
  return {degrees * std::numbers::pi / 180};
}

CuttingShape read_shape(TableReader& reader) {
  const std::optional<std::string> word = reader.text(shape_key, "ball", Need::required);
  if (!word) return CuttingShape::flat;
  std::vector<std::string_view> names;
  for (const CuttingShape shape : all_shapes) {
    if (name_of(shape) == *word) return shape;
    names.push_back(name_of(shape));
  }
  const std::string_view near = suggestion(*word, names);
  reader.error("machine.shape", shape_key,
               toml_says::key_is.with({{"key", reader.full_name(shape_key)}, {"value", fmt::format("\"{}\"", *word)}}),
               near.empty() ? std::string("flat, ball, bull, vee, taper, drill or thread-mill")
                            : fmt::format("perhaps {}", near));
  return CuttingShape::flat;
}

void read_thread_mill(TableReader& reader, CuttingTool& tool) {
  tool.neck_diameter = Mm(reader.number(neck_key, Need::required).value_or(neck_key.least));
  tool.reach = Mm(reader.number(reach_key, Need::optional).value_or(0));
  tool.tooth_tip = Mm(reader.number(tooth_tip_key, Need::optional).value_or(0));
  tool.teeth = static_cast<std::uint32_t>(reader.whole_number(teeth_key, Need::optional).value_or(1));
  const Need pitch = tool.teeth > 1 ? Need::required : Need::optional;
  tool.tooth_pitch = Mm(reader.number(tooth_pitch_key, pitch).value_or(0));
}

void read_sizes(TableReader& reader, CuttingTool& tool) {
  tool.shape = read_shape(reader);
  tool.diameter = Mm(reader.number(diameter_key, Need::required).value_or(3));
  switch (tool.shape) {
    case CuttingShape::flat:
    case CuttingShape::ball: break;
    case CuttingShape::bull:
      tool.corner_radius = Mm(reader.number(corner_key, Need::required).value_or(corner_key.least));
      break;
    case CuttingShape::vee:
      tool.tip = Mm(reader.number(tip_key, Need::optional).value_or(0));
      tool.angle = radians(reader.number(angle_key, Need::required).value_or(60));
      break;
    case CuttingShape::taper:
      tool.tip = Mm(reader.number(tip_key, Need::required).value_or(0));
      tool.angle = radians(reader.number(angle_key, Need::required).value_or(60));
      break;
    case CuttingShape::drill:
      tool.angle = radians(reader.number(angle_key, Need::optional).value_or(usual_point_deg));
      break;
    case CuttingShape::thread_mill: read_thread_mill(reader, tool); break;
  }
}

// A name goes into comments of programs, which end at a parenthesis or at the end of the line.
void read_name(TableReader& reader, CuttingTool& tool) {
  const std::optional<std::string> name = reader.text(name_key, "roughing", Need::optional);
  if (!name) return;
  const bool is_plain = std::ranges::all_of(
      *name, [](char c) { return static_cast<unsigned char>(c) >= 0x20U && c != 0x7f && c != '(' && c != ')'; });
  if (is_plain && name->size() <= longest_name) {
    tool.name = *name;
    return;
  }
  reader.error("machine.name", name_key,
               fmt::format("{} cannot be part of a comment in a program", reader.full_name(name_key)),
               fmt::format("at most {} bytes in one line, without parentheses", longest_name));
}

// The tool above its cutting edges.
void read_shank(TableReader& reader, CuttingTool& tool) {
  tool.flute_length = Mm(reader.number(flute_key, Need::optional).value_or(0));
  tool.holder_diameter = Mm(reader.number(holder_key, Need::optional).value_or(0));
  const bool has_old_name = reader.has(holder_from_key.name);
  if (has_old_name && reader.has(stick_out_key.name)) {
    reader.error("machine.both-given", stick_out_key.name,
                 fmt::format("{} and {} are the same key", reader.full_name(holder_from_key.name), stick_out_key.name),
                 "one of them");
  }
  const bool is_needed = tool.holder_diameter > Mm(0) && !has_old_name;
  const auto stick_out = reader.number(stick_out_key, is_needed ? Need::required : Need::optional);
  const auto holder_from = reader.number(holder_from_key, Need::optional);
  tool.stick_out = Mm(stick_out.value_or(holder_from.value_or(0)));
}

void read_chip_loads(TableReader& reader, const TomlReporter& reporter, bool is_complete, CuttingTool& tool) {
  const TomlEntry* const entry =
      reader.table(loads_key, "a table [tool.1.chip_load_mm] with lines like plywood = 0.08", Need::optional);
  if (entry == nullptr) return;
  TableReader loads(std::get<TomlTable>(entry->value.content), reader.full_name(loads_key), entry->place, reporter);
  for (const std::string_view name : work_material_names()) {
    const auto load = loads.number({name, 1e-4, 5, "0.05"}, Need::optional);
    if (load) tool.chip_loads.emplace(*work_material_of(name), Mm(*load));
  }
  loads.finish(is_complete, {});
}

CuttingTool read_tool(TableReader& reader, const TomlReporter& reporter, bool is_complete) {
  CuttingTool tool;
  read_name(reader, tool);
  read_sizes(reader, tool);
  tool.flutes = static_cast<std::uint32_t>(reader.whole_number(flutes_key, Need::optional).value_or(2));
  read_shank(reader, tool);
  tool.centre_cutting = reader.flag("centre_cutting").value_or(true);
  const auto is_hss = reader.is_second_of("machine.material", "material", "carbide", "hss", Need::optional);
  tool.material = is_hss.value_or(false) ? ToolMaterial::hss : ToolMaterial::carbide;
  tool.most_rpm = reader.number(rpm_key, Need::optional);
  tool.life.length = Mm(reader.number(life_length_key, Need::optional).value_or(0) * mm_in_metre);
  tool.life.time = Seconds(reader.number(life_time_key, Need::optional).value_or(0) * seconds_per_minute);
  read_chip_loads(reader, reporter, is_complete, tool);
  return tool;
}

std::vector<CuttingTool> read_tools(const TomlDocument& document, const TomlReporter& reporter,
                                    const Diagnostics& found) {
  std::map<std::int32_t, CuttingTool> tools;
  TableReader top(document.root, "", {}, reporter);
  const TomlEntry* const all = top.table("tool", "a table [tool.1] for each tool", Need::required);
  if (all != nullptr) {
    const auto& entries = std::get<TomlTable>(all->value.content).entries;
    if (entries.empty()) reporter.error("machine.tool", all->place, "there is no tool", "a table such as [tool.1]");
    for (const TomlEntry& entry : entries) {
      const auto number = parse_tool_number(entry.key);
      const auto* const table = std::get_if<TomlTable>(&entry.value.content);
      if (!number || table == nullptr || entry.key.starts_with('T')) {
        reporter.error("machine.tool", entry.place, fmt::format("tool.{} is not a tool", entry.key),
                       "a table for each tool, with its number, e.g. [tool.1]");
        continue;
      }
      const std::size_t errors = found.errors();
      TableReader reader(*table, fmt::format("tool.{}", entry.key), entry.place, reporter);
      CuttingTool tool = read_tool(reader, reporter, document.complete);
      reader.finish(document.complete, {});
      if (found.errors() > errors) continue;
      tool.number = *number;
      if (const std::string flaw = flaw_of(shape_of(tool)); !flaw.empty()) {
        reporter.error("machine.tool", entry.place, fmt::format("tool.{} is not a valid tool", entry.key), flaw);
      } else if (!tools.emplace(*number, std::move(tool)).second) {
        reporter.error("machine.duplicate", entry.place, fmt::format("tool {} is given twice", *number),
                       "each tool once");
      }
    }
  }
  top.finish(document.complete, {});
  std::vector<CuttingTool> sorted;
  for (auto& [number, tool] : tools) sorted.push_back(std::move(tool));
  return sorted;
}

}  // namespace

CuttingTool read_cutting_tool(TableReader& reader, const TomlReporter& reporter, bool is_complete) {
  return read_tool(reader, reporter, is_complete);
}

std::vector<ToolKey> tool_keys() {
  using Shapes = std::vector<CuttingShape>;
  using enum CuttingShape;
  const auto number = [](const NumberKey& key, Shapes shapes = {}, bool is_needed = false) {
    return ToolKey{
        .name = key.name, .shapes = std::move(shapes), .least = key.least, .most = key.most, .is_needed = is_needed};
  };
  const auto whole = [&](const NumberKey& key, Shapes shapes = {}) {
    ToolKey row = number(key, std::move(shapes));
    row.kind = ToolKey::Kind::whole_number;
    return row;
  };
  std::vector<std::string_view> shapes;
  for (const CuttingShape shape : all_shapes) shapes.push_back(name_of(shape));
  return {{.name = name_key, .kind = ToolKey::Kind::text},
          {.name = shape_key, .kind = ToolKey::Kind::choice, .choices = std::move(shapes), .is_needed = true},
          number(diameter_key, {}, true),
          number(corner_key, {bull}, true),
          number(angle_key, {vee, taper, drill}),
          number(tip_key, {vee, taper}),
          number(neck_key, {thread_mill}, true),
          number(reach_key, {thread_mill}),
          number(tooth_tip_key, {thread_mill}),
          whole(teeth_key, {thread_mill}),
          number(tooth_pitch_key, {thread_mill}),
          whole(flutes_key),
          number(flute_key),
          number(stick_out_key),
          number(holder_key),
          {.name = "centre_cutting", .kind = ToolKey::Kind::flag},
          {.name = "material", .kind = ToolKey::Kind::choice, .choices = {"carbide", "hss"}},
          number(rpm_key)};
}

std::optional<ToolLibrary> ToolLibrary::parse(std::string_view text, const std::string& file,
                                              Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Diagnostics found(most_sorted_errors);
  const TomlReporter reporter(text, file, found, {.area = "tools", .words = "a tool library"});
  ToolLibrary library;
  library.file_ = file;
  if (is_fit_for_parser(reporter)) {
    library.tools_ = read_tools(parse_toml(std::string(text), reporter), reporter, found);
  }
  hand_over(found, diagnostics);
  if (found.any_error()) return std::nullopt;
  return library;
}

std::optional<ToolLibrary> ToolLibrary::read(const std::string& path, Diagnostics& diagnostics) {
  const auto text =
      read_bytes(path, {.area = "tools", .expected = "a tool library in TOML", .most = largest_file}, diagnostics);
  if (!text) return std::nullopt;
  return parse(*text, path, diagnostics);
}

const CuttingTool* ToolLibrary::find(std::int32_t number) const {
  const auto found = std::ranges::lower_bound(tools_, number, {}, &CuttingTool::number);
  return found == tools_.end() || found->number != number ? nullptr : &*found;
}

std::string ToolLibrary::numbers() const {
  std::vector<std::string> words;
  for (const CuttingTool& tool : tools_) words.push_back(fmt::format("T{}", tool.number));
  return fmt::format("{}", fmt::join(words, ", "));
}

std::map<std::int32_t, ToolShape> ToolLibrary::shapes() const {
  std::map<std::int32_t, ToolShape> shapes;
  for (const CuttingTool& tool : tools_) shapes.emplace(tool.number, shape_of(tool));
  return shapes;
}

std::optional<std::int32_t> parse_tool_number(std::string_view text) {
  if (text.starts_with('T')) text.remove_prefix(1);
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_read = error == std::errc() && end == text.data() + text.size();
  if (!is_read || number < 0 || number > largest_number) return std::nullopt;
  return number;
}

}  // namespace passo
