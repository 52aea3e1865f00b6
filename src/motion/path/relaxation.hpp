// Relaxation: the arithmetic of the sweeps. A step moves a control of the spline to where the bending is least, as far
// as the tube allows. A step that the tube stops may slide along the tube instead: to the place on the tube that is
// nearest to the end of the step. Without that, controls stick to the tube where they first meet it.
//
// A control k acts on the spline at three knots, k-1 to k+1, and in the middles of four spans, k-2 to k+1, by known
// factors. Each move updates the deviations from the path and the second derivatives at these places. The values of one
// axis lie side by side, so four places are computed at once. This is the hot path of the smoother: about 30 ns a step.
#pragma once

#include <array>
#include <cstdint>

#include "passo/base/lanes.hpp"
#include "passo/geometry/axes.hpp"

namespace passo {

class Relaxation {
 public:
  using Four = std::array<double, 4>;
  // The effect of moving a control by 1, at the knots k-1 to k+1 (the fourth is 0) and in the middles of the spans k-2
  // to k+1. The step to least bending is minus the sum of `pull` times p'' at the knots. The step to the least change
  // of bending is found in the same way, from the knots k-2 to k+2.
  struct Factors {
    Four off{};
    Four bend{};
    Four middle{};
    Four pull{};
    std::array<double, 5> change_pull{};
  };

  // Forgets everything; the next number is -1.
  void begin();
  // Makes room for the numbers up to `k`. Numbers before `oldest` may be forgotten.
  void make_room(std::int64_t k, std::int64_t oldest);

  Point control(std::int64_t k) const { return gather(&AxisLanes::control, k); }
  Point off(std::int64_t k) const { return gather(&AxisLanes::off, k); }
  Point bend(std::int64_t k) const { return gather(&AxisLanes::bend, k); }
  Point middle_off(std::int64_t k) const { return gather(&AxisLanes::middle, k); }
  void set_control(std::int64_t k, const Point& value) { scatter(&AxisLanes::control, k, value); }
  void set_off(std::int64_t k, const Point& value) { scatter(&AxisLanes::off, k, value); }
  void set_bend(std::int64_t k, const Point& value) { scatter(&AxisLanes::bend, k, value); }
  void set_middle_off(std::int64_t k, const Point& value) { scatter(&AxisLanes::middle, k, value); }
  // Sets how far a knot, and the middle of the span after it, may be off.
  void set_reach(std::int64_t k, double reach) { reach_[slot(k)] = reach * reach; }
  void set_middle_reach(std::int64_t k, double reach) { middle_reach_[slot(k)] = reach * reach; }
  void set_factors(std::int64_t k, const Factors& factors) { factors_[slot(k)] = factors; }

  // Makes a step of control k. `axes`: the number of axes that move, from the first on. The others must be at rest.
  template <std::size_t axes>
  void relax_bending(std::int64_t k);
  // `slides`: a step that the tube stops slides along the tube. That takes longer.
  template <std::size_t axes>
  void relax_change(std::int64_t k, bool slides);
  void move(std::int64_t k, const Point& step);

 private:
  // Not a power of two, because then the lanes would share the same lines of the processor's cache.
  static constexpr std::size_t capacity = 9001;
  using Lanes = std::array<double, capacity>;
  struct AxisLanes {
    Lanes control{};
    Lanes off{};
    Lanes bend{};
    Lanes middle{};  // off, in the middles
  };

  // How far a step may go, and the place that stops it.
  struct Stop {
    double share = 1;
    double factor = 0;  // of the control, at the place
    Lanes AxisLanes::*off = nullptr;
    std::size_t place = 0;
    double reach = 0;  // a square
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
  Lanes reach_{};  // squares
  Lanes middle_reach_{};
  std::array<Factors, capacity> factors_{};
};

}  // namespace passo
