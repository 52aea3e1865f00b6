// JournalFile: a journal on the disk. The journal survives when its program is killed. If the computer loses power, the
// disk may keep an older state of the journal. That state does not know the board's rest, so it is refused.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "passo/base/result.hpp"
#include "passo/journal/journal.hpp"

namespace passo {

// What is in the place of a journal.
struct FoundJournal {
  enum class Kind : std::uint8_t {
    none,     // no file
    empty,    // a file without text
    foreign,  // no journal of Passo's
    torn,     // a journal, and not whole
    whole,
  };
  Kind kind = Kind::none;
  std::optional<Journal> journal = {};  // the whole one
};

class JournalFile final : public JournalStore {
 public:
  explicit JournalFile(std::string path) : path_(std::move(path)) {}
  ~JournalFile() override;
  JournalFile(const JournalFile&) = delete;
  JournalFile& operator=(const JournalFile&) = delete;

  const std::string& path() const { return path_; }
  // Claims the journal for this program, as long as this object lives. The error is errno; EWOULDBLOCK: another program
  // writes the journal.
  [[nodiscard]] Status<int> claim();
  // The text of the file. Empty: there is none.
  std::string text() const;
  FoundJournal find() const;
  // When the file was last written; seconds since 1970. 0: there is none.
  double written_at() const;
  [[nodiscard]] bool replace(std::string_view text) override;
  [[nodiscard]] bool overwrite(std::size_t offset, std::string_view bytes) override;
  bool append(std::string_view bytes) override;
  // Why the journal could not be written, after a function has returned false.
  std::string trouble() const;
  // Removes the journal when the job is done, or cannot go on.
  void remove();

 private:
  std::string path_;
  int descriptor_ = -1;  // the file at the path, locked
  int error_ = 0;        // errno of the last failure
};

}  // namespace passo
