// JerkOptimizer: makes the rows of the limits. Rows of bends have factors that hold for speeds near the present ones.
#include <algorithm>
#include <cmath>
#include <utility>

#include "arithmetic.hpp"
#include "jerk_optimizer.hpp"

namespace passo {
namespace {

constexpr double outer_part = 0.65;  // weight of x at the node in the mean speed of half a cell; the rest: the middle
constexpr double reached = 0.999;    // a limit counts as reached from this share on

double times(const std::array<double, 4>& factors, const double* values) {
  return factors[0] * values[0] + factors[1] * values[1] + factors[2] * values[2] + factors[3] * values[3];
}

std::array<double, 4> sum(const std::array<double, 4>& a, double factor_a, const std::array<double, 4>& b,
                          double factor_b) {
  return {a[0] * factor_a + b[0] * factor_b, a[1] * factor_a + b[1] * factor_b, a[2] * factor_a + b[2] * factor_b,
          a[3] * factor_a + b[3] * factor_b};
}

struct Forms {  // linear forms of a cell, in x0, a0, x1, a1
  explicit Forms(double h)
      : middle_x{0.5, h / 4, 0.5, -h / 4},
        middle_a{-1 / h, -0.5, 1 / h, -0.5},
        first{-2 / (h * h), -3 / h, 2 / (h * h), -1 / h},
        second{2 / (h * h), 1 / h, -2 / (h * h), 3 / h} {}
  std::array<double, 4> middle_x;
  std::array<double, 4> middle_a;
  std::array<double, 4> first;  // j / v
  std::array<double, 4> second;
};

constexpr std::array<double, 4> x_in = {1, 0, 0, 0};
constexpr std::array<double, 4> a_in = {0, 1, 0, 0};
constexpr std::array<double, 4> x_out = {0, 0, 1, 0};

}  // namespace

// From rest with jerk j the motion is at h = j t³/6 with v = j t²/2 and a = j t. So a = 2 x / 3 h.
void JerkOptimizer::tie(Four& along) const {
  for (const Tie& tied : {tied_first_, tied_last_}) {
    if (!tied.holds) continue;
    if (cell_ == tied.node) along[0] += tied.factor * std::exchange(along[1], 0);
    if (cell_ + 1 == tied.node) along[2] += tied.factor * std::exchange(along[3], 0);
  }
}

void JerkOptimizer::add_row(Row row) {
  tie(row.along);
  add_tied_row(row);
}

// Slacks and prices of a row are kept when it is computed again.
void JerkOptimizer::add_tied_row(const Row& row) {
  if (rows_made_ == rows_.size()) rows_.emplace_back();
  Row& to = rows_[rows_made_++];
  to.along = row.along;
  to.offset = row.offset;
  to.limit = row.limit;
}

void JerkOptimizer::add_jolt_row(JoltRow row) {
  tie(row.along);
  if (jolt_rows_made_ == jolt_rows_.size()) jolt_rows_.emplace_back();
  JoltRow& to = jolt_rows_[jolt_rows_made_++];
  to.along = row.along;
  to.limit = row.limit;
  to.place = row.place;
}

// The greatest x at the node of the cell that is no rest. With the jerk the same in all of the cell, a³ = 6 h j², and
// each demand of an axis is a power of a.
double JerkOptimizer::highest_beside_rest(const Stretch& stretch, std::size_t cell, bool begins) const {
  const JerkCell& own = stretch.cells[cell];
  const double h = own.length;
  const double by_jerk = 1 / std::sqrt(6 * h);
  const double by_speed = std::sqrt(1.5 * h);
  double most = infinity;    // of |a|
  double most_x = infinity;  // of x
  const auto meet = [&](double factor, double limit) {
    if (factor > 0 && limit < infinity) most = std::min(most, std::cbrt(limit * limit / (factor * factor)));
  };
  if (own.straight) {
    meet(by_jerk, own.jerk * stretch.share[cell]);
    most = std::min(most, own.acceleration * stretch.share[cell]);
  } else {
    const AxisShape* shape = &stretch.shapes[cell * axes_.size()];
    for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
      const double limit = axes_[k].jerk * stretch.share[cell];
      // Backwards in time the slope and the third derivative change their signs, and so does a.
      const double first = begins ? shape->slope_out : -shape->slope_in;
      const double second = begins ? shape->bend_out : shape->bend_in;
      const double third = begins ? shape->third_out : -shape->third_in;
      meet(std::abs(begins ? shape->slope_in : shape->slope_out) * by_jerk, limit);
      meet(std::abs(first * by_jerk + 3 * second * by_speed + third * by_speed * by_speed * by_speed), limit);
      const double force = std::abs(first * 2 / (3 * h) + second);
      if (force > 0) most_x = std::min(most_x, axes_[k].acceleration * stretch.share[cell] / force);
    }
  }
  return std::min(1.5 * h * most, most_x);
}

