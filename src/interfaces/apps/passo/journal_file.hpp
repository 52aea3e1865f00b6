// JournalFile: a journal on the disk. The journal survives when its program is killed. If the computer loses power, the
// disk may keep an older state of the journal. That state does not know the board's rest, so it is refused.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "passo/base/result.hpp"
#include "passo/journal/journal.hpp"

namespace passo {

// The path of a file about a board, in XDG_STATE_HOME/passo or ~/.local/state/passo. Empty: neither is known. `ending`:
// ".journal" or ".place".
std::string state_file(const std::string& board, std::string_view ending);
// Reads such a file. A file that is too long for a journal gives an empty text. Nothing: there is no readable file.
std::optional<std::string> read_state_file(const std::string& path);
// Writes such a file anew: all of it or nothing is on the disk, whatever happens meanwhile. Returns its descriptor,
// open for writing; less than 0: it cannot be written, and this is -errno.
int replace_state_file(const std::string& path, std::string_view text);
// The stamp of a file as it is now. Standard input and pipes, which can be read only once, have a stamp without a name.
FileStamp stamp_of(const std::string& path);
// The stamp of a text that was read from the file `path`.
FileStamp stamp_of_text(const std::string& path, std::string_view text);

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
