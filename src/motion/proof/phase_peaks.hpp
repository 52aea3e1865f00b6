// PhasePeaks: the peak speeds, accelerations and jumps of each axis, computed from the phases.
//
//   q̇ = q' ṡ      q̈ = q'' ṡ² + q' s̈      q⃛ = q''' ṡ³ + 3 q'' ṡ s̈ + q' s⃛
//
// On a line or a cubic the peaks are found exactly: in closed form without jerk (EvenMotion), else as those of
// polynomials of time (AxisPolynomial). In the plane of an arc many points are evaluated, followed by a search between
// the neighbours of the best one. An upper bound for the whole phase comes first: most phases have no new peak.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "axis_polynomial.hpp"
#include "even_motion.hpp"
#include "exact_curve.hpp"
#include "speed_limit.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class PhasePeaks {
 public:
  // Writes its findings into `proof`, whose axes and limits are already set.
  PhasePeaks(MotionProof& proof, const ProofOptions& options, const std::vector<SpeedLimit>& limits);

  // `curve` is that of the move, which has a length and phases. `programmed_speed`: the greatest one that may apply; 0:
  // that of the segment.
  void watch(const PlannedMove& move, const ExactCurve& curve, double programmed_speed = 0);
  // Processes an action, or the end, at which the machine stops.
  void rest(Seconds dwell);

  Seconds now() const { return now_; }

 private:
  struct Motion {
    double velocity = 0;
    double acceleration = 0;
    double jerk = 0;
  };
  struct Way {  // s and its time derivatives
    double s, v, a, j;
  };

  static Way way_at(const Phase& phase, double t);
  static Motion motion_of(const Derivatives& q, const Way& way);
  enum class Kind : std::uint8_t { velocity, acceleration, jerk };
  static constexpr std::array all_kinds = {Kind::velocity, Kind::acceleration, Kind::jerk};

  // The largest absolute values in a phase.
  struct Range {
    double way = 0;
    double velocity = 0;
    double acceleration = 0;
    double jerk = 0;
    double fastest_at = 0;    // the time of the highest velocity
    double strongest_at = 0;  // and of the highest acceleration
  };
  static Range range_of(const Phase& phase);
  // Upper bounds of the absolute values of an axis in a phase.
  static Motion bounds_of(const Derivatives& slopes, const Range& range);
  static Motion bounds_in_plane(const ExactCurve& curve, double from, const Range& range);

  void measure(const ExactCurve& curve, const Phase& phase);
  void measure_line(double slope, const Range& range, std::size_t i);
  void measure_even(const EvenMotion& motion, std::size_t i);
  void measure_torque(const EvenMotion& motion, std::size_t i);
  void measure_polynomial(const Derivatives& slopes, const Phase& phase, const Range& range, std::size_t i);
  void measure_arc(const ExactCurve& curve, const Phase& phase, const Range& range);
  bool can_be_worst(std::size_t i, const Motion& bounds, Kind kind) const;
  template <class MotionOfLook, class MotionAt>
  void measure_looks(const MotionOfLook& motion_of_look, const MotionAt& motion_at, double duration, double fastest,
                     int looks, std::size_t i, std::span<const Kind> kinds);
  template <class MotionAt>
  void look_closely(const MotionAt& motion_at, double low, double high, std::size_t i, Kind kind);
  double severity(std::size_t i, const Motion& motion, Kind kind) const;
  double worst(std::size_t i, Kind kind) const;
  void see(std::size_t i, const Motion& motion, double t, Kind kind);
  void see_feed(const Segment& segment, const Phase& phase);
  bool counts_surface(const Segment& segment, const ExactCurve& curve) const;
  void see_surface_feed(const Segment& segment, const ExactCurve& curve, const Phase& phase, double speed);
  void join(const ExactCurve& curve, const Phase& phase, bool rests);
  bool stands() const;
  void meet(std::size_t i, const Motion& motion, bool rests);
  void raise_jump(std::size_t i, double jump, double limit);
  void stop_exactly();
  Point motors_at(Point place) const;
  void check_gap(double gap);
  void raise(Finding& finding, double value, double t) const;
  void raise_acceleration(std::size_t i, const Motion& motion, double t);

  // Points of a phase on an arc, for all axes.
  struct Look {
    Way way{};
    ExactCurve::AllDerivatives slopes{};
  };

  MotionProof& proof_;
  std::vector<Look> looks_;
  Seconds now_{0};  // at the start of the current phase
  std::uint32_t line_ = 0;
  std::vector<Axis> letters_;       // by axis
  std::vector<SpeedLimit> limits_;  // by axis
  std::vector<double> start_stop_;  // by axis
  PerAxis<double> backlash_;
  PerAxis<std::optional<double>> surface_radius_;
  AxisSet downs_;                // the axes whose backlash is taken up for the negative direction
  std::vector<Motion> before_;   // by axis, at the end of the last phase
  std::vector<double> stopped_;  // by axis: the velocity just before the latest stop without duration
  bool at_rest_ = true;
  std::optional<Point> place_;  // position of the motors at the end of the last phase
};

}  // namespace passo::proof
