// ResumableRun: what a run over a line leaves behind so that another can go on, and how that other one does.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "board_run.hpp"
#include "commands.hpp"
#include "journal_file.hpp"

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

  // Waits until the board rests, finds the place with --resume, and writes the head of the new journal. False, and said
  // why, where the job cannot go on.
  [[nodiscard]] bool begin(BoardRun& board, const ProgramReader& program, const Subject& subject, int& code);
  void add_to(Job::Options& options) const;
  // The board was greeted. False, and said why, where it is not as it was before.
  [[nodiscard]] bool start(Job& job, int& code);
  // The program has come to its end; else the journal stays.
  void end(const Job& job);

 private:
  explicit ResumableRun(const std::string& path) : file_(path), writer_(file_) {}
  bool find_place(BoardRun& board, const ProgramReader& program, const Subject& subject, int& code);

  JournalFile file_;
  JournalWriter writer_;
  std::optional<Journal> before_;
  JournalHead head_;
  bool resumes_ = false;
  std::optional<ResumePoint> point_;
};

}  // namespace passo
