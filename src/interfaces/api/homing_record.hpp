// HomingRecord: the results of the last homing, and the repeatability over all homings. Private to api/.
#pragma once

#include <optional>
#include <vector>

#include "passo/activity/homing_repeats.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class HomingRecord {
 public:
  // Both must outlive this object.
  HomingRecord(const MachineDescription& machine, const MachineSession& session)
      : session_(session), repeats_(machine) {}

  // Must be called when the machine's state changes.
  void on_change(MachineState state);
  const std::vector<HomedAxis>& homed() const { return homed_; }
  const HomingRepeats& repeats() const { return repeats_; }

 private:
  const MachineSession& session_;
  HomingRepeats repeats_;
  std::vector<HomedAxis> homed_;  // the axes homed by the last homing
  std::optional<Point> from_;     // position at the start of the homing, if it was known
  bool homes_ = false;            // homing is in progress
};

}  // namespace passo
