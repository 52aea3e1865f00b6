// MachineApi: how a program becomes a job, and what becomes of the job.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// The first error, for the history, which outlives the findings.
std::string words_of_error(const Diagnostics& findings, std::string else_words) {
  const auto& all = findings.all();
  const auto first = std::ranges::find(all, Severity::error, &Diagnostic::severity);
  if (first == all.end()) return else_words;
  return fmt::format("line {}: {} [{}]", first->place.line, first->message, first->code);
}

HistoryState history_state_of(JobState state) {
  switch (state) {
    case JobState::done: return HistoryState::done;
    case JobState::failed: return HistoryState::failed;
    case JobState::interrupted: return HistoryState::interrupted;
    default: return HistoryState::stopped;
  }
}

}  // namespace

WebAnswer no_history() {
  return error_answer(404, "data.none", "passo serve keeps nothing: start it with --data DIR");
}

WebAnswer no_room() {
  return error_answer(507, "programs.no-room", "there are too many programs: delete some first");
}

WebAnswer unwritten(std::string_view what, std::string_view why) {
  return error_answer(507, "data.unwritten", fmt::format("{} cannot be written: {}", what, why));
}

WebAnswer MachineApi::no_room_in_history() const {
  const std::string& trouble = options_.history->trouble();
  return trouble.empty() ? no_room() : unwritten("the job", trouble);
}

WebAnswer no_place() {
  return bad_body(
      "from_line: expected the number of a line, 1 or more; pass: a number, 1 or more; after: millimetres, 0 or more");
}

std::optional<LinePlace> place_from(std::string_view query) {
  const auto read = [query](const char* key, auto& value) {
    const std::string_view text = query_value(query, key);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
  };
  const auto is_given = [query](const char* key) { return !query_value(query, key).empty(); };
  LinePlace place;
  double after = 0;
  if (!read("from_line", place.line) || place.line == 0) return {};
  if (is_given("pass") && (!read("pass", place.pass) || place.pass == 0)) return {};
  if (is_given("after") && (!read("after", after) || !std::isfinite(after) || after < 0)) return {};
  place.after = Mm(after);
  return place;
}

// From where the machine stands to the first motion of a line. Goes through the program.
Result<Reentry, ReentryProblem> MachineApi::way_to(const StoredProgram& program, const LinePlace& from) const {
  const KnownPosition position = session_.status().position;
  const auto refused = [](ReentryRefusal refusal) {
    return Failure{ReentryProblem{.code = code_of(refusal), .why = std::string(message_of(refusal))}};
  };
  if (session_.busy() || position.trust == Trust::unknown) {
    return Failure{ReentryProblem{
        .code = "reentry.place-unknown",
        .why = session_.busy() ? "the machine is busy" : "where the machine stands is not known: home it first"}};
  }
  InterpreterOptions options = programs_.options_of(program);
  options.start = position.place;
  const auto at = find_line(ProgramReader::from_text(program.name, program.text), machine_, options, from);
  if (!at) return Failure{ReentryProblem{.code = code_of(at.error().refusal), .why = message_of(at.error())}};
  auto way = plan_reentry(machine_, *at, position.place);
  if (!way) return refused(way.error());
  return std::move(*way);
}

WebAnswer MachineApi::run_program(const StoredProgram& program, std::string_view query) {
  if (query_value(query, "from_line").empty()) return begin_job(program, 0);
  const auto from = place_from(query);
  if (!from) return no_place();
  if (session_.state() == MachineState::idle) {
    if (const auto way = way_to(program, *from); !way) return error_answer(409, way.error().code, way.error().why);
  }
  WebAnswer answer = begin_job(program, 0);
  if (answer.status == 202) from_ = from;
  return answer;
}

WebAnswer MachineApi::begin_job(const StoredProgram& program, std::int64_t history) {
  if (session_.state() != MachineState::idle) {
    return error_answer(409, "machine.busy", fmt::format("the machine is not idle: {}", name_of(session_.state())));
  }
  if (const auto refused = session_.closed_limit()) return error_answer(409, code_of(refused->code), refused->message);
  if (const auto refused = session_.lost_place()) return error_answer(409, code_of(refused->code), refused->message);
  if (kept_ && kept_->interrupted() != nullptr) {
    return error_answer(409, "jobs.interrupted", "a job was broken off: resume it or drop it first");
  }
  // A job that cannot be noted does not begin.
  if (history != 0) {
    if (!options_.history->begin(history, wall_time())) return no_room_in_history();
  } else if (options_.history != nullptr) {
    const char* const dialect = program.dialect == Dialect::grbl ? "grbl" : "linuxcnc";
    history = options_.history->add_running(program.name, dialect, program.text_to_keep(), wall_time()).value_or(0);
    if (history == 0) return no_room_in_history();
  }
  resumes_ = reenters_ = named_ = false;
  from_.reset();
  map_for_ = 0;
  job_ = {.id = ++last_job_,
          .program = program.id,
          .name = program.name,
          .state = JobState::checking,
          .why = {},
          .history = history};
  job_owner_ = owner_.changes();
  programs_.check(program.id, machine_, session_.status().position.place);
  return json_answer(202, as_json(job_));
}

