// Work: what a session is busy with: either an activity on its own drive, or a check. Private to session/.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "progress_ahead.hpp"

#include "passo/activity/homing_path.hpp"
#include "passo/activity/program.hpp"
#include "passo/drive/motion_drive.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// The lines of the program whose motion is planned, and when their motion begins.
class LinesAhead {
 public:
  void plan(const OperationSource& line, Seconds begins, Seconds now) {
    static_cast<void>(at(now));
    const OperationSource& last = ahead_.empty() ? now_ : ahead_.back().line;
    if (line.line == last.line && line.line_number == last.line_number) return;
    ahead_.push_back({.line = line, .begins = begins});
  }
  const OperationSource& at(Seconds time) {
    for (; !ahead_.empty() && ahead_.front().begins <= time; ahead_.pop_front()) now_ = ahead_.front().line;
    return now_;
  }

 private:
  struct Planned {
    OperationSource line;
    Seconds begins{0};
  };
  std::deque<Planned> ahead_;
  OperationSource now_;
};

class MachineSession::Work {
 public:
  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  // Whether this is a program, which may be held and goes on.
  bool is_program() const { return program != nullptr || lines != nullptr; }

  WaitWords* wait_words() const {
    return program != nullptr ? &program->wait_words() : lines != nullptr ? &lines->wait_words() : nullptr;
  }
  std::string words_at(std::uint32_t line) const {
    const WaitWords* const words = wait_words();
    return words != nullptr ? words->at(line) : std::string();
  }

  Ticket ticket = 0;
  bool ended = false;
  std::uint64_t stops_before = 0;  // of the program, where it was taken up amid its path
  bool stopped = false;            // somebody asked to stop
  bool finishing = false;          // the drive has ended, and the board is asked for its counts
  bool rest_told = false;          // the rest of the current hold has been reported
  bool stops_outputs = false;      // at rest in the hold for a door, the outputs are to be switched off
  int recoveries_told = 0;
  std::optional<std::uint32_t> standstill_line;  // of the program, when a standstill amid motion was heard of

  // For a jog: when the lease is over, and how long each renewal lasts.
  std::optional<Seconds> lease_end;
  Seconds lease{0};

  // The order matters: each member uses members above it.
  Diagnostics own_findings;  // used where nobody else wants the findings
  Diagnostics* findings = &own_findings;
  AnswerBook answers;
  Watchers watchers;
  std::unique_ptr<Activity> activity;
  Program* program = nullptr;    // the activity, if it is a program
  OpenProgram* lines = nullptr;  // the program behind the activity, if it comes line by line
  bool drops = false;            // what is queued is being dropped
  HomingPath* homing = nullptr;
  std::unique_ptr<LeftOutTime> path;  // the activity's, as the drive gets it
  std::unique_ptr<MotionDrive> drive;
  std::unique_ptr<ProgramChecker> checker;  // for a check, which has no activity
  Point ahead;                              // the end of the planned path, for live motion
  LinesAhead lines_ahead;                   // the same
  ProgressAhead progress_ahead;             // the same
  std::optional<Seconds> program_ends;      // when the motion before an M2 or M30 that was planned last ends
  Seconds whole{0};                         // the nominal time of a program that tells its progress
};

}  // namespace passo
