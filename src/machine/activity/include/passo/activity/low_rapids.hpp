// LowRapids: warns of rapids below the top of the workpiece.
//
// The top of the workpiece is not known, so it is estimated: the end of each downward feed is in material, and the
// highest such point so far counts as the top:
//
//     Z |  \ rapid          rapid /          top: the end of the first plunge; a depth reached by rapid alone,
//       |   \ feed               /           and feeds in the air, do not count
//   top |....\___ feed ____....                 \ feed
//       |                  \ feed              . \___ ...
//
// It reports rapids that move sideways and end at the top or below it, rapids straight down below all feeds so far,
// rapids below zero before the program has set X or Y, and programs whose feeds move down but never below Z0. Each
// warning is reported once, at its first line, with a list of further lines. Heights are work coordinates; a change of
// the work coordinate system starts again. G53, G28 and G30 are included if the work zero is known. Only for machines
// with X, Y and Z: on a lathe, Z is not a height.
#pragma once

#include <limits>
#include <optional>

#include "passo/activity/operation_watcher.hpp"
#include "passo/activity/tool_track.hpp"

namespace passo {

class LowRapids : OperationWatcher {
 public:
  // `zero_is_known`: whether the machine position of the work zero is known before the program sets it.
  LowRapids(const MachineDescription& machine, bool zero_is_known, std::string file, Diagnostics& diagnostics);

  // Call it for each operation of the program, in order.
  void watch(const Operation& operation, const ToolTrack& track);
  // Call it after the last operation.
  void finish();

 private:
  void know_place(const Operation& operation);
  void feed(const Operation& operation, const ToolTrack& track, bool knew_z);
  void rapid(const Operation& operation, const ToolTrack& track, bool knew_z);
  void end_descent(const Point& end);

  bool has_height_;
  bool has_spindle_;  // the spindle has a speed
  bool zero_is_known_;
  bool knows_z_ = false;                                     // the tool's work Z is known
  bool knows_xy_ = false;                                    // the program has set X and Y
  bool descends_ = false;                                    // the last feed moved down
  std::optional<double> top_;                                // Z; empty: no cut is known yet
  std::optional<double> deepest_;                            // the lowest Z of a feed
  double lowest_ = std::numeric_limits<double>::infinity();  // the lowest Z in any work coordinate system
  std::optional<Diagnostic> no_depth_;                       // set at the first feed that moves down
};

}  // namespace passo
