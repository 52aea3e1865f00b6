// HomingRecord: what the last homing has found, and how well all homings agree. Private to api/.
#pragma once

#include <optional>
#include <vector>

#include "passo/activity/homing_repeats.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

class HomingRecord {
 public:
  // Both outlive this.
  HomingRecord(const MachineDescription& machine, const MachineSession& session)
      : session_(session), repeats_(machine) {}

  // The machine is now in this state.
  void on_change(MachineState state);
  const std::vector<HomedAxis>& homed() const { return homed_; }
  const HomingRepeats& repeats() const { return repeats_; }

 private:
  const MachineSession& session_;
  HomingRepeats repeats_;
  std::vector<HomedAxis> homed_;  // by the last homing
  std::optional<Point> from_;     // where the machine stood, if that was known when a homing began
  bool homes_ = false;            // a homing goes on
};

}  // namespace passo
