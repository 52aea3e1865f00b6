#include "part_job_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "option_value.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/operations/cam_operation.hpp"
#include "passo/operations/length_text.hpp"
#include "passo/part_job/part_kinds.hpp"
#include "passo/tooling/cutting_feeds.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo {
namespace {

constexpr NumberKey feed_key{"feed_mm_min", 0.1, 1e6, "900"};
constexpr NumberKey plunge_key{"plunge_mm_min", 0.1, 1e6, "300"};
constexpr NumberKey speed_key{"spindle_rpm", 0, 1e6, "18000"};
constexpr double longest = 10'000;  // mm, of the stock
constexpr std::array<std::string_view, 6> job_tables = {"job", "stock", "nest", "clamp", "tool", "operation"};

}  // namespace

std::vector<ToolKey> keys_of_part_tools() {
  std::vector<ToolKey> keys = tool_keys();
  for (const NumberKey& key : {feed_key, plunge_key, speed_key}) {
    keys.push_back({.name = key.name, .least = key.least, .most = key.most});
  }
  keys.back().kind = ToolKey::Kind::whole_number;
  return keys;
}

void PartJobReader::read() {
  TableReader top(document_.root, "", {}, reporter_);
  for (const std::string_view name : job_tables) top.know(name);
  const auto entry = [&](std::string_view key) { return find(document_.root, key); };
  // Operations need the contents of the tables before them.
  if (const TomlEntry* job = top.table("job", "a table [job]", Need::optional)) read_job(*job);
  if (const TomlEntry* nest = top.table("nest", "a table [nest]", Need::optional)) read_nest(*nest);
  if (const TomlEntry* stock = top.table("stock", "a table [stock]", Need::optional)) read_stock(*stock);
  if (job_.nesting && !job_.stock && find(document_.root, "stock") == nullptr) {
    top.missing("stock", "a table [stock], with the thickness of the sheets");
  }
  const Need own_tools = job_.tools.empty() ? Need::required : Need::optional;
  if (const TomlEntry* tools = top.table("tool", "a table [tool.1] for each tool", own_tools)) read_tools(*tools);
  for (auto& [number, tool] : job_.tools) find_feeds(tool);
  for (const std::string_view key : {"clamp", "fixture"}) {
    top.know(key);
    if (const TomlEntry* const list = entry(key)) {
      read_list(*list, [&](const TomlTable& table, const std::string& path, const SourceLocation& place) {
        read_clamp(table, path, place);
      });
    }
  }
  const TomlEntry* const operations = entry("operation");
  if (operations == nullptr) {
    top.missing("operation", "[[operation]], a table for each operation");
  } else {
    read_list(*operations, [&](const TomlTable& table, const std::string& path, const SourceLocation& place) {
      read_operation(table, path, place);
    });
  }
  top.finish(document_.complete, {});
}

template <class Read>
void PartJobReader::read_list(const TomlEntry& entry, Read read) {
  const auto* list = std::get_if<TomlArray>(&entry.value.content);
  const std::string expected = fmt::format("[[{}]], a table for each", entry.key);
  if (list == nullptr || list->size() > most_part_operations) {
    reporter_.error("job.wrong-type", entry.place, fmt::format("{} is {}", entry.key, kind_of(entry.value)),
                    list == nullptr ? expected : fmt::format("at most {} of [[{}]]", most_part_operations, entry.key));
    return;
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const TomlValue& item = (*list)[i];
    if (const auto* table = std::get_if<TomlTable>(&item.content)) {
      read(*table, fmt::format("{}.{}", entry.key, i + 1), item.place);
    } else {
      reporter_.error("job.wrong-type", item.place, fmt::format("{} has {} in its list", entry.key, kind_of(item)),
                      expected);
    }
  }
}

std::string PartJobReader::in_folder(const std::string& name) const {
  return name.empty() || name.front() == '/' ? name : job_.folder + name;
}

std::vector<std::string> PartJobReader::names(const TomlTable& table, TableReader& reader, std::string_view key) {
  reader.know(key);
  const TomlEntry* const entry = find(table, key);
  if (entry == nullptr) return {};
  if (const auto* text = std::get_if<std::string>(&entry->value.content)) return {*text};
  std::vector<std::string> all;
  const auto* list = std::get_if<TomlArray>(&entry->value.content);
  const bool is_good = list != nullptr && std::ranges::all_of(*list, [&](const TomlValue& item) {
                         const auto* text = std::get_if<std::string>(&item.content);
                         if (text != nullptr) all.push_back(*text);
                         return text != nullptr;
                       });
  if (is_good) return all;
  reader.error("job.wrong-type", key, fmt::format("{} is {}", reader.full_name(key), kind_of(entry->value)),
               fmt::format("a text in quotes or a list of them, e.g. {} = \"plate.svg\"", key));
  return {};
}