WebAnswer MachineApi::change_interrupted(const FoundRoute& found) {
  if (options_.history == nullptr) return no_history();
  if (!kept_ || kept_->interrupted() == nullptr) return refusal(404);
  if (job_.state == JobState::checking) return error_answer(409, "machine.busy", "a job is about to begin");
  if (found.route->path.ends_with("/resume")) return resume_job(false);
  if (found.route->path.ends_with("/reenter")) return resume_job(true);
  kept_->drop();
  return json_answer(200, Json::object());
}

std::optional<Point> MachineApi::broken_off_at() {
  const InterruptedJob* const job = kept_ ? kept_->interrupted() : nullptr;
  return job != nullptr && job->back_at ? std::optional(job->back_at->point) : std::nullopt;
}

// The job that was broken off goes on amid its path. It is checked from where it began.
WebAnswer MachineApi::resume_job(bool by_a_way_back) {
  const InterruptedJob& broken = *kept_->interrupted();
  if (session_.state() != MachineState::idle) {
    return error_answer(409, "machine.busy", fmt::format("the machine is not idle: {}", name_of(session_.state())));
  }
  if (by_a_way_back) {
    if (const auto way = kept_->reentry(); !way) return error_answer(409, way.error().code, way.error().why);
  } else if (!broken.code.empty()) {
    return error_answer(409, broken.code, broken.why);
  }
  if (const auto refused = session_.closed_limit()) return error_answer(409, code_of(refused->code), refused->message);
  const InterpreterOptions options = kept_->options();
  const StoredProgram* const program = programs_.add(broken.job.name, options.dialect, kept_->program());
  if (program == nullptr) return no_room();
  if (!options_.history->begin(broken.job.id, wall_time())) {
    programs_.remove(program->id);
    return no_room_in_history();
  }
  resumes_ = true;
  reenters_ = by_a_way_back;
  from_.reset();
  named_ = false;
  job_ = {.id = ++last_job_,
          .program = program->id,
          .name = program->name,
          .state = JobState::checking,
          .why = {},
          .history = broken.job.id};
  job_owner_ = owner_.changes();
  programs_.check(program->id, machine_, options.start);
  return json_answer(202, as_json(job_));
}

void MachineApi::begin_checked_job() {
  if (!named_) return name_job();
  if (session_.state() != MachineState::idle) return end_job(JobState::interrupted, "the board was lost");
  if (kept_->is_named()) start_job();
}

// The check is done, and the machine stands where the check began. With a journal, the board hears of the job first.
void MachineApi::name_job() {
  const StoredProgram& program = *programs_.find(job_.program);
  if (owner_.changes() != job_owner_) return end_job(JobState::stopped, "the ownership of motion was passed on");
  if (program.state != UploadState::good) {
    return end_job(JobState::failed, words_of_error(program.findings, "the program has errors: see its findings"));
  }
  way_.reset();
  if (goes_on_) {
    auto way = way_behind_stop();
    if (!way) return end_job(JobState::failed, way.error().why);
    way_ = std::move(*way);
  }
  if (from_) {
    auto way = way_to(program, *from_);
    if (!way) return end_job(JobState::failed, way.error().why);
    way_ = std::move(*way);
  }
  if (!kept_) return start_job();
  if (session_.state() != MachineState::idle) return end_job(JobState::failed, "the machine is not idle any more");
  const bool begun = reenters_  ? kept_->reenter(program.path)
                     : resumes_ ? kept_->resume(program.path)
                                : kept_->begin({.history = job_.history,
                                                .text = program.text_to_keep(),
                                                .path = program.path,
                                                .place = way_ ? way_->at.place : PathPlace(),
                                                .start = goes_on_ ? parked_->start : session_.status().position.place,
                                                .probes = goes_on_ ? parked_->probes : std::vector<ProbeOutcome>()});
  if (begun) {
    named_ = true;
  } else if (const InterruptedJob* const broken = kept_->interrupted(); resumes_ && broken != nullptr) {
    end_job(JobState::interrupted, broken->why);
  } else {
    end_job(JobState::failed, "the journal of the job cannot be written: " + options_.keeper->trouble());
  }
}

