#include "passo/activity/spindle_mistakes.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/interpreter/is_any_of.hpp"

namespace passo {

SpindleMistakes::SpindleMistakes(const MachineDescription& machine, std::string file, Diagnostics& diagnostics)
    : OperationWatcher(std::move(file), diagnostics),
      may_be_early_(machine.tool.highest_rpm > 0 && !machine.spindle.run_up_is_given && !machine.spindle.modbus),
      is_lathe_(std::ranges::find(machine.axes, Axis::y, &AxisDescription::axis) == machine.axes.end()),
      has_laser_(machine.motion_outputs.laser.has_value()) {}

void SpindleMistakes::watch(const Operation& operation, const ToolTrack& track) {
  using namespace passo::operation;
  if (const auto* set = std::get_if<SetFeedOverride>(&operation.what)) taps_ = !set->on;
  if (taps_ || has_laser_) return;
  if (const auto* turned = std::get_if<TurnSpindle>(&operation.what)) return turn(operation, turned->direction);
  if (const auto* speed = std::get_if<SetSpindleSpeed>(&operation.what)) {
    return set_speed(operation, speed->revolutions_per_minute);
  }
  if (is_any_of<StraightFeed, ArcFeed, NurbsFeed>(operation)) {
    if (track.moves()) feed(operation);
    return;
  }
  if (!is_any_of<StraightTraverse, Dwell, ProgramStop, OptionalProgramStop, ChangeTool>(operation)) return;
  fed_last_ = false;
  changed_.reset();
  if (!is_any_of<StraightTraverse>(operation)) sped_up_.reset();
}

void SpindleMistakes::turn(const Operation& operation, SpindleDirection direction) {
  if (direction == SpindleDirection::off) {
    sped_up_.reset();
  } else if (direction != direction_) {
    check_speed_up(operation);
  }
  direction_ = direction;
}

void SpindleMistakes::set_speed(const Operation& operation, double speed) {
  const double before = std::exchange(speed_, speed);
  if (direction_ == SpindleDirection::off || speed == before) return;
  changed_ = operation.source.line;
  if (speed > before) check_speed_up(operation);
}

void SpindleMistakes::check_speed_up(const Operation& operation) {
  if (!may_be_early_ || early_ || sped_up_) return;
  sped_up_ = warning(operation, "path.spindle-early",
                     "a cut follows at once, and nothing waits until the spindle is at its speed",
                     "run_up_s in the table [spindle] of the machine file, or a dwell (G4) before the cut");
}

void SpindleMistakes::feed(const Operation& operation) {
  if (sped_up_) early_ = std::exchange(sped_up_, std::nullopt);
  const bool changes = changed_ && (fed_last_ || *changed_ == operation.source.line);
  changed_.reset();
  fed_last_ = true;
  const bool backwards = direction_ == SpindleDirection::counterclockwise;
  if (is_lathe_ || !(changes || backwards)) return;
  any_changes_ |= changes;
  any_backwards_ |= backwards;
  ++places_;
  if (laser_) return laser_->add_line(operation.source.line);
  laser_ = warning(operation, "path.laser", {}, "a program for a spindle, or [laser] in the machine file");
}

void SpindleMistakes::finish() {
  if (laser_) {
    const std::string_view what = !any_backwards_ ? "S changes" : !any_changes_ ? "M4 is on" : "S changes, or M4 is on";
    laser_->message = fmt::format(
        "{} in {}, as in a laser program; without [laser] in the machine file the beam would stay on in rapids and at "
        "stops, and "
        "motion stops at each change of S",
        what, counted(places_, "feed"));
    diagnostics_.add_certain(*std::exchange(laser_, std::nullopt));
  } else if (early_) {
    diagnostics_.add_certain(*std::exchange(early_, std::nullopt));
  }
}

}  // namespace passo
