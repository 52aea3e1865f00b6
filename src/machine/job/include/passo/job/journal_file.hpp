// JournalFile: a journal file on the disk. It survives if the process is killed. After a power failure, the disk may
// hold an older version of the journal. That version does not contain the board's stop point, so it is rejected.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "passo/base/result.hpp"
#include "passo/journal/journal.hpp"

namespace passo {

// The content found at the path of a journal.
struct FoundJournal {
  enum class Kind : std::uint8_t {
    none,     // no file
    empty,    // a file without text
    foreign,  // not a Passo journal
    torn,     // an incomplete journal
    whole,
  };
  Kind kind = Kind::none;
  std::optional<Journal> journal = {};  // the journal, if it is complete
};

class JournalFile final : public JournalStore {
 public:
  explicit JournalFile(std::string path) : path_(std::move(path)) {}
  ~JournalFile() override;
  JournalFile(const JournalFile&) = delete;
  JournalFile& operator=(const JournalFile&) = delete;

  const std::string& path() const { return path_; }
  // Locks the journal for this process while this object exists. The error is errno; EWOULDBLOCK: another process
  // writes the journal.
  [[nodiscard]] Status<int> claim();
  // The text of the file. Empty: there is none.
  std::string text() const;
  FoundJournal find() const;
  // Returns the time of the last write; seconds since 1970. 0: there is no file.
  double written_at() const;
  [[nodiscard]] bool replace(std::string_view text) override;
  [[nodiscard]] bool overwrite(std::size_t offset, std::string_view bytes) override;
  bool append(std::string_view bytes) override;
  // Returns the write error after a function has returned false.
  std::string trouble() const;
  // Removes the journal when the job is done or cannot continue.
  void remove();

 private:
  std::string path_;
  int descriptor_ = -1;  // the file at the path, locked
  int error_ = 0;        // errno of the last failure
};

}  // namespace passo
