// MidRunChanges: what `passo run` does to a program while the program runs: holds and feed overrides at given times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/kinematics/kinematics.hpp"
#include "passo/machine/virtual_machine.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/report/summary.hpp"
#include "passo/session/machine_session.hpp"

namespace passo {

// When a cable is cut, and for how long.
struct CableCut {
  Seconds at{0};
  Seconds missing{0};
};
// Reads "SECONDS:SECONDS". Any other text is reported on standard error, and the result is empty.
std::optional<CableCut> read_cable_cut(const std::string& text);

// The counted steps of a virtual machine's motors.
MotorPlace motors_of(const MachineCounts& counts);
// The machine position of each axis of a virtual machine, computed from the counted steps of its motors.
std::vector<double> place_of(const VirtualMachine& machine, const MachineDescription& description);

// Collects the rests at the ends of braking tails during a run.
class TailWatch {
 public:
  // Call after each turn of the session.
  void update(const MachineSession& session, const VirtualMachine& machine, const MachineDescription& description);
  const std::vector<TailSummary>& tails() const { return tails_; }

 private:
  std::vector<TailSummary> tails_;
};

class MidRunChanges {
 public:
  // `holds`: "2.5" ends the run with a hold at 2.5 s; "2.5:1" goes on after one second of rest. `overrides`: "50@2.5"
  // halves the feed from 2.5 s on. Times are the board's, from the start of the program. Any other text is reported on
  // standard error, and the result is empty.
  static std::optional<MidRunChanges> read(const std::vector<std::string>& holds,
                                           const std::vector<std::string>& overrides);

  struct Change {
    Seconds at{0};
    std::optional<double> factor = {};  // factor of the feed; empty: a hold
    std::optional<Seconds> pause = {};  // how long a hold rests; empty: the hold ends the run
  };
  // By time.
  const std::vector<Change>& all() const { return changes_; }
  bool any() const { return !changes_.empty(); }
  // Call it when the program begins. `now` is the board's time.
  void begin(Seconds now) { begun_ = now; }
  // Call before each turn of the session. Returns how long the turn may take at most.
  Seconds act(MachineSession& session, const VirtualMachine& machine, const MachineDescription& description);

  // The holds in which the machine came to rest.
  std::vector<HoldSummary> holds() const;

 private:
  Seconds now(const MachineSession& session) const { return session.now() - begun_; }
  Seconds update_rest(MachineSession& session, const VirtualMachine& machine, const MachineDescription& description);
  void apply(const Change& change, MachineSession& session);

  std::vector<Change> changes_;
  std::size_t next_ = 0;
  Seconds begun_{0};
  bool holds_now_ = false;            // a hold was requested and is not over yet
  std::optional<Seconds> pause_;      // the pause of that hold
  std::optional<Seconds> resume_at_;  // the machine rests until then
  std::vector<HoldSummary> holds_;
};

}  // namespace passo
