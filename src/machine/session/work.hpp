// Work: the current work of a session: either an activity on its own drive, or a check. Private to session/.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "jog_keep_alive.hpp"
#include "planned_ahead.hpp"
#include "stop_in_hold.hpp"

#include "passo/activity/homing_path.hpp"
#include "passo/activity/program.hpp"
#include "passo/drive/motion_drive.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {

class BoardMachineSession::Work {
 public:
  // asks_counts: the drive has ended, and the board is queried for its counts.
  enum class Stage : std::uint8_t { moves, asks_counts, ended };

  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  // Whether this is a program, which can be held and resumed.
  bool is_program() const { return program != nullptr || lines != nullptr; }

  OperatorMessages* operator_messages() const {
    return program != nullptr ? &program->operator_messages()
           : lines != nullptr ? &lines->operator_messages()
                              : nullptr;
  }
  std::string words_at(std::uint32_t line) const {
    const OperatorMessages* const words = operator_messages();
    return words != nullptr ? words->at(line) : std::string();
  }

  Ticket ticket = 0;
  Stage stage = Stage::moves;
  std::uint64_t stops_before = 0;  // stops of the program before the point at which it was started in the middle of its
                                   // path
  bool stopped = false;            // a stop was requested
  StopInHold rest;                 // for a program
  int recoveries_told = 0;
  std::optional<std::uint32_t> standstill_line;  // program line, when a standstill during motion was reported
  JogKeepAlive lease;                            // for a jog

  // The order matters: each member uses members above it.
  Diagnostics own_findings;  // used if the caller does not collect the findings
  Diagnostics* findings = &own_findings;
  StoredResults answers;
  std::unique_ptr<Activity> activity;
  Program* program = nullptr;        // the activity, if it is a program
  StreamedProgram* lines = nullptr;  // the program behind the activity, if it arrives line by line
  bool drops = false;                // queued items are being dropped
  HomingPath* homing = nullptr;
  std::unique_ptr<SkippedTime> path;  // the activity's path, as passed to the drive
  std::unique_ptr<MotionDrive> drive;
  std::unique_ptr<ProgramChecker> checker;  // for a check, which has no activity
  PlannedAhead ahead;                       // for motion with immediate reactions
};

}  // namespace passo
