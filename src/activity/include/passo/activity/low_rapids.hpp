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
// Two rapids are reported: one that goes sideways and ends at the top or below it, and one that goes straight down
// below all feeds so far. Each is reported once, where the program makes it first. Heights are work coordinates; a
// change of the work frame begins anew. Only for machines with X, Y and Z: on a lathe Z is no height.
#pragma once

#include <optional>

#include "passo/activity/operation_watcher.hpp"

namespace passo {

class LowRapids : OperationWatcher {
 public:
  LowRapids(const MachineDescription& machine, std::string file, Diagnostics& diagnostics);

  // Call it for each operation of the program, in order.
  void watch(const Operation& operation);

 private:
  void feed_to(const Point& end);
  void rapid_to(const Operation& operation, const Point& end);
  void end_descent();
  void forget_heights();

  bool has_height_;
  std::optional<Point> place_;     // empty: unknown in the present frame
  bool descends_ = false;          // the last feed went down
  std::optional<double> top_;      // Z; empty: nothing is known to be cut
  std::optional<double> deepest_;  // the lowest Z of a feed
  bool told_sideways_ = false;
  bool told_down_ = false;
};

}  // namespace passo