std::optional<double> PartJobReader::length_of(TableReader& reader, std::string_view key, const TomlValue& value,
                                               double least, const std::string& example) const {
  const auto refuse = [&](const char* code, const std::string& expected) {
    reporter_.error(code, value.place, fmt::format("{} is {}", reader.full_name(key), kind_of(value)), expected);
    return std::nullopt;
  };
  const auto* const number = std::get_if<double>(&value.content);
  const auto* const text = std::get_if<std::string>(&value.content);
  double mm = number != nullptr ? *number * unit_mm_ : 0;
  if (text != nullptr) {
    const Result<Mm, std::string> read = parse_length("", *text, unit_mm_);
    if (!read) return refuse("job.bad-value", fmt::format("a length, e.g. {} or \"1/2in\"", example));
    mm = read->value();
  } else if (number == nullptr) {
    return refuse("job.wrong-type", fmt::format("a length, e.g. {}", example));
  }
  if (mm >= least && mm <= longest) return mm;
  return refuse("job.out-of-range",
                fmt::format("{:.6g} to {:.6g} {}", least / unit_mm_, longest / unit_mm_, job_.units));
}

std::optional<double> PartJobReader::length(const TomlTable& table, TableReader& reader, std::string_view key,
                                            double least, std::string_view example, Need need) {
  const std::string line = fmt::format("{} = {}", key, example);
  reader.know(key);
  if (const TomlEntry* const entry = find(table, key)) return length_of(reader, key, entry->value, least, line);
  if (need == Need::required) reader.missing(key, line);
  return std::nullopt;
}

std::optional<LowHigh> PartJobReader::pair(const TomlTable& table, TableReader& reader, std::string_view key,
                                           double least, Need need) {
  const std::string line = fmt::format("{} = [100, 60]", key);
  reader.know(key);
  const TomlEntry* const entry = find(table, key);
  if (entry == nullptr) {
    if (need == Need::required) reader.missing(key, line);
    return std::nullopt;
  }
  const auto* const list = std::get_if<TomlArray>(&entry->value.content);
  if (list == nullptr || list->size() != 2) {
    reader.error("job.wrong-type", key, fmt::format("{} is {}", reader.full_name(key), kind_of(entry->value)),
                 fmt::format("two lengths, e.g. {}", line));
    return std::nullopt;
  }
  const auto low = length_of(reader, key, list->front(), least, line);
  const auto high = length_of(reader, key, list->back(), least, line);
  return low && high ? std::optional(LowHigh{*low, *high}) : std::nullopt;
}

void PartJobReader::read_job(const TomlEntry& entry) {
  const auto& table = std::get<TomlTable>(entry.value.content);
  TableReader reader(table, "job", entry.place, reporter_);
  job_.name = reader.text("name", "plate", Need::optional).value_or("");
  job_.units = reader.text("units", "mm", Need::optional).value_or("mm");
  if (job_.units == "inch") {
    unit_mm_ = 25.4;
  } else if (job_.units == "cm") {
    unit_mm_ = 10;
  } else if (job_.units != "mm") {
    reader.error("job.bad-value", "units", fmt::format("job.units is \"{}\"", job_.units), "mm, cm or inch");
  }
  for (const std::string& name : names(table, reader, "drawing")) job_.drawings.push_back(in_folder(name));
  reader.know("zero");
  CamOption zero{"zero", &job_.zero, CamKind::place, "", {.choices = {"file", "lower-left"}}};
  if (const TomlEntry* given = find(table, "zero")) {
    const std::string expected = set_option(zero, given->value);
    const bool is_good = job_.zero == "file" || job_.zero == "lower-left" || job_.zero.find(',') != std::string::npos;
    if (!expected.empty() || !is_good) {
      reader.error("job.bad-value", "zero", fmt::format("job.zero is {}", kind_of(given->value)),
                   "\"file\", \"lower-left\" or X and Y, e.g. [10, 0]");
    }
  }
  job_.output = in_folder(reader.text("output", "plate.ngc", Need::optional).value_or(""));
  job_.one_program =
      !reader.is_second_of("job.bad-value", "programs", "one", "each-tool", Need::optional).value_or(false);
  job_.keeps_order =
      reader.is_second_of("job.bad-value", "order", "by-tool", "as-written", Need::optional).value_or(false);
  if (const auto library = reader.text("tools", "router-tools.toml", Need::optional)) {
    read_library(in_folder(*library), reader.place_of("tools"));
  }
  read_program_words(table, reader);
  // The rest: options that operations can have as keys.
  std::set<std::string_view> of_operations;
  for (const PartKindKeys& keys : keys_of_part_kinds()) of_operations.insert(keys.options.begin(), keys.options.end());
  of_operations.erase("chamfer");  // decides the command, so each operation has its own
  std::set<std::string_view> known;
  for (const std::string_view command : {"profile", "pocket", "drill", "engrave", "relief", "thread"}) {
    const CamOperation* const operation = find_cam_operation(command);
    for (const CamOption& option : operation->options()) {
      if (!option.traits.is_of_job && of_operations.contains(option.name)) known.insert(option.name);
    }
  }
  for (const TomlEntry& option : table.entries) {
    if (!known.contains(option.key) || option.key == "units" || option.key == "tools") continue;
    reader.know(option.key);
    defaults_.entries.push_back(option);
    job_.defaults.push_back({option.key, option.value.place, true});
  }
  reader.finish(document_.complete, {});
}

