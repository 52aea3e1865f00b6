// Journal: what a restarted host must know to go on with a job. The journal tells which program the job runs and under
// which numbers the board knows the job. For every place at which the board may have come to rest by itself, the
// journal tells where on the path that place is.
//
// A journal is a text: a head, and a ring of lines of equal length, one for each rest that may still count. The head is
// written when the session begins. A line is written before the refill is sent that makes its rest possible. So a host
// that is killed at any instant leaves a journal that knows the rest to which the board comes. The head and each line
// carry a check, so a torn write is noticed.
//
// The way of a program behind a probe move depends on what the probe has found. So the journal also has a line for each
// outcome, at its end, in order. An outcome is on the disk before any motion goes on from there. See
// docs/decisions/0101.
//
// A session begins in four steps: the head is written, the board hears hello (and forgets the session before), the
// board hears the session's number, and the board gets its first items. The host may be killed between any two of them.
// The board's status tells which step was the last: a hello has a number that is not 0, and the board has that number
// from nowhere else. A program that is not the first of its host begins without a hello, and is known by the session's
// number alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/drive/refiller.hpp"
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
  std::string made_by;          // version of the program that runs the job
  FileStamp program;            // no name: the program is from no file
  FileStamp machine;            // the machine's file
  std::uint64_t path = 0;       // fingerprint of the program's path
  std::vector<int> job_counts;  // the board's count of each motor at machine zero
  Point start;                  // where the job began, machine coordinates
  SessionNumbers numbers;
  PathPlace place;                        // where this session begins
  std::vector<ProbeOutcome> probes = {};  // what the probe moves before that place have found, in order
  friend bool operator==(const JournalHead&, const JournalHead&) = default;
};

// Where a journal is kept. The store knows nothing of the contents.
class JournalStore {
 public:
  virtual ~JournalStore() = default;
  // Replaces the whole contents by `text`, completely or not at all. False: `text` cannot be written.
  [[nodiscard]] virtual bool replace(std::string_view text) = 0;
  // Overwrites bytes within the contents.
  [[nodiscard]] virtual bool overwrite(std::size_t offset, std::string_view bytes) = 0;
  // Adds bytes at the end. They are on the disk when this returns.
  [[nodiscard]] virtual bool append(std::string_view bytes) = 0;
};

class JournalWriter {
 public:
  // A board has fewer places than this for items, and so for rests.
  static constexpr std::size_t rests = 256;

  // The store outlives the writer.
  explicit JournalWriter(JournalStore& store) : store_(store) {}
  void begin(const JournalHead& head);
  void record(const BoardRest& rest);
  void record(const ProbeOutcome& outcome);
  // True: something could not be written, so the journal cannot be relied on.
  bool failed() const { return failed_; }

 private:
  JournalStore& store_;
  std::size_t head_size_ = 0;
  std::uint64_t noted_ = 0;
  std::size_t probes_ = 0;  // outcomes in the journal
  bool failed_ = false;
};

class Journal {
 public:
  // Empty if the head or an outcome is damaged.
  static std::optional<Journal> read(std::string_view text);
  // True: the text is a journal of any version, whole or not.
  static bool is_journal(std::string_view text);

  // Its outcomes of probe moves are all that are known, those of its session too.
  const JournalHead& head() const { return head_; }
  // True: the board last worked on this job.
  bool is_of(const BoardStatus& status) const { return stage_of(status) != SessionNumbers::Stage::another; }
  // Where on the path the board rests. The status must be one at rest. Empty: the journal does not know that rest.
  std::optional<PathPlace> place_of(const BoardStatus& status) const;
  // All of the path before this place is executed, whatever has become of the board.
  PathPlace done() const;
  // Where the board comes to rest by itself, if it has got all that was sent.
  PathPlace farthest() const;
  // Lines that were torn in writing.
  std::size_t torn() const { return torn_; }

 private:
  SessionNumbers::Stage stage_of(const BoardStatus& status) const;

  JournalHead head_;
  std::vector<BoardRest> rests_;  // the latest first
  std::size_t torn_ = 0;
};

}  // namespace passo
