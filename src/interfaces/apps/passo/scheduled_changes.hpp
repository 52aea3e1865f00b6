// ScheduledChanges: changes that `passo run` makes while a program runs: holds, feed overrides and factors of adaptive
// feed at given times.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"

#include "passo/kinematics/kinematics.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/report/summary.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {

// When a cable is cut, and for how long.
struct CableCut {
  Seconds at{0};
  Seconds missing{0};
};
// Parses "SECONDS:SECONDS". Reports any other text on standard error, and returns nothing.
std::optional<CableCut> read_cable_cut(const std::string& text);

// Returns the counted steps of a virtual machine's motors.
MotorPosition motors_of(const MachineCounts& counts);
// Returns the machine position of each axis of a virtual machine, computed from the counted steps of its motors.
std::vector<double> place_of(const VirtualMachine& machine, const MachineDescription& description);

// Records the stops at the ends of stop ramps during a run.
class TailWatch {
 public:
  // Must be called after each turn of the session.
  void update(const BoardMachineSession& session, const VirtualMachine& machine, const MachineDescription& description);
  const std::vector<StopRampSummary>& tails() const { return tails_; }

 private:
  std::vector<StopRampSummary> tails_;
};

class ScheduledChanges {
 public:
  // Hold "2.5" ends the run with a hold at 2.5 s; "2.5:1" continues one second after the stop. Override "50@2.5"
  // halves the feed from 2.5 s on. Times are the board's, from the start of the program. Reports any other text, and a
  // faulty adaptive feed file, on standard error, and returns nothing.
  static std::optional<ScheduledChanges> read(const ChangeArguments& arguments);

  bool any() const { return !changes_.empty(); }
  // Must be called when the program begins. `now` is the board's time.
  void begin(Seconds now) { begun_ = now; }
  // Must be called before each turn of the session. Returns the maximum duration of the turn. `place`: that of each
  // axis now.
  Seconds act(MachineSession& session, const std::function<std::vector<double>()>& place);

  // The holds in which the machine has stopped.
  std::vector<HoldSummary> holds() const;

 private:
  struct Change {
    Seconds at{0};
    std::optional<double> factor = {};    // feed factor
    std::optional<double> adaptive = {};  // the machine's own feed factor (M52)
    std::optional<Seconds> pause = {};    // duration of a hold; empty: the hold ends the run
    bool is_hold() const { return !factor && !adaptive; }
  };

  Seconds now(const MachineSession& session) const { return session.now() - begun_; }
  Seconds update_rest(MachineSession& session, const std::function<std::vector<double>()>& place);
  void apply(const Change& change, MachineSession& session);
  [[nodiscard]] bool add_adaptive_feed(const std::string& file);

  std::vector<Change> changes_;
  std::size_t next_ = 0;
  Seconds begun_{0};
  bool holds_now_ = false;            // a hold was requested and has not ended yet
  std::optional<Seconds> pause_;      // the duration of that hold
  std::optional<Seconds> resume_at_;  // time at which the machine is to resume
  std::vector<HoldSummary> holds_;
};

}  // namespace passo
