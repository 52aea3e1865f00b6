// HomingPath: finds out where a machine stands, by the limit switches of its axes.
//
// An axis seeks its switch, backs off until the switch is open, comes back slowly, and pulls off. The point where the
// switch closes during the slow return is the axis's place, to the step. Each of these moves is a probe move with that
// switch in the probe's place. So each move brakes on the path within the limits, over any line, and no move depends on
// a single message. All other limit switches stop the machine at once. If the switch is closed at the beginning, the
// axis first backs off.
//
// Axes of the same turn first move together until one of them meets its switch. That one is homed alone; then the
// others go on.
//
// An axis with two motors is squared before it latches. Each motor goes on alone to its own switch. Both back off
// together. The second motor then falls behind a little, so that the first one's switch is sure to close first: so the
// exact places of both switches are found, one by one, without racking the axis by more than that. In the path a motor
// that moves alone moves its axis (TwinMotors): `goes_` tells where each of them truly is.
//
// The place of an axis is unknown until the axis is homed. Until then the path counts from where the machine stood.
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
  look,    // of the axes that sought together, which one has met its switch
  square,  // one of the axis's two motors moves alone
  back_off,
  latch,
  pull_off,
};

// Where a machine rests after homing, in machine coordinates. Axes that are not homed keep their places of `start`.
Point home_rest(const MachineDescription& machine, const Point& start = {});

struct HomedAxis {
  Axis axis = Axis::x;
  double way = 0;    // from where the axis stood to where the switch closed
  double place = 0;  // where the axis rests, in machine coordinates
  // How far the second motor was moved against the first one, in the axis's direction. Empty: there is none.
  std::optional<double> squared = {};
};

class HomingPath final : public Activity {
 public:
  // `machine` and `answers` outlive the path. `answers` tell what the current probe move has found. `start`: where the
  // machine stands. Axes that are not homed keep their places.
  HomingPath(const MachineDescription& machine, const MachineAnswers& answers, const Point& start = {});
  ActivityKind kind() const override { return ActivityKind::homing; }
  [[nodiscard]] bool next(PathItem& item) override;
  std::optional<double> progress() const override;
  std::optional<ActivityFault> fault() const override;

  // The axis that is being homed; null after the last one.
  const AxisDescription* axis() const { return axis_; }
  HomingStage stage() const { return stage_; }
  const std::vector<HomedAxis>& homed() const { return homed_; }
  // Where the machine stood, as far as was known.
  const Point& start() const { return start_; }
  std::optional<MachineFault> homing_fault() const { return fault_; }
  // All axes are homed.
  bool done() const { return axis_ == nullptr; }
  // Where the machine stands when all axes are homed, in machine coordinates.
  Point place() const;

 private:
  enum class Step : std::uint8_t { begin, move, end, judge };
  // What a motor does alone, in this order.
  enum class Alone : std::uint8_t { close_first, close_second, lag, find_second, adjust };
  static constexpr std::size_t first_motor = 0;
  static constexpr std::size_t second_motor = 1;

  const HomeDescription& home() const { return *axis_->home; }
  // Steps a millimetre or a degree of the axis that is being homed.
  double steps_per_unit() const { return kinematics_.steps_per_unit(axis_->axis); }
  // A place of that axis in whole steps of its motor.
  double in_steps(double place) const;
  const ProbeOutcome& outcome() const { return *answers_.probe(); }
  double direction() const { return home().toward_high ? 1 : -1; }
  // Where the current axis stands.
  double stands() const { return position_[axis_->axis]; }
  // The place, a pull-off away from `place`, where the switch is to be open.
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
  std::vector<const AxisDescription*> turn_;  // the axes of this turn that are not homed yet
  std::size_t looked_at_ = 0;                 // of these
  bool together_ = false;                     // all of them seek at once
  std::optional<Point> met_;                  // where they were when the first of them met its switch
  const AxisDescription* axis_ = nullptr;
  HomingStage stage_ = HomingStage::seek;
  Alone alone_ = Alone::close_first;
  bool settles_ = false;  // the motor that moved alone goes on to a whole step from the other
  Step step_ = Step::begin;
  bool until_closed_ = true;  // the move ends when the switch closes; else when it opens
  Point target_;
  MmPerSecond speed_{0};
  std::uint8_t limits_ = 0;        // the switches that are watched
  bool knows_switch_ = false;      // knows roughly where the switch closes
  std::array<double, 2> goes_{};   // where the axis's motors are; with one motor, both are the axis
  std::array<double, 2> found_{};  // where each of them was when its switch closed
  double lag_ = 0;                 // how far the second motor falls behind before the latch
  int turns_ = 0;
  Point position_;  // where the machine rests
  std::vector<HomedAxis> homed_;
  std::optional<MachineFault> fault_;
};

}  // namespace passo