void MachineApi::start_job() {
  const StoredProgram& program = *programs_.find(job_.program);
  findings_.clear();
  request::Start start{.program = ProgramReader::from_text(program.name, program.text),
                       .options = programs_.options_of(program)};
  start.nominal_time = program.check.nominal_time;
  start.findings = &findings_;
  words_.clear();
  start.watchers.operations = [this](const Operation& operation) { note_words(operation); };
  start.options.start = goes_on_ ? parked_->start : session_.status().position.place;
  if (way_) {
    start.from = way_->at;
    start.lead_in = way_->lead_in;
  }
  if (goes_on_) start.known_probes = parked_->probes;
  if (named_) kept_->add_to(start);
  const Point begins_at = start.options.start;
  std::vector<ProbeOutcome> probes = start.known_probes;
  const auto ticket = session_.request(std::move(start));
  if (!ticket) return end_job(JobState::failed, ticket.error().message);
  job_start_ = begins_at;
  probes_ = std::move(probes);
  if (std::exchange(goes_on_, false)) parked_.reset();
  if (named_) kept_->forget_interrupted();
  ticket_ = *ticket;
  job_.state = JobState::running;
  stopped_by_.clear();
}

// A job that was broken off and did not begin again stays broken off.
void MachineApi::end_job(JobState state, std::string why) {
  // What could not go on waits as before.
  if (std::exchange(goes_on_, false) && state == JobState::failed) {
    if (std::exchange(named_, false)) kept_->end(false);
    job_.state = JobState::running;
    job_.why = std::move(why);
    return;
  }
  if (parked_ && parked_->job.id == job_.id) parked_.reset();
  if (resumes_ && kept_->interrupted() != nullptr) state = JobState::interrupted;
  if (job_.state == JobState::running) mdi_.begin_anew();
  job_.state = state;
  job_.why = std::move(why);
  ticket_.reset();
  map_for_ = 0;
  ++jobs_ended_;
  if (named_) kept_->end(state == JobState::interrupted);
  named_ = false;
  if (job_.history != 0) options_.history->end(job_.history, history_state_of(state), job_.why, wall_time());
}

// A hold amid the wait is no second one.
void MachineApi::note_wait() {
  const auto wait = session_.status().waits_for;
  if (job_.history == 0 || !ticket_ || !wait || std::exchange(wait_noted_, true)) return;
  const bool is_tool = wait->kind == Action::Kind::tool_change;
  options_.history->note_wait(job_.history, {.at = wall_time(),
                                             .code = code_of(*wait),
                                             .line = wait->line,
                                             .tool = is_tool ? std::optional(wait->tool) : std::nullopt,
                                             .words = wait->words});
}

void MachineApi::heed_state(MachineState state) {
  if (state == MachineState::run) wait_noted_ = false;
  if (state == MachineState::alarm || state == MachineState::fault) note_alarm();
  const HomingPath* const homing = session_.homing();
  if (state == MachineState::home && homing != nullptr) {
    const bool was_known = session_.status().position.trust == Trust::homed;
    homes_from_ = was_known ? std::optional(homing->start()) : std::nullopt;
  } else if (homes_ && state == MachineState::idle && homing != nullptr && homing->done()) {
    homed_ = homing->homed();
    repeats_.note(homed_, homes_from_);
  }
  homes_ = state == MachineState::home;
}

void MachineApi::heed(const std::vector<MachineChange>& changes) {
  for (const MachineChange& change : changes) {
    mdi_.heed(change);
    if (change.kind == MachineChange::Kind::rested_by_tail) ++late_;
    if (change.kind == MachineChange::Kind::state) heed_state(change.state);
    if (change.kind == MachineChange::Kind::came_to_rest) note_wait();
    if (change.kind == MachineChange::Kind::probed && ticket_) probes_.push_back(*change.probe);
    if (change.kind != MachineChange::Kind::answered || !ticket_ || change.ticket != *ticket_) continue;
    // What was broken off by the board, or because the program ends, may go on.
    const bool is_broken_off =
        change.outcome == Outcome::failed ? change.fault && change.fault->code.starts_with("board.") : leaves_;
    switch (change.outcome) {
      case Outcome::done:
        keep_results();
        end_job(JobState::done);
        break;
      case Outcome::stopped:
        end_job(named_ && is_broken_off ? JobState::interrupted : JobState::stopped,
                leaves_               ? "passo serve was told to end"
                : stopped_by_.empty() ? "it was stopped"
                                      : "stopped by " + stopped_by_);
        break;
      case Outcome::failed: {
        // What came true only in the run: a probe that touched nothing, a way that leads out of the travel.
        const std::string words = change.fault ? change.fault->message : "";
        const bool is_of_program = change.fault && change.fault->code == "program.wrong";
        end_job(named_ && is_broken_off ? JobState::interrupted : JobState::failed,
                is_of_program ? words_of_error(findings_, words) : words);
        break;
      }
    }
  }
}

}  // namespace passo
