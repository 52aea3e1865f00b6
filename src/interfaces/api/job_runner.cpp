#include "job_runner.hpp"

#include <algorithm>
#include <utility>

#include "api_answers.hpp"
#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/activity/placed_tool_change.hpp"
#include "passo/activity/stage_options.hpp"
#include "passo/drive/backlash_options.hpp"
#include "passo/session/board_machine_session.hpp"
#include "passo/session/confirmed_place.hpp"

namespace passo {
namespace {

// How long a machine at rest may take to end its job.
constexpr Seconds a_turn{0.005};
constexpr int most_turns = 400;

// The first error, for the history, which outlives the findings.
Sentence first_error(const Diagnostics& findings, Sentence otherwise) {
  const auto& all = findings.all();
  const auto first = std::ranges::find(all, Severity::error, &Diagnostic::severity);
  if (first == all.end()) return otherwise;
  SentenceArguments arguments = held_as("finding", first->message);
  arguments.emplace_back("line", std::to_string(first->place.line));
  arguments.emplace_back("code", first->code);
  return {.code = "job.finding",
          .arguments = std::move(arguments),
          .text = fmt::format("line {}: {} [{}]", first->place.line, first->message, first->code)};
}

Sentence sentence_of_end() {
  return {.code = "job.server-ends", .text = "passo serve was shut down"};
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

std::string_view name_of(JobState state) {
  switch (state) {
    case JobState::none: return "none";
    case JobState::checking: return "checking";
    case JobState::running: return "running";
    case JobState::done: return "done";
    case JobState::stopped: return "stopped";
    case JobState::failed: return "failed";
    case JobState::interrupted: return "interrupted";
  }
  return "";
}

JobRunner::JobRunner(const ApiShared& shared, MdiLines& mdi) : shared_(shared), mdi_(mdi) {
  const ApiOptions& options = shared.options;
  if (options.workshop.records != nullptr)
    cuts_ = std::make_unique<CutRecorder>(*options.workshop.records, "passo serve");
  BoardMachineSession* const own = shared.session.as_board_session();
  if (own == nullptr || options.keeper == nullptr || options.history == nullptr) return;
  kept_ = std::make_unique<KeptJob>(
      shared.machine, *own, *options.keeper, *options.history,
      [&programs = shared.programs](Dialect dialect) { return programs.options_of(dialect); },
      KeptJob::Names{.made_by = options.version, .machine = options.machine_access.stamp});
  own->listen_before_hello(
      [this](const BoardStatus& status, const Greeting& greeting) { kept_->hear(status, greeting); });
  if (options.broken_off) kept_->find(*options.broken_off);
  if (cuts_) kept_->recover_cuts(*cuts_);
}

bool JobRunner::runs(const StoredProgram& program) const {
  if (parked_ && parked_->job.program == program.id) return true;
  return job_.state == JobState::running && job_.program == program.id;
}

bool JobRunner::waits_with(std::uint64_t program) const {
  return (parked_ && parked_->job.program == program) || (is_checking() && job_.program == program);
}

WebAnswer JobRunner::no_room_in_history() const {
  const std::string& trouble = shared_.options.history->trouble();
  return trouble.empty() ? no_room() : unwritten("the job", "job", trouble);
}

Result<Reentry, Sentence> JobRunner::way_to(const StoredProgram& program, const LinePlace& from) const {
  const MachineSession& session = shared_.session;
  const KnownPosition position = session.status().position;
  if (session.busy() || position.trust == Trust::unknown) {
    const RefusalReason reason = session.busy() ? RefusalReason::busy : RefusalReason::unknown_so_home;
    return Failure{Sentence{.code = session.busy() ? "reentry.place-unknown.busy" : "reentry.place-unknown",
                            .text = Refusal{reason}.message()}};
  }
  InterpreterOptions options = shared_.programs.options_of(program);
  options.start = position.place;
  auto way = reentry_at_line(ProgramReader::from_text(program.name, program.text), shared_.machine, options, from);
  if (way) return std::move(*way);
  return Failure{Sentence{.code = std::string(code_of(way.error().refusal)),
                          .arguments = {{"times", std::to_string(way.error().times)}},
                          .text = message_of(way.error())}};
}

// Why nothing begins where the machine stands.
std::optional<WebAnswer> JobRunner::refuse_begin() const {
  const MachineSession& session = shared_.session;
  if (session.state() != MachineState::idle) return not_idle(session.state());
  if (const auto refused = session.closed_limit()) return refused_answer(*refused);
  if (const auto refused = session.lost_place()) return refused_answer(*refused);
  return {};
}

WebAnswer JobRunner::begin(const StoredProgram& program, const Wanted& wanted) {
  if (auto refused = refuse_begin()) return std::move(*refused);
  if (interrupted() != nullptr) {
    return error_answer(409, "jobs.interrupted", "a job was interrupted: resume it or discard it first");
  }
  const bool is_checked = program.state == UploadState::good;
  if (is_checked && program.changes_tools_by_moves && !is_place_confirmed(shared_.session)) {
    Sentence why = sentence_of_unplaced_tool_change();
    return error_answer(409, why.code, why);
  }
  // A job that cannot be noted does not begin.
  std::int64_t number = wanted.history;
  if (number != 0) {
    // On the disk before the first move: after a power failure, a job that has moved must not look as if it waited.
    JobHistory& history = *shared_.options.history;
    if (!history.begin(number, shared_.wall_time())) return no_room_in_history();
    if (!history.keep()) {
      history.end(number, HistoryState::failed, "its start could not be written", shared_.wall_time());
      return no_room_in_history();
    }
  } else {
    const std::string& name = wanted.board_file.empty() ? program.name : wanted.board_file;
    const auto noted = note_job(name, program.dialect, program.text_to_keep());
    if (!noted) return no_room_in_history();
    number = *noted;
  }
  begins_ = {.from = wanted.from, .map_for = wanted.map_for, .board_file = wanted.board_file};
  return begin_check(program, number, shared_.session.status().position.place);
}

std::optional<std::int64_t> JobRunner::note_job(const std::string& name, Dialect dialect, const std::string& text) {
  JobHistory* const history = shared_.options.history;
  if (history == nullptr) return 0;
  return history->add_running(name, dialect_name(dialect), text, shared_.wall_time());
}

WebAnswer JobRunner::begin_unchecked(const std::string& board_file) {
  if (auto refused = refuse_begin()) return std::move(*refused);
  const auto noted = note_job(board_file, Dialect::grbl, "");
  if (!noted) return no_room_in_history();
  begins_ = {.owner = shared_.owner.changes(), .board_file = board_file};
  named_ = false;
  job_ = {.id = ++last_job_, .name = board_file, .state = JobState::checking, .why = {}, .history = *noted};
  start_board_file();
  return json_answer(202, as_json(job_));
}

WebAnswer JobRunner::begin_check(const StoredProgram& program, std::int64_t history, const Point& start) {
  named_ = false;
  job_ = {.id = ++last_job_,
          .program = program.id,
          .name = begins_.board_file.empty() ? program.name : begins_.board_file,
          .state = JobState::checking,
          .why = {},
          .history = history};
  begins_.owner = shared_.owner.changes();
  shared_.programs.check(program.id, shared_.machine, start);
  return json_answer(202, as_json(job_));
}

WebAnswer JobRunner::resume(bool by_a_way_back) {
  const InterruptedJob& broken = *kept_->interrupted();
  const MachineSession& session = shared_.session;
  if (session.state() != MachineState::idle) return not_idle(session.state());
  if (by_a_way_back) {
    if (const auto way = kept_->reentry(); !way) return error_answer(409, way.error().code, way.error());
  } else if (!broken.why.code.empty()) {
    return error_answer(409, broken.why.code, broken.why);
  }
  if (const auto refused = session.closed_limit()) return refused_answer(*refused);
  const InterpreterOptions options = kept_->options();
  const StoredProgram* const program = shared_.programs.add(broken.job.name, options.dialect, kept_->program());
  if (program == nullptr) return no_room();
  if (!shared_.options.history->begin(broken.job.id, shared_.wall_time())) {
    shared_.programs.remove(program->id);
    return no_room_in_history();
  }
  begins_ = {.resumes = true, .reenters = by_a_way_back};
  return begin_check(*program, broken.job.id, options.start);
}

bool JobRunner::call_off() {
  if (!is_checking() || shared_.session.busy()) return false;
  end_job(JobState::stopped, Sentence{.code = "job.called-off", .text = "cancelled before it started"});
  return true;
}

void JobRunner::poll() {
  if (kept_) kept_->poll();
  if (cuts_) cuts_->poll(shared_.wall_time());
  if (is_checking() && !shared_.programs.checks()) begin_checked_job();
}

void JobRunner::begin_checked_job() {
  if (!named_) return name_job();
  if (shared_.session.state() != MachineState::idle) {
    return end_job(JobState::interrupted, Sentence{.code = "job.board-lost", .text = "the board was lost"});
  }
  if (kept_->is_named()) start_job();
}

// The check is done, and the machine stands where the check began. With a journal, the board hears of the job first.
void JobRunner::name_job() {
  const StoredProgram& program = *shared_.programs.find(job_.program);
  if (shared_.owner.changes() != begins_.owner) {
    return end_job(JobState::stopped, Sentence{.code = "job.owner-changed", .text = "another client took control"});
  }
  if (program.state != UploadState::good) {
    return end_job(JobState::failed,
                   first_error(program.findings, Sentence{.code = "job.program-errors",
                                                          .text = "the program has errors: see its findings"}));
  }
  if (program.changes_tools_by_moves && !is_place_confirmed(shared_.session)) {
    return end_job(JobState::failed, sentence_of_unplaced_tool_change());
  }
  begins_.way.reset();
  if (goes_on_ || begins_.from) {
    auto way = goes_on_ ? way_behind_stop() : way_to(program, *begins_.from);
    if (!way) return end_job(JobState::failed, way.error());
    begins_.way = std::move(*way);
  }
  if (!kept_) return start_job();
  if (shared_.session.state() != MachineState::idle) {
    return end_job(JobState::failed, Sentence{.code = "job.not-idle", .text = "the machine is no longer idle"});
  }
  const Point stands = shared_.session.status().position.place;
  const bool begun = begins_.reenters ? kept_->reenter(program.path)
                     : begins_.resumes
                         ? kept_->resume(program.path)
                         : kept_->begin({.history = job_.history,
                                         .text = program.text_to_keep(),
                                         .path = program.path,
                                         .place = begins_.way ? begins_.way->at.place : PathPosition(),
                                         .start = goes_on_ ? parked_->start : stands,
                                         .probes = goes_on_ ? parked_->probes : std::vector<ProbeOutcome>()});
  if (begun) {
    named_ = true;
  } else if (const InterruptedJob* const broken = kept_->interrupted(); begins_.resumes && broken != nullptr) {
    end_job(JobState::interrupted, broken->why);
  } else {
    end_job(JobState::failed,
            sentence_of_unwritten("the journal of the job", "journal", shared_.options.keeper->trouble()));
  }
}

// The board reads the program from its own storage. Its lines do not come from here.
void JobRunner::start_board_file() {
  findings_.clear();
  log_.clear();
  const auto ticket = shared_.session.request(request::RunBoardFile{begins_.board_file});
  if (!ticket) return end_job(JobState::failed, ticket.error().sentence());
  start_ = shared_.session.status().position.place;
  probes_.clear();
  ticket_ = *ticket;
  job_.state = JobState::running;
  stopped_by_.reset();
}

void JobRunner::start_job() {
  if (!begins_.board_file.empty()) return start_board_file();
  const StoredProgram& program = *shared_.programs.find(job_.program);
  findings_.clear();
  request::Start start{.program = ProgramReader::from_text(program.name, program.text),
                       .options = shared_.programs.options_of(program)};
  start.nominal_time = program.check.nominal_time;
  start.findings = &findings_;
  log_.clear();
  start.watchers.operations = [this](const Operation& operation) { log_.record(operation); };
  start.options.start = goes_on_ ? parked_->start : shared_.session.status().position.place;
  if (begins_.way) {
    start.from = begins_.way->at;
    start.lead_in = begins_.way->lead_in;
  }
  if (goes_on_) start.known_probes = parked_->probes;
  if (named_) kept_->add_to(start);
  if (cuts_) cuts_->begin(start, named_ ? kept_->run() : std::string());
  const Point begins_at = start.options.start;
  std::vector<ProbeOutcome> probes = start.known_probes;
  const auto ticket = shared_.session.request(std::move(start));
  if (!ticket) return end_job(JobState::failed, ticket.error().sentence());
  start_ = begins_at;
  probes_ = std::move(probes);
  if (std::exchange(goes_on_, false)) parked_.reset();
  if (named_) kept_->forget_interrupted();
  ticket_ = *ticket;
  job_.state = JobState::running;
  stopped_by_.reset();
}

// A job that was broken off and did not begin again stays broken off.
void JobRunner::end_job(JobState state, Sentence why) {
  // What could not go on waits as before.
  if (std::exchange(goes_on_, false) && state == JobState::failed) {
    if (std::exchange(named_, false)) kept_->end(false);
    job_.state = JobState::running;
    job_.why = std::move(why);
    return;
  }
  if (cuts_) cuts_->end();
  if (parked_ && parked_->job.id == job_.id) parked_.reset();
  if (begins_.resumes && kept_->interrupted() != nullptr) state = JobState::interrupted;
  if (job_.state == JobState::running) mdi_.begin_anew();
  job_.state = state;
  job_.why = std::move(why);
  ticket_.reset();
  begins_.map_for = 0;
  ++ended_;
  if (named_) kept_->end(state == JobState::interrupted);
  named_ = false;
  if (job_.history == 0) return;
  shared_.options.history->end(job_.history, history_state_of(state), job_.why.text, shared_.wall_time(),
                               kept_form(job_.why));
}

// A hold amid the wait is no second one.
void JobRunner::record_wait() {
  const auto wait = shared_.session.status().waits_for;
  if (job_.history == 0 || !ticket_ || !wait || std::exchange(wait_noted_, true)) return;
  const bool is_tool = wait->kind == Action::Kind::tool_change;
  shared_.options.history->record_wait(job_.history, {.at = shared_.wall_time(),
                                                      .code = code_of(*wait),
                                                      .line = wait->line,
                                                      .tool = is_tool ? std::optional(wait->tool) : std::nullopt,
                                                      .words = wait->words});
}

void JobRunner::on_change(const MachineChange& change) {
  const bool runs_again = change.kind == MachineChange::Kind::state && change.state == MachineState::run;
  if (runs_again) wait_noted_ = false;
  if (change.kind == MachineChange::Kind::came_to_rest) record_wait();
  if (change.kind == MachineChange::Kind::probed && ticket_) probes_.push_back(*change.probe);
  if (change.kind == MachineChange::Kind::answered && ticket_ && change.ticket == *ticket_) on_end(change);
}

void JobRunner::on_end(const MachineChange& change) {
  // What was broken off by the board, or because the program ends, may go on.
  const bool is_broken_off =
      change.outcome == Outcome::failed ? change.fault && is_of_board(change.fault->fault) : leaves_;
  switch (change.outcome) {
    case Outcome::done:
      keep_results();
      end_job(JobState::done);
      break;
    case Outcome::stopped:
      end_job(named_ && is_broken_off ? JobState::interrupted : JobState::stopped,
              leaves_ ? sentence_of_end() : sentence_of_stop());
      break;
    case Outcome::failed: {
      // What came true only in the run: a probe that touched nothing, a way that leads out of the travel.
      const Sentence why = change.fault ? change.fault->sentence() : Sentence();
      const bool is_of_program = change.fault && change.fault->fault == MachineFault::program_wrong;
      end_job(named_ && is_broken_off ? JobState::interrupted : JobState::failed,
              is_of_program ? first_error(findings_, why) : why);
      break;
    }
  }
}

Sentence JobRunner::sentence_of_stop() const {
  if (!stopped_by_) return {.code = "job.stopped", .text = "it was stopped"};
  if (stopped_by_->empty()) {
    return {.code = "job.stopped-by-stranger", .text = "stopped by a client that is not in control"};
  }
  return {.code = "job.stopped-by", .arguments = {{"name", *stopped_by_}}, .text = "stopped by " + *stopped_by_};
}

// What a program has found, and set, counts when the program has come to its end.
void JobRunner::keep_results() {
  if (const auto results = shared_.session.program_results()) {
    shared_.offsets.adopt(results->parameters, results->tools);
  }
  if (begins_.map_for == 0) return;
  Diagnostics ignored;
  // Somebody may have deleted the program meanwhile: the map then stays with the cycle that has found it.
  const std::uint64_t owner = shared_.programs.find(begins_.map_for) != nullptr ? begins_.map_for : job_.program;
  if (auto map = read_height_map("log", log_.lines(), ignored)) {
    shared_.programs.set_height_map(owner, std::move(*map));
  }
}

bool JobRunner::is_free_to_move(const MachineStatus& status) const {
  if (parked_ || !ticket_ || job_.state != JobState::running || !status.waits_for || !status.rests) return false;
  return status.outputs.spindle == SpindleDirection::off &&
         !status.holds.any_of({HoldReason::operator_hold, HoldReason::door, HoldReason::stop}) &&
         !takes_up_backlash(step_options(shared_.machine));
}

void JobRunner::step_aside() {
  MachineSession& session = shared_.session;
  const MachineStatus status = session.status();
  if (!is_free_to_move(status)) return;
  parked_ = ParkedJob{.job = job_,
                      .wait = *status.waits_for,
                      .parameters = shared_.programs.parameters(),
                      .tools = shared_.programs.tools(),
                      .start = start_,
                      .probes = probes_};
  ticket_.reset();
  if (std::exchange(named_, false)) kept_->end(false);
  static_cast<void>(session.request(request::Stop{}).has_value());
  for (int turns = 0; session.busy() && turns < most_turns; ++turns) session.poll(a_turn);
  if (cuts_) cuts_->end();
  mdi_.begin_anew();
}

Result<Reentry, Sentence> JobRunner::way_behind_stop() const {
  return parked_->way_behind_stop(shared_.machine, shared_.programs, shared_.session.status().position.place);
}

WebAnswer JobRunner::go_on() {
  if (is_checking()) return not_idle(shared_.session.state());
  if (auto refused = refuse_begin()) return std::move(*refused);
  if (const auto way = way_behind_stop(); !way) return error_answer(409, way.error().code, way.error());
  job_ = parked_->job;
  job_.state = JobState::checking;
  job_.why = {};
  goes_on_ = true;
  named_ = false;
  begins_ = {.owner = shared_.owner.changes()};
  shared_.programs.check(job_.program, shared_.machine, parked_->start);
  return ticket_answer(shared_.session, 0);
}

WebAnswer JobRunner::stop_parked() {
  job_ = parked_->job;
  end_job(JobState::stopped, sentence_of_stop());
  return ticket_answer(shared_.session, 0);
}

WebAnswer JobRunner::parked_refusal() const {
  const std::string& name = parked_->job.name;
  const std::uint32_t line = parked_->wait.line;
  return error_answer(409, "jobs.waits",
                      Sentence{.code = "jobs.waits",
                               .arguments = {{"name", name}, {"line", std::to_string(line)}},
                               .text = fmt::format("{} waits at line {}: continue or stop it first", name, line)});
}

void JobRunner::leave() {
  leaves_ = true;
  stopped_by_.reset();
  if (!parked_) return;
  job_ = parked_->job;
  end_job(JobState::stopped, sentence_of_end());
}

}  // namespace passo
