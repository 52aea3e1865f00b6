#include "passo/kinematics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo {
namespace {

// A pivot below this share of its row is a rounding error: no motor tells of that axis.
constexpr double least_pivot = 1e-9;

// Equations for the axes that share motors: factors · axes = steps. Solved by elimination.
class SharedAxes {
 public:
  void add_axis(Axis axis) { axes_[axis_count_++] = axis; }
  // `steps`: what the row's axes that are not known make of the motor's steps.
  void add_motor(const AxisRow& row, double steps) {
    Equation& equation = equations_[equation_count_++];
    for (std::size_t i = 0; i < axis_count_; ++i) {
      equation.factors[i] = row.factor_of(axes_[i]);
      equation.size = std::max(equation.size, std::fabs(equation.factors[i]));
    }
    equation.steps = steps;
  }
  // Leaves an axis as it is for which there are too few motors.
  void solve(Point& place) {
    std::size_t solved = 0;
    std::array<std::size_t, axis_count> row_of{};
    std::array<bool, axis_count> is_found{};
    for (std::size_t i = 0; i < axis_count_; ++i) {
      is_found[i] = eliminate(i, solved);
      if (is_found[i]) row_of[i] = solved++;
    }
    for (std::size_t i = 0; i < axis_count_; ++i) {
      if (!is_found[i]) continue;
      const Equation& equation = equations_[row_of[i]];
      double steps = equation.steps;
      for (std::size_t k = 0; k < axis_count_; ++k) {
        if (!is_found[k]) steps -= equation.factors[k] * place[axes_[k]];
      }
      place[axes_[i]] = steps / equation.factors[i] + 0.0;  // never a negative zero
    }
  }

 private:
  struct Equation {
    std::array<double, axis_count> factors{};
    double steps = 0;
    double size = 0;  // of the greatest factor at first
  };

  // Leaves axis `i` in one equation, which becomes the one at `place`. False: no equation from there on has the axis.
  bool eliminate(std::size_t i, std::size_t place) {
    std::size_t pivot = place;
    double greatest = least_pivot;
    for (std::size_t e = place; e < equation_count_; ++e) {
      const double share = std::fabs(equations_[e].factors[i]) / equations_[e].size;
      if (!(share > greatest)) continue;
      greatest = share;
      pivot = e;
    }
    if (!(greatest > least_pivot)) return false;
    std::swap(equations_[place], equations_[pivot]);
    const Equation& own = equations_[place];
    for (std::size_t e = 0; e < equation_count_; ++e) {
      if (e == place || equations_[e].factors[i] == 0) continue;
      const double times = equations_[e].factors[i] / own.factors[i];
      for (std::size_t k = 0; k < axis_count_; ++k) equations_[e].factors[k] -= times * own.factors[k];
      equations_[e].factors[i] = 0;
      equations_[e].steps -= times * own.steps;
    }
    return true;
  }

  std::array<Axis, axis_count> axes_{};
  std::array<Equation, max_motors> equations_{};
  std::size_t axis_count_ = 0;
  std::size_t equation_count_ = 0;
};

double place_at(const MotorRow& row, double steps, bool down) {
  const double place = (steps - row.offset) / row.steps.factor() + 0.0;  // never a negative zero
  return row.screw ? row.screw->place(place, down) : place;
}

}  // namespace

Kinematics::Kinematics(std::initializer_list<MotorRow> rows) {
  for (const MotorRow& row : rows) add(row);
}

void Kinematics::add(const MotorRow& row) {
  if (count_ < max_motors) rows_[count_++] = row;
}

MotorPosition Kinematics::motors(const Point& axes, AxisSet downs) const {
  MotorPosition place;
  for (std::size_t m = 0; m < count_; ++m) place[m] = rows_[m].steps_at(axes, downs);
  return place;
}

Point Kinematics::axes(const MotorPosition& motors, AxisSet downs, const Point& others) const {
  Point place = others;
  AxisSet known;
  bool shares = false;
  for (std::size_t m = 0; m < count_; ++m) {
    const AxisRow& row = rows_[m].steps;
    shares = shares || !row.has_one_axis();
    if (!row.has_one_axis() || row.factor() == 0 || known.has(row.axis())) continue;
    place[row.axis()] = place_at(rows_[m], motors[m], downs.has(row.axis()));
    known.add(row.axis());
  }
  if (shares) find_shared(motors, known, place);
  return place;
}

void Kinematics::find_shared(const MotorPosition& motors, AxisSet known, Point& place) const {
  SharedAxes shared;
  AxisSet unknown;
  for (const MotorRow& row : rows()) {
    for (const AxisRow::Share& share : row.steps.shares()) {
      if (share.factor == 0 || known.has(share.axis) || unknown.has(share.axis)) continue;
      unknown.add(share.axis);
      shared.add_axis(share.axis);
    }
  }
  for (std::size_t m = 0; m < count_; ++m) {
    double steps = motors[m] - rows_[m].offset;
    bool tells = false;
    for (const AxisRow::Share& share : rows_[m].steps.shares()) {
      if (known.has(share.axis)) steps -= share.factor * place[share.axis];
      tells = tells || (unknown.has(share.axis) && share.factor != 0);
    }
    if (tells) shared.add_motor(rows_[m].steps, steps);
  }
  shared.solve(place);
}

Point Kinematics::axes_after(const Point& from, const MotorPosition& motors, unsigned moved, AxisSet downs) const {
  const Point there = axes(motors, downs, from);
  Point place = from;
  for (std::size_t m = 0; m < count_; ++m) {
    if ((moved >> m & 1U) == 0) continue;
    for (const AxisRow::Share& share : rows_[m].steps.shares()) {
      if (share.factor != 0) place[share.axis] = there[share.axis];
    }
  }
  return place;
}

double Kinematics::steps_per_unit(Axis axis) const {
  double most = 0;
  for (const MotorRow& row : rows()) most = std::max(most, std::fabs(row.steps.factor_of(axis)));
  return most;
}

}  // namespace passo
