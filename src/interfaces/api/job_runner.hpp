// JobRunner: the job that runs, from its check to its end, and the job that waits for a person meanwhile.
//
//   begin() -> check -> the board hears of the job (with a journal) -> the session runs it -> end
//                                                                   -> step_aside() -> go_on() -> check …
//
// Place: what moves the machine by programs, for JobsApi and MachineApi. Private to api/. Only one job runs at a time.
// A job that was broken off, or waits, is not lost: see KeptJob and ParkedJob.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api_shared.hpp"
#include "job_log.hpp"
#include "parked_job.hpp"

#include "passo/api/api_job.hpp"
#include "passo/api/mdi_lines.hpp"

namespace passo {

class JobRunner {
 public:
  // All of them outlive this.
  JobRunner(const ApiShared& shared, MdiLines& mdi);

  const ApiJob& job() const { return job_; }
  bool is_checking() const { return job_.state == JobState::checking; }
  // The program runs, or its job waits for a person.
  bool runs(const StoredProgram& program) const;
  // The program is about to run, or its job waits for a person.
  bool waits_with(std::uint64_t program) const;
  const std::optional<ParkedJob>& parked() const { return parked_; }
  bool goes_on() const { return goes_on_; }
  const JobLog& log() const { return log_; }
  std::uint64_t jobs_ended() const { return ended_; }
  // False: the journal of the job cannot be written.
  bool is_journal_written() const { return !named_ || kept_->is_written(); }
  // The job that was broken off. Null: there is none.
  const InterruptedJob* interrupted() const { return kept_ ? kept_->interrupted() : nullptr; }
  Result<Reentry, Sentence> way_of_interrupted() { return kept_->reentry(); }
  void drop_interrupted() { kept_->drop(); }
  // From where the machine stands to the first motion of a line. Goes through the program.
  Result<Reentry, Sentence> way_to(const StoredProgram& program, const LinePlace& from) const;

  struct Wanted {
    std::int64_t history = 0;            // its number in the history; 0: it gets one
    std::optional<LinePlace> from = {};  // where it is to begin; empty: at its beginning
    std::uint64_t map_for = 0;           // the program that gets the height map which the job probes; 0: it probes none
  };
  WebAnswer begin(const StoredProgram& program, const Wanted& wanted);
  // The job that was broken off goes on amid its path. It is checked from where it began.
  WebAnswer resume(bool by_a_way_back);
  // True: the job had not begun yet, and does not begin any more.
  bool call_off();
  // Who is about to stop the job.
  // `who`: empty for a client that is not in control. Nothing: it has no name.
  void set_stopped_by(std::optional<std::string> who) { stopped_by_ = std::move(who); }

  // The spindle stands, and the machine can be led back onto the path.
  bool is_free_to_move(const MachineStatus& status) const;
  // The motion of a job that waits ends here, if that is possible, so that a person may move the machine.
  void step_aside();
  // The parked job is checked with what counts now, and begins behind its stop.
  WebAnswer go_on();
  WebAnswer stop_parked();
  WebAnswer parked_refusal() const;

  void on_change(const MachineChange& change);
  void poll();
  // The program is about to end.
  void leave();
  WebAnswer no_room_in_history() const;

 private:
  std::optional<WebAnswer> refuse_begin() const;
  WebAnswer begin_check(const StoredProgram& program, std::int64_t history, const Point& start);
  void begin_checked_job();
  void name_job();
  void start_job();
  void end_job(JobState state, Sentence why = {});
  Sentence sentence_of_stop() const;
  void on_end(const MachineChange& change);
  void keep_results();
  void record_wait();
  Result<Reentry, Sentence> way_behind_stop() const;

  const ApiShared& shared_;
  MdiLines& mdi_;
  std::unique_ptr<KeptJob> kept_;  // null: no journal is kept
  ApiJob job_;
  // How the job is to begin.
  struct Beginning {
    std::uint64_t owner = 0;             // MotionOwner::changes() when the job was asked for
    bool resumes = false;                // the job was broken off, and goes on
    bool reenters = false;               // by a way back onto its path
    std::optional<LinePlace> from = {};  // where the job is to begin; empty: at its beginning
    std::optional<Reentry> way = {};     // the way there
    std::uint64_t map_for = 0;           // as in Wanted
  };
  Beginning begins_;
  bool named_ = false;                // the job's journal is begun
  std::optional<Ticket> ticket_;      // of the session, for the job
  Point start_;                       // where the path of the job begins
  std::vector<ProbeOutcome> probes_;  // what the job has probed
  Diagnostics findings_;              // of the run
  JobLog log_;
  std::optional<ParkedJob> parked_;
  bool goes_on_ = false;                   // the parked job is about to begin behind its stop
  bool wait_noted_ = false;                // where the job waits for a person now
  std::optional<std::string> stopped_by_;  // who has asked to stop the job
  bool leaves_ = false;
  std::uint64_t last_job_ = 0;
  std::uint64_t ended_ = 0;
};

}  // namespace passo
