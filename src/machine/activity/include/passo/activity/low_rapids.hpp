// LowRapids: warns of a rapid below the work's top.
//
// Nobody tells the program where the work's top is, so this is an estimate. Wherever a feed goes down and comes to the
// end of its way down, there is material. The highest such place so far counts as the work's top:
//
//     Z |  \ rapid          rapid /          top: the end of the first way down; feeds that come down by rapid alone,
//       |   \ feed               /           and feeds in the air, do not count
//   top |....\___ feed ____....                 \ feed
//       |                  \ feed              . \___ ...
//
// Rapids are reported that go sideways and end at the top or below it, that go straight down below all feeds so far,
// and that go down below zero before the program has given X or Y. So are programs whose feeds go down, and never below
// Z0. Each is reported once, where the program makes it first, with the other lines that make it. Heights are work
// coordinates; a change of the work frame begins anew. G53, G28 and G30 count where the zero of the work is known. Only
// for machines with X, Y and Z: on a lathe Z is no height.
#pragma once

#include <limits>
#include <optional>

#include "passo/activity/operation_watcher.hpp"
#include "passo/activity/tool_track.hpp"

namespace passo {

class LowRapids : OperationWatcher {
 public:
  // `zero_is_known`: where the zero of the work is on the machine, before the program says so.
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
  bool has_spindle_;  // with a speed
  bool zero_is_known_;
  bool knows_z_ = false;                                     // the tool's height in the work
  bool knows_xy_ = false;                                    // the program has said where it begins
  bool descends_ = false;                                    // the last feed went down
  std::optional<double> top_;                                // Z; empty: nothing is known to be cut
  std::optional<double> deepest_;                            // the lowest Z of a feed
  double lowest_ = std::numeric_limits<double>::infinity();  // the same in all frames
  std::optional<Diagnostic> no_depth_;                       // at the first feed that goes down
};

}  // namespace passo