// A job has one controller for all operations.
void PartJobReader::read_program_words(const TomlTable& table, TableReader& reader) {
  CamPocketArguments arguments;
  for (const CamOption& option : cam_options_of(arguments)) {
    if (!is_of_program(option.name)) continue;
    reader.know(option.name);
    const TomlEntry* const entry = find(table, option.name);
    if (entry == nullptr) continue;
    const std::string expected = set_option(option, entry->value);
    if (!expected.empty()) {
      reader.error("job.bad-value", option.name, fmt::format("job.{} is {}", option.name, kind_of(entry->value)),
                   expected);
    }
    auto* const* text = std::get_if<std::string*>(&option.value);
    if (option.kind == CamKind::file && text != nullptr) **text = in_folder(**text);
  }
  job_.program = arguments;
}

void PartJobReader::read_stock(const TomlEntry& entry) {
  const auto& table = std::get<TomlTable>(entry.value.content);
  TableReader reader(table, "stock", entry.place, reporter_);
  PartStock stock;
  const auto own_size = pair(table, reader, "size", 1e-3, sheet_ ? Need::optional : Need::required);
  const auto size = sheet_ ? sheet_ : own_size;
  if (sheet_ && own_size) {
    reader.error("job.bad-value", "size", "both stock.size and nest.sheet are given", "one of them");
  }
  const auto corner = pair(table, reader, "corner", -longest, Need::optional);
  stock.thickness = length(table, reader, "thickness", 1e-3, "12", Need::required).value_or(0);
  stock.margin_below = length(table, reader, "below", 0, "0.5", Need::optional).value_or(stock.margin_below);
  stock.material = reader.text("material", "plywood", Need::optional).value_or("");
  stock.known_material = work_material_of(stock.material);
  if (corner) {
    stock.x = corner->low;
    stock.y = corner->high;
  }
  reader.finish(document_.complete, {});
  if (!size || !(stock.thickness > 0)) return;
  stock.width = size->low;
  stock.length = size->high;
  job_.stock = stock;
}

void PartJobReader::read_nest(const TomlEntry& entry) {
  const auto& table = std::get<TomlTable>(entry.value.content);
  TableReader reader(table, "nest", entry.place, reporter_);
  constexpr NumberKey quantity{"quantity", 1, 1000, "12"};
  constexpr NumberKey rotations{"rotations", 1, 72, "4"};
  PartNesting nesting{.place = entry.place};
  sheet_ = pair(table, reader, "sheet", 1e-3, Need::optional);
  nesting.quantity = static_cast<std::uint32_t>(reader.whole_number(quantity, Need::required).value_or(1));
  nesting.rotations = static_cast<std::uint32_t>(reader.whole_number(rotations, Need::optional).value_or(4));
  nesting.gap = length(table, reader, "gap", 0, "8", Need::optional);
  nesting.margin = length(table, reader, "margin", 0, "10", Need::optional);
  reader.finish(document_.complete, {});
  job_.nesting = nesting;
}

