// ResumableRun: writes what a run over a line leaves, so that another run can go on, and goes on from what another run
// has left.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "journal_file.hpp"
#include "opened_machine.hpp"

#include "passo/activity/program.hpp"
#include "passo/journal/resumption.hpp"

namespace passo {

class ResumableRun {
 public:
  // The program, the machine and the path of the run.
  struct Subject {
    const RunArguments& arguments;
    const MachineDescription& machine;
    const InterpreterOptions& options;
    const ProgramCheck& check;
    std::uint64_t path;  // the path's fingerprint
  };
  // Reads the journal, if there is one. With --resume there must be a journal of this program on this machine;
  // otherwise returns null, with a message and the exit code in `code`. Also null, with exit_done, if no journal is
  // kept.
  static std::unique_ptr<ResumableRun> open(const Subject& subject, int& code);

  // Waits until the board rests, finds the place with --resume, and writes the head of the new journal. Then greets the
  // board with the head's numbers, or only names the session if the machine is already ready. False, with a message:
  // the program cannot go on.
  [[nodiscard]] bool begin(OpenedMachine& machine, const ProgramReader& program, const Subject& subject, int& code);
  void add_to(request::Start& start);
  // Tells that the program has come to its end. Otherwise the journal stays.
  void end(const MachineSession& session, const Answered& answered);

 private:
  explicit ResumableRun(const std::string& path) : file_(path), writer_(file_) {}
  bool find_place(OpenedMachine& machine, const ProgramReader& program, const Subject& subject, int& code);
  bool write_head(const Subject& subject, int& code);
  bool stands_there(const BoardSession& board, int& code) const;

  JournalFile file_;
  JournalWriter writer_;
  std::optional<Journal> before_;
  JournalHead head_;
  bool resumes_ = false;
  std::optional<ResumePoint> point_;
};

}  // namespace passo
