// Kinematics: converts the positions of the axes into positions of the motors, and back.
//
// Each motor has a row: its steps are a sum over axes (AxisRow), optionally corrected by the errors and the backlash of
// a screw. A Cartesian machine has one axis in each row and one row for each axis. A gantry has two rows for the axis
// with two motors. CoreXY has two rows of X and Y. Under such rows a line stays a line, and an arc or a cubic stays a
// sum of the same functions of the distance, so the step generator and the planner follow the rows themselves.
//
// Programs, jogs and travel limits refer to axes. Step counts, switches at motors and the wire protocol refer to
// motors. No other module converts between them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>

#include "passo/geometry/axes.hpp"
#include "passo/kinematics/axis_row.hpp"
#include "passo/kinematics/screw_map.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo {

// A motor, and the axes that it moves.
struct MotorRow {
  AxisRow steps;      // per millimetre or degree; negative: the motor counts down when the axis moves up
  double offset = 0;  // steps with all axes at 0; not for a motor with a screw
  std::shared_ptr<const ScrewMap> screw = {};  // only for a row of one axis; null: motor and axis are proportional

  // Returns the steps, with a fraction. `downs`: the axes whose backlash is taken up for motion in the negative
  // direction.
  double steps_at(const Point& place, AxisSet downs = {}) const {
    if (!screw) return steps.of(place) + offset;
    return screw->nominal(place[steps.axis()], downs.has(steps.axis())) * steps.factor() + offset;
  }
};

// The steps of each motor from the machine's zero, with fractions.
struct MotorPosition {
  std::array<double, max_motors> steps{};
  double& operator[](std::size_t motor) { return steps[motor]; }
  double operator[](std::size_t motor) const { return steps[motor]; }
};

// Returns the steps since the counts were `zero`.
template <class Counts, class Zero>
MotorPosition steps_since(const Zero& zero, const Counts& counts) {
  MotorPosition place;
  for (std::size_t m = 0; m < zero.size() && m < max_motors; ++m) {
    place[m] = static_cast<double>(std::int64_t{counts[m]} - zero[m]);
  }
  return place;
}

class Kinematics {
 public:
  Kinematics() = default;
  Kinematics(std::initializer_list<MotorRow> rows);
  // A motor beyond max_motors is ignored.
  void add(const MotorRow& row);

  std::span<const MotorRow> rows() const { return {rows_.data(), count_}; }
  std::uint8_t motor_count() const { return static_cast<std::uint8_t>(count_); }

  // `downs`: the axes whose backlash is taken up for motion in the negative direction, here and in axes().
  MotorPosition motors(const Point& axes, AxisSet downs = {}) const;
  // Converts motor positions to axis positions. An axis with a motor of its own follows that motor (the first, if there
  // are two); axes that share motors follow all of these. `others`: the positions of axes without a motor.
  Point axes(const MotorPosition& motors, AxisSet downs = {}, const Point& others = {}) const;
  // The same, if only some motors have moved since the axes were at `from`: bit i of `moved` is motor i. The other axes
  // keep exactly their positions.
  Point axes_after(const Point& from, const MotorPosition& motors, unsigned moved, AxisSet downs = {}) const;

  // Steps per millimetre or degree of the axis, for the motor that makes the most. Never negative; 0: no motor moves
  // the axis.
  double steps_per_unit(Axis axis) const;

 private:
  void find_shared(const MotorPosition& motors, AxisSet known, Point& place) const;

  std::array<MotorRow, max_motors> rows_;
  std::size_t count_ = 0;
};

}  // namespace passo
