// HomingPath: the path of homing, which finds the machine position with the limit switches of its axes.
//
// An axis seeks its switch, backs off until the switch opens, returns slowly, and pulls off. The point at which the
// switch closes during the slow return determines the position, to the step. Each of these moves is a probe move with
// that switch as the probe. It therefore stops on the path within the limits, over any link, and does not depend on a
// single message. All other limit switches stop the machine instantly. If the switch is closed at the start, the axis
// first backs off.
//
// Axes of the same group first move together until one of them reaches its switch. That axis is homed separately; then
// the others continue.
//
// An axis with two motors is squared before it latches. Each motor continues separately to its own switch. Both back
// off together. The second motor then lags slightly, so that the first one's switch certainly closes first. In this
// way, the exact positions of both switches are found one after the other, without racking the axis by more than the
// lag. In the path, a motor that moves separately moves its axis (TwinMotors): `goes_` has the true position of each.
//
// The position of an axis is unknown until it is homed. Until then, the path counts from the start position.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "passo/activity/activity.hpp"
#include "passo/interpreter/machine_answers.hpp"
#include "passo/kinematics/kinematics.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

enum class HomingStage : std::uint8_t {
  seek,
  look,    // find the axis, of those that seek together, that has reached its switch
  square,  // one of the axis' two motors moves separately
  back_off,
  latch,
  pull_off,
};

// The machine position after homing. Axes that are not homed keep their positions of `start`.
Point home_rest(const MachineDescription& machine, const Point& start = {});

struct HomedAxis {
  Axis axis = Axis::x;
  double way = 0;    // from the start position to the closing point of the switch
  double place = 0;  // the final position, in machine coordinates
  // The correction of the second motor relative to the first one, in the axis' direction. Empty: there is none.
  std::optional<double> squared = {};
};

class HomingPath final : public Activity {
 public:
  // `machine` and `answers` must outlive the path. `answers` gives the result of the current probe move. `start`: the
  // current position. Axes that are not homed keep their positions.
  HomingPath(const MachineDescription& machine, const MachineAnswers& answers, const Point& start = {});
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
  static constexpr std::size_t first_motor = 0;
  static constexpr std::size_t second_motor = 1;

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
  void begin_look(std::size_t which);
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
  double farthest_beyond() const;
  double apart_from_switches() const;
  void judge_approach();
  void judge_retreat();
  void retreat(HomingStage stage, double target);
  void reverse_watch();
  void end_axis();
  void fail(MachineFault fault) { fault_ = fault; }

  const MachineDescription& machine_;
  const Kinematics kinematics_;
  const MachineAnswers& answers_;
  Point start_;
  std::vector<const AxisDescription*> turn_;  // the axes of this group that are not homed yet
  std::size_t looked_at_ = 0;                 // of these
  bool together_ = false;                     // all of them seek together
  std::optional<Point> met_;                  // their positions when the first of them reached its switch
  const AxisDescription* axis_ = nullptr;
  HomingStage stage_ = HomingStage::seek;
  Alone alone_ = Alone::close_first;
  bool settles_ = false;  // the separately moved motor continues to a whole-step distance from the other
  Step step_ = Step::begin;
  bool until_closed_ = true;  // the move ends when the switch closes; otherwise when it opens
  Point target_;
  MmPerSecond speed_{0};
  std::uint8_t limits_ = 0;        // the watched switches
  bool knows_switch_ = false;      // the approximate closing point of the switch is known
  std::array<double, 2> goes_{};   // the positions of the axis' motors; with one motor, both are that of the axis
  std::array<double, 2> found_{};  // the position of each of them when its switch closed
  double lag_ = 0;                 // lag of the second motor before the latch
  int turns_ = 0;
  Point position_;  // the position at the last stop
  std::vector<HomedAxis> homed_;
  std::optional<MachineFault> fault_;
};

}  // namespace passo