void PartJobReader::read_clamp(const TomlTable& table, const std::string& path, const SourceLocation& place) {
  TableReader reader(table, path, place, reporter_);
  PartClamp clamp;
  clamp.name = reader.text("name", "left clamp", Need::optional).value_or(path);
  const auto from = pair(table, reader, "from", -longest, Need::required);
  const auto to = pair(table, reader, "to", -longest, Need::required);
  const auto height = length(table, reader, "height", -longest, "15", Need::required);
  reader.finish(document_.complete, {});
  if (!from || !to || !height) return;
  if (from->low >= to->low || from->high >= to->high) {
    reader.error(
        "job.bad-value", "to",
        fmt::format("{0}.to is [{1:g}, {2:g}], not beyond {0}.from", path, to->low / unit_mm_, to->high / unit_mm_),
        fmt::format("X above {:g} and Y above {:g}", from->low / unit_mm_, from->high / unit_mm_));
    return;
  }
  clamp.x[0] = from->low;
  clamp.x[1] = to->low;
  clamp.y[0] = from->high;
  clamp.y[1] = to->high;
  clamp.height = *height;
  job_.clamps.push_back(clamp);
}

void PartJobReader::read_tools(const TomlEntry& entry) {
  for (const TomlEntry& tool : std::get<TomlTable>(entry.value.content).entries) read_tool(tool);
}

void PartJobReader::read_tool(const TomlEntry& entry) {
  constexpr std::int32_t largest = 99'999;
  std::int32_t number = 0;
  const bool has_digits = !entry.key.empty() && entry.key.size() <= 5 &&
                          std::ranges::all_of(entry.key, [](char c) { return c >= '0' && c <= '9'; });
  for (const char c : entry.key) number = has_digits ? number * 10 + (c - '0') : 0;
  const auto* const table = std::get_if<TomlTable>(&entry.value.content);
  if (number < 1 || number > largest || table == nullptr) {
    reporter_.error("job.tool", entry.place, fmt::format("tool.{} is not a tool", entry.key),
                    "a table for each tool, with its number from 1, e.g. [tool.1]");
    return;
  }
  TableReader reader(*table, fmt::format("tool.{}", entry.key), entry.place, reporter_);
  PartTool tool;
  tool.tool = read_cutting_tool(reader, reporter_, document_.complete);
  tool.tool.number = number;
  tool.shape = shape_of(tool.tool);
  tool.feed = reader.number(feed_key, Need::optional);
  tool.plunge = reader.number(plunge_key, Need::optional);
  if (const auto speed = reader.whole_number(speed_key, Need::optional)) {
    tool.spindle = static_cast<std::uint32_t>(*speed);
  }
  reader.finish(document_.complete, {});
  if (const std::string flaw = flaw_of(tool.shape); !flaw.empty()) {
    reporter_.error("job.tool", entry.place, fmt::format("tool.{} is not a valid tool", entry.key), flaw);
    return;
  }
  job_.tools.insert_or_assign(number, tool);
}

// A tool of the job replaces the library's tool with the same number.
void PartJobReader::read_library(const std::string& path, const SourceLocation& place) {
  Diagnostics found;
  const auto library = ToolLibrary::read(path, found);
  if (!library) {
    reporter_.error("job.tools", place, fmt::format("{} is not a tool library: {}", path, found.all().front().message),
                    "a file with tables [tool.1], see passo tools --help");
    return;
  }
  job_.library = path;
  for (const CuttingTool& tool : library->tools()) {
    if (tool.number > 0) job_.tools.emplace(tool.number, PartTool{.tool = tool, .shape = shape_of(tool)});
  }
}

// Values that the file does not give follow from the material.
void PartJobReader::find_feeds(PartTool& tool) {
  if (!job_.stock || !job_.stock->known_material || (tool.feed && tool.spindle)) return;
  FeedRequest request{.material = *job_.stock->known_material};
  if (tool.spindle) request.rpm = *tool.spindle;
  const CuttingFeeds feeds = feeds_of(tool.tool, request);
  constexpr double per_minute = 60;
  if (!tool.spindle) tool.spindle = static_cast<std::uint32_t>(std::lround(feeds.rpm));
  if (!tool.feed) tool.feed = std::round(feeds.feed.value() * per_minute);
  if (!tool.plunge && feeds.plunge.value() > 0) tool.plunge = std::round(feeds.plunge.value() * per_minute);
  tool.feeds_from = fmt::format("{:g} mm/min at {} rpm: {:.3g} mm per tooth in {}", *tool.feed, *tool.spindle,
                                feeds.chip_load.value(), name_of(*job_.stock->known_material));
}

}  // namespace passo
