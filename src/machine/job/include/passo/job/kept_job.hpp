// KeptJob: the running job, recorded so that the next process can continue it; and the interrupted job of an earlier
// process.
//
// Position in the pipeline: below the API's JobRunner. The journal (decision 0047) has the possible stop points of a
// board on the path; the history has the text of the job. An interrupted job waits until it is resumed or discarded.
// See docs/decisions/0075.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/interpreter/interpreter.hpp"
#include "passo/job/cut_recorder.hpp"
#include "passo/job/interrupted_job.hpp"
#include "passo/job/job_history.hpp"
#include "passo/job/job_identity.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {

class KeptJob {
 public:
  struct Names {
    std::string made_by;  // version of this software
    FileStamp machine;    // the machine file
  };
  // Returns the current offsets and tools for a program of that dialect.
  using OptionsOf = std::function<InterpreterOptions(Dialect dialect)>;
  // All of them must outlive this object.
  KeptJob(const MachineDescription& machine, BoardMachineSession& session, JobKeeper& keeper, JobHistory& history,
          OptionsOf options_of, Names names);

  // Processes the job found before the handshake. Interprets the program up to the job's position.
  void find(const BrokenOff& found);
  // The same for a board that was disconnected, at another handshake. poll() determines the position later.
  void hear(const BoardStatus& status, const Greeting& greeting);
  void poll();
  // Returns null if there is no interrupted job. The reason is up to date, because the machine may have moved since.
  const InterruptedJob* interrupted();
  // The job's program, and its start.
  std::string program() const;
  InterpreterOptions options() const;
  void drop();
  // Records what the interrupted job has cut, if the process that ran it could not.
  void recover_cuts(CutRecorder& cuts) const;

  struct Beginning {
    std::int64_t history = 0;
    std::string text;
    std::uint64_t path = 0;            // the fingerprint of the job's path
    PathPosition place;                // the position on the path where it begins
    Point start;                       // start point of the path
    std::vector<ProbeOutcome> probes;  // the results of the probe moves before that position
  };
  // Begins the journal of a job: writes its head, and gives the board a new session number. Returns false if the
  // journal cannot be written.
  [[nodiscard]] bool begin(Beginning job);
  // The same, to continue the interrupted job. False, with the reason in interrupted(): it cannot continue.
  [[nodiscard]] bool resume(std::uint64_t path);
  // Returns the path back to the job from the current position.
  Result<Reentry, Sentence> reentry();
  // The same as resume(), on that path.
  [[nodiscard]] bool reenter(std::uint64_t path);
  // Returns true if the board has received the number, so the job may start.
  bool is_named() const { return session_.board().ready(); }
  // run_of() the journal of the job that is about to start.
  const std::string& run() const { return begun_run_; }
  // Returns false if a write to the journal of the job failed, so the job could not be resumed.
  bool is_written() const { return run_.is_written(); }
  // For the job that is about to start. After its start, an earlier interrupted job is no longer offered.
  void add_to(request::Start& start);
  void forget_interrupted() { interrupted_.reset(); }
  // Records the end of the job. `may_go_on`: it was interrupted, and is kept for the next process.
  void end(bool may_go_on);

 private:
  bool write(const JournalHead& head, std::optional<JobEntry> entry);
  void refuse(std::string_view code, std::string_view why, SentenceArguments arguments = {});
  void check_place();
  void compare_switches();
  void find_way_back(const std::string& text);
  bool is_of(std::uint64_t path);

  const MachineDescription& machine_;
  BoardMachineSession& session_;
  JobKeeper& keeper_;
  JobHistory& history_;
  OptionsOf options_of_;
  Names names_;
  JournaledRun run_;
  std::optional<InterruptedJob> interrupted_;
  std::optional<BrokenOff> heard_;
  std::string begun_run_;
  Point hello_at_;           // the position at the handshake, as far as known
  bool is_compared_ = true;  // the switch positions were compared with the previous ones
};

}  // namespace passo
