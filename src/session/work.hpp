// Work: what a session is busy with: an activity on a drive of its own, or a check. Private to session/.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "passo/activity/homing_path.hpp"
#include "passo/activity/program.hpp"
#include "passo/drive/motion_drive.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class MachineSession::Work {
 public:
  Work() = default;
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

  Ticket ticket = 0;
  bool ended = false;
  bool stopped = false;    // somebody asked for that
  bool finishing = false;  // the drive has ended, and the board's counts are asked for
  bool rest_told = false;  // of the hold at hand
  int recoveries_told = 0;

  // For a jog: when the lease is over, and for how long it is renewed.
  std::optional<Seconds> lease_end;
  Seconds lease{0};

  // In this order: each uses what is above it.
  Diagnostics own_findings;  // where nobody else wants them
  Diagnostics* findings = &own_findings;
  AnswerBook answers;
  Watchers watchers;
  std::unique_ptr<Activity> activity;
  Program* program = nullptr;  // of the activity, where it is one
  HomingPath* homing = nullptr;
  std::unique_ptr<MotionDrive> drive;
  std::unique_ptr<ProgramChecker> checker;  // of a check, which has no activity
  Point ahead;                              // the end of what is planned, of live motion
};

}  // namespace passo
