// JobHistory: the jobs that wait, those that have run and how each ended, and the machine's alarms, in a file of
// SQLite.
//
// Place: beside the street. It knows no machine. Its owner says what has happened, and when.
//
// A job is queued, runs, and ends. It never starts by itself. A job that ran when the program ended in whatever way is
// `interrupted` after the next open(). A killed program loses nothing: each call is one transaction, in a write-ahead
// log. The log reaches the disk with keep(), which takes as long as the disk takes: call it while the machine rests. So
// a power cut may lose what came since the last keep(), and never leaves half a job.
//
// A job whose beginning cannot be written does not begin. What has happened anyway, the end of a job or an alarm, is
// kept in memory until the disk has room, and is told meanwhile.
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

// Where a job has waited for a person.
struct HistoryWait {
  double at = 0;
  std::string code;  // M0, M1 or M6
  std::uint32_t line = 0;
  std::optional<std::int32_t> tool = {};  // of M6
  std::string words;                      // of the program, line by line
  friend bool operator==(const HistoryWait&, const HistoryWait&) = default;
};

struct HistoryJob {
  std::int64_t id = 0;
  std::string name;
  std::string dialect;
  std::uint64_t bytes = 0;  // of the program
  HistoryState state = HistoryState::queued;
  std::string why;           // of one that failed
  std::string why_sentence;  // the same as the caller has it; empty: an older program has written it
  // Seconds since 1970; 0: not yet.
  double queued_at = 0;
  double begun_at = 0;
  double ended_at = 0;
  std::vector<HistoryWait> waits;
};

struct HistoryAlarm {
  double at = 0;
  std::string words;
  std::string sentence;  // as HistoryJob::why_sentence
};

class JobHistory {
 public:
  static constexpr std::size_t most_queued = 256;
  static constexpr std::int64_t most_ended = 10'000;  // older ones are forgotten
  static constexpr std::int64_t most_alarms = 10'000;
  static constexpr std::int64_t most_waits = 32;  // of a job; later ones are not noted

  // Opens or makes the file. The error is a sentence with the reason: the file is damaged, of a newer version, or
  // another program has it.
  static Result<std::unique_ptr<JobHistory>, std::string> open(const std::string& file);
  ~JobHistory();
  JobHistory(const JobHistory&) = delete;
  JobHistory& operator=(const JobHistory&) = delete;

  // Queues a job at the end. Empty: too many wait, or trouble() tells why it cannot be written.
  std::optional<std::int64_t> add(std::string_view name, std::string_view dialect, std::string_view program,
                                  double now);
  // A job that runs at once. Empty: it cannot be written.
  std::optional<std::int64_t> add_running(std::string_view name, std::string_view dialect, std::string_view program,
                                          double now);
  std::optional<HistoryJob> find(std::int64_t id) const;
  // Empty: there is no such job, or its program was forgotten when it ended.
  std::optional<std::string> program_of(std::int64_t id) const;
  // False: there is no such job, or it cannot be written; an end is then kept in memory. The program of a job that is
  // done is forgotten.
  bool begin(std::int64_t id, double now);
  bool end(std::int64_t id, HistoryState state, std::string_view why, double now, std::string_view why_sentence = {});
  bool record_wait(std::int64_t id, const HistoryWait& wait);
  // Takes a job that waits out of the queue. False: it does not wait.
  bool remove(std::int64_t id);
  bool record_alarm(std::string_view words, double now, std::string_view sentence = {});

  // In the order of the queue.
  std::vector<HistoryJob> queue() const;
  // Newest first.
  std::vector<HistoryJob> ended(std::int64_t most) const;
  std::vector<HistoryAlarm> alarms(std::int64_t most) const;

  // Brings all to the disk. False: not all of it is there; try again.
  bool keep();
  // Why the last call could not write. Empty: it could.
  const std::string& trouble() const { return trouble_; }
  // True: something has happened that is not written yet.
  bool is_behind() const { return !unwritten_.empty() || !unwritten_alarms_.empty(); }

 private:
  explicit JobHistory(sqlite3* database) : database_(database) {}
  bool run(const char* sql) const;
  std::vector<HistoryJob> jobs(const char* where, std::int64_t value) const;
  void add_waits(std::vector<HistoryJob>& jobs, const char* where, std::int64_t value) const;
  struct End {
    std::int64_t id = 0;
    HistoryState state = HistoryState::done;
    std::string why;
    std::string why_sentence;
    double at = 0;
  };
  // Notes the trouble, if `done` is false.
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
