#include "jobs_api.hpp"

#include <algorithm>
#include <charconv>
#include <utility>
#include <vector>

#include "api_json.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "passo/api/deleted_lines.hpp"
#include "passo/probing/probing_cycle.hpp"

namespace passo {
namespace {

constexpr std::int64_t shown_of_history = 100;

// How many a client wants to see.
std::int64_t most_from(const ApiCall& call) {
  std::int64_t most = shown_of_history;
  const std::string_view digits = call.query("most");
  std::from_chars(digits.data(), digits.data() + digits.size(), most);
  return std::clamp<std::int64_t>(most, 1, JobHistory::most_ended);
}

WebAnswer jobs_answer(const std::vector<HistoryJob>& jobs) {
  Json list = Json::array();
  for (const HistoryJob& one : jobs) list.push_back(as_json(one));
  return json_answer(200, {{"jobs", std::move(list)}});
}

constexpr const char* bad_attempt = "the id of an attempt is 1 to 64 letters, digits, hyphens or underscores";
bool is_attempt(std::string_view id) {
  constexpr std::size_t longest = 64;
  const auto is_plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !id.empty() && id.size() <= longest && std::ranges::all_of(id, is_plain);
}

std::optional<ProbingKind> kind_named(const std::string& name) {
  for (const ProbingKind kind : all_probing_kinds()) {
    if (name_of(kind) == name) return kind;
  }
  return {};
}

// Empty, with the reason: the body is no cycle.
std::optional<ProbingCycle> cycle_from(const Json& body, std::uint64_t& program, std::string& reason) {
  const Json name = body.value("cycle", Json());
  const auto kind = name.is_string() ? kind_named(name.get<std::string>()) : std::nullopt;
  if (!kind) {
    std::vector<std::string_view> known;
    for (const ProbingKind one : all_probing_kinds()) known.push_back(name_of(one));
    reason = fmt::format("cycle: expected one of {}", fmt::join(known, ", "));
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
                           field == nullptr ? "this cycle has no such option" : "expected a number");
      return {};
    }
    field->value(cycle) = value.get<double>();
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

WebAnswer JobsApi::run(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  if (jobs_.is_checking()) return job_begins();
  if (jobs_.parked()) return jobs_.parked_refusal();
  if (call.query("from_line").empty()) return jobs_.begin(*program, {});
  const auto from = place_from(call.request.query);
  if (!from) return no_place();
  if (shared_.session.state() == MachineState::idle) {
    if (const auto way = jobs_.way_to(*program, *from); !way) {
      return error_answer(409, way.error().code, way.error());
    }
  }
  return jobs_.begin(*program, {.from = from});
}

WebAnswer JobsApi::way(const ApiCall& call) {
  const StoredProgram* const program = shared_.programs.find(call.id);
  if (program == nullptr) return refusal_answer(404);
  const auto from = place_from(call.request.query);
  return from ? json_answer(200, as_json(shared_.machine, jobs_.way_to(*program, *from))) : no_place();
}

WebAnswer JobsApi::probe(const ApiCall& call) {
  std::string reason;
  std::uint64_t target = 0;
  const auto cycle = cycle_from(call.members(), target, reason);
  if (!cycle) return bad_body(reason);
  const auto text = probing_program(*cycle);
  if (!text) return bad_body(text.error());
  ProgramStore& programs = shared_.programs;
  if (target != 0 && programs.find(target) == nullptr) return refusal_answer(404);
  jobs_.step_aside();
  const MachineSession& session = shared_.session;
  if (session.state() != MachineState::idle || jobs_.is_checking()) return not_idle(session.state());
  if (cycle->kind == ProbingKind::tool) {
    programs.set_offsets(programs.parameters(),
                         with_tool(programs.tools(), static_cast<std::int32_t>(cycle->tool.number)));
  }
  const StoredProgram* const program =
      programs.add(fmt::format("probe {}", name_of(cycle->kind)), Dialect::linuxcnc, *text);
  if (program == nullptr) return no_room();
  const std::uint64_t id = program->id;
  const bool makes_map = cycle->kind == ProbingKind::map;
  WebAnswer answer = jobs_.begin(*program, {.map_for = !makes_map ? 0 : target != 0 ? target : id});
  if (answer.status != 202) programs.remove(id);
  return answer;
}

WebAnswer JobsApi::log(const ApiCall&) {
  return json_answer(200, {{"job", jobs_.job().id}, {"words", jobs_.log().json()}});
}

WebAnswer JobsApi::list_queue(const ApiCall&) {
  return jobs_answer(shared_.options.history->queue());
}

Result<JobsApi::SentProgram, WebAnswer> JobsApi::sent_program(const ApiCall& call) {
  const auto dialect = dialect_from(call.request.query);
  if (!dialect) return Failure{dialect.error()};
  const auto name = name_from(call.request.query, "program");
  if (!name) return Failure{name.error()};
  const bool leaves_out = *dialect != Dialect::grbl && call.query("block_delete") == "true";
  const std::string& text = call.request.body;
  return SentProgram{.name = *name,
                     .dialect = std::string(dialect_name(*dialect)),
                     .text = leaves_out ? with_deleted_lines_as_comments(text) : text};
}

WebAnswer JobsApi::queue(const ApiCall& call) {
  JobHistory* const history = shared_.options.history;
  const auto sent = sent_program(call);
  if (!sent) return sent.error();
  const auto id = history->add(sent->name, sent->dialect, sent->text, shared_.wall_time());
  return id ? json_answer(201, as_json(*history->find(*id))) : jobs_.no_room_in_history();
}

// A client that got no answer repeats its request, and gets the job that it has queued before.
WebAnswer JobsApi::queue_attempt(const ApiCall& call) {
  JobHistory* const history = shared_.options.history;
  if (!is_attempt(call.rest)) return error_answer(400, "queue.attempt", bad_attempt);
  const auto sent = sent_program(call);
  if (!sent) return sent.error();
  const auto added = history->add_attempt(call.rest, sent->name, sent->dialect, sent->text, shared_.wall_time());
  if (!added.job) return jobs_.no_room_in_history();
  if (added.other_program) {
    return error_answer(409, "queue.other-program", "this attempt has been queued with another program");
  }
  const auto job = history->find(*added.job);
  return job ? json_answer(added.is_new ? 201 : 200, as_json(*job))
             : error_answer(410, "queue.attempt-removed", "this attempt was taken out of the queue before it began");
}

WebAnswer JobsApi::get_attempt(const ApiCall& call) {
  if (!is_attempt(call.rest)) return error_answer(400, "queue.attempt", bad_attempt);
  const auto job = shared_.options.history->find_attempt(call.rest);
  return job ? json_answer(200, as_json(*job)) : refusal_answer(404);
}

// The error: there is no such job in the queue, or nobody may touch it now.
Result<HistoryJob, WebAnswer> JobsApi::queued(std::uint64_t id) const {
  auto job = shared_.options.history->find(static_cast<std::int64_t>(std::min<std::uint64_t>(id, INT64_MAX)));
  if (!job || job->state != HistoryState::queued) return Failure{refusal_answer(404)};
  if (jobs_.is_checking()) return Failure{job_begins()};
  return std::move(*job);
}

WebAnswer JobsApi::delete_queued(const ApiCall& call) {
  const auto job = queued(call.id);
  if (!job) return job.error();
  const bool is_gone = shared_.options.history->remove(job->id);
  return is_gone ? json_answer(200, Json::object()) : jobs_.no_room_in_history();
}

WebAnswer JobsApi::run_queued(const ApiCall& call) {
  const auto job = queued(call.id);
  if (!job) return job.error();
  if (jobs_.parked()) return jobs_.parked_refusal();
  const StoredProgram* const program =
      shared_.programs.add(job->name, job->dialect == "grbl" ? Dialect::grbl : Dialect::linuxcnc,
                           shared_.options.history->program_of(job->id).value_or(""));
  if (program == nullptr) return no_room();
  const std::uint64_t stored = program->id;
  WebAnswer answer = jobs_.begin(*program, {.history = job->id});
  if (answer.status != 202) shared_.programs.remove(stored);
  return answer;
}

WebAnswer JobsApi::list_history(const ApiCall& call) {
  return jobs_answer(shared_.options.history->ended(most_from(call)));
}

WebAnswer JobsApi::list_alarms(const ApiCall& call) {
  Json list = Json::array();
  for (const HistoryAlarm& one : shared_.options.history->alarms(most_from(call))) {
    list.push_back({{"at", one.at}, {"words", one.words}, {"sentence", sentence_json(one.sentence, one.words)}});
  }
  return json_answer(200, {{"alarms", std::move(list)}});
}

WebAnswer JobsApi::get_interrupted(const ApiCall&) {
  const InterruptedJob* const job = jobs_.interrupted();
  Json json;
  if (job != nullptr) json = as_json(shared_.machine, *job, jobs_.way_of_interrupted());
  return json_answer(200, {{"interrupted", std::move(json)}});
}

std::optional<WebAnswer> JobsApi::refuse_interrupted() const {
  if (jobs_.interrupted() == nullptr) return refusal_answer(404);
  if (jobs_.is_checking()) return job_begins();
  return {};
}

WebAnswer JobsApi::drop_interrupted(const ApiCall&) {
  if (auto refused = refuse_interrupted()) return std::move(*refused);
  jobs_.drop_interrupted();
  return json_answer(200, Json::object());
}

WebAnswer JobsApi::resume_interrupted(const ApiCall&) {
  auto refused = refuse_interrupted();
  return refused ? std::move(*refused) : jobs_.resume(false);
}

WebAnswer JobsApi::reenter_interrupted(const ApiCall&) {
  auto refused = refuse_interrupted();
  return refused ? std::move(*refused) : jobs_.resume(true);
}

}  // namespace passo
