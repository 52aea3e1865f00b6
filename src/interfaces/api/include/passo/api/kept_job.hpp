// KeptJob: the job that runs, kept so that the next program can go on with it; and the job of an earlier program that
// was broken off.
//
// Place: beside JobRunner. The journal (decision 0047) tells where on its path a board may rest; the history has the
// text of the job. A job that was broken off waits until somebody resumes it or drops it. See docs/decisions/0075.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "passo/api/program_store.hpp"
#include "passo/history/job_history.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/journal/reentry.hpp"
#include "passo/journal/resumption.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// Where the journal of a job is kept, and how the board hears the number by which it knows the job.
class JobKeeper {
 public:
  virtual ~JobKeeper() = default;
  virtual JournalStore& store() = 0;
  // The journal's text. Empty: there is none.
  virtual std::string read() = 0;
  // Why the journal could not be written last.
  virtual std::string trouble() { return {}; }
  virtual double noted_at() = 0;  // when it was last written; seconds since 1970
  // Removes the journal.
  virtual void remove() = 0;
  // A number for a session that is not the board's present one.
  virtual std::uint16_t new_number() = 0;
  // Tells the board its new number, at rest.
  virtual void name_session(std::uint16_t number) = 0;
};

// What a journal and a board tell of a job, before the board hears of a new session.
struct BrokenOff {
  JournalHead head;  // its place: where the board rests, if nothing is refused
  std::optional<ResumeRefusal> refused;
  PathPlace done;       // all before this place is executed
  PathPlace farthest;   // nothing after this place is
  double noted_at = 0;  // when the journal was last written; seconds since 1970
};
// A status in motion is refused. Takes the numbers of the greeting that follows into the head. Write the head as the
// new journal before the board is greeted, unless the job is refused.
BrokenOff broken_off(const Journal& journal, const BoardStatus& status, const Greeting& greeting);

// A job that was broken off, and why it cannot go on amid its path, if it cannot.
struct InterruptedJob {
  HistoryJob job;
  BrokenOff journal;
  std::optional<ResumePoint> point;  // where it rests on its path
  std::string code;
  std::string why;  // a sentence without a full stop
  // Where the machine may be led back onto the path: where it rests, or else before the last executed step.
  std::optional<ResumePoint> back_at;
  std::optional<Box> range;  // where its motors may have been stopped, if the board has lost its place
  std::string shift;         // what homing has found to be elsewhere than there; a sentence without a full stop
};

// Why something is refused, for an answer.
struct ReentryProblem {
  std::string_view code;
  std::string why;
};

class KeptJob {
 public:
  struct Names {
    std::string made_by;  // version of this program
    FileStamp machine;    // the machine's file
  };
  // All of them outlive this.
  KeptJob(const MachineDescription& machine, MachineSession& session, JobKeeper& keeper, JobHistory& history,
          const ProgramStore& programs, Names names);

  // Says what was found before the board was greeted. Goes through the program up to the place.
  void find(const BrokenOff& found);
  // The same for a board that was lost and is greeted again. look() finds the place later.
  void hear(const BoardStatus& status, const Greeting& greeting);
  void look();
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
  Result<Reentry, ReentryProblem> reentry();
  // The same as resume(), by that way.
  [[nodiscard]] bool reenter(std::uint64_t path);
  // True: the board has heard the number, so the job may begin.
  bool is_named() const { return session_.board().ready(); }
  // False: the journal of the job cannot be written any more, so it could not be resumed.
  bool is_written() const { return !writer_.failed(); }
  // For the job that is about to begin. Once it has begun, no other job is broken off.
  void add_to(request::Start& start);
  void forget_interrupted() { interrupted_.reset(); }
  // The job has ended. `may_go_on`: it was broken off, and is kept for the next program.
  void end(bool may_go_on);

 private:
  bool write(const JournalHead& head);
  void refuse(std::string_view code, std::string_view why);
  void mind_place();
  void compare_switches();
  void find_way_back(const std::string& text);
  bool is_of(std::uint64_t path);

  const MachineDescription& machine_;
  MachineSession& session_;
  JobKeeper& keeper_;
  JobHistory& history_;
  const ProgramStore& programs_;  // for the offsets
  Names names_;
  JournalWriter writer_;
  std::optional<InterruptedJob> interrupted_;
  std::optional<BrokenOff> heard_;
  bool resumes_ = false;
  std::optional<Reentry> way_;  // by which the job goes on
  Point stands_;                // where the job that is resumed stands, on its path
  Point hello_at_;              // where the machine stood at the hello, as far as was known
  bool is_compared_ = true;     // the switches were compared with the places before
};

}  // namespace passo
