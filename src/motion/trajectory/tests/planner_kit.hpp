// Shared by the planner's tests: plans, and independently computed velocities and accelerations.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "../cell.hpp"
#include "../speed_window.hpp"
#include "kit/motion_text.hpp"
#include "kit/stage_test.hpp"
#include <gtest/gtest.h>

#include "passo/path/path_smoother.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo::test {

using Real = long double;

inline MotionLimits equal_limits(double velocity, double acceleration) {
  MotionLimits limits;
  for (const Axis axis : all_axes) {
    limits.velocity[axis] = MmPerSecond(velocity);
    limits.acceleration[axis] = MmPerSecond2(acceleration);
  }
  return limits;
}

inline Segment line(const Point& start, const Point& end, double speed) {
  return {.curve = Curve::line(start, end),
          .speed = MmPerSecond(speed),
          .rapid = false,
          .mode = PathMode::continuous,
          .tolerance = Mm(0.01),
          .source = {}};
}

inline std::vector<PathItem> polyline(const std::vector<Point>& corners, double speed) {
  std::vector<PathItem> items;
  for (std::size_t i = 1; i < corners.size(); ++i) items.emplace_back(line(corners[i - 1], corners[i], speed));
  return items;
}

inline std::vector<MotionItem> plan(const std::vector<PathItem>& path, const MotionLimits& limits,
                                    std::size_t most_queued = Planner::most_queued_cells) {
  ListSource<PathItem> source(path);
  Planner planner(source, limits, most_queued);
  return drain(planner);
}

// Smooths corners as in a job.
inline std::vector<PathItem> smoothed(const std::vector<PathItem>& path,
                                      Smoothness smoothness = Smoothness::least_bending) {
  ListSource<PathItem> source(path);
  PathSmoother smoother(source, smoothness);
  return drain(smoother);
}

inline double total_time(const std::vector<MotionItem>& motion) {
  double sum = 0;
  for (const MotionItem& item : motion) {
    if (const auto* move = std::get_if<PlannedMove>(&item)) sum += move->duration().value();
  }
  return sum;
}

inline double entry_speed(const PlannedMove& move) {
  return move.begin()->velocity.value();
}
inline double exit_speed(const PlannedMove& move) {
  return move.exit_velocity().value();
}

inline std::string to_text(const std::vector<MotionItem>& motion) {
  std::string text;
  for (const MotionItem& item : motion) text += passo::to_text(item);
  return text;
}

// Velocity and acceleration of every axis at the path speed v with acceleration a, computed independently in polar
// form.
struct Motion {
  PerAxis<Real> velocity;
  PerAxis<Real> acceleration;
};
inline Motion motion_at(const Curve& curve, Real s, Real v, Real a) {
  const Real length = curve.length().value();
  Motion motion;
  for (const Axis axis : all_axes) {
    const Real slope = (Real(curve.end()[axis]) - Real(curve.start()[axis])) / length;
    motion.velocity[axis] = slope * v;
    motion.acceleration[axis] = slope * a;
  }
  if (curve.shape() == Curve::Shape::line) return motion;
  if (curve.shape() == Curve::Shape::cubic) {
    const Curve::CubicData cubic = curve.cubic_data();
    for (const Axis axis : all_axes) {
      const Real slope = cubic.first[axis] + s * (2 * Real(cubic.second[axis]) + 3 * s * Real(cubic.third[axis]));
      const Real bend = 2 * Real(cubic.second[axis]) + 6 * s * Real(cubic.third[axis]);
      motion.velocity[axis] = slope * v;
      motion.acceleration[axis] = slope * a + bend * v * v;
    }
    return motion;
  }
  const Curve::ArcData& arc = curve.arc_data();
  const Real radius = arc.start_radius + (Real(arc.end_radius) - arc.start_radius) * s / length;
  const Real angle = arc.start_angle + Real(arc.sweep) * s / length;
  const Real radius_rate = (Real(arc.end_radius) - arc.start_radius) / length * v;
  const Real angle_rate = Real(arc.sweep) / length * v;
  const Real radius_change = (Real(arc.end_radius) - arc.start_radius) / length * a;
  const Real angle_change = Real(arc.sweep) / length * a;
  const Real radial = radius_change - radius * angle_rate * angle_rate;
  const Real around = radius * angle_change + 2 * radius_rate * angle_rate;
  const Real cosine = std::cos(angle);
  const Real sine = std::sin(angle);
  motion.velocity[arc.first] = radius_rate * cosine - radius * angle_rate * sine;
  motion.velocity[arc.second] = radius_rate * sine + radius * angle_rate * cosine;
  motion.acceleration[arc.first] = radial * cosine - around * sine;
  motion.acceleration[arc.second] = radial * sine + around * cosine;
  return motion;
}

