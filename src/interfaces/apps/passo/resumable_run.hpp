// ResumableRun: writes the journal of a run over a serial link, so that another run can resume the job. With --resume,
// it resumes the job of an earlier journal.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "machine_connection.hpp"

#include "passo/activity/program.hpp"
#include "passo/job/cut_recorder.hpp"
#include "passo/job/job_identity.hpp"
#include "passo/job/journal_file.hpp"
#include "passo/job/journaled_run.hpp"
#include "passo/journal/cut_between.hpp"

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
    const std::optional<Reentry>& way;  // the reentry move to the line at which the program is to start
  };
  // Reads the journal, if there is one. With --resume there must be a journal of this program on this machine. If there
  // is none, or if another program is writing the journal, shows a message, sets `code` and returns null. If no journal
  // can be kept, returns null with `code` == exit_done.
  static std::unique_ptr<ResumableRun> open(const RunArguments& arguments, int& code);
  // Returns the path of the journal of such a run; empty: it cannot be stored.
  static std::string journal_of(const RunArguments& arguments);

  // With --resume: returns the original start position of the job.
  std::optional<Point> start() const { return resumes_ ? std::optional(before_->head().start) : std::nullopt; }
  // With --resume, the meaning of the program must be unchanged. If it is not, shows a message and returns false.
  [[nodiscard]] bool suits(const Subject& subject, int& code);
  // With --resume, waits until the board is stopped and determines the resume position. Writes the head of the new
  // journal. Then performs the handshake with the head's numbers; if the machine is already ready, only sets the
  // session number. If the program cannot begin, shows a message and returns false. Must be called after suits().
  [[nodiscard]] bool begin(MachineConnection& machine, const ProgramReader& program, const Subject& subject, int& code);
  // With --resume, begin() also records what the interrupted run has cut, if it was killed. `cuts` must outlive this.
  void count_into(CutRecorder& cuts) { cuts_ = &cuts; }
  // run_of() the journal of the run that is about to start.
  std::string run() const { return run_of(head_); }
  void add_to(request::Start& start) { run_.add_to(start); }
  // Must be called after the run. Removes the journal if the program has reached its end, is invalid, or did not begin
  // and was not to be resumed. Otherwise the journal stays.
  void end(const BoardMachineSession& session, const Answered& answered);

 private:
  explicit ResumableRun(const std::string& path) : file_(path), run_(file_) {}
  // Evaluates an existing journal file. Returns an exit code, with a message if the run cannot begin.
  int judge_old(const RunArguments& arguments, const FoundJournal& found) const;
  std::optional<JobEntry> find_place(MachineConnection& machine, const ProgramReader& program, const Subject& subject,
                                     int& code);
  bool write_head(const Subject& subject, std::optional<JobEntry> entry, int& code);
  bool stands_there(const BoardSession& board, const MachineDescription& machine, int& code) const;

  JournalFile file_;
  JournaledRun run_;
  JobIdentity now_;
  std::optional<Journal> before_;
  JournalHead head_;
  bool resumes_ = false;
  CutRecorder* cuts_ = nullptr;  // null: not counted
};

}  // namespace passo
