// KeptJob: the job that runs, kept so that the next program can go on with it; and the job of an earlier program that
// was broken off.
//
// Place: below the API's JobRunner. The journal (decision 0047) tells where on its path a board may rest; the history
// has the text of the job. A job that was broken off waits until somebody resumes it or drops it. See
// docs/decisions/0075.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/history/job_history.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/job/interrupted_job.hpp"
#include "passo/job/job_identity.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class KeptJob {
 public:
  struct Names {
    std::string made_by;  // version of this program
    FileStamp machine;    // the machine's file
  };
  // The offsets and the tools that a program of that dialect finds now.
  using OptionsOf = std::function<InterpreterOptions(Dialect dialect)>;
  // All of them outlive this.
  KeptJob(const MachineDescription& machine, MachineSession& session, JobKeeper& keeper, JobHistory& history,
          OptionsOf options_of, Names names);

  // Says what was found before the board was greeted. Goes through the program up to the place.
  void find(const BrokenOff& found);
  // The same for a board that was lost and is greeted again. poll() finds the place later.
  void hear(const BoardStatus& status, const Greeting& greeting);
  void poll();
  // Null: no job was broken off. Its reason is as of now: the machine may have been moved since.
  const InterruptedJob* interrupted();
  // The job's program, and where it began.
  std::string program() const;
  InterpreterOptions options() const;
  void drop();

  struct Beginning {
    std::int64_t history = 0;
    std::string text;
    std::uint64_t path = 0;            // the fingerprint of the job's path
    PathPlace place;                   // where on its path it begins
    Point start;                       // where its path begins
    std::vector<ProbeOutcome> probes;  // what the probe moves before that place have found
  };
  // Begins the journal of a job: writes its head, and gives the board a new number. False: the journal cannot be
  // written.
  [[nodiscard]] bool begin(Beginning job);
  // The same, to go on with the job that was broken off. False, with the reason in interrupted(): it cannot go on.
  [[nodiscard]] bool resume(std::uint64_t path);
  // The way back onto the path of the job, from where the machine stands now.
  Result<Reentry, Sentence> reentry();
  // The same as resume(), by that way.
  [[nodiscard]] bool reenter(std::uint64_t path);
  // True: the board has heard the number, so the job may begin.
  bool is_named() const { return session_.board().ready(); }
  // False: the journal of the job cannot be written any more, so it could not be resumed.
  bool is_written() const { return run_.is_written(); }
  // For the job that is about to begin. Once it has begun, no other job is broken off.
  void add_to(request::Start& start);
  void forget_interrupted() { interrupted_.reset(); }
  // The job has ended. `may_go_on`: it was broken off, and is kept for the next program.
  void end(bool may_go_on);

 private:
  bool write(const JournalHead& head, std::optional<JobEntry> entry);
  void refuse(std::string_view code, std::string_view why, SentenceArguments arguments = {});
  void check_place();
  void compare_switches();
  void find_way_back(const std::string& text);
  bool is_of(std::uint64_t path);

  const MachineDescription& machine_;
  MachineSession& session_;
  JobKeeper& keeper_;
  JobHistory& history_;
  OptionsOf options_of_;
  Names names_;
  JournaledRun run_;
  std::optional<InterruptedJob> interrupted_;
  std::optional<BrokenOff> heard_;
  Point hello_at_;           // where the machine stood at the hello, as far as was known
  bool is_compared_ = true;  // the switches were compared with the places before
};

}  // namespace passo