// In the first cell after a rest, or the last cell before one, only x at the other node is unknown.
void JerkOptimizer::add_cell_at_rest(const Stretch& stretch, std::size_t cell, bool begins) {
  const std::size_t node = begins ? cell + 1 : cell;
  const double cap = std::min(stretch.node_cap[node], highest_beside_rest(stretch, cell, begins)) / 2;
  add_tied_row({.along = begins ? x_out : x_in, .offset = cap, .limit = cap});
}

void JerkOptimizer::add_stop_row(const Four& x, const Stop& stop, double share) {
  const double cap = stop.square * share / 2;
  add_tied_row({.along = x, .offset = cap, .limit = cap});
}

void JerkOptimizer::add_straight_rows(const JerkCell& cell, double share, double in_share) {
  const Forms forms(cell.length);
  if (cell.acceleration < infinity) {
    const double limit = cell.acceleration * share;
    if (in_share > 0) add_row({.along = a_in, .limit = cell.acceleration * in_share});
    add_row({.along = forms.middle_a, .limit = limit});
  }
  if (cell.jerk < infinity) {
    const double limit = cell.jerk * share;
    add_jolt_row({.along = forms.first, .limit = limit, .place = At::early});
    add_jolt_row({.along = forms.second, .limit = limit, .place = At::late});
  }
}

// Where the limit falls, the row uses the line that is the highest at the present speed: |force| + fall w <= at rest.
void JerkOptimizer::add_force_rows(const Row& row, const LimitedAxis& axis, const Four& x, const Place& place) {
  add_row(row);
  if (!axis.falls_at(place.weight * place.cap)) return;
  const AccelerationCurve::Line& line = axis.line_at(place.weight * place.x);
  const double fall = place.share * place.weight * line.fall;
  add_row({.along = sum(row.along, 1, x, fall), .limit = place.share * line.at_rest});
  add_row({.along = sum(row.along, 1, x, -fall), .limit = place.share * line.at_rest});
}

// An axis is left out if the limits of other axes keep it far from its own limits. With the largest |q'|, |q''| and
// |q'''| of each axis in the cell, and with the smallest |q'|, an axis limits the acceleration along the path to
// (A + |q''| x) / |q'|, and the jerk to (J + 3 |q''| v a + |q'''| v³) / |q'|.
JerkOptimizer::Binding JerkOptimizer::binding_in(const Stretch& stretch, std::size_t cell) const {
  const double share = stretch.share[cell];
  const double x = std::max({stretch.node_cap[cell], stretch.cap[cell], stretch.node_cap[cell + 1]});
  const double v = std::sqrt(x);
  struct Steepness {
    double least = 0;
    double most = 0;
    double bend = 0;
    double third = 0;
  };
  std::array<Steepness, most_limited_axes> all;
  double acceleration = infinity;
  const AxisShape* const shapes = &stretch.shapes[cell * axes_.size()];
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const AxisShape& shape = shapes[k];
    const double in = std::abs(shape.slope_in);
    const double out = std::abs(shape.slope_out);
    Steepness& own = all[k];
    own.third = std::max(std::abs(shape.third_in), std::abs(shape.third_out));
    own.bend = std::max(std::abs(shape.bend_in), std::abs(shape.bend_out));
    const double bulge = stretch.cells[cell].length * stretch.cells[cell].length / 8 * own.third;
    own.most = std::max(in, out) + bulge;
    own.least = shape.slope_in * shape.slope_out > 0 ? std::max(std::min(in, out) - bulge, 0.0) : 0;
    if (own.least > 0) {
      acceleration = std::min(acceleration, (axes_[k].acceleration * share + own.bend * x) / own.least);
    }
  }
  double jerk = infinity;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    if (!(all[k].least > 0)) continue;
    const double turning = 3 * all[k].bend * v * acceleration + all[k].third * v * x;
    jerk = std::min(jerk, (axes_[k].jerk * share + turning) / all[k].least);
  }
  Binding binding;
  for (std::size_t k = 0; k < axes_.size(); ++k) {
    const Steepness& own = all[k];
    if (own.most == 0 && own.bend == 0) continue;
    const std::uint32_t bit = std::uint32_t{1} << k;
    const double force = own.most * acceleration + own.bend * x;
    const double force_limit = axes_[k].acceleration * share;
    if (force_limit < infinity && (axes_[k].falling != nullptr || !(force < reached * force_limit))) {
      binding.force |= bit;
    }
    const double jolt = own.most * jerk + 3 * own.bend * v * acceleration + own.third * v * x;
    const double jolt_limit = axes_[k].jerk * share;
    if (jolt_limit < infinity && !(jolt < reached * jolt_limit)) binding.jolt |= bit;
  }
  return binding;
}

