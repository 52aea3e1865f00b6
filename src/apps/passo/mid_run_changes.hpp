// MidRunChanges: what `passo run` does to a program while it runs: holds and feed overrides at given times.
#pragma once

#include <optional>
#include <string>
#include <vector>

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
// Of "SECONDS:SECONDS"; nothing where it says something else, which is told on standard error.
std::optional<CableCut> read_cable_cut(const std::string& text);

// Where the motors of a virtual machine stand, on each axis, from the steps that were counted.
std::vector<double> place_of(const VirtualMachine& machine, const MachineDescription& description);

// Watches a run for rests at the ends of braking tails.
class TailWatch {
 public:
  // After each turn of the session.
  void look(const MachineSession& session, const VirtualMachine& machine, const MachineDescription& description);
  const std::vector<TailSummary>& tails() const { return tails_; }

 private:
  std::vector<TailSummary> tails_;
};

class MidRunChanges {
 public:
  // `holds`: "2.5" ends the run at rest from 2.5 s on; "2.5:1" goes on after a second of rest. `overrides`: "50@2.5" is
  // half the feed from 2.5 s on. Times are those of the board, from the start of the program. Nothing where one says
  // something else, which is told on standard error.
  static std::optional<MidRunChanges> read(const std::vector<std::string>& holds,
                                           const std::vector<std::string>& overrides);

  bool any() const { return !changes_.empty(); }
  // The program begins now.
  void begin(Seconds now) { begun_ = now; }
  // Before each turn of the session. How long that may take at most.
  Seconds act(MachineSession& session, const VirtualMachine& machine, const MachineDescription& description);

  // Those that came before the end of the program.
  std::vector<HoldSummary> holds() const;

 private:
  struct Change {
    Seconds at{0};
    std::optional<double> factor = {};  // of the feed; none: a hold
    std::optional<Seconds> pause = {};  // of a hold, until it goes on
  };
  Seconds now(const MachineSession& session) const { return session.now() - begun_; }
  Seconds mind_rest(MachineSession& session, const VirtualMachine& machine, const MachineDescription& description);
  void apply(const Change& change, MachineSession& session);

  std::vector<Change> changes_;  // by time
  std::size_t next_ = 0;
  Seconds begun_{0};
  bool holds_now_ = false;            // a hold was asked for, and is not over
  std::optional<Seconds> pause_;      // of it
  std::optional<Seconds> resume_at_;  // it rests until then
  std::vector<HoldSummary> holds_;
};

}  // namespace passo
