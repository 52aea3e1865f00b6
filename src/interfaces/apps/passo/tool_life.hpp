// The life of tools for the commands: the file in which it is counted, and what is left of it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "passo/activity/cut_forecast.hpp"
#include "passo/job/cut_recorder.hpp"
#include "passo/job/tool_records.hpp"

namespace passo {

// Options of `check` and `run`.
struct ToolLifeArguments {
  std::string library;  // TOML; empty: the tools have no limits
  std::string records;  // empty: tools.sqlite in the state folder
};

// Returns the file of the records. Empty: there is no state folder.
std::string tool_records_file(const std::string& given);
// Opens the records. Null, with a message and `code`, if they cannot be opened.
std::unique_ptr<ToolRecords> open_tool_records(const std::string& file, int& code);
// The count of a run.
class CountedCuts {
 public:
  // Opens the records. Without a state folder, nothing is counted. Returns the exit code, with a message.
  int open(const ToolLifeArguments& arguments, const std::string& machine);
  // Null: nothing is counted.
  CutRecorder* recorder() { return recorder_ ? &*recorder_ : nullptr; }

 private:
  std::unique_ptr<ToolRecords> records_;
  std::optional<CutRecorder> recorder_;
};
// Ends the count of a run. Null: there is none. Shows a note if it cannot be written.
void end_cuts(CutRecorder* cuts);

// Returns what is left of the lives of the library's tools. Records that do not exist yet count as empty. Nothing, with
// messages and `code`: a file cannot be read.
std::optional<LivesLeft> read_lives(const ToolLifeArguments& arguments, int& code);

}  // namespace passo
