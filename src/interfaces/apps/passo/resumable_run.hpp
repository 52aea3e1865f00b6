// ResumableRun: keeps the journal of a run over a line, so that another run can go on with the job. With --resume, it
// goes on with the job of an earlier journal.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "opened_machine.hpp"

#include "passo/activity/program.hpp"
#include "passo/job/job_identity.hpp"
#include "passo/job/journal_file.hpp"
#include "passo/job/journaled_run.hpp"

namespace passo {

class ResumableRun {
 public:
  // The program, the machine and the path of the run.
  struct Subject {
    const RunArguments& arguments;
    const MachineDescription& machine;
    const InterpreterOptions& options;
    const ProgramCheck& check;
    std::uint64_t path;                 // the path's fingerprint
    const std::optional<Reentry>& way;  // to the line where the program is to begin
  };
  // Reads the journal, if there is one. With --resume there must be a journal of this program on this machine. If there
  // is none, or if another program writes the journal, shows a message, sets `code` and returns null. If no journal can
  // be kept, returns null with `code` == exit_done.
  static std::unique_ptr<ResumableRun> open(const RunArguments& arguments, int& code);
  // The path of the journal of such a run; empty: there is no place for it.
  static std::string journal_of(const RunArguments& arguments);

  // With --resume: where the job began.
  std::optional<Point> start() const { return resumes_ ? std::optional(before_->head().start) : std::nullopt; }
  // With --resume, the program must mean what it meant. If it does not, shows a message and returns false.
  [[nodiscard]] bool suits(const Subject& subject, int& code);
  // With --resume, waits until the board rests and finds the place to go on from. Writes the head of the new journal.
  // Then greets the board with the head's numbers; if the machine is already ready, only names the session. If the
  // program cannot begin, shows a message and returns false. Call it after suits().
  [[nodiscard]] bool begin(OpenedMachine& machine, const ProgramReader& program, const Subject& subject, int& code);
  void add_to(request::Start& start) { run_.add_to(start); }
  // Call it after the run. Removes the journal if the program has come to its end, is wrong, or did not begin and was
  // not to be resumed. Otherwise the journal stays.
  void end(const MachineSession& session, const Answered& answered);

 private:
  explicit ResumableRun(const std::string& path) : file_(path), run_(file_) {}
  // What is in the place of the journal. Returns an exit code, with a message where the run cannot begin.
  int judge_old(const RunArguments& arguments, const FoundJournal& found) const;
  std::optional<JobEntry> find_place(OpenedMachine& machine, const ProgramReader& program, const Subject& subject,
                                     int& code);
  bool write_head(const Subject& subject, std::optional<JobEntry> entry, int& code);
  bool stands_there(const BoardSession& board, const MachineDescription& machine, int& code) const;

  JournalFile file_;
  JournaledRun run_;
  JobIdentity now_;
  std::optional<Journal> before_;
  JournalHead head_;
  bool resumes_ = false;
};

}  // namespace passo
