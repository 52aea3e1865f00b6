// HomingPath: the path of homing, which finds the machine position with the limit switches of its axes.
//
// An axis seeks its switch, backs off until the switch opens, returns slowly, and pulls off. The point at which the
// switch closes during the slow return determines the position, to the step. Each of these moves is a probe move with
// that switch as the probe. It therefore stops on the path within the limits, over any link, even if a message is lost.
// All other limit switches stop the machine instantly. If the switch is closed at the start, the axis first backs off.
//
// Axes of the same group first move together until one of them reaches its switch. That axis is homed separately; then
// the others continue.
//
// An axis with two motors is squared before it latches. Each motor continues separately to its own switch. Both back
// off together. The second motor then lags slightly, so that the first one's switch certainly closes first. In this
// way, the exact positions of both switches are found one after the other, without racking the axis by more than the
// lag. In the path, a motor that moves separately moves its axis (TwinMotors): HomedMotors has the true position of
// each.
//
// The position of an axis is unknown until it is homed. Until then, the path counts from the start position.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "passo/activity/activity.hpp"
#include "passo/activity/homed_motors.hpp"
#include "passo/activity/homing_group.hpp"
#include "passo/activity/switch_watch.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

enum class HomingStage : std::uint8_t {
  seek,
  look,    // find the axis, of those moving together, that has reached its switch
  square,  // one of the axis' two motors moves separately
  back_off,
  latch,
  pull_off,
};

// The machine position after homing. Axes that are not homed keep their positions of `start`.
Point home_rest(const MachineDescription& machine, const Point& start = {});

struct HomedAxis {
  Axis axis = Axis::x;
  double way = 0;    // distance from the start position to the closing point of the switch
  double place = 0;  // the final position, in machine coordinates
  // The correction of the second motor relative to the first one, in the axis' direction. Empty: there is none.
  std::optional<double> squared = {};
};

class HomingPath final : public Activity {
 public:
  // `machine` and `answers` must outlive the path. `answers` gives the result of the current probe move. `start`: the
  // current position. Axes that are not homed keep their positions.
  HomingPath(const MachineDescription& machine, const MachineResults& answers, const Point& start = {});
  ActivityKind kind() const override { return ActivityKind::homing; }
  [[nodiscard]] bool next(PathItem& item) override;
  std::optional<double> progress() const override;
  std::optional<ActivityFault> fault() const override;

  // The axis that is being homed; null after the last one.
  const AxisDescription* axis() const { return axis_; }
  HomingStage stage() const { return stage_; }
  const std::vector<HomedAxis>& homed() const { return homed_; }
  // The start position, as far as it was known.
  const Point& start() const { return start_; }
  std::optional<MachineFault> homing_fault() const { return fault_; }
  // Whether all axes are homed.
  bool done() const { return axis_ == nullptr; }
  // The position when all axes are homed, in machine coordinates.
  Point place() const;

 private:
  enum class Step : std::uint8_t { begin, move, end, judge };
  // The separate moves of the two motors, in this order.
  enum class Alone : std::uint8_t { close_first, close_second, lag, find_second, adjust };

  const HomeDescription& home() const { return *axis_->home; }
  // Steps per millimetre or degree of the current axis.
  double steps_per_unit() const { return kinematics_.steps_per_unit(axis_->axis); }
  // A position of that axis, rounded to whole steps of its motor.
  double in_steps(double place) const;
  const ProbeOutcome& outcome() const { return *answers_.probe(); }
  double direction() const { return home().toward_high ? 1 : -1; }
  // The position of the current axis.
  double stands() const { return position_[axis_->axis]; }
  // The position one pull-off away from `place`, at which the switch must be open.
  double off(double place) const;
  Action action(Action::Kind kind, const Point& place) const;
  bool is_pair() const { return axis_->second.has_value(); }
  void begin_turn();
  void seek_together();
  void begin_look(const AxisDescription& axis);
  void begin_axis(const AxisDescription& axis);
  void begin(HomingStage stage, double target);
  void begin_alone(Alone alone, double way);
  void move_alone(double way);
  void judge();
  void record_way(const Point& before);
  void judge_together();
  void judge_look();
  void judge_alone();
  void go_on_alone();
  void fall_further_behind();
  void judge_approach();
  void judge_retreat();
  void retreat(HomingStage stage, double target);
  void reverse_watch();
  void end_axis();
  void fail(MachineFault fault) { fault_ = fault; }

  const MachineDescription& machine_;
  const Kinematics kinematics_;
  const MachineResults& answers_;
  Point start_;
  HomingGroup turn_;
  const AxisDescription* axis_ = nullptr;
  HomingStage stage_ = HomingStage::seek;
  Alone alone_ = Alone::close_first;
  bool settles_ = false;  // the separately moved motor continues to a whole-step distance from the other
  Step step_ = Step::begin;
  SwitchWatch watch_;
  Point target_;
  MmPerSecond speed_{0};
  bool knows_switch_ = false;  // the approximate closing point of the switch is known
  HomedMotors motors_;
  double lag_ = 0;  // lag of the second motor before the latch
  Point position_;  // the position at the last stop
  std::vector<HomedAxis> homed_;
  std::optional<MachineFault> fault_;
};

}  // namespace passo
