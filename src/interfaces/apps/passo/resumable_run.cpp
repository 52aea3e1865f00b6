#include "resumable_run.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "program_input.hpp"
#include "state_folder.hpp"
#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/job/state_file.hpp"

namespace passo {
namespace {

int refuse(std::string_view code, const std::string& words) {
  return fail(exit_not_resumed, fmt::format("{} [{}]", words, code));
}

int refuse(ResumeRefusal refusal) {
  return refuse(code_of(refusal), std::string(message_of(refusal)));
}

std::string describe(const ResumePoint& point, const MachineDescription& machine) {
  const std::string line = point.line == 0 ? "at the end of the program" : fmt::format("at line {}", point.line);
  return fmt::format("{} {} (machine coordinates)", line, place_words(machine, point.point));
}

// Refuses a file that is not the journal's, or that was changed since.
int refuse_changed(JobChange change, const FileStamp& now, const FileStamp& then) {
  if (now.name == then.name) return refuse(code_of(change), now.name + " was changed since the job started");
  return refuse(code_of(change), fmt::format("the unfinished job uses {}", then.name.empty() ? "-" : then.name));
}

int refuse(JobChange change, const JobIdentity& now, const JournalHead& then) {
  switch (change) {
    case JobChange::program: return refuse_changed(change, now.program, then.program);
    case JobChange::machine: return refuse_changed(change, now.machine, then.machine);
    case JobChange::version: break;
  }
  return refuse(code_of(change), "the job was started by version " + then.made_by);
}

}  // namespace

std::string ResumableRun::journal_of(const RunArguments& arguments) {
  return arguments.journal.empty() ? state_file(state_folder(), arguments.board, ".journal") : arguments.journal;
}

std::unique_ptr<ResumableRun> ResumableRun::open(const RunArguments& arguments, int& code) {
  code = exit_done;
  const std::string path = journal_of(arguments);
  if (path.empty()) {
    if (arguments.resume)
      code = refuse("resume.no-journal", "the location of the journal is unknown: neither HOME nor --journal is set");
    return nullptr;
  }
  std::unique_ptr<ResumableRun> run(new ResumableRun(path));
  run->resumes_ = arguments.resume;
  if (const auto claimed = run->file_.claim(); !claimed) {
    if (claimed.error() == EWOULDBLOCK) {
      code = fail(exit_failed, path + ": in use by another passo [journal.in-use]");
      return nullptr;
    }
    if (arguments.resume || !arguments.journal.empty()) {
      code = fail(exit_failed, fmt::format("{}: this journal cannot be opened: {} [journal.unreadable]", path,
                                           std::strerror(claimed.error())));
      return nullptr;
    }
  }
  FoundJournal found = run->file_.find();
  run->now_ = {.made_by = PASSO_VERSION,
               .program = stamp_of_file(arguments.program.program),
               .machine = stamp_of_file(arguments.machine)};
  code = run->judge_old(arguments, found);
  if (code != exit_done) return nullptr;
  run->before_ = std::move(found.journal);
  run->head_.made_by = run->now_.made_by;
  run->head_.program = run->now_.program;
  run->head_.machine = run->now_.machine;
  return run;
}

int ResumableRun::judge_old(const RunArguments& arguments, const FoundJournal& found) const {
  using Kind = FoundJournal::Kind;
  const std::string& path = file_.path();
  if (!arguments.resume) {
    // Is it a name that was mistyped?
    if (found.kind != Kind::foreign) return exit_done;
    return fail(exit_bad_program, path + ": not a journal of Passo, so it is not overwritten; choose another file");
  }
  switch (found.kind) {
    case Kind::none:
      return refuse("resume.no-journal", path + " does not exist: there is no unfinished job on this board");
    case Kind::torn: return refuse("resume.torn-journal", path + " is incomplete");
    case Kind::empty:
    case Kind::foreign: return refuse("resume.no-journal", path + " is not a journal of Passo");
    case Kind::whole: break;
  }
  const auto change = change_since(found.journal->head(), now_);
  return change ? refuse(*change, now_, found.journal->head()) : exit_done;
}

bool ResumableRun::suits(const Subject& subject, int& code) {
  head_.path = subject.path;
  head_.start = subject.options.start;
  if (!resumes_ || before_->head().path == subject.path) return true;
  code = refuse("resume.path-changed",
                "the program has a different meaning now: the options, or a subroutine, tool table, parameter or "
                "settings file, were changed since");
  return false;
}

std::optional<JobEntry> ResumableRun::find_place(MachineConnection& machine, const ProgramReader& program,
                                                 const Subject& subject, int& code) {
  if (const auto stranger = refuse_stranger(*before_, machine.before())) {
    code = refuse(*stranger);
    return {};
  }
  if (const auto words = machine.wait_for_rest()) {
    code = fail(exit_failed, "the board: " + *words);
    return {};
  }
  const BoardStatus& status = machine.before();
  const auto found = resume_point_of(*before_, status, program, subject.machine, subject.options);
  if (!found) {
    if (found.error() == ResumeRefusal::rest_unknown && before_->torn() > 0) {
      code = refuse("resume.torn-journal",
                    file_.path() + " is incomplete: it does not contain the point at which the board stopped");
    } else {
      code = refuse(found.error());
    }
    return {};
  }
  if (cuts_ != nullptr) {
    const JournalHead& old = before_->head();
    cuts_->recover(run_of(old),
                   cut_between(program.again(), subject.machine, subject.options, old.place, found->place, old.probes));
  }
  head_ = head_of_resumption(before_->head(), status, *found);
  JobEntry entry = entry_at_rest(before_->head(), *found, status, subject.machine);
  const auto known = machine.place();
  machine.start_at({.place = *entry.stands, .trust = known ? known->trust : Trust::counted});
  fmt::print(stderr, "passo: continues {}\n", describe(*found, subject.machine));
  return entry;
}

bool ResumableRun::begin(MachineConnection& machine, const ProgramReader& program, const Subject& subject, int& code) {
  BoardMachineSession& session = machine.session();
  const bool is_ready = session.state() != MachineState::offline;
  const BoardStatus status = is_ready ? *session.board().status() : machine.before();
  std::optional<JobEntry> entry;
  if (resumes_) {
    entry = find_place(machine, program, subject, code);
    if (!entry) return false;
  } else {
    // The old journal knows the board as it was before the hello.
    if (before_ && !refuse_rest(*before_, machine.before())) {
      const std::string name = std::filesystem::path(before_->head().program.name).filename().string();
      note(fmt::format("{} was left unfinished on this board; --resume would have continued it",
                       name.empty() ? "a program" : name));
    }
    head_ = head_of_beginning(std::move(head_), status, steps_at(subject.machine, session.status().position.place),
                              subject.machine.axes.size());
    if (subject.way) head_.place = subject.way->at.place;
  }
  const Greeting greeting = machine.any_greeting();
  head_.numbers.session = greeting.session;
  head_.numbers.greeting = is_ready ? std::uint8_t{0} : greeting.number;
  if (!write_head(subject, std::move(entry), code)) return false;
  if (is_ready) return machine.name_session(greeting.session, code);
  return machine.greet(greeting, code) && stands_there(session.board(), subject.machine, code);
}

bool ResumableRun::write_head(const Subject& subject, std::optional<JobEntry> entry, int& code) {
  if (run_.begin(head_, std::move(entry))) return true;
  const std::string words = file_.path() + ": this journal cannot be written: " + file_.trouble();
  if (resumes_ || !subject.arguments.journal.empty()) {
    code = fail(exit_failed, words);
    return false;
  }
  note(words + ", so the job could not be resumed after an interruption");
  return true;
}

// Whether the board, which was greeted meanwhile, still stands where the job is to be resumed.
bool ResumableRun::stands_there(const BoardSession& board, const MachineDescription& machine, int& code) const {
  const auto& entry = run_.entry();
  if (!entry || (board.status() && stands_at(head_, entry->at, *board.status(), machine))) return true;
  code = refuse(ResumeRefusal::counts_differ);
  return false;
}

void ResumableRun::end(const BoardMachineSession& session, const Answered& answered) {
  const JobEnd end = end_of_run(answered, session.status().trouble, resumes_);
  if (end == JobEnd::over) return file_.remove();
  if (!run_.is_written()) return note(file_.path() + ": this journal could not be written: " + file_.trouble());
  if (end == JobEnd::board_in_fault) return;  // --resume would be refused
  if (end == JobEnd::board_silent) {
    return note("the program is unfinished; if the board keeps its power, the same command with --resume continues it");
  }
  const FoundJournal found = file_.find();
  const auto& status = session.board().status();
  if (!found.journal || !status || refuse_rest(*found.journal, *status)) return;
  note("the program is unfinished; the same command with --resume continues it");
}

}  // namespace passo
