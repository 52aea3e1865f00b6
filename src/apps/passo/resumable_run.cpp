#include "resumable_run.hpp"

#include <filesystem>
#include <random>
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

void note(const std::string& words) {
  fmt::print(stderr, "passo: note: {}\n", words);
}

// A number for the new session, by which the board is recognised later. Differs from `before`, the board's last
// session, and is never 0 or 1.
std::uint16_t any_session(std::uint16_t before) {
  std::random_device random;
  std::uniform_int_distribution<unsigned> numbers(2, 65535);
  auto session = static_cast<std::uint16_t>(numbers(random));
  while (session == before) session = static_cast<std::uint16_t>(numbers(random));
  return session;
}

std::uint8_t any_greeting() {
  std::random_device random;
  return static_cast<std::uint8_t>(std::uniform_int_distribution<unsigned>(1, 255)(random));
}

std::string place_words(const ResumePoint& point, const MachineDescription& machine) {
  std::string words = point.line == 0 ? "at the end of the program" : fmt::format("at line {}", point.line);
  for (const AxisDescription& axis : machine.axes) {
    words += fmt::format(" {}{:.3f}", letter_of(axis.axis), point.point[axis.axis]);
  }
  return words + " (machine coordinates)";
}

// Refuses a program that is not the journal's, or that was changed since.
int refuse_changed(const FileStamp& now, const FileStamp& then, std::string_view code) {
  if (now.name == then.name) return refuse(code, now.name + " was changed since the job began");
  return refuse(code, fmt::format("the job that was not finished is of {}", then.name.empty() ? "-" : then.name));
}

}  // namespace

std::unique_ptr<ResumableRun> ResumableRun::open(const Subject& subject, int& code) {
  const RunArguments& arguments = subject.arguments;
  code = exit_done;
  if (subject.check.probes) {
    if (arguments.resume) code = fail(exit_bad_program, "--resume: not for a program with probe moves yet");
    return nullptr;
  }
  const std::string path = arguments.journal.empty() ? usual_journal(arguments.board) : arguments.journal;
  if (path.empty()) {
    if (arguments.resume) code = refuse("resume.no-journal", "no HOME, and no --journal: where is the journal?");
    return nullptr;
  }
  std::unique_ptr<ResumableRun> run(new ResumableRun(path));
  run->resumes_ = arguments.resume;
  const std::optional<std::string> text = read_journal(path);
  if (text) run->before_ = Journal::read(*text);
  run->head_.made_by = PASSO_VERSION;
  run->head_.program = stamp_of(arguments.program.program);
  run->head_.machine = stamp_of(arguments.machine);
  run->head_.path = subject.path;
  if (!arguments.resume) return run;

  const JournalHead& now = run->head_;
  if (!text) {
    code = refuse("resume.no-journal", path + " is not there: nothing on this board was left unfinished");
  } else if (!run->before_) {
    code = refuse("resume.torn-journal", path + " is not whole");
  } else if (const JournalHead& then = run->before_->head(); then.made_by != now.made_by) {
    code = refuse("resume.other-version", "the job was begun by version " + then.made_by);
  } else if (then.program != now.program) {
    code = refuse_changed(now.program, then.program, "resume.program-changed");
  } else if (then.machine != now.machine) {
    code = refuse_changed(now.machine, then.machine, "resume.machine-changed");
  } else if (then.path != now.path) {
    code = refuse("resume.path-changed",
                  "the program does not mean what it meant: other options, or a sub, tool table, parameter or settings "
                  "file was changed since");
  }
  if (code != exit_done) return nullptr;
  return run;
}

bool ResumableRun::find_place(OpenedMachine& machine, const ProgramReader& program, const Subject& subject, int& code) {
  if (const auto stranger = refuse_stranger(*before_, machine.before())) {
    code = refuse(*stranger);
    return false;
  }
  if (!machine.wait_for_rest()) {
    code = fail(exit_failed, "the board: it does not answer any more");
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
  fmt::print(stderr, "passo: goes on {}\n", place_words(*point_, subject.machine));
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
    if (before_ && before_->is_of(machine.before())) {
      const std::string name = std::filesystem::path(before_->head().program.name).filename().string();
      note(fmt::format("{} was not finished on this board; --resume would have gone on with it",
                       name.empty() ? "a program" : name));
    }
    head_ = head_of_beginning(std::move(head_), status, steps_at(subject.machine, session.status().position.place),
                              subject.machine.axes.size());
  }
  head_.session = any_session(status.session);
  head_.greeting = is_ready ? std::uint8_t{0} : any_greeting();
  if (!write_head(subject, code)) return false;
  if (!is_ready) {
    return machine.greet({.session = head_.session, .number = head_.greeting}, code) &&
           stands_there(session.board(), code);
  }
  session.name_session(head_.session);
  if (await(session.board(), [&] { return session.board().ready(); })) return true;
  code = fail(exit_failed, "the board: it does not answer any more");
  return false;
}

bool ResumableRun::write_head(const Subject& subject, int& code) {
  writer_.begin(head_);
  if (!writer_.failed()) return true;
  const std::string words = file_.path() + ": this journal cannot be written";
  if (resumes_ || !subject.arguments.journal.empty()) {
    code = fail(exit_failed, words);
    return false;
  }
  note(words + ", so the job could not be resumed if it were broken off");
  return true;
}

// Whether the board, which was greeted meanwhile, still stands where the job is to be resumed.
bool ResumableRun::stands_there(const BoardSession& board, int& code) const {
  if (!point_ || (board.status() && stands_at(head_, *point_, *board.status()))) return true;
  code = refuse(ResumeRefusal::counts_differ);
  return false;
}

void ResumableRun::add_to(request::Start& start) {
  start.from = point_;
  start.watchers.rests = [this](const BoardRest& rest) { writer_.note(rest); };
}

void ResumableRun::end(const MachineSession& session, const Answered& answered) {
  const auto trouble = session.status().trouble;
  const bool ended = !trouble && answered.outcome == Outcome::done;
  const bool by_program = answered.fault && answered.fault->code == "program.wrong";
  if (ended || by_program) return file_.remove();
  // The machine's place is not certain. So --resume would be refused, and the note below would be wrong.
  if (trouble == LinkError::stopped || trouble == LinkError::was_reset) return;
  if (writer_.failed()) return note(file_.path() + ": this journal could not be written");
  note("the program has not come to its end; the same command with --resume goes on with it");
}

}  // namespace passo
