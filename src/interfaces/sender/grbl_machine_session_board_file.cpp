// GrblMachineSession: how a file runs that the board reads from its own storage. The session only watches: it holds,
// resumes and stops the board, and asks it again who and where it is at the end, because a file may change everything.
#include <utility>

#include "grbl_board_storage.hpp"
#include "grbl_work.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr Seconds longest_begin{10};
// A board that is idle for so long, in so many reports, has come to the end of its file.
constexpr Seconds shortest_end{1};
constexpr std::uint64_t reports_of_end = 5;

}  // namespace

// Nothing may be sent from here on but real-time commands: grblHAL drops other bytes, or ends the file at them.
void GrblMachineSession::begin_board_file() {
  take_board();
  // A board at rest may ignore a hold: nothing may move then either.
  if (work_->hold.asked) return;
  while (sender_.take_reply()) continue;
  if (overrides_ != Overrides()) send_overrides();
  sender_.ask(work_->board_file.line, longest_begin);
  work_->stage = Work::Stage::moves;
}

void GrblMachineSession::poll_board_file() {
  Work::BoardFile& file = work_->board_file;
  const auto fail = [&](std::string code, const std::string& words) {
    const Sentence sentence{.code = std::move(code), .text = fmt::format("the board ended {}: {}", file.path, words)};
    trouble_.fault = GrblFault{.code = sentence.code, .message = sentence.text};
    work_->fault = ActivityFault{MachineFault::board_stopped, {{"trouble", sentence.text}}, sentence};
  };
  if (!file.is_running) {
    const auto answer = sender_.take_reply();
    if (!answer) return;
    if (!answer->error.empty()) {
      fail("grbl.file-refused", answer->error);
      return end_work(Outcome::failed, work_->fault);
    }
    file.is_running = true;
    file.active = now();
    file.reports = heard_.reports;
  }
  update_holds();
  const auto& report = sender_.report();
  if (report->file_share) file.share = *report->file_share;
  if (report->file_share || report->state != "Idle") {
    file.active = now();
    file.reports = heard_.reports;
  }
  const bool is_over =
      now() - file.active >= shortest_end && heard_.reports - file.reports >= reports_of_end && rests();
  if (!is_over) return;
  file.has_ended = true;
  if (!file.trouble.empty()) fail("grbl.file-error", file.trouble);
  resync();
}

// grblHAL: "error:20 in SD file at line 5". FluidNC: "[MSG:ERR: …]". It may come together with the answer that the file
// has begun.
void GrblMachineSession::hear_board_file(std::string_view line) {
  if (!busy() || !work_->is_board_file() || work_->stage != Work::Stage::moves) return;
  if (!work_->board_file.trouble.empty()) return;
  if (line.starts_with("error:") || line.starts_with("[MSG:ERR")) work_->board_file.trouble = line;
}

void GrblMachineSession::tell_board_file(MachineStatus& status) const {
  status.executes.board_file = work_->board_file.path;
  if (work_->board_file.is_running) status.progress = work_->board_file.share;
}

}  // namespace passo
