#include "passo/activity/frequent_mistakes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "mistake_sentences.hpp"
#include <fmt/format.h>

#include "passo/interpreter/is_any_of.hpp"
#include "passo/interpreter/plane_axes.hpp"

namespace passo {
namespace {

// Dwells in milliseconds are whole hundreds as a rule. A dwell so long in seconds is rare: a spindle that warms up.
constexpr Seconds suspicious_dwell{100};

bool is_in_milliseconds(Seconds time) {
  return time >= suspicious_dwell && std::fmod(time.value(), 10.0) == 0;
}

// An arc whose ends are closer than this is a full circle that misses its start, or a short arc the wrong way round.
constexpr Mm nearly_closed{0.05};

// True: the arc goes round nearly once, and not nearly not at all.
bool is_nearly_circle(const operation::ArcFeed& arc, const Point& from) {
  if (std::abs(arc.turns) != 1) return false;
  const PlaneAxes axes = axes_of(arc.plane);
  const double first = from[axes.first] - arc.first_center.value();
  const double second = from[axes.second] - arc.second_center.value();
  const double end_first = arc.end[axes.first] - arc.first_center.value();
  const double end_second = arc.end[axes.second] - arc.second_center.value();
  const double gap = std::hypot(end_first - first, end_second - second);
  if (gap == 0 || gap > nearly_closed.value() || gap > std::hypot(first, second) / 4) return false;
  const double counterclockwise = first * end_second - second * end_first;
  return counterclockwise * arc.turns < 0;
}

}  // namespace

FrequentMistakes::FrequentMistakes(const MachineDescription& machine, LengthUnits units, std::string file,
                                   Diagnostics& diagnostics)
    : OperationWatcher(std::move(file), diagnostics),
      has_laser_(machine.motion_outputs.laser.has_value()),
      has_spindle_(machine.tool.highest_rpm > 0 && !has_laser_),
      knows_units_(units == LengthUnits::inch) {}

void FrequentMistakes::watch(const Operation& operation, const ToolTrack& track) {
  using namespace passo::operation;
  const OperationKind& what = operation.what;
  hand_.watch(operation);
  if (is_any_of<StraightFeed, ArcFeed, NurbsFeed, RigidTap>(operation)) {
    if (!track.moves()) return;
    if (const auto* round = std::get_if<ArcFeed>(&what)) arc(operation, *round, track.from());
    return feed(operation);
  }
  if (is_any_of<StraightTraverse, StraightProbe>(operation)) {
    probes_ |= is_any_of<StraightProbe>(operation);
    return move(operation);
  }
  const bool is_by_hand = is_any_of<ProgramStop>(operation) && hand_.at_stop() != 0;
  if (is_by_hand || is_any_of<ChangeTool, SetToolNumber>(operation)) change_tool();
  if (is_any_of<Finish>(operation) && left_on_) diagnostics_.add_certain(*std::exchange(left_on_, std::nullopt));
  if (const auto* tool = std::get_if<SelectTool>(&what)) return select(operation, tool->tool);
  if (const auto* turn = std::get_if<TurnSpindle>(&what)) return turn_spindle(operation, turn->direction);
  if (const auto* pause = std::get_if<Dwell>(&what)) return dwell(operation, pause->time);
  if (const auto* speed = std::get_if<SetSpindleSpeed>(&what)) {
    speed_ = speed->revolutions_per_minute;
    if (speed_ > 0) turned_at_zero_.reset();
    if (speed_ > 0 && !has_spindle_ && !has_laser_) idle_speed(operation);
  } else if (is_any_of<SetLengthUnits>(operation) && operation.source.line > 0) {
    knows_units_ = true;  // line 0: the interpreter says its own units before the program begins
  }
}

// A speed has no effect on a spindle that is switched on and off.
void FrequentMistakes::idle_speed(const Operation& operation) {
  warn(operation, "path.idle-speed", mistakes_say::idle_speed, mistakes_say::speed_in_machine_file);
}

void FrequentMistakes::change_tool() {
  probes_ = false;
  changes_tools_ = true;
  idle_tool_.reset();
  keeps_spindle_off_ = false;  // M6 itself stops the spindle
}

// T alone selects a tool. Programs often select the next tool early, so only a program without any change is wrong.
void FrequentMistakes::select(const Operation& operation, std::int32_t tool) {
  if (changes_tools_ || tool == 0) return;
  if (idle_tool_) return idle_tool_->add_line(operation.source.line);
  idle_tool_ = warning(operation, "path.idle-tool", mistakes_say::idle_tool.with({{"tool", std::to_string(tool)}}),
                       mistakes_say::tool_change);
}

void FrequentMistakes::finish() {
  if (idle_tool_) diagnostics_.add_certain(*std::exchange(idle_tool_, std::nullopt));
}

void FrequentMistakes::dwell(const Operation& operation, Seconds time) {
  if (!is_in_milliseconds(time) || is_noted(operation, "path.long-dwell")) return;
  const std::string written = fmt::format("{:g}", time.value());
  diagnostics_.add_certain(warning(
      operation, "path.long-dwell", mistakes_say::long_dwell.with({{"time", written}}),
      mistakes_say::dwell_in_seconds.with({{"short", fmt::format("{:g}", time.value() / 1000)}, {"time", written}})));
}

void FrequentMistakes::turn_spindle(const Operation& operation, SpindleDirection direction) {
  spindle_ = direction;
  turned_at_zero_.reset();
  left_on_.reset();
  // Line 0: the interpreter itself, before the program begins.
  keeps_spindle_off_ = direction == SpindleDirection::off && !has_turned_ && operation.source.line > 0;
  if (direction == SpindleDirection::off) return;
  has_turned_ = true;
  left_on_ =
      warning(operation, "path.spindle-left-on", mistakes_say::spindle_left_on, mistakes_say::spindle_off_before);
  if (speed_ > 0) return;
  turned_at_zero_ =
      warning(operation, "path.spindle-at-zero", mistakes_say::spindle_at_zero, mistakes_say::speed_first);
}

void FrequentMistakes::move(const Operation& operation) {
  if (std::exchange(knows_units_, true)) return;
  diagnostics_.add_certain(warning(operation, "path.no-units", mistakes_say::no_units, mistakes_say::units_first));
}

void FrequentMistakes::feed(const Operation& operation) {
  move(operation);
  if (!has_spindle_) return;
  if (turned_at_zero_) {
    diagnostics_.add_certain(*std::exchange(turned_at_zero_, std::nullopt));
  } else if (spindle_ == SpindleDirection::off && !probes_ && !keeps_spindle_off_) {
    warn(operation, "path.spindle-off-in-feed", mistakes_say::feed_without_spindle, mistakes_say::spindle_first);
  }
}

void FrequentMistakes::arc(const Operation& operation, const operation::ArcFeed& arc, const Point& from) {
  if (!is_nearly_circle(arc, from) || is_noted(operation, "path.nearly-circle")) return;
  const PlaneAxes axes = axes_of(arc.plane);
  const double gap = std::hypot(arc.end[axes.first] - from[axes.first], arc.end[axes.second] - from[axes.second]);
  diagnostics_.add_certain(warning(operation, "path.nearly-circle",
                                   mistakes_say::nearly_circle.with({{"gap", fmt::format("{:.2g}", gap)}}),
                                   mistakes_say::whole_circle));
}

}  // namespace passo
