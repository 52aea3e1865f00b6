#include "passo/machine_file/tool_shapes_file.hpp"

#include <charconv>
#include <numbers>
#include <variant>

#include "fit_for_parser.hpp"
#include "machine_file_sentences.hpp"
#include "table_reader.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

constexpr NumberKey diameter_key{"diameter_mm", 1e-3, 500, "3"};
constexpr NumberKey tip_key{"tip_diameter_mm", 0, 500, "0.2"};
constexpr NumberKey corner_key{"corner_radius_mm", 1e-3, 250, "0.5"};
constexpr NumberKey angle_key{"angle_deg", 0.5, 179.5, "60"};
constexpr NumberKey flute_key{"flute_length_mm", 0, 500, "12"};
constexpr NumberKey holder_key{"holder_diameter_mm", 0, 1000, "30"};
constexpr NumberKey holder_from_key{"holder_from_mm", 1e-3, 1000, "25"};
constexpr std::string_view shape_key = "shape";
constexpr std::int32_t largest_number = 99'999;
constexpr std::size_t largest_tools = 1U << 20U;

std::optional<std::int32_t> number_of(std::string_view key) {
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), number);
  if (error != std::errc() || end != key.data() + key.size() || number < 0 || number > largest_number)
    return std::nullopt;
  return number;
}

Cutter read_cutter(TableReader& reader) {
  const std::optional<std::string> shape = reader.text(shape_key, "\"ball\"", Need::required);
  const auto kind = shape ? cutter_kind_of(*shape) : std::nullopt;
  if (shape && !kind) {
    reader.error("machine.shape", shape_key,
                 machine_file_says::key_is.with(
                     {{"key", reader.full_name(shape_key)}, {"value", fmt::format("\"{}\"", *shape)}}),
                 cutter_kind_names);
  }
  const auto diameter = Mm(reader.number(diameter_key, Need::required).value_or(3));
  const auto tip = [&](Need need) { return Mm(reader.number(tip_key, need).value_or(0)); };
  const auto included_angle = [&] {
    return Radians{reader.number(angle_key, Need::required).value_or(60) * std::numbers::pi / 180};
  };
  switch (kind.value_or(Cutter::Kind::flat)) {
    case Cutter::Kind::flat: break;
    case Cutter::Kind::ball: return Cutter::ball(diameter);
    case Cutter::Kind::bull_nose:
      return Cutter::bull_nose(diameter, Mm(reader.number(corner_key, Need::required).value_or(0)));
    case Cutter::Kind::v: {
      const Mm flat = tip(Need::optional);
      return Cutter::vee(diameter, included_angle(), flat);
    }
    case Cutter::Kind::tapered_ball: {
      const Mm ball = tip(Need::required);
      return Cutter::tapered_ball(diameter, ball, {included_angle().value / 2});
    }
  }
  return Cutter::flat_end(diameter);
}

ToolShape read_tool(TableReader& reader) {
  ToolShape tool{.cutter = read_cutter(reader)};
  tool.flute_length = Mm(reader.number(flute_key, Need::optional).value_or(0));
  tool.holder_radius = Mm(reader.number(holder_key, Need::optional).value_or(0) / 2);
  const Need from = tool.holder_radius > Mm(0) ? Need::required : Need::optional;
  tool.holder_from = Mm(reader.number(holder_from_key, from).value_or(0));
  return tool;
}

ToolShapes read_tools(const TomlDocument& document, const TomlReporter& reporter, const Diagnostics& found) {
  ToolShapes tools;
  TableReader top(document.root, "", {}, reporter);
  const TomlEntry* const all = top.table("tool", "a table [tool.1] for each tool", Need::required);
  if (all != nullptr) {
    for (const TomlEntry& entry : std::get<TomlTable>(all->value.content).entries) {
      const auto number = number_of(entry.key);
      const auto* const table = std::get_if<TomlTable>(&entry.value.content);
      if (!number || table == nullptr) {
        reporter.error("machine.tool", entry.place, fmt::format("tool.{} is not a tool", entry.key),
                       "a table for each tool, with its number, e.g. [tool.1]");
        continue;
      }
      const std::size_t errors = found.errors();
      TableReader reader(*table, fmt::format("tool.{}", entry.key), entry.place, reporter);
      const ToolShape tool = read_tool(reader);
      reader.finish(document.complete, {});
      if (found.errors() > errors) continue;
      if (const std::string flaw = flaw_of(tool); !flaw.empty()) {
        reporter.error("machine.tool", entry.place, fmt::format("tool.{} is not a valid tool number", entry.key), flaw);
      }
      tools.emplace(*number, tool);
    }
  }
  top.finish(document.complete, {});
  return tools;
}

}  // namespace

std::optional<ToolShapes> parse_tool_shapes(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Diagnostics found(most_sorted_errors);
  const TomlReporter reporter(text, file, found, {.area = "tools", .words = "a tool file"});
  ToolShapes tools;
  if (is_fit_for_parser(reporter)) tools = read_tools(parse_toml(std::string(text), reporter), reporter, found);
  hand_over(found, diagnostics);
  if (found.any_error()) return std::nullopt;
  return tools;
}

std::optional<ToolShapes> read_tool_shapes(const std::string& path, Diagnostics& diagnostics) {
  const auto text =
      read_bytes(path, {.area = "tools", .expected = "a tool file in TOML", .most = largest_tools}, diagnostics);
  if (!text) return std::nullopt;
  return parse_tool_shapes(*text, path, diagnostics);
}

}  // namespace passo
