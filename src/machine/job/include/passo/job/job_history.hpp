// JobHistory: the queued jobs, the ended jobs with their results, and the machine's alarms, in an SQLite file.
//
// Position in the pipeline: outside it. It is independent of the machine. Its owner reports events and their times.
//
// A job is queued, runs, and ends. It never starts automatically. A job that was running when the process ended is
// `interrupted` after the next open(). A killed process loses nothing: each call is one transaction, in a write-ahead
// log. keep() flushes the log to the disk, which may be slow: call it while the machine is stopped. So a power failure
// may lose what was written since the last keep(), but never leaves an incomplete job.
//
// A job does not start if its start cannot be written. Events such as the end of a job or an alarm are kept in memory
// until the disk has space, and are included in queries.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"

struct sqlite3;

namespace passo {

enum class HistoryState : std::uint8_t { queued, running, done, stopped, failed, interrupted };
std::string_view name_of(HistoryState state);

// A stop at which a job has waited for the operator.
struct HistoryWait {
  double at = 0;
  std::string code;  // M0, M1 or M6
  std::uint32_t line = 0;
  std::optional<std::int32_t> tool = {};  // the tool of M6
  std::string words;                      // the program's message, line by line
  friend bool operator==(const HistoryWait&, const HistoryWait&) = default;
};

// A picture that a camera has taken of a job.
struct HistoryStill {
  std::int64_t id = 0;
  double at = 0;
  std::string moment;  // "start" or "end"
};

struct HistoryJob {
  std::int64_t id = 0;
  std::string attempt;  // the id that a client has given it; empty: none
  std::string name;
  std::string dialect;
  std::uint64_t bytes = 0;  // size of the program
  HistoryState state = HistoryState::queued;
  std::string why;           // why the job failed
  std::string why_sentence;  // the same as a Sentence, in the caller's format; empty: written by an older version
  // Seconds since 1970; 0: not yet.
  double queued_at = 0;
  double begun_at = 0;
  double ended_at = 0;
  std::vector<HistoryWait> waits;
  std::vector<HistoryStill> stills;
};

struct HistoryAlarm {
  double at = 0;
  std::string words;
  std::string sentence;  // as HistoryJob::why_sentence
};

class JobHistory {
 public:
  static constexpr std::size_t most_queued = 256;
  static constexpr std::int64_t most_ended = 10'000;  // older ones are deleted
  static constexpr std::int64_t most_alarms = 10'000;
  static constexpr std::int64_t most_waits = 32;                       // per job; later ones are not recorded
  static constexpr std::int64_t most_stills = 8;                       // per job; later ones are not recorded
  static constexpr std::int64_t most_kept_stills = 400;                // of all jobs; older ones are deleted
  static constexpr std::size_t largest_still = std::size_t{1} << 20U;  // bytes; larger ones are not recorded

  // Opens or creates the file. The error is a sentence with the reason: the file is damaged, belongs to a newer
  // version, or is in use by another process.
  static Result<std::unique_ptr<JobHistory>, std::string> open(const std::string& file);
  ~JobHistory();
  JobHistory(const JobHistory&) = delete;
  JobHistory& operator=(const JobHistory&) = delete;

  // Adds a job at the end of the queue. Empty: the queue is full, or trouble() gives the reason why the job cannot be
  // written.
  std::optional<std::int64_t> add(std::string_view name, std::string_view dialect, std::string_view program,
                                  double now);
  // Adds a job that starts immediately. Empty: it cannot be written.
  std::optional<std::int64_t> add_running(std::string_view name, std::string_view dialect, std::string_view program,
                                          double now);
  // The same with an id of the client's choice, 1 to 64 characters. If there is a job with this id already, whatever
  // has become of it, that job is returned: a client that got no answer may repeat its request. `other_program`: with
  // another program.
  struct Attempt {
    std::optional<std::int64_t> job;  // empty: see add()
    bool is_new = false;
    bool other_program = false;
  };
  Attempt add_attempt(std::string_view attempt, std::string_view name, std::string_view dialect,
                      std::string_view program, double now);
  std::optional<HistoryJob> find_attempt(std::string_view attempt) const;
  std::optional<HistoryJob> find(std::int64_t id) const;
  // Returns a job's program. Empty: there is no such job, or its program was deleted when it ended.
  std::optional<std::string> program_of(std::int64_t id) const;
  // Returns false if there is no such job, or it cannot be written; an end is then kept in memory. The program of a
  // completed job is deleted.
  bool begin(std::int64_t id, double now);
  bool end(std::int64_t id, HistoryState state, std::string_view why, double now, std::string_view why_sentence = {});
  bool record_wait(std::int64_t id, const HistoryWait& wait);
  // Records a JPEG. Returns false if it is too large, the job is unknown, or it cannot be written.
  bool record_still(std::int64_t id, std::string_view moment, double now, std::string_view jpeg);
  // Returns the JPEG of a still. Empty: there is no such still, or it was deleted.
  std::optional<std::string> still(std::int64_t id) const;
  // Removes a waiting job from the queue. Returns false if it is not waiting.
  bool remove(std::int64_t id);
  bool record_alarm(std::string_view words, double now, std::string_view sentence = {});

  // In the order of the queue.
  std::vector<HistoryJob> queue() const;
  // Newest first.
  std::vector<HistoryJob> ended(std::int64_t most) const;
  std::vector<HistoryAlarm> alarms(std::int64_t most) const;

  // Flushes everything to the disk. Returns false if some data is not on the disk yet; try again.
  bool keep();
  // The error of the last call that writes. Empty: it succeeded.
  const std::string& trouble() const { return trouble_; }
  // Returns true if some events are not written yet.
  bool is_behind() const { return !unwritten_.empty() || !unwritten_alarms_.empty(); }

 private:
  explicit JobHistory(sqlite3* database) : database_(database) {}
  bool run(const char* sql) const;
  std::vector<HistoryJob> jobs(const char* where, std::int64_t value) const;
  void add_waits(std::vector<HistoryJob>& jobs, const char* where, std::int64_t value) const;
  void add_stills(std::vector<HistoryJob>& jobs, const char* where, std::int64_t value) const;
  struct End {
    std::int64_t id = 0;
    HistoryState state = HistoryState::done;
    std::string why;
    std::string why_sentence;
    double at = 0;
  };
  // Records the error, if `done` is false.
  bool judge(bool done);
  bool write(const End& end);
  bool write(const HistoryAlarm& alarm);
  std::optional<std::int64_t> insert(HistoryState state, std::string_view name, std::string_view dialect,
                                     std::string_view program, double now);

  sqlite3* database_;
  bool is_kept_ = true;
  std::string trouble_;
  std::vector<End> unwritten_;
  std::vector<HistoryAlarm> unwritten_alarms_;
};

}  // namespace passo
