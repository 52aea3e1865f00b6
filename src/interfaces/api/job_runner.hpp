// JobRunner: the running job, from its check to its end, and the parked job that waits for the operator.
//
//   begin() -> check -> the board gets a session number (with a journal) -> the session runs it -> end
//                                                                        -> step_aside() -> go_on() -> check …
//
// Position in the pipeline: moves the machine by programs, for JobsApi and MachineApi. Private to api/. Only one job
// runs at a time. An interrupted or waiting job is not lost: see KeptJob and ParkedJob.
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
  // All references must outlive this object.
  JobRunner(const ApiShared& shared, MdiLines& mdi);

  const ApiJob& job() const { return job_; }
  bool is_checking() const { return job_.state == JobState::checking; }
  // Returns whether the program runs, or its job waits for the operator.
  bool runs(const StoredProgram& program) const;
  // Returns whether the program is about to run, or its job waits for the operator.
  bool waits_with(std::uint64_t program) const;
  const std::optional<ParkedJob>& parked() const { return parked_; }
  bool goes_on() const { return goes_on_; }
  const JobLog& log() const { return log_; }
  std::uint64_t jobs_ended() const { return ended_; }
  // Returns false if the journal of the job cannot be written.
  bool is_journal_written() const { return !named_ || kept_->is_written(); }
  // Returns the interrupted job. Null if there is none.
  const InterruptedJob* interrupted() const { return kept_ ? kept_->interrupted() : nullptr; }
  Result<Reentry, Sentence> way_of_interrupted() { return kept_->reentry(); }
  void drop_interrupted() { kept_->drop(); }
  // Computes the reentry from the current position to the first motion of a line. Runs through the program.
  Result<Reentry, Sentence> way_to(const StoredProgram& program, const LinePlace& from) const;

  struct Wanted {
    std::int64_t history = 0;            // its number in the history; 0: a new one is assigned
    std::optional<LinePlace> from = {};  // start position in the program; empty: its beginning
    std::uint64_t map_for = 0;           // the program that gets the height map probed by the job; 0: none
    std::string board_file = {};         // the board runs this file of its own; the program is its text
  };
  WebAnswer begin(const StoredProgram& program, const Wanted& wanted);
  // Begins a file of the board whose text is not known here, so that it is not checked.
  WebAnswer begin_unchecked(const std::string& board_file);
  // Resumes the interrupted job in the middle of its path. It is checked from its original start.
  WebAnswer resume(bool by_a_way_back);
  // Returns true if the job had not begun yet and is now cancelled.
  bool call_off();
  // Sets who is about to stop the job. `who`: empty for a client that is not in control. Nothing: unnamed.
  void set_stopped_by(std::optional<std::string> who) { stopped_by_ = std::move(who); }

  // Returns whether the spindle is stopped and the machine can be returned to the path.
  bool is_free_to_move(const MachineStatus& status) const;
  // Ends the motion of a waiting job, if possible, so that the operator may move the machine.
  void step_aside();
  // Checks the parked job with the current offsets and tools, and restarts it after its stop.
  WebAnswer go_on();
  WebAnswer stop_parked();
  WebAnswer parked_refusal() const;

  void on_change(const MachineChange& change);
  void poll();
  // Announces the end of the program.
  void leave();
  WebAnswer no_room_in_history() const;

 private:
  std::optional<WebAnswer> refuse_begin() const;
  // Notes a job in the history. Empty: it cannot be noted. 0: there is no history.
  std::optional<std::int64_t> note_job(const std::string& name, Dialect dialect, const std::string& text);
  WebAnswer begin_check(const StoredProgram& program, std::int64_t history, const Point& start);
  void begin_checked_job();
  void name_job();
  void start_job();
  void start_board_file();
  void end_job(JobState state, Sentence why = {});
  Sentence sentence_of_stop() const;
  void on_end(const MachineChange& change);
  void keep_results();
  void record_wait();
  Result<Reentry, Sentence> way_behind_stop() const;

  const ApiShared& shared_;
  MdiLines& mdi_;
  std::unique_ptr<KeptJob> kept_;      // null: no journal is kept
  std::unique_ptr<CutRecorder> cuts_;  // null: not counted
  ApiJob job_;
  // The parameters of the start of the job.
  struct Beginning {
    std::uint64_t owner = 0;             // MachineControl::changes() when the job was requested
    bool resumes = false;                // the interrupted job is resumed
    bool reenters = false;               // it is resumed by a reentry move to its path
    std::optional<LinePlace> from = {};  // start position in the program; empty: its beginning
    std::optional<Reentry> way = {};     // the reentry move
    std::uint64_t map_for = 0;           // the program that gets the height map, as in Wanted
    std::string board_file = {};         // as in Wanted
  };
  Beginning begins_;
  bool named_ = false;                // the job's journal has been started
  std::optional<Ticket> ticket_;      // the session's ticket of the job
  Point start_;                       // start of the job's path
  std::vector<ProbeOutcome> probes_;  // probe results of the job
  Diagnostics findings_;              // findings of the run
  JobLog log_;
  std::optional<ParkedJob> parked_;
  bool goes_on_ = false;                   // the parked job is about to restart after its stop
  bool wait_noted_ = false;                // the current stop of the job has been recorded
  std::optional<std::string> stopped_by_;  // who requested the stop
  bool leaves_ = false;
  std::uint64_t last_job_ = 0;
  std::uint64_t ended_ = 0;
};

}  // namespace passo
