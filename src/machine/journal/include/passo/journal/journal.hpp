// Journal: the data with which a restarted host can continue a job. The journal identifies the job's program, and the
// session numbers by which the board knows the job. For every point at which the board may have stopped by itself, the
// journal has its position on the path.
//
// A journal is a text: a head, and a ring of lines of equal length, one for each stop point that is still possible. The
// head is written when the session begins. A line is written before the queue update that makes its stop point possible
// is sent. So a host that is killed at any instant leaves a journal that contains the board's stop point. The head and
// each line have a checksum, so an incomplete write is detected.
//
// The path of a program after a probe move depends on the result. So the journal also has a line for each probe result,
// at its end, in order. A result is on the disk before any motion continues from there. See docs/decisions/0101.
//
// A session begins in four steps: the head is written, the board receives a hello (and forgets the previous session),
// the board receives the session's number, and the board gets its first items. The host may be killed between any two
// of them. The board's status shows which step was the last: a hello has a number other than 0, which the board cannot
// have from any other source. A program that is not the first of its host begins without a hello, and is identified by
// the session's number alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/drive/queue_updater.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/interpreter/probe_outcome.hpp"
#include "passo/journal/session_numbers.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// A file as it was when the job began.
struct FileStamp {
  std::string name;
  std::uint64_t size = 0;
  std::uint64_t fingerprint = 0;
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

struct JournalHead {
  std::string made_by;          // version of the software that runs the job
  FileStamp program;            // no name: the program is not from a file
  FileStamp machine;            // the machine file
  std::uint64_t path = 0;       // fingerprint of the program's path
  std::vector<int> job_counts;  // the board's count of each motor at machine zero
  Point start;                  // where the job began, in machine coordinates
  SessionNumbers numbers;
  PathPosition place;                     // where this session begins
  std::vector<ProbeOutcome> probes = {};  // the results of the probe moves before that position, in order
  friend bool operator==(const JournalHead&, const JournalHead&) = default;
};

// The storage of a journal. It is independent of the contents.
class JournalStore {
 public:
  virtual ~JournalStore() = default;
  // Replaces the whole contents by `text`, completely or not at all. Returns false if `text` cannot be written.
  [[nodiscard]] virtual bool replace(std::string_view text) = 0;
  // Overwrites bytes within the contents.
  [[nodiscard]] virtual bool overwrite(std::size_t offset, std::string_view bytes) = 0;
  // Adds bytes at the end. They are on the disk when this returns.
  [[nodiscard]] virtual bool append(std::string_view bytes) = 0;
};

class JournalWriter {
 public:
  // A board's queue has fewer places than this, and so fewer possible stop points.
  static constexpr std::size_t rests = 256;

  // The store must outlive the writer.
  explicit JournalWriter(JournalStore& store) : store_(store) {}
  void begin(const JournalHead& head);
  void record(const BoardStop& rest);
  void record(const ProbeOutcome& outcome);
  // Returns true if a write failed, so the journal is unreliable.
  bool failed() const { return failed_; }

 private:
  JournalStore& store_;
  std::size_t head_size_ = 0;
  std::uint64_t noted_ = 0;
  std::size_t probes_ = 0;  // number of probe results in the journal
  bool failed_ = false;
};

class Journal {
 public:
  // Reads a journal. Empty: the head or a probe result is damaged.
  static std::optional<Journal> read(std::string_view text);
  // Returns true if the text is a journal of any version, even if it is incomplete.
  static bool is_journal(std::string_view text);

  // The head with all known probe results, including those of its session.
  const JournalHead& head() const { return head_; }
  // Returns true if the board last worked on this job.
  bool is_of(const BoardStatus& status) const { return stage_of(status) != SessionNumbers::Stage::another; }
  // Returns the board's stop point on the path. The status must be that of a stopped board. Empty: the journal does not
  // contain that stop point.
  std::optional<PathPosition> place_of(const BoardStatus& status) const;
  // Returns a position up to which the path is certainly executed, whatever happened to the board.
  PathPosition done() const;
  // Returns the stop point of the board if it has received everything that was sent.
  PathPosition farthest() const;
  // The number of lines damaged by incomplete writes.
  std::size_t torn() const { return torn_; }

 private:
  SessionNumbers::Stage stage_of(const BoardStatus& status) const;

  JournalHead head_;
  std::vector<BoardStop> rests_;  // the newest first
  std::size_t torn_ = 0;
};

}  // namespace passo