void JerkOptimizer::add_rows(const Stretch& stretch, std::size_t cell, bool is_first) {
  const JerkCell& own = stretch.cells[cell];
  const double share = stretch.share[cell];
  const double in_share = cell > 0 ? std::min(share, stretch.share[cell - 1]) : share;
  const Forms forms(own.length);
  const double half_cap = stretch.cap[cell] / 2;
  const double in_cap = stretch.node_cap[cell] / 2;
  if (!is_first) add_row({.along = x_in, .offset = in_cap, .limit = in_cap});
  add_row({.along = forms.middle_x, .offset = half_cap, .limit = half_cap});
  if (own.straight) {
    add_straight_rows(own, share, is_first ? 0 : in_share);
    return;
  }
  // The jerk is the same in all of half a cell.
  const double* const at = here_;
  const double middle = std::max(times(forms.middle_x, at), std::min(at[0], at[2]) / 4);
  const double first = outer_part * at[0] + (1 - outer_part) * middle;
  const double second = outer_part * at[2] + (1 - outer_part) * middle;
  const double first_by_in = std::sqrt(first / at[0]);  // quotients of speeds
  const double first_by_middle = std::sqrt(first / middle);
  const double second_by_middle = std::sqrt(second / middle);
  const double second_by_out = std::sqrt(second / at[2]);
  const Binding binding = binding_in(stretch, cell);
  const AxisShape* shape = &stretch.shapes[cell * axes_.size()];
  for (std::size_t k = 0; k < axes_.size(); ++k, ++shape) {
    const bool has_force = (binding.force >> k & 1) != 0;
    const bool has_jolt = (binding.jolt >> k & 1) != 0;
    if (!has_force && !has_jolt) continue;
    const double third = shape->third_middle();
    const double slope = shape->slope_middle(own.length);
    const double bend = shape->bend_middle();
    if (has_force) {
      const auto add_place = [&](const Four& a, const Four& x, double q1, double q2, double own_share, double cap) {
        add_force_rows({.along = sum(a, q1, x, q2), .limit = axes_[k].acceleration * own_share}, axes_[k], x,
                       {.weight = q1 * q1, .share = own_share, .x = times(x, at), .cap = cap});
      };
      if (!is_first) add_place(a_in, x_in, shape->slope_in, shape->bend_in, in_share, stretch.node_cap[cell]);
      add_place(forms.middle_a, forms.middle_x, slope, bend, share, stretch.cap[cell]);
    }
    if (!has_jolt) continue;
    const double limit = axes_[k].jerk * share;
    const auto add_jolt = [&](At place, const Four& along) {
      add_jolt_row({.along = along, .limit = limit, .place = place});
    };
    const Four turning = sum(forms.middle_a, 3 * bend, forms.middle_x, third);
    const Four turning_in = {shape->third_in, 3 * shape->bend_in, 0, 0};
    const Four turning_out = {0, 0, shape->third_out, 3 * shape->bend_out};
    add_jolt(At::in, sum(forms.first, shape->slope_in * first_by_in, turning_in, 1));
    add_jolt(At::middle, sum(forms.first, slope * first_by_middle, turning, 1));
    add_jolt(At::middle, sum(forms.second, slope * second_by_middle, turning, 1));
    add_jolt(At::out, sum(forms.second, shape->slope_out * second_by_out, turning_out, 1));
  }
}

// Where a cell bends, its rows have factors that hold for speeds near the present ones, so they are computed again
// during a lift: the same rows in the same order.
void JerkOptimizer::make_rows(const Stretch& stretch, std::size_t first, std::size_t last) {
  cells_.clear();
  rows_made_ = 0;
  jolt_rows_made_ = 0;
  for (std::size_t k = first; k < last; ++k) {
    cell_ = k - first;
    here_ = &at_[2 * cell_];
    add_cell(stretch, k);
  }
}

void JerkOptimizer::add_cell(const Stretch& stretch, std::size_t cell) {
  const bool begins = here_[0] == 0;
  const bool has_rest = begins || here_[2] == 0;
  const double h = stretch.cells[cell].length;
  Cell own{.to_and_fro = {-1 / h, -1, 1 / h, -1}, .length = h};
  tie(own.to_and_fro);
  if (has_rest) {
    add_cell_at_rest(stretch, cell, begins);
  } else {
    add_rows(stretch, cell, cell_ == 0);
    if (begins_free() && cell_ == 0) add_stop_row(x_in, stretch.begins, stretch.share[cell]);
    if (ends_free() && cell_ + 1 == tied_last_.node) add_stop_row(x_out, stretch.ends, stretch.share[cell]);
    Four middle = Forms(h).middle_x;
    tie(middle);
    const std::array<Four, 5> squares = {x_in, middle, x_out, sum(x_in, outer_part, middle, 1 - outer_part),
                                         sum(x_out, outer_part, middle, 1 - outer_part)};
    own.pace_count = stretch.cells[cell].straight ? 5 : 3;
    for (std::size_t p = 0; p < own.pace_count; ++p) own.paces[p].square = squares[p];
  }
  own.rows_end = rows_made_;
  own.jolt_rows_end = jolt_rows_made_;
  cells_.push_back(own);
}

}  // namespace passo
