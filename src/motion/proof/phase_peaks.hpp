// PhasePeaks: the peak speeds, accelerations and jumps of each axis, computed from the phases.
//
//   q̇ = q' ṡ      q̈ = q'' ṡ² + q' s̈      q⃛ = q''' ṡ³ + 3 q'' ṡ s̈ + q' s⃛
//
// On a line or a cubic these are polynomials of time, whose peaks are found exactly (AxisPolynomial). In the plane of
// an arc, and under a limit that falls with the speed, many points are evaluated, followed by a golden-section search
// between the neighbours of the best one.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "axis_polynomial.hpp"
#include "exact_curve.hpp"
#include "speed_limit.hpp"

#include "passo/proof/motion_proof.hpp"

namespace passo::proof {

class PhasePeaks {
 public:
  // Writes its findings into `proof`, whose axes and limits are already set.
  PhasePeaks(MotionProof& proof, const ProofOptions& options);

  // `curve` is that of the move, which has a length and phases.
  void watch(const PlannedMove& move, const ExactCurve& curve);
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

  void measure(const ExactCurve& curve, const Phase& phase);
  void measure_polynomial(const AxisPolynomial& polynomial, Seconds duration, std::size_t i);
  template <class MotionAt>
  void measure_looks(const MotionAt& motion_at, double duration, int looks, std::size_t i, std::span<const Kind> kinds);
  template <class MotionAt>
  void look_closely(const MotionAt& motion_at, double low, double high, std::size_t i, Kind kind);
  double severity(std::size_t i, const Motion& motion, Kind kind) const;
  double worst(std::size_t i, Kind kind) const;
  void see(std::size_t i, const Motion& motion, double t, Kind kind);
  void see_feed(const Segment& segment, const Phase& phase);
  void join(const ExactCurve& curve, const Phase& phase, bool rests);
  bool stands() const;
  void meet(std::size_t i, const Motion& motion, bool rests);
  void raise_jump(std::size_t i, double jump, double limit);
  void stop_exactly();
  Point motors_at(Point place) const;
  void check_gap(double gap);
  void raise(Finding& finding, double value, double t) const;
  void raise_acceleration(std::size_t i, const Motion& motion, double t);

  MotionProof& proof_;
  Seconds now_{0};  // at the start of the current phase
  std::uint32_t line_ = 0;
  std::vector<Axis> letters_;       // by axis
  std::vector<SpeedLimit> limits_;  // by axis
  std::vector<double> start_stop_;  // by axis
  PerAxis<double> backlash_;
  AxisSet downs_;                // the axes whose backlash is taken up for the negative direction
  std::vector<Motion> before_;   // by axis, at the end of the last phase
  std::vector<double> stopped_;  // by axis: the velocity just before the latest stop without duration
  bool at_rest_ = true;
  std::optional<Point> place_;  // position of the motors at the end of the last phase
};

}  // namespace passo::proof
