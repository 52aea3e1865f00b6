// JobIdentity: what must be as it was for a job to go on: the program that runs it, its text and the machine's file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/journal/journal.hpp"

namespace passo {

// The stamp of a text of that name.
FileStamp stamp_of(std::string name, std::string_view text);
// The stamp of a text that was read from the file `path`. Empty path: the stamp has no name.
FileStamp stamp_of_text(const std::string& path, std::string_view text);
// The stamp of a file as it is now. Standard input and pipes, which can be read only once, have a stamp without a name.
FileStamp stamp_of_file(const std::string& path);

struct JobIdentity {
  std::string made_by;  // version of the program that runs the job
  FileStamp program;
  FileStamp machine;
};

// What has changed since a job began.
enum class JobChange : std::uint8_t {
  version,  // another version of this program has begun the job
  program,  // it is another program, or its text was changed
  machine,  // it is another machine file, or the file was changed
};
// A code for scripts. A code never changes.
std::string_view code_of(JobChange change);

// `then`: the journal of the job. Empty: nothing has changed.
std::optional<JobChange> change_since(const JournalHead& then, const JobIdentity& now);

}  // namespace passo
