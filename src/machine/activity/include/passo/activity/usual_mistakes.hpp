// UsualMistakes: warns of what is allowed, but seldom meant. A program says no units; it feeds while the spindle
// stands; M3 runs at S0; '%' ends it with the spindle on; a dwell of minutes was probably meant in milliseconds; an arc
// is nearly a circle; S or T has no effect.
//
// Each mistake is reported once, where the program makes it first, with the other lines that make it. The warnings
// about the spindle are for machines whose file gives the spindle a speed (tool.max_rpm). A laser, a hot wire and a pen
// have none; S is idle there.
#pragma once

#include <optional>

#include "passo/activity/operation_watcher.hpp"
#include "passo/activity/tool_track.hpp"

namespace passo {

class UsualMistakes : OperationWatcher {
 public:
  // `units`: the units before the program says any; inches were then chosen by the user.
  UsualMistakes(const MachineDescription& machine, LengthUnits units, std::string file, Diagnostics& diagnostics);

  // Call it for each operation of the program, in order.
  void watch(const Operation& operation, const ToolTrack& track);
  // Call it after the last operation.
  void finish();

 private:
  void feed(const Operation& operation);
  void arc(const Operation& operation, const operation::ArcFeed& arc, const Point& from);
  void move(const Operation& operation);
  void dwell(const Operation& operation, Seconds time);
  void idle_speed(const Operation& operation);
  void change_tool();
  void select(const Operation& operation, std::int32_t tool);
  void turn_spindle(const Operation& operation, SpindleDirection direction);

  bool has_spindle_;
  bool knows_units_;
  SpindleDirection spindle_ = SpindleDirection::off;
  double speed_ = 0;  // S
  // M3 or M4 while S is 0. A later S makes it good, so this is reported at the first feed.
  std::optional<Diagnostic> turned_at_zero_;
  std::optional<Diagnostic> left_on_;  // M3 or M4, while the spindle is on
  // The tool is a probe since its first probe move, until the tool is changed. A probe does not turn when it is fed.
  bool probes_ = false;
  bool changes_tools_ = false;
  std::optional<Diagnostic> idle_tool_;  // a T word, as long as no tool is changed
};

}  // namespace passo
