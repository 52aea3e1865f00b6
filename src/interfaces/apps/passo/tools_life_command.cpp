// passo tools life: what each tool has cut, what is left of its life, its length and its pocket.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <set>

#include "commands.hpp"
#include "program_input.hpp"
#include "tool_life.hpp"
#include "tools_command.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/interpreter/tool_table_file.hpp"
#include "passo/tooling/tool_library.hpp"

namespace passo {
namespace {

using LifeJson = nlohmann::ordered_json;

// One tool, from the library, the tool table and the records. Null: the file does not have it.
struct ToolLifeRow {
  std::int32_t number = 0;
  const CuttingTool* tool = nullptr;
  const Tool* entry = nullptr;
  ToolRecord record = {};
};

std::string day_of(double seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  if (seconds <= 0 || localtime_r(&time, &parts) == nullptr) return "-";
  return fmt::format("{:04}-{:02}-{:02}", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday);
}

// "12.3 / 300"; without a limit "12.3".
std::string amount_cell(double amount, double limit) {
  return limit > 0 ? fmt::format("{:.1f} / {:g}", amount, limit) : fmt::format("{:.1f}", amount);
}

// The part of the life that is used, whichever limit is nearer; 0: there is no limit.
double used_share(const ToolLifeRow& row) {
  if (row.tool == nullptr) return 0;
  const ToolLife& life = row.tool->life;
  const double by_length = life.length > Mm(0) ? row.record.cut.length / life.length : 0;
  const double by_time = life.time > Seconds(0) ? row.record.cut.time / life.time : 0;
  return std::max(by_length, by_time);
}

void print_row(const ToolLifeRow& row) {
  const ToolLife life = row.tool != nullptr ? row.tool->life : ToolLife();
  const double share = used_share(row);
  std::string line =
      fmt::format("{:<7} {:>16} {:>16} {:>6} {:>10} {:>9} {:>6}  {}", fmt::format("T{}", row.number),
                  amount_cell(row.record.cut.length.value() / mm_in_metre, life.length.value() / mm_in_metre),
                  amount_cell(row.record.cut.time.value() / seconds_per_minute, life.time.value() / seconds_per_minute),
                  share > 0 ? fmt::format("{:.0f} %", share * 100) : "-", day_of(row.record.replaced_at),
                  row.entry != nullptr ? fmt::format("{:.3f}", row.entry->offset[Axis::z]) : "-",
                  row.entry != nullptr ? fmt::format("{}", row.entry->pocket) : "-",
                  row.tool != nullptr ? describe(*row.tool) : "");
  line.erase(line.find_last_not_of(' ') + 1);
  fmt::print("{}\n", line);
}

LifeJson json_of(const ToolLifeRow& row) {
  const auto known = [](double value) { return value > 0 ? LifeJson(value) : LifeJson(); };
  const ToolLife life = row.tool != nullptr ? row.tool->life : ToolLife();
  return {{"number", row.number},
          {"description", row.tool != nullptr ? LifeJson(describe(*row.tool)) : LifeJson()},
          {"cut_m", row.record.cut.length.value() / mm_in_metre},
          {"cut_min", row.record.cut.time.value() / seconds_per_minute},
          {"life_m", known(life.length.value() / mm_in_metre)},
          {"life_min", known(life.time.value() / seconds_per_minute)},
          {"replaced_at", known(row.record.replaced_at)},
          {"length_mm", row.entry != nullptr ? LifeJson(row.entry->offset[Axis::z]) : LifeJson()},
          {"pocket", row.entry != nullptr ? LifeJson(row.entry->pocket) : LifeJson()}};
}

std::vector<ToolLifeRow> rows_of(const std::optional<ToolLibrary>& library, const ToolTable& table,
                                 const std::vector<ToolRecord>& records) {
  std::set<std::int32_t> numbers;
  if (library) {
    for (const CuttingTool& tool : library->tools()) numbers.insert(tool.number);
  }
  for (const auto& [number, tool] : table.all()) numbers.insert(number);
  for (const ToolRecord& record : records) numbers.insert(record.tool);
  std::vector<ToolLifeRow> rows;
  for (const std::int32_t number : numbers) {
    const auto record = std::ranges::find(records, number, &ToolRecord::tool);
    rows.push_back({.number = number,
                    .tool = library ? library->find(number) : nullptr,
                    .entry = table.find(number),
                    .record = record == records.end() ? ToolRecord{.tool = number, .cut = {}} : *record});
  }
  return rows;
}

}  // namespace

int tools_life(const ToolsLifeArguments& arguments) {
  std::optional<ToolLibrary> library;
  ToolTable table;
  Diagnostics findings;
  if (!arguments.library.empty()) library = ToolLibrary::read(arguments.library, findings);
  const LengthUnits units = arguments.units == "inch" ? LengthUnits::inch : LengthUnits::mm;
  if (!arguments.table.empty()) static_cast<void>(read_tool_table(arguments.table, units, table, findings));
  show(findings);
  if (findings.any_error()) return exit_bad_program;
  const std::string file = tool_records_file(arguments.records);
  if (file.empty()) {
    return fail(exit_bad_program, "--tool-records: expected a file, because neither HOME nor XDG_STATE_HOME is set");
  }
  std::error_code none;
  const bool exists = std::filesystem::exists(file, none);
  if (!exists && !arguments.records.empty() && arguments.replaced.empty()) {
    return fail(exit_bad_program, fmt::format("{} does not exist: no tool has cut yet [tools.records]", file));
  }
  std::vector<ToolRecord> records;
  if (exists || !arguments.replaced.empty()) {
    int code = exit_done;
    const auto opened = open_tool_records(file, code);
    if (!opened) return code;
    const double now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    for (const std::string& tool : arguments.replaced) {
      const auto number = parse_tool_number(tool);
      if (!number || *number == 0) {
        return fail(exit_bad_program, fmt::format("--replaced: expected a tool, e.g. T3, found '{}'", tool));
      }
      if (!opened->replace(*number, now)) {
        return fail(exit_failed, fmt::format("{}: {} [tools.records]", file, opened->trouble()));
      }
    }
    records = opened->all();
  }
  const std::vector<ToolLifeRow> rows = rows_of(library, table, records);
  if (arguments.json) {
    LifeJson json = {{"records", file}, {"tools", LifeJson::array()}};
    for (const ToolLifeRow& row : rows) json["tools"].push_back(json_of(row));
    fmt::print("{}\n", json.dump(2, ' ', false, LifeJson::error_handler_t::replace));
    return flush_output();
  }
  fmt::print("{:<7} {:>16} {:>16} {:>6} {:>10} {:>9} {:>6}  {}\n", "tool", "cut m", "in the cut, min", "used",
             "replaced", "length", "pocket", "name");
  for (const ToolLifeRow& row : rows) print_row(row);
  return flush_output();
}

}  // namespace passo
