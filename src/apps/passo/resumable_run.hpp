// ResumableRun: what a run over a line leaves behind so that another can go on, and how that other one does.
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
  // What the run is of.
  struct Subject {
    const RunArguments& arguments;
    const MachineDescription& machine;
    const InterpreterOptions& options;
    const ProgramCheck& check;
    std::uint64_t path;  // its fingerprint
  };
  // Reads the journal that is there. With --resume it must be one, and of this program on this machine; else null, and
  // said why, with `code` to exit with. Also null, with exit_done, where no journal is kept.
  static std::unique_ptr<ResumableRun> open(const Subject& subject, int& code);

  // Waits until the board rests, finds the place with --resume, writes the head of the new journal, and greets the
  // board by it, or names the session where the machine is ready already. False, and said why, where the program cannot
  // go on.
  [[nodiscard]] bool begin(OpenedMachine& machine, const ProgramReader& program, const Subject& subject, int& code);
  void add_to(request::Start& start);
  // The program has come to its end; else the journal stays.
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
