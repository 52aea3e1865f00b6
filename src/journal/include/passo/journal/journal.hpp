// Journal: what a host that is started anew must know to go on with a job: of which program it is, under which
// numbers the board knows it, and of every place at which the board may have come to rest by itself, where that is on
// the path.
//
// A text: a head, written when the session begins, and a ring of as many lines of one length as there can be rests to
// choose from, each written before the refill is sent that makes it possible. So a host that is killed at any instant
// leaves a journal that knows the rest to which the board comes. Head and lines carry a check each: what was torn in
// writing is noticed.
//
// A session begins in four steps, between any two of which the host may be killed: the head is written, the board
// hears hello (and forgets the session before), hears the session's number, and gets its first items. The board's
// status tells which it was: a hello has a number that is not 0, which the board has nowhere else from. A program that
// is not the first of its host begins without a hello, and goes by the session's number alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/drive/refiller.hpp"
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
  FileStamp program;            // without a name: from no file
  FileStamp machine;            // the machine's file
  std::uint64_t path = 0;       // fingerprint of all that the program means
  std::vector<int> job_counts;  // the board's, of each motor, where the machine's zero is
  // The board as it was before this session's hello, and what it gets to hear.
  std::uint16_t session_before = 0;
  ItemNumber executed_before = 0;
  std::uint8_t greeting = 0;  // 0: no hello, the board hears of the session alone
  std::uint16_t session = 0;  // not 0
  PathPlace place;            // where this session begins
  friend bool operator==(const JournalHead&, const JournalHead&) = default;
};

// Where a journal is kept. Knows nothing of what is in it.
class JournalStore {
 public:
  virtual ~JournalStore() = default;
  // In the place of all that there is, as a whole or not at all. False: it cannot be written.
  [[nodiscard]] virtual bool replace(std::string_view text) = 0;
  // Bytes amid it.
  [[nodiscard]] virtual bool overwrite(std::size_t offset, std::string_view bytes) = 0;
};

class JournalWriter {
 public:
  // A board has fewer places than that for items, and so for rests.
  static constexpr std::size_t rests = 256;

  // The store outlives it.
  explicit JournalWriter(JournalStore& store) : store_(store) {}
  void begin(const JournalHead& head);
  void note(const BoardRest& rest);
  // Something could not be written: the journal is not to be relied on.
  bool failed() const { return failed_; }

 private:
  JournalStore& store_;
  std::size_t head_size_ = 0;
  std::uint64_t noted_ = 0;
  bool failed_ = false;
};

class Journal {
 public:
  // Nothing where the head is not whole.
  static std::optional<Journal> read(std::string_view text);

  const JournalHead& head() const { return head_; }
  // Whether it is this job that the board was last at.
  bool is_of(const BoardStatus& status) const { return state_of(status) != State::another; }
  // Where on the path the board rests; it does rest. Nothing where the journal does not know that rest.
  std::optional<PathPlace> place_of(const BoardStatus& status) const;
  // Lines that were torn in writing.
  std::size_t torn() const { return torn_; }

 private:
  enum class State : std::uint8_t {
    another,         // it was reset, or has heard of another session
    before_hello,    // as it was before this session
    before_session,  // it has heard this one's hello
    in_session,
  };
  State state_of(const BoardStatus& status) const;

  JournalHead head_;
  std::vector<BoardRest> rests_;  // the latest first
  std::size_t torn_ = 0;
};

}  // namespace passo
