// FrequentMistakes: warns of code that is valid, but rarely intended: a program without a unit; a feed while the
// spindle is off; M3 at S0; '%' at the end with the spindle on; a dwell of minutes, probably meant in milliseconds; an
// arc that is nearly a circle; S or T without effect.
//
// Each mistake is reported once, at its first position, with the other lines that repeat it. The spindle warnings are
// for machines whose file gives the spindle a speed (tool.max_rpm). A laser, a hot wire and a pen have none; there S is
// unused.
#pragma once

#include <optional>

#include "passo/activity/operation_watcher.hpp"
#include "passo/activity/tool_track.hpp"
#include "passo/path/hand_tool_change.hpp"

namespace passo {

class FrequentMistakes : OperationWatcher {
 public:
  // `units`: the units before the program sets any; inches were then chosen by the user.
  FrequentMistakes(const MachineDescription& machine, LengthUnits units, std::string file, Diagnostics& diagnostics);

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

  bool has_laser_;
  bool has_spindle_;
  bool knows_units_;
  SpindleDirection spindle_ = SpindleDirection::off;
  double speed_ = 0;  // S
  // M3 or M4 while S is 0. A later S corrects this, so it is reported at the first feed.
  std::optional<Diagnostic> turned_at_zero_;
  std::optional<Diagnostic> left_on_;  // set by M3 or M4, while the spindle is on
  // From its first probe move until a tool change, the tool is a probe. A probe does not rotate during a feed.
  bool probes_ = false;
  // M5 before the first M3 or M4: the program feeds with the spindle off on purpose.
  bool keeps_spindle_off_ = false;
  bool has_turned_ = false;
  bool changes_tools_ = false;
  HandToolChange hand_;
  std::optional<Diagnostic> idle_tool_;  // a T word without a tool change so far
};

}  // namespace passo
