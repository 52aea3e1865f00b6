// JournalFile: a journal on the disk. It survives that its program is killed; a computer that loses power may keep an
// older state of it, which then does not know the board's rest, and is refused.
#pragma once

#include <optional>
#include <string>

#include "passo/journal/journal.hpp"

namespace passo {

// Where the journal of what runs on that board is kept: XDG_STATE_HOME/passo or ~/.local/state/passo. Empty: neither
// is known.
std::string usual_journal(const std::string& board);
// What is in a journal's file, at most as much as a journal may have. Nothing where there is none that can be read.
std::optional<std::string> read_journal(const std::string& path);
// Of a file as it is now. What is read only once, standard input or a pipe, has a stamp without a name.
FileStamp stamp_of(const std::string& path);

class JournalFile final : public JournalStore {
 public:
  explicit JournalFile(std::string path) : path_(std::move(path)) {}
  ~JournalFile() override;
  JournalFile(const JournalFile&) = delete;
  JournalFile& operator=(const JournalFile&) = delete;

  const std::string& path() const { return path_; }
  [[nodiscard]] bool replace(std::string_view text) override;
  [[nodiscard]] bool overwrite(std::size_t offset, std::string_view bytes) override;
  // The job is done.
  void remove();

 private:
  std::string path_;
  int descriptor_ = -1;
};

}  // namespace passo
