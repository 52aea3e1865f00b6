// MidRunChanges: what `passo run` does to a job while it runs: holds and feed overrides at given times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "passo/drive/motion_drive.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/report/summary.hpp"

namespace passo {

// When a cable is cut, and for how long.
struct CableCut {
  Seconds at{0};
  Seconds missing{0};
};
// Of "SECONDS:SECONDS"; nothing where it says something else, which is told on standard error.
std::optional<CableCut> read_cable_cut(const std::string& text);

// Watches a job for rests at the ends of braking tails.
class TailWatch {
 public:
  // After each step of the drive.
  void look(const MotionDrive& drive, const VirtualMachine& machine, const MachineDescription& description);
  const std::vector<TailSummary>& tails() const { return tails_; }

 private:
  std::vector<TailSummary> tails_;
};

class MidRunChanges {
 public:
  // `holds`: "2.5" ends the run at rest from 2.5 s on; "2.5:1" goes on after a second of rest. `overrides`: "50@2.5" is
  // half the feed from 2.5 s on. Times are those of the virtual machine. Nothing where one says something else, which
  // is told on standard error.
  static std::optional<MidRunChanges> read(const std::vector<std::string>& holds,
                                           const std::vector<std::string>& overrides);

  bool any() const { return !changes_.empty(); }
  // Before the first step.
  void begin(MotionDrive& drive) const;
  // Between any two steps of the drive.
  void act(MotionDrive& drive, VirtualMachine& machine, const MachineDescription& description);

  // Those that came before the end of the program.
  std::vector<HoldSummary> holds() const;

 private:
  struct Change {
    Seconds at{0};
    std::optional<double> factor = {};  // of the feed; none: a hold
    std::optional<Seconds> pause = {};  // of a hold, until it goes on
  };
  void wait_for_feed(MotionDrive& drive);
  void rest(MotionDrive& drive, VirtualMachine& machine, const MachineDescription& description);

  std::vector<Change> changes_;  // by time
  std::size_t next_ = 0;
  std::optional<Seconds> pause_;
  std::vector<HoldSummary> holds_;
};

}  // namespace passo
