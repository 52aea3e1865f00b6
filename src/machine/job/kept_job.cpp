#include "passo/job/kept_job.hpp"

#include <charconv>
#include <utility>

#include "passo/journal/cut_between.hpp"

namespace passo {
namespace {

constexpr std::string_view stamp_title = "job ";

std::string title_of(std::int64_t number) {
  return std::string(stamp_title) + std::to_string(number);
}

// The number of a job in the history, from the name in its stamp. 0: it is none.
std::int64_t number_of(std::string_view name) {
  std::int64_t number = 0;
  if (!name.starts_with(stamp_title)) return 0;
  name.remove_prefix(stamp_title.size());
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : 0;
}

std::string describe(JobChange change, const JournalHead& then) {
  switch (change) {
    case JobChange::version: return "the job was started by version " + then.made_by;
    case JobChange::program: return "the history has another program under the job's number";
    case JobChange::machine: return "the machine file is different, or has changed since";
  }
  return "";
}

}  // namespace

KeptJob::KeptJob(const MachineDescription& machine, BoardMachineSession& session, JobKeeper& keeper,
                 JobHistory& history, OptionsOf options_of, Names names)
    : machine_(machine),
      session_(session),
      keeper_(keeper),
      history_(history),
      options_of_(std::move(options_of)),
      names_(std::move(names)),
      run_(keeper.store()) {}

void KeptJob::refuse(std::string_view code, std::string_view why, SentenceArguments arguments) {
  interrupted_->why = {std::string(code), std::move(arguments), std::string(why)};
}

void KeptJob::find(const BrokenOff& found) {
  const std::int64_t number = number_of(found.head.program.name);
  const auto job = history_.find(number);
  if (!job || job->state != HistoryState::interrupted) return keeper_.remove();
  interrupted_.emplace();
  interrupted_->job = *job;
  interrupted_->journal = found;
  const std::string text = program();
  const JobIdentity now{
      .made_by = names_.made_by, .program = stamp_of(title_of(number), text), .machine = names_.machine};
  if (const auto change = change_since(found.head, now))
    return refuse(code_of(*change), describe(*change, found.head), {{"version", found.head.made_by}});
  find_way_back(text);
  if (found.refused) return refuse(code_of(*found.refused), message_of(*found.refused));
  interrupted_->point = find_resume_point(ProgramReader::from_text(job->name, text), machine_, options(),
                                          found.head.place, found.head.probes);
  if (!interrupted_->point)
    return refuse(code_of(ResumeRefusal::path_changed), message_of(ResumeRefusal::path_changed));
  if (interrupted_->point->in_thread) refuse(code_of(ResumeRefusal::in_thread), message_of(ResumeRefusal::in_thread));
}

// The board's place is lost with its power. Then the switches tell how far the machine is from where it was.
void KeptJob::find_way_back(const std::string& text) {
  const BrokenOff& found = interrupted_->journal;
  const auto program = ProgramReader::from_text(interrupted_->job.name, text);
  interrupted_->back_at = find_resume_point(program.again(), machine_, options(), found.done, found.head.probes);
  hello_at_ = session_.status().position.place;
  is_compared_ = found.refused != ResumeRefusal::board_reset;
  // A job that has not come beyond its beginning may still have been on its way there.
  const bool is_on_its_path = found.done != found.head.place;
  if (!is_compared_ && is_on_its_path) {
    interrupted_->range =
        range_between(program.again(), machine_, options(), found.done, found.farthest, found.head.probes);
  }
}

void KeptJob::compare_switches() {
  const HomingPath* const homing = session_.homing();
  if (is_compared_ || homing == nullptr || session_.busy() || session_.status().position.trust != Trust::homed) return;
  is_compared_ = true;
  if (!interrupted_->range) return;
  interrupted_->shift = words_of_shift(machine_, homing->homed(), *interrupted_->range, homing->start() - hello_at_);
}

Result<Reentry, Sentence> KeptJob::reentry() {
  const KnownPosition position = session_.status().position;
  if (!interrupted_->back_at) {
    return Failure{interrupted_->why};
  }
  if (position.trust == Trust::unknown) {
    return Failure{Sentence{.code = "reentry.place-unknown", .text = "the machine position is unknown: home it first"}};
  }
  if (!interrupted_->shift.empty()) return Failure{Sentence{.code = "reentry.shifted", .text = interrupted_->shift}};
  auto way = plan_reentry(machine_, *interrupted_->back_at, position.place);
  if (way) return std::move(*way);
  return Failure{Sentence{.code = std::string(code_of(way.error())), .text = std::string(message_of(way.error()))}};
}

void KeptJob::hear(const BoardStatus& status, const Greeting& greeting) {
  if (auto found = resume_job(keeper_, run_, status, greeting)) heard_ = std::move(found);
}

void KeptJob::poll() {
  if (interrupted_) compare_switches();
  if (!heard_ || session_.state() == MachineState::offline) return;
  find(*std::exchange(heard_, std::nullopt));
}

// Somebody may have moved the machine, and may have moved it back.
void KeptJob::check_place() {
  const bool is_sure = interrupted_->point && !interrupted_->journal.refused && !interrupted_->point->in_thread;
  const auto& status = session_.board().status();
  if (!is_sure || session_.state() != MachineState::idle || !status) return;
  interrupted_->why = {};
  if (stands_at(interrupted_->journal.head, *interrupted_->point, *status, machine_)) return;
  refuse(code_of(ResumeRefusal::counts_differ),
         "the machine has been moved since then: move it back to where the job stopped");
}

const InterruptedJob* KeptJob::interrupted() {
  if (!interrupted_) return nullptr;
  check_place();
  return &*interrupted_;
}

std::string KeptJob::program() const {
  return history_.program_of(interrupted_->job.id).value_or("");
}

InterpreterOptions KeptJob::options() const {
  InterpreterOptions options = options_of_(interrupted_->job.dialect == "grbl" ? Dialect::grbl : Dialect::linuxcnc);
  options.start = interrupted_->journal.head.start;
  return options;
}

// The path up to there was found by find_way_back(), so it is that of the job.
void KeptJob::recover_cuts(CutRecorder& cuts) const {
  if (!interrupted_ || !interrupted_->back_at) return;
  const BrokenOff& found = interrupted_->journal;
  const auto text = ProgramReader::from_text(interrupted_->job.name, program());
  cuts.recover(found.run, cut_between(text.again(), machine_, options(), found.began, found.done, found.head.probes));
}

void KeptJob::drop() {
  interrupted_.reset();
  keeper_.remove();
}

bool KeptJob::write(const JournalHead& head, std::optional<JobEntry> entry) {
  if (!run_.begin(head, std::move(entry))) return false;
  begun_run_ = run_of(head);
  keeper_.name_session(head.numbers.session);
  return true;
}

bool KeptJob::begin(Beginning job) {
  const auto& status = session_.board().status();
  if (!status || !session_.zero_counts()) return false;
  JournalHead head{.made_by = names_.made_by,
                   .program = stamp_of(title_of(job.history), job.text),
                   .machine = names_.machine,
                   .path = job.path,
                   .job_counts = {},
                   .start = job.start,
                   .numbers = {.session_before = status->session,
                               .executed_before = status->executed,
                               .greeting = 0,
                               .session = keeper_.new_number()},
                   .place = job.place,
                   .probes = std::move(job.probes)};
  for (std::size_t m = 0; m < machine_.axes.size(); ++m) {
    head.job_counts.push_back(static_cast<int>((*session_.zero_counts())[m]));
  }
  return write(head, {});
}

bool KeptJob::is_of(std::uint64_t path) {
  if (path == interrupted_->journal.head.path) return true;
  interrupted_->point.reset();
  interrupted_->back_at.reset();
  refuse(code_of(ResumeRefusal::path_changed), message_of(ResumeRefusal::path_changed));
  return false;
}

bool KeptJob::reenter(std::uint64_t path) {
  if (!is_of(path)) return false;
  const auto way = reentry();
  if (!way) return false;
  const JournalHead& before = interrupted_->journal.head;
  JournalHead head = head_of_resumption(before, *session_.board().status(), way->at);
  for (std::size_t m = 0; m < machine_.axes.size(); ++m) {
    head.job_counts[m] = static_cast<int>((*session_.zero_counts())[m]);
  }
  head.numbers.greeting = 0;
  head.numbers.session = keeper_.new_number();
  return write(head, entry_by_way(*way, before.probes));
}

bool KeptJob::resume(std::uint64_t path) {
  if (!is_of(path)) return false;
  check_place();
  if (!interrupted_->why.code.empty()) return false;
  const BoardStatus& status = *session_.board().status();
  const JournalHead& before = interrupted_->journal.head;
  JournalHead head = head_of_resumption(before, status, *interrupted_->point);
  head.numbers.greeting = 0;
  head.numbers.session = keeper_.new_number();
  return write(head, entry_at_rest(before, *interrupted_->point, status, machine_));
}

void KeptJob::add_to(request::Start& start) {
  if (run_.entry()) start.options = options();
  run_.add_to(start);
}

void KeptJob::end(bool may_go_on) {
  if (!may_go_on) keeper_.remove();
}

}  // namespace passo
