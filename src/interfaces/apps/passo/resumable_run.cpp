#include "resumable_run.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/link/await.hpp"

namespace passo {
namespace {

int refuse(std::string_view code, const std::string& words) {
  return fail(exit_not_resumed, fmt::format("{} [{}]", words, code));
}

int refuse(ResumeRefusal refusal) {
  return refuse(code_of(refusal), std::string(message_of(refusal)));
}

std::string words_of(const ResumePoint& point, const MachineDescription& machine) {
  const std::string line = point.line == 0 ? "at the end of the program" : fmt::format("at line {}", point.line);
  return fmt::format("{} {} (machine coordinates)", line, place_words(machine, point.point));
}

// Refuses a program that is not the journal's, or that was changed since.
int refuse_changed(const FileStamp& now, const FileStamp& then, std::string_view code) {
  if (now.name == then.name) return refuse(code, now.name + " was changed since the job began");
  return refuse(code, fmt::format("the job that was not finished is of {}", then.name.empty() ? "-" : then.name));
}

}  // namespace

std::string ResumableRun::journal_of(const RunArguments& arguments) {
  return arguments.journal.empty() ? state_file(arguments.board, ".journal") : arguments.journal;
}

std::unique_ptr<ResumableRun> ResumableRun::open(const RunArguments& arguments, int& code) {
  code = exit_done;
  const std::string path = journal_of(arguments);
  if (path.empty()) {
    if (arguments.resume) code = refuse("resume.no-journal", "no HOME, and no --journal: where is the journal?");
    return nullptr;
  }
  std::unique_ptr<ResumableRun> run(new ResumableRun(path));
  run->resumes_ = arguments.resume;
  if (const auto claimed = run->file_.claim(); !claimed) {
    if (claimed.error() == EWOULDBLOCK) {
      code = fail(exit_failed, path + ": another passo that runs now keeps this journal [journal.in-use]");
      return nullptr;
    }
    if (arguments.resume || !arguments.journal.empty()) {
      code = fail(exit_failed, fmt::format("{}: this journal cannot be opened: {} [journal.unreadable]", path,
                                           std::strerror(claimed.error())));
      return nullptr;
    }
  }
  const std::optional<std::string> text = read_state_file(path);
  if (text) run->before_ = Journal::read(*text);
  run->head_.made_by = PASSO_VERSION;
  run->head_.program = stamp_of(arguments.program.program);
  run->head_.machine = stamp_of(arguments.machine);
  if (!arguments.resume) {
    // Is it a name that was mistyped? Of a file that is too long for a journal there is no text.
    std::error_code none;
    if (!text || Journal::is_journal(*text) || std::filesystem::is_empty(path, none)) return run;
    code = fail(exit_bad_program, path + ": no journal of Passo's, and would be overwritten; name another file");
    return nullptr;
  }
  const JournalHead& now = run->head_;
  if (!text) {
    code = refuse("resume.no-journal", path + " is not there: nothing on this board was left unfinished");
  } else if (!run->before_) {
    code = Journal::is_journal(*text) ? refuse("resume.torn-journal", path + " is not whole")
                                      : refuse("resume.no-journal", path + " is no journal of Passo's");
  } else if (const JournalHead& then = run->before_->head(); then.made_by != now.made_by) {
    code = refuse("resume.other-version", "the job was begun by version " + then.made_by);
  } else if (then.program != now.program) {
    code = refuse_changed(now.program, then.program, "resume.program-changed");
  } else if (then.machine != now.machine) {
    code = refuse_changed(now.machine, then.machine, "resume.machine-changed");
  }
  if (code != exit_done) return nullptr;
  return run;
}

bool ResumableRun::suits(const Subject& subject, int& code) {
  head_.path = subject.path;
  head_.start = subject.options.start;
  if (!resumes_ || before_->head().path == subject.path) return true;
  code = refuse("resume.path-changed",
                "the program does not mean what it meant: other options, or a sub, tool table, parameter or settings "
                "file was changed since");
  return false;
}

bool ResumableRun::find_place(OpenedMachine& machine, const ProgramReader& program, const Subject& subject, int& code) {
  if (const auto stranger = refuse_stranger(*before_, machine.before())) {
    code = refuse(*stranger);
    return false;
  }
  if (const auto words = machine.wait_for_rest()) {
    code = fail(exit_failed, "the board: " + *words);
    return false;
  }
  const auto found = resume_point_of(*before_, machine.before(), program, subject.machine, subject.options);
  if (!found) {
    if (found.error() == ResumeRefusal::rest_unknown && before_->torn() > 0) {
      code = refuse("resume.torn-journal", file_.path() + " is not whole, and the board's rest is not in it");
    } else {
      code = refuse(found.error());
    }
    return false;
  }
  point_ = *found;
  head_ = head_of_resumption(before_->head(), machine.before(), *point_);
  const auto known = machine.place();
  stands_ = place_by_counts(before_->head(), *point_, machine.before(), subject.machine);
  machine.start_at({.place = stands_, .trust = known ? known->trust : Trust::counted});
  fmt::print(stderr, "passo: goes on {}\n", words_of(*point_, subject.machine));
  return true;
}

bool ResumableRun::begin(OpenedMachine& machine, const ProgramReader& program, const Subject& subject, int& code) {
  MachineSession& session = machine.session();
  const bool is_ready = session.state() != MachineState::offline;
  const BoardStatus status = is_ready ? *session.board().status() : machine.before();
  if (resumes_) {
    if (!find_place(machine, program, subject, code)) return false;
  } else {
    // The old journal knows the board as it was before the hello.
    if (before_ && !refuse_rest(*before_, machine.before())) {
      const std::string name = std::filesystem::path(before_->head().program.name).filename().string();
      note(fmt::format("{} was not finished on this board; --resume would have gone on with it",
                       name.empty() ? "a program" : name));
    }
    head_ = head_of_beginning(std::move(head_), status, steps_at(subject.machine, session.status().position.place),
                              subject.machine.axes.size());
    if (subject.way) head_.place = subject.way->at.place;
  }
  const Greeting greeting = machine.any_greeting();
  head_.numbers.session = greeting.session;
  head_.numbers.greeting = is_ready ? std::uint8_t{0} : greeting.number;
  if (!write_head(subject, code)) return false;
  if (is_ready) return machine.name_session(greeting.session, code);
  return machine.greet(greeting, code) && stands_there(session.board(), subject.machine, code);
}

bool ResumableRun::write_head(const Subject& subject, int& code) {
  writer_.begin(head_);
  if (!writer_.failed()) return true;
  const std::string words = file_.path() + ": this journal cannot be written: " + file_.trouble();
  if (resumes_ || !subject.arguments.journal.empty()) {
    code = fail(exit_failed, words);
    return false;
  }
  note(words + ", so the job could not be resumed if it were broken off");
  return true;
}

// Whether the board, which was greeted meanwhile, still stands where the job is to be resumed.
bool ResumableRun::stands_there(const BoardSession& board, const MachineDescription& machine, int& code) const {
  if (!point_ || (board.status() && stands_at(head_, *point_, *board.status(), machine))) return true;
  code = refuse(ResumeRefusal::counts_differ);
  return false;
}

void ResumableRun::add_to(request::Start& start) {
  if (point_) {
    start.from = point_;
    start.lead_in = way_back_of_probe(*point_, stands_);
    start.stands = stands_;
    start.known_probes = head_.probes;
  }
  start.watchers.probe = [this](const ProbeOutcome& outcome) { writer_.note(outcome); };
  start.watchers.rests = [this](const BoardRest& rest) { writer_.note(rest); };
}

void ResumableRun::end(const MachineSession& session, const Answered& answered) {
  const auto trouble = session.status().trouble;
  const bool ended = !trouble && answered.outcome == Outcome::done;
  const bool is_refused = answered.refused && answered.refused->code != RefusalCode::place_unknown;
  const bool is_of_program = answered.fault && answered.fault->fault == MachineFault::program_wrong;
  if (ended || (is_refused && !resumes_) || is_of_program) return file_.remove();
  if (writer_.failed()) return note(file_.path() + ": this journal could not be written: " + file_.trouble());
  if (trouble && *trouble != LinkError::no_answer) return;  // --resume would be refused
  if (trouble) {
    return note(
        "the program has not come to its end; if the board keeps its power, the same command with --resume goes "
        "on with it");
  }
  const std::optional<std::string> text = read_state_file(file_.path());
  const std::optional<Journal> journal = text ? Journal::read(*text) : std::nullopt;
  const auto& status = session.board().status();
  if (!journal || !status || refuse_rest(*journal, *status)) return;
  note("the program has not come to its end; the same command with --resume goes on with it");
}

}  // namespace passo
