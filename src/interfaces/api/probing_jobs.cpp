// MachineApi: probing cycles as jobs, what a job says, height maps, and programs levelled by them.
#include <charconv>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/levelling/map_figures.hpp"
#include "passo/probing/levelled_program.hpp"
#include "passo/probing/probing_cycle.hpp"

namespace passo {
namespace {

constexpr double finest_tolerance = 1e-4;  // mm
constexpr double coarsest_tolerance = 10;

std::optional<ProbingKind> kind_named(const std::string& name) {
  for (const ProbingKind kind : all_probing_kinds()) {
    if (name_of(kind) == name) return kind;
  }
  return {};
}

// Empty, with the reason: the body is no cycle.
std::optional<ProbingCycle> cycle_from(const Json& body, std::uint64_t& program, std::string& reason) {
  const auto name = body.is_object() ? body.find("cycle") : body.end();
  const auto kind =
      body.is_object() && name != body.end() && name->is_string() ? kind_named(name->get<std::string>()) : std::nullopt;
  if (!kind) {
    reason = "cycle: expected surface, edge, corner, bore, boss, tool, angle or map";
    return {};
  }
  ProbingCycle cycle{.kind = *kind};
  for (const auto& [key, value] : body.items()) {
    if (key == "cycle") continue;
    if (key == "side" && value.is_string()) {
      cycle.side = value.get<std::string>();
      continue;
    }
    if (key == "program" && value.is_number_unsigned() && *kind == ProbingKind::map) {
      program = value.get<std::uint64_t>();
      continue;
    }
    const ProbingField* field = nullptr;
    for (const ProbingField& one : probing_fields()) field = one.name == key && one.is_of(*kind) ? &one : field;
    if (field == nullptr || !value.is_number()) {
      reason = fmt::format("{}: {}", key.substr(0, 40),
                           field == nullptr ? "this cycle does not know it" : "expected a number");
      return {};
    }
    cycle.*(field->value) = value.get<double>();
  }
  return cycle;
}

// A tool that is measured has to be in the table.
ToolTable with_tool(ToolTable tools, std::int32_t number) {
  if (tools.name.empty()) tools.name = "tool table";
  if (tools.find(number) == nullptr) static_cast<void>(tools.add({.number = number, .pocket = number}));
  return tools;
}

}  // namespace

WebAnswer MachineApi::begin_probing(std::string_view body) {
  std::string reason;
  std::uint64_t target = 0;
  const auto cycle = cycle_from(Json::parse(body, nullptr, false), target, reason);
  if (!cycle) return error_answer(400, "http.bad-body", reason);
  const auto text = probing_program(*cycle);
  if (!text) return error_answer(400, "http.bad-body", text.error());
  if (target != 0 && programs_.find(target) == nullptr) return refusal(404);
  step_aside();
  if (session_.state() != MachineState::idle || job_.state == JobState::checking) {
    return error_answer(409, "machine.busy", fmt::format("the machine is not idle: {}", name_of(session_.state())));
  }
  if (cycle->kind == ProbingKind::tool) {
    programs_.set_offsets(programs_.parameters(), with_tool(programs_.tools(), static_cast<std::int32_t>(cycle->tool)));
  }
  const StoredProgram* const program =
      programs_.add(fmt::format("probe {}", name_of(cycle->kind)), Dialect::linuxcnc, *text);
  if (program == nullptr) return no_room();
  const std::uint64_t id = program->id;
  WebAnswer answer = begin_job(*program, 0);
  if (answer.status != 202) {
    programs_.remove(id);
  } else if (cycle->kind == ProbingKind::map) {
    map_for_ = target != 0 ? target : id;
  }
  return answer;
}

void MachineApi::note_words(const Operation& operation) {
  if (words_.size() >= most_words) return;
  const auto note = [&](std::string_view kind, std::string_view text) {
    words_.push_back({.kind = kind, .line = operation.source.line, .text = std::string(text.substr(0, longest_words))});
  };
  if (const auto* print = std::get_if<operation::Print>(&operation.what)) note("print", print->text);
  if (const auto* message = std::get_if<operation::Message>(&operation.what)) note("message", message->text);
  const auto* log = std::get_if<operation::Log>(&operation.what);
  if (log != nullptr && log->kind == operation::Log::Kind::line) note("log", log->text);
}

// What a program has found, and set, counts when the program has come to its end.
void MachineApi::keep_results(const SavedParameters& parameters, const ToolTable& all_tools) {
  const ToolTable& tools = programs_.tools().name.empty() ? programs_.tools() : all_tools;
  const bool changed = parameters != programs_.parameters() || tools != programs_.tools();
  programs_.set_offsets(parameters, ToolTable(tools));
  if (changed) keep_offsets();
}

void MachineApi::keep_results() {
  if (const Program* const program = session_.program(); program != nullptr) {
    keep_results(program->saved_parameters(), program->tools());
  }
  if (map_for_ == 0) return;
  std::string text;
  for (const JobWords& words : words_) {
    if (words.kind == "log") text += words.text + "\n";
  }
  Diagnostics ignored;
  // Somebody may have deleted the program meanwhile: the map then stays with the cycle that has found it.
  const std::uint64_t owner = programs_.find(map_for_) != nullptr ? map_for_ : job_.program;
  if (auto map = read_height_map("log", text, ignored)) programs_.set_height_map(owner, std::move(*map));
}

WebAnswer MachineApi::words_answer() const {
  Json list = Json::array();
  for (const JobWords& words : words_) {
    list.push_back({{"kind", words.kind}, {"line", words.line}, {"text", words.text}});
  }
  return json_answer(200, {{"job", job_.id}, {"words", std::move(list)}});
}

WebAnswer MachineApi::take_height_map(const StoredProgram& program, const WebRequest& request) {
  Diagnostics findings;
  auto map = read_height_map("the body", request.body, findings);
  if (!map) return error_answer(400, "surface.height-map", findings.all().front().message);
  programs_.set_height_map(program.id, std::move(*map));
  return height_map_answer(*programs_.find(program.id), "");
}

WebAnswer height_map_answer(const StoredProgram& program, std::string_view query) {
  if (!program.height_map) return error_answer(404, "http.not-found", "this program has no height map");
  const HeightMap& map = *program.height_map;
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

// A program of its own, so that it is seen and checked like any other.
WebAnswer MachineApi::level_program(const StoredProgram& program, std::string_view query) {
  if (!program.height_map) return error_answer(404, "http.not-found", "this program has no height map");
  if (session_.state() != MachineState::idle || job_.state == JobState::checking) {
    return error_answer(409, "machine.busy", fmt::format("the machine is not idle: {}", name_of(session_.state())));
  }
  if (program.text.size() > longest_to_level) return refusal(413);
  LevelOptions wish;
  if (const std::string_view tolerance = query_value(query, "tolerance"); !tolerance.empty()) {
    wish.tolerance = 0;
    std::from_chars(tolerance.data(), tolerance.data() + tolerance.size(), wish.tolerance);
  }
  if (!(wish.tolerance >= finest_tolerance && wish.tolerance <= coarsest_tolerance)) {
    return error_answer(400, "http.bad-body",
                        fmt::format("tolerance: expected {:g} to {:g} mm", finest_tolerance, coarsest_tolerance));
  }
  const std::string_view holes = query_value(query, "holes");
  if (!holes.empty() && holes != "true" && holes != "false") {
    return error_answer(400, "http.bad-body", "holes: expected true or false");
  }
  wish.holes = holes == "true";
  Diagnostics findings;
  InterpreterOptions options = programs_.options_of(program);
  options.start = session_.status().position.place;
  options.on_machine = true;
  std::string text;
  write_levelled_program(ProgramReader::from_text(program.name, program.text), options, *program.height_map, wish,
                         findings, [&](std::string_view piece) { text += piece; });
  if (findings.any_error()) {
    for (const Diagnostic& one : findings.all()) {
      if (one.severity != Severity::error) continue;
      return error_answer(409, one.code, fmt::format("line {}: {}", one.place.line, one.message));
    }
  }
  const StoredProgram* const levelled = programs_.add("level " + program.name, Dialect::linuxcnc, std::move(text));
  if (levelled == nullptr) return no_room();
  Json answer = as_json(*levelled, false);
  answer["findings"] = as_json(findings);
  return json_answer(201, std::move(answer));
}

}  // namespace passo
