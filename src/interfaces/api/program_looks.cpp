// What viewers ask of a program: its path in chunks, a window of its text, and its height map.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "api_json.hpp"

#include "passo/levelling/map_figures.hpp"

namespace passo {
namespace {

constexpr std::uint64_t most_lines = 2000;  // of one answer
constexpr std::uint64_t most_chunks = 4;    // of one answer: a coarse level takes 2 ms, and the machine waits

std::optional<std::uint64_t> number_of(std::string_view query, std::string_view key) {
  const std::string_view digits = query_value(query, key);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return {};
  return value;
}

Json as_json(const ProgramPath::Range& range) {
  if (range.empty()) return Json();
  return {{"low", range.low}, {"high", range.high}};
}

Json as_json(const MachineDescription& machine, const std::optional<ProgramPath::Reach>& reach) {
  if (!reach) return Json();
  const auto box = [&machine](const Box& one) {
    return Json{{"low", as_json(machine, one.low)}, {"high", as_json(machine, one.high)}};
  };
  return {{"machine", box(reach->machine)}, {"work", box(reach->work)}};
}

Json as_json(const ProgramPath::Speeds& speeds) {
  if (speeds.empty()) return Json();
  return {{"low", speeds.low.value() * seconds_per_minute}, {"high", speeds.high.value() * seconds_per_minute}};
}

// The diameter is that of the tool table, else that of the machine file's tool; null: unknown.
Json tools_json(const ProgramPath& path, const MachineDescription& machine, const ToolTable& tools) {
  Json list = Json::array();
  for (const ProgramPath::UsedTool& used : path.tools()) {
    const Tool* const tool = tools.find(used.number);
    const double by_table = tool == nullptr ? 0 : std::abs(tool->diameter.value());
    const double diameter = by_table > 0 ? by_table : machine.tool.diameter.value();
    list.push_back({{"tool", used.number},
                    {"diameter", diameter > 0 ? Json(diameter) : Json()},
                    {"zero_z", used.zero_z},
                    {"feeds", used.feeds}});
  }
  return list;
}

}  // namespace

WebAnswer path_answer(const StoredProgram& program, const MachineDescription& machine, const ToolTable& tools,
                      std::string_view query) {
  const ProgramPath& path = program.path_points;
  if (query_value(query, "chunk").empty()) {
    return json_answer(200, {{"program", program.id},
                             {"checks", program.checks},
                             {"growing", program.state == UploadState::checking},
                             {"complete", path.complete()},
                             {"cut_off", path.cut_off()},
                             {"points", path.points()},
                             {"chunks", path.chunks()},
                             {"levels", ProgramPath::levels},
                             {"all", as_json(path.all())},
                             {"cuts", as_json(path.cuts())},
                             {"work", as_json(path.work())},
                             {"reach", as_json(machine, path.reach())},
                             {"speeds", as_json(path.speeds())},
                             {"tools", tools_json(path, machine, tools)}});
  }
  const auto chunk = number_of(query, "chunk");
  const auto level = query_value(query, "level").empty() ? std::optional<std::uint64_t>(0) : number_of(query, "level");
  if (!chunk || !level || *chunk >= path.chunks() || *level >= ProgramPath::levels) {
    return bad_body("there is no such chunk, or no such level");
  }
  const std::uint64_t count = std::clamp<std::uint64_t>(number_of(query, "count").value_or(1), 1, most_chunks);
  WebAnswer answer{.type = "application/octet-stream"};
  for (std::uint64_t i = *chunk; i < std::min<std::uint64_t>(*chunk + count, path.chunks()); ++i) {
    answer.body += path.chunk(static_cast<std::size_t>(i), static_cast<unsigned>(*level));
  }
  return answer;
}

WebAnswer text_answer(const StoredProgram& program, std::string_view query) {
  const std::uint64_t from = number_of(query, "from").value_or(1);
  const std::uint64_t count = std::min(number_of(query, "lines").value_or(most_lines), most_lines);
  return {.type = "text/plain; charset=utf-8", .body = std::string(program.lines_from(from, count))};
}

WebAnswer height_map_answer(const HeightMap& map, std::string_view query) {
  if (query_value(query, "as") == "csv") return {.type = "text/csv", .body = text_of(map)};
  const MapFigures figures = figures_of(map);
  Json heights = Json::array();
  for (std::size_t row = 0; row < map.rows().size(); ++row) {
    Json line = Json::array();
    for (std::size_t column = 0; column < map.columns().size(); ++column) line.push_back(map.at(column, row));
    heights.push_back(std::move(line));
  }
  return json_answer(200, {{"columns", map.columns()},
                           {"rows", map.rows()},
                           {"heights", std::move(heights)},
                           {"lowest", figures.lowest},
                           {"highest", figures.highest},
                           {"mean", figures.mean},
                           {"rise_x", figures.rise_x},
                           {"rise_y", figures.rise_y},
                           {"off_plane", figures.farthest_off_plane}});
}

}  // namespace passo
