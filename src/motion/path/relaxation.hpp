// Relaxation: the arithmetic of the sweeps. A step moves a control point of the spline to the position of least
// bending, as far as the tube allows. A step that the tube stops may slide along the tube instead: to the point on the
// tube that is nearest to the end of the step. Without that, control points stick where they first reach the tube.
//
// A control point k affects the spline at three knots, k-1 to k+1, and in the middles of four spans, k-2 to k+1, by
// known factors. Each move updates the deviations from the path and the second derivatives at these points. The values
// of one axis are contiguous, so four points are computed at once. This is the hot path of the smoother: about 30 ns
// per step.
#pragma once

#include <array>
#include <cstdint>

#include "passo/base/lanes.hpp"
#include "passo/geometry/axes.hpp"

namespace passo {

class Relaxation {
 public:
  using Four = std::array<double, 4>;
  enum class Power : std::uint8_t { fourth, eighth };
  // The effect of moving a control point by 1, at the knots k-1 to k+1 (the fourth is 0) and in the middles of the
  // spans k-2 to k+1. The step to least bending is minus the sum of `pull` times p'' at the knots. The step to the
  // least change of bending is found in the same way, from the knots k-2 to k+2.
  struct Factors {
    Four off{};
    Four bend{};
    Four middle{};
    Four pull{};
    std::array<double, 5> change_pull{};
  };

  // Clears everything; the next number is -1.
  void begin();
  // Makes room for the numbers up to `k`. Numbers before `oldest` may be dropped.
  void make_room(std::int64_t k, std::int64_t oldest);

  Point control(std::int64_t k) const { return gather(&AxisLanes::control, k); }
  Point off(std::int64_t k) const { return gather(&AxisLanes::off, k); }
  Point bend(std::int64_t k) const { return gather(&AxisLanes::bend, k); }
  Point middle_off(std::int64_t k) const { return gather(&AxisLanes::middle, k); }
  void set_control(std::int64_t k, const Point& value) { scatter(&AxisLanes::control, k, value); }
  void set_off(std::int64_t k, const Point& value) { scatter(&AxisLanes::off, k, value); }
  void set_bend(std::int64_t k, const Point& value) { scatter(&AxisLanes::bend, k, value); }
  void set_middle_off(std::int64_t k, const Point& value) { scatter(&AxisLanes::middle, k, value); }
  // Sets the maximum deviation at a knot, and in the middle of the span after it.
  void set_reach(std::int64_t k, double reach) { reach_[slot(k)] = reach * reach; }
  void set_middle_reach(std::int64_t k, double reach) { middle_reach_[slot(k)] = reach * reach; }
  void set_factors(std::int64_t k, const Factors& factors) { factors_[slot(k)] = factors; }

  // Makes a step of control point k. `axes`: the number of moving axes, from the first on. The others must not move.
  template <std::size_t axes>
  void relax_bending(std::int64_t k);
  // The same for the least sum of the fourth or eighth powers of each axis' p''.
  template <std::size_t axes, Power power>
  void relax_highest_bending(std::int64_t k);
  // `slides`: a step that the tube stops slides along the tube, which takes longer.
  template <std::size_t axes>
  void relax_change(std::int64_t k, bool slides);
  // The same for the least sum of the fourth or eighth powers of each axis' change of p'' in a span. `weights`: of the
  // spans k-2 to k+1; 0 for a span that does not exist.
  template <std::size_t axes, Power power>
  void relax_highest_change(std::int64_t k, const Four& weights, bool slides);
  // Returns the square of the change of p'' in the span after a knot.
  double square_of_change(std::int64_t k) const;
  void move(std::int64_t k, const Point& step);

 private:
  // Not a power of two, because then the lanes would share the same cache lines.
  static constexpr std::size_t capacity = 501;
  using Lanes = std::array<double, capacity>;
  struct AxisLanes {
    Lanes control{};
    Lanes off{};
    Lanes bend{};
    Lanes middle{};  // deviations in the middles
  };

  // The maximum length of a step, and the point that limits it.
  struct Stop {
    double share = 1;
    double factor = 0;  // of the control point, at the limiting point
    Lanes AxisLanes::*off = nullptr;
    std::size_t place = 0;
    double reach = 0;  // squared
  };

  template <std::size_t axes>
  void take_step(std::size_t at, std::array<double, axes>& step, bool slides);
  std::size_t slot(std::int64_t k) const { return static_cast<std::size_t>(k - base_); }
  Point gather(Lanes AxisLanes::*lanes, std::int64_t k) const;
  void scatter(Lanes AxisLanes::*lanes, std::int64_t k, const Point& value);
  template <std::size_t axes>
  void move(std::size_t at, const std::array<double, axes>& step);
  template <std::size_t axes>
  Stop stop_of(std::size_t at, const std::array<double, axes>& step, double square) const;
  template <std::size_t axes>
  bool slide(std::size_t at, const std::array<double, axes>& step, double square, const Stop& stop);
  static void shorten(Stop& stop, Lanes AxisLanes::*lanes, std::size_t first, double square, const Four& factors,
                      FourLanes off, FourLanes along, FourLanes reach);

  std::int64_t base_ = -1;  // the number in slot 0
  std::array<AxisLanes, axis_count> axes_{};
  Lanes reach_{};  // squared
  Lanes middle_reach_{};
  std::array<Factors, capacity> factors_{};
};

}  // namespace passo
