// The operations of a job file: the options of their commands, and the values of their tools.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "option_value.hpp"
#include "part_job_reader.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/part_job/part_kinds.hpp"

namespace passo {
namespace {

// A chamfer of a given width is cut by the flank. Without a width, the tip follows the edge.
PartArguments arguments_of(PartKind kind, bool has_chamfer) {
  switch (kind) {
    case PartKind::face:
    case PartKind::pocket: return CamPocketArguments();
    case PartKind::profile: return CamProfileArguments();
    case PartKind::drill:
    case PartKind::bore: return CamDrillArguments();
    case PartKind::chamfer:
      if (has_chamfer) return CamProfileArguments();
      return CamEngraveArguments();
    case PartKind::engrave: return CamEngraveArguments();
    case PartKind::relief: return CamReliefArguments();
    case PartKind::thread_mill: return CamThreadArguments();
  }
  return CamProfileArguments();
}

std::string_view command_of(const PartOperation& operation) {
  switch (operation.kind) {
    case PartKind::face: return "pocket";
    case PartKind::bore: return "drill";
    case PartKind::chamfer:
      return std::holds_alternative<CamProfileArguments>(operation.arguments) ? "profile" : "engrave";
    case PartKind::thread_mill: return "thread";
    default: return name_of(operation.kind);
  }
}

// Options of profiles that a chamfer does not have: it is cut in one pass, whose depth follows from its width.
bool is_not_of_chamfer(std::string_view option) {
  constexpr std::array<std::string_view, 13> names = {
      "depth", "step",      "tabs",      "no-tabs",     "tab",         "tab-width",    "tab-height",
      "ramp",  "dog-bones", "allowance", "finish-pass", "finish-feed", "spring-passes"};
  return std::ranges::find(names, option) != names.end();
}

// Options that a job sets for all operations, or by their tools.
bool is_set_by_job(const CamOption& option, const PartOperation& operation) {
  const bool is_wide_chamfer =
      operation.kind == PartKind::chamfer && std::holds_alternative<CamProfileArguments>(operation.arguments);
  if (is_wide_chamfer && option.name == "chamfer") return false;
  if (is_wide_chamfer && is_not_of_chamfer(option.name)) return true;
  constexpr std::array<std::string_view, 38> names = {
      "output",     "picture",     "json",   "units",       "zero",      "sheet",      "mirror",    "mirror-at",
      "align",      "align-drill", "tool",   "tools",       "drill",     "mill",       "cutter",    "angle",
      "tip",        "clear",       "rough",  "rest",        "FILE",      "two-sided",  "pins",      "parting",
      "tool-table", "material",    "limits", "chamfer",     "neck",      "reach",      "tooth-tip", "teeth",
      "nest",       "quantity",    "gap",    "nest-margin", "rotations", "most-sheets"};
  return option.kind == CamKind::drawings || is_of_program(option.name) ||
         std::ranges::find(names, option.name) != names.end();
}

// The key of the operation's second tool, and its option.
struct FirstTool {
  std::string_view key;
  std::string_view option;
};
FirstTool first_tool_of(PartKind kind) {
  if (kind == PartKind::engrave) return {"clear-tool", "clear"};
  if (kind == PartKind::relief) return {"rough-tool", "rough"};
  return {};
}

// Gives an option a value. Options that the operation does not have are ignored.
void give(const std::vector<CamOption>& options, std::string_view name, const std::string& value) {
  const auto found = std::ranges::find(options, name, &CamOption::name);
  if (found == options.end()) return;
  if (auto* const* text = std::get_if<std::string*>(&found->value)) **text = value;
}

std::string mm_words(Mm length) {
  return fmt::format("{}mm", length.value());
}

double degrees_of(const Cutter& cutter) {
  return cutter.half_angle.value * 360 / std::numbers::pi;
}

// In the format of parse_cutter().
std::string cutter_words(const Cutter& cutter) {
  const std::string diameter = fmt::format("{}", 2 * cutter.radius.value());
  switch (cutter.kind()) {
    case Cutter::Kind::flat: return "flat:" + diameter;
    case Cutter::Kind::ball: return "ball:" + diameter;
    case Cutter::Kind::bull_nose: return fmt::format("bull:{}:{}", diameter, cutter.corner.value());
    case Cutter::Kind::v: return fmt::format("vee:{}:{}:{}", degrees_of(cutter), diameter, 2 * cutter.flat.value());
    case Cutter::Kind::tapered_ball:
      return fmt::format("taper:{}:{}:{}", 2 * cutter.corner.value(), degrees_of(cutter) / 2, diameter);
  }
  return "flat:" + diameter;
}

// The kind of tool that an operation needs; empty: this one is suitable.
std::string tool_expected(PartKind kind, CuttingShape shape) {
  if (kind == PartKind::thread_mill) {
    return shape == CuttingShape::thread_mill ? "" : "a tool with shape = \"thread-mill\"";
  }
  if (shape == CuttingShape::thread_mill) return "a tool of another shape: this one is only for threads";
  if (kind == PartKind::drill) {
    const bool leaves_round_bottom = shape == CuttingShape::ball || shape == CuttingShape::taper;
    return leaves_round_bottom ? "a tool with shape = \"drill\", \"flat\", \"bull\" or \"vee\"" : "";
  }
  if (kind == PartKind::relief) return shape != CuttingShape::drill ? "" : "a milling cutter";
  if (kind == PartKind::engrave || kind == PartKind::chamfer) {
    return shape == CuttingShape::vee ? "" : "a tool with shape = \"vee\"";
  }
  return shape == CuttingShape::flat || shape == CuttingShape::bull ? "" : "a tool with shape = \"flat\" or \"bull\"";
}

}  // namespace

std::vector<PartKindKeys> keys_of_part_kinds() {
  std::vector<PartKindKeys> all;
  for (const std::string_view name : names_of_part_kinds()) {
    PartOperation operation;
    operation.kind = *part_kind_of(name);
    operation.arguments = arguments_of(operation.kind, true);
    PartKindKeys keys{.kind = operation.kind,
                      .command = command_of(operation),
                      .first_tool = first_tool_of(operation.kind).key,
                      .options = {},
                      .file = operation.kind == PartKind::relief ? "file" : "drawing",
                      .has_place = operation.kind == PartKind::engrave};
    for (const CamOption& option : cam_options_of(operation)) {
      if (!is_set_by_job(option, operation)) keys.options.push_back(option.name);
    }
    all.push_back(std::move(keys));
  }
  return all;
}

std::int32_t PartJobReader::tool_number(TableReader& reader, std::string_view key, Need need) {
  const auto number = reader.whole_number({key, 1, 99'999, "1"}, need);
  if (!number) return 0;
  const auto tool = static_cast<std::int32_t>(*number);
  if (job_.tools.contains(tool)) return tool;
  // An error in the tool's own table was reported there.
  const TomlEntry* const tools = find(document_.root, "tool");
  const auto* const table = tools == nullptr ? nullptr : std::get_if<TomlTable>(&tools->value.content);
  if (table != nullptr && find(*table, fmt::format("{}", tool)) != nullptr) return 0;
  std::vector<std::int32_t> all;
  for (const auto& [known, shape] : job_.tools) all.push_back(known);
  reader.error("job.no-such-tool", key, fmt::format("there is no table [tool.{}]", tool),
               all.empty() ? "a table [tool.1]" : fmt::format("{}", fmt::join(all, ", ")));
  return 0;
}

void PartJobReader::read_operation(const TomlTable& table, const std::string& path, const SourceLocation& place) {
  TableReader reader(table, path, place, reporter_);
  const auto names_of_kinds = names_of_part_kinds();
  const auto word = reader.text("kind", "pocket", Need::required);
  const auto kind = word ? part_kind_of(*word) : std::nullopt;
  if (!kind) {
    if (word) {
      const std::string_view near = suggestion(*word, names_of_kinds);
      reader.error("job.unknown-kind", "kind", fmt::format("there is no kind of operation \"{}\"", *word),
                   near.empty() ? fmt::format("{}", fmt::join(names_of_kinds, ", ")) : fmt::format("perhaps {}", near));
    } else {
      reporter_.error("job.missing-key", place,
                      fmt::format("[[operation]] number {} has no kind", path.substr(path.find('.') + 1)),
                      fmt::format("kind = one of {}", fmt::join(names_of_kinds, ", ")));
    }
    return;
  }
  PartOperation operation;
  operation.kind = *kind;
  operation.place = reader.place_of("kind");
  operation.arguments = arguments_of(*kind, find(table, "chamfer") != nullptr);
  operation.title = reader.text("title", "windows", Need::optional).value_or("");
  operation.tool = tool_number(reader, "tool", Need::required);
  if (const FirstTool first = first_tool_of(*kind); !first.key.empty()) {
    operation.first_tool = tool_number(reader, first.key, Need::optional);
  }
  if (*kind == PartKind::engrave) {
    if (const auto at = pair(table, reader, "at", -1e4, Need::optional)) operation.at = {at->low, at->high};
  }
  if (operation.tool > 0) {
    const std::string expected = tool_expected(*kind, job_.tools.at(operation.tool).tool.shape);
    if (!expected.empty()) {
      reader.error("job.wrong-tool", "tool",
                   fmt::format("{} cannot use {}", name_of(*kind), describe(job_.tools.at(operation.tool).tool)),
                   expected);
    }
  }
  for (const std::string& name : names(table, reader, *kind == PartKind::relief ? "file" : "drawing")) {
    operation.files.push_back(in_folder(name));
  }
  if (*kind == PartKind::chamfer && find(table, "chamfer") != nullptr && find(table, "depth") != nullptr) {
    reader.know("depth");
    reader.error("job.bad-value", "depth", fmt::format("{} has a chamfer and a depth", path),
                 "only chamfer, the width; the depth follows from the angle of the cutter");
  }
  read_options(table, reader, operation);
  reader.finish(document_.complete, {});
  if (operation.tool == 0) return;
  apply_defaults(operation);
  apply_tool(operation);
  const bool draws = *kind == PartKind::face || operation.has("text");
  if (operation.files.empty() && *kind != PartKind::relief && !draws) operation.files = job_.drawings;
  if (operation.files.empty() && !draws) {
    reporter_.error("job.missing-key", operation.place, fmt::format("{} has nothing to cut", path),
                    *kind == PartKind::relief ? "file = \"face.stl\"" : "drawing = \"plate.svg\", here or in [job]");
  }
  if (*kind == PartKind::face && !job_.stock) {
    reporter_.error("job.missing-key", operation.place, "face needs the size of the stock", "a table [stock]");
  }
  if (*kind == PartKind::relief && job_.units == "cm") {
    reporter_.error("job.bad-value", operation.place, "a relief cannot be in cm", "units = \"mm\" or \"inch\"");
  }
  if (operation.title.empty()) {
    const auto number = job_.operations.size() + 1;
    std::vector<std::string> words = operation.layers;
    words.insert(words.end(), operation.colors.begin(), operation.colors.end());
    words.insert(words.end(), operation.names.begin(), operation.names.end());
    std::erase(words, "");  // the shapes on no layer
    if (words.empty()) words.push_back(fmt::format("{}", number));
    operation.title = fmt::format("{} {}", name_of(*kind), fmt::join(words, " "));
  }
  job_.operations.push_back(std::move(operation));
}

void PartJobReader::read_options(const TomlTable& table, TableReader& reader, PartOperation& operation) {
  const std::vector<CamOption> options = cam_options_of(operation);
  for (const CamOption& option : options) {
    if (is_set_by_job(option, operation)) continue;
    reader.know(option.name);
    const TomlEntry* const entry = find(table, option.name);
    if (entry == nullptr) continue;
    const std::string expected = set_option(option, entry->value);
    if (!expected.empty()) {
      reader.error("job.bad-value", option.name,
                   fmt::format("{} is {}", reader.full_name(option.name), kind_of(entry->value)), expected);
      continue;
    }
    operation.keys.push_back({entry->key, entry->value.place, false});
    auto* const* text = std::get_if<std::string*>(&option.value);
    if (option.kind == CamKind::file && text != nullptr) {
      const std::string inside = in_folder(**text);
      // A font may be the name of an installed one.
      if (option.traits.names.empty() || std::filesystem::exists(inside)) **text = inside;
    }
  }
  const auto selected = [&](std::string_view name) {
    const auto found = std::ranges::find(options, name, &CamOption::name);
    return found == options.end() ? std::vector<std::string>() : *std::get<std::vector<std::string>*>(found->value);
  };
  operation.layers = selected("layer");
  operation.colors = selected("color");
  operation.names = selected("name");
}

// The options in [job] for all operations that have them.
void PartJobReader::apply_defaults(PartOperation& operation) {
  for (const CamOption& option : cam_options_of(operation)) {
    const TomlEntry* const entry = find(defaults_, option.name);
    if (entry == nullptr || operation.has(option.name) || is_set_by_job(option, operation)) continue;
    const std::string expected = set_option(option, entry->value);
    if (expected.empty()) {
      operation.keys.push_back({entry->key, entry->value.place, true});
    } else {
      reporter_.error("job.bad-value", entry->value.place,
                      fmt::format("job.{} is {}", entry->key, kind_of(entry->value)), expected);
    }
  }
}

void PartJobReader::apply_tool(PartOperation& operation) {
  const PartTool& tool = job_.tools.at(operation.tool);
  const Cutter& cutter = tool.shape.cutter;
  const std::vector<CamOption> options = cam_options_of(operation);
  const std::string diameter = mm_words(2 * cutter.radius);
  give(options,
       operation.kind == PartKind::drill  ? "drill"
       : operation.kind == PartKind::bore ? "mill"
                                          : "tool",
       diameter);
  give(options, "cutter", cutter_words(cutter));
  if (auto* engrave = std::get_if<CamEngraveArguments>(&operation.arguments)) {
    engrave->angle = degrees_of(cutter);
    engrave->tip = mm_words(2 * cutter.flat);
    engrave->on_line = engrave->on_line || operation.kind == PartKind::chamfer;
  }
  if (auto* thread = std::get_if<CamThreadArguments>(&operation.arguments)) {
    const auto known = [](Mm length) { return length > Mm(0) ? mm_words(length) : std::string(); };
    thread->neck = mm_words(tool.tool.neck_diameter);
    thread->reach = known(tool.tool.reach);
    thread->tooth_tip = known(tool.tool.tooth_tip);
    thread->tooth_pitch = known(tool.tool.tooth_pitch);
    thread->teeth = tool.tool.teeth;
  }
  if (auto* profile = std::get_if<CamProfileArguments>(&operation.arguments);
      profile != nullptr && operation.kind == PartKind::chamfer) {
    profile->angle = degrees_of(cutter);
    profile->tip = mm_words(2 * cutter.flat);
  }
  const auto feed = [&](std::string_view name, const std::optional<double>& mm_per_min) {
    if (mm_per_min && !operation.has(name)) give(options, name, fmt::format("{}mm", *mm_per_min));
  };
  const bool goes_down = operation.kind == PartKind::drill || operation.kind == PartKind::bore;
  feed("feed", goes_down && tool.plunge ? tool.plunge : tool.feed);
  feed("mill-feed", tool.feed);
  feed("plunge-feed", tool.plunge);
  feed("plunge", tool.plunge);
  if (tool.spindle && !operation.has("spindle")) {
    const auto found = std::ranges::find(options, "spindle", &CamOption::name);
    if (found != options.end()) *std::get<std::uint32_t*>(found->value) = *tool.spindle;
  }
  if (operation.first_tool > 0) {
    const Cutter& first = job_.tools.at(operation.first_tool).shape.cutter;
    give(options, "clear", mm_words(2 * first.radius));
    give(options, "rough", cutter_words(first));
  }
  give(options, "units", job_.units);
}

}  // namespace passo
