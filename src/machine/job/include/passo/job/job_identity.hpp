// JobIdentity: the data that must be unchanged for a job to continue: the version of this program, the G-code text and
// the machine file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/journal/journal.hpp"

namespace passo {

// Returns the stamp of a text with that name.
FileStamp stamp_of(std::string name, std::string_view text);
// Returns the stamp of a text that was read from the file `path`. Empty path: the stamp has no name.
FileStamp stamp_of_text(const std::string& path, std::string_view text);
// Returns the stamp of a file in its present state. Standard input and pipes, which can be read only once, have a stamp
// without a name.
FileStamp stamp_of_file(const std::string& path);

struct JobIdentity {
  std::string made_by;  // version of the program that runs the job
  FileStamp program;
  FileStamp machine;
};

// The change since a job began.
enum class JobChange : std::uint8_t {
  version,  // another version of this software began the job
  program,  // the program is another one, or its text was changed
  machine,  // the machine file is another one, or was changed
};
// A stable code for scripts.
std::string_view code_of(JobChange change);

// Compares with `then`, the head of the job's journal. Empty: nothing has changed.
std::optional<JobChange> change_since(const JournalHead& then, const JobIdentity& now);

}  // namespace passo
