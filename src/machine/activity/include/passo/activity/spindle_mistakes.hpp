// SpindleMistakes: warns of a cut that may begin before the spindle has reached its speed, and of a program that seems
// to be made for a laser.
//
// Without [laser] in the machine file, the beam of such a program would stay on in rapids and during stops. A machine
// without Y is a lathe, for which there is no laser warning: there M4 is usual, and S may change between cuts.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/activity/operation_watcher.hpp"
#include "passo/activity/tool_track.hpp"

namespace passo {

class SpindleMistakes : OperationWatcher {
 public:
  SpindleMistakes(const MachineDescription& machine, std::string file, Diagnostics& diagnostics);

  // Call it for each operation of the program, in order.
  void watch(const Operation& operation, const ToolTrack& track);
  // Call it after the last operation.
  void finish();

 private:
  void turn(const Operation& operation, SpindleDirection direction);
  void set_speed(const Operation& operation, double speed);
  void check_speed_up(const Operation& operation);
  void feed(const Operation& operation);

  bool may_be_early_;  // the spindle has a speed, and the machine file does not give its run-up time
  bool is_lathe_;
  bool has_laser_;

  SpindleDirection direction_ = SpindleDirection::off;
  double speed_ = 0;       // S
  bool taps_ = false;      // inside a tapping cycle, which reverses the spindle at the bottom of the hole
  bool fed_last_ = false;  // the last motion was a feed, without a stop since

  std::optional<Diagnostic> sped_up_;  // the spindle was accelerated, without a wait since
  std::optional<Diagnostic> early_;    // the same, followed by a feed: the first position

  std::optional<std::uint32_t> changed_;  // the line of a change of S since the last motion
  std::uint64_t places_ = 0;              // number of feeds typical of a laser program
  bool any_changes_ = false;              // S has changed
  bool any_backwards_ = false;            // M4 was used
  std::optional<Diagnostic> laser_;       // set at the first position
};

}  // namespace passo
