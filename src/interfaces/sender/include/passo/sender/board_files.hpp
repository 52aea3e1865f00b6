// The files of a board that has a card or a flash memory for them: how they are listed and run. FileUpload sends one.
//
// grblHAL lists the files of its card by $F+, and runs one by $F=/name. FluidNC has two places, /sd and /localfs, which
// are the first part of a path here: $SD/List, $LocalFS/Run=name. Other firmwares have no files.
//
// What a board says is untrusted: at most `most_board_files` files are listed, and a path has no control characters.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/sender/grbl_machine.hpp"
#include "passo/session/board_storage.hpp"

namespace passo {

inline constexpr std::size_t most_board_files = 5000;
inline constexpr std::size_t longest_board_path = 200;  // bytes

// What one firmware knows about files.
class BoardFiles {
 public:
  // The error is a clause: this board has no files.
  static Result<BoardFiles, std::string> of(const GrblMachine& machine);

  // Returns the lines that ask for the list. A place that is missing answers with an error: no card is inserted.
  std::vector<std::string> questions() const;
  // Adds the files in the answer to one of these lines.
  void hear(std::string_view question, std::span<const std::string> said);
  const std::vector<StoredFile>& all() const { return files_; }

  // Returns the line that runs a file. The error is a clause.
  Result<std::string, std::string> run_line(std::string_view path) const;
  // Returns the line that deletes a file. It may also delete a folder: only for paths of the list. The error is a
  // clause.
  Result<std::string, std::string> remove_line(std::string_view path) const;
  // Returns the line that begins an upload, and the name by which the board stores the file; empty: none is needed.
  Result<std::string, std::string> upload_line(std::string_view path) const;
  bool is_fluidnc() const { return is_fluidnc_; }
  std::string_view card_folder() const { return is_fluidnc_ ? "/sd/" : "/"; }

 private:
  explicit BoardFiles(bool is_fluidnc) : is_fluidnc_(is_fluidnc) {}
  void add(std::string path, std::string_view fields);

  bool is_fluidnc_ = false;
  std::vector<StoredFile> files_;
};

}  // namespace passo