inline void expect_within_limits(const PlannedMove& move, const MotionLimits& limits, Real slack = 1e-6L) {
  for (const Phase& phase : move) {
    for (int k = 0; k <= 16; ++k) {
      const Real t = Real(phase.duration.value()) * k / 16;
      const Real v = phase.velocity.value() + phase.acceleration.value() * t;
      const Real s = phase.start.value() + t * (phase.velocity.value() + t * phase.acceleration.value() / 2);
      ASSERT_GE(v, -1e-12L);
      ASSERT_LE(v, Real(move.segment.speed.value()) * (1 + 1e-9L));
      const Motion motion = motion_at(move.segment.curve, s, v, phase.acceleration.value());
      for (const Axis axis : all_axes) {
        ASSERT_LE(std::abs(motion.velocity[axis]), limits.velocity[axis].value() * (1 + 1e-6L)) << letter_of(axis);
        ASSERT_LE(std::abs(motion.acceleration[axis]), limits.acceleration[axis].value() * (1 + slack))
            << letter_of(axis) << " at s " << double(s) << " of " << move.segment.curve.length().value();
      }
      for (const RowLimits& own : limits.rows) {
        Real velocity = 0;
        Real acceleration = 0;
        for (const auto& [axis, factor] : own.row.shares()) {
          velocity += factor * motion.velocity[axis];
          acceleration += factor * motion.acceleration[axis];
        }
        ASSERT_LE(std::abs(velocity), own.velocity.value() * (1 + 1e-6L)) << "of a row";
        ASSERT_LE(std::abs(acceleration), own.acceleration.value() * (1 + slack)) << "of a row at s " << double(s);
      }
    }
  }
}

inline void expect_continuous(const std::vector<MotionItem>& motion) {
  double speed = 0;
  double position = 0;  // on the segment
  for (const MotionItem& item : motion) {
    const auto* move = std::get_if<PlannedMove>(&item);
    if (move == nullptr) {
      ASSERT_EQ(speed, 0) << "an action not at rest";
      continue;
    }
    SCOPED_TRACE(passo::to_text(*move));
    const double length = move->segment.curve.length().value();
    ASSERT_GE(move->phase_count, 1U);
    for (const Phase& phase : *move) {
      ASSERT_GT(phase.duration.value(), 0);
      ASSERT_NEAR(phase.start.value(), position, 1e-11 * length);
      ASSERT_NEAR(phase.velocity.value(), speed, 1e-9 * (1 + speed));
      position = phase.position_at(phase.duration).value();
      speed = phase.velocity_at(phase.duration).value();
      ASSERT_GE(speed, 0);
    }
    ASSERT_NEAR(position, move->to.value(), 1e-11 * length);
    if (move->to.value() == length) position = 0;
  }
  ASSERT_EQ(position, 0) << "a segment is not played to its end";
  ASSERT_EQ(speed, 0) << "the program does not end at rest";
}

// A single cell.
struct LoneCell {
  Cell cell;
  std::array<AxisDemand, most_demands_of_cell> demands;
  std::array<FallingDemand, most_limited_axes> falling;
  CellPlace place() { return {cell, demands.data(), falling.data()}; }
};

// Plans the whole program at once: backwards over all cells, then forwards. Returns the squared speeds at their ends.
inline std::vector<double> exits_offline(const std::vector<PathItem>& path, const MotionLimits& limits) {
  struct Whole {
    LoneCell piece;
    double top = 0;
    double entry = 0;
  };
  std::vector<Whole> cells;
  CellCutter cutter(limits);
  const Segment* before = nullptr;
  for (const PathItem& item : path) {
    const auto* segment = std::get_if<Segment>(&item);
    if (segment != nullptr) cutter.begin(*segment, std::numeric_limits<double>::infinity());
    bool rest = before == nullptr || segment == nullptr || before->mode == PathMode::exact_stop;
    if (!rest) {
      const Point turn = segment->curve.tangent(Mm(0)) - before->curve.tangent(before->curve.length());
      for (const double part : turn.values) rest = rest || std::abs(part) > 1e-6;
    }
    before = segment;
    Whole cell;
    while (segment != nullptr && !cutter.at_end()) {
      cutter.next(cell.piece.place());
      cell.top = std::min(cell.piece.cell.top_squared, segment->speed.value() * segment->speed.value());
      cell.entry = rest || cells.empty() ? 0 : std::min(cell.top, cells.back().top);
      rest = false;
      cells.push_back(cell);
    }
  }
  double exit = 0;
  for (auto cell = cells.rbegin(); cell != cells.rend(); ++cell) {
    const Cell& data = cell->piece.cell;
    const std::span demands(cell->piece.demands.data(), cell->piece.cell.demand_count);
    exit = cell->entry = data.straight ? std::min(cell->entry, exit + 2 * data.acceleration * data.length)
                                       : largest_entry(demands, cell->entry, std::min(exit, cell->top));
  }
  std::vector<double> exits;
  double speed = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& data = cells[i].piece.cell;
    const std::span demands(cells[i].piece.demands.data(), cells[i].piece.cell.demand_count);
    const double most = std::min(cells[i].top, i + 1 < cells.size() ? cells[i + 1].entry : 0);
    const double change = 2 * data.acceleration * data.length;
    speed = data.straight ? std::min(most, speed + change) : largest_exit(demands, speed, most);
    exits.push_back(speed);
  }
  return exits;
}

}  // namespace passo::test
