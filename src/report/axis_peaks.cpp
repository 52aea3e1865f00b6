#include "axis_peaks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace passo {
namespace {

// A time interval inside one phase.
struct Stretch {
  double begin = 0;
  double end = 0;
};

double acceleration_at(const Phase& phase, double t) {
  return phase.acceleration.value() + phase.jerk.value() * t;
}

double highest_speed(const Phase& phase, Stretch time) {
  double highest = std::max(std::abs(phase.velocity_at(Seconds(time.begin)).value()),
                            std::abs(phase.velocity_at(Seconds(time.end)).value()));
  if (phase.jerk.value() != 0) {  // the speed may have an extreme value inside
    const double turn = -phase.acceleration.value() / phase.jerk.value();
    if (turn > time.begin && turn < time.end) {
      highest = std::max(highest, std::abs(phase.velocity_at(Seconds(turn)).value()));
    }
  }
  return highest;
}

double highest_acceleration(const Phase& phase, Stretch time) {
  return std::max(std::abs(acceleration_at(phase, time.begin)), std::abs(acceleration_at(phase, time.end)));
}

// An interval of s.
struct Way {
  double from = 0;
  double to = 0;
};

// One axis of an arc's plane: x(s) = centre + r cos(angle), with r and angle linear in s.
class ArcAxis {
 public:
  ArcAxis(const Curve& curve, double shift)
      : radius_(curve.arc_data().start_radius),
        growth_((curve.arc_data().end_radius - curve.arc_data().start_radius) / curve.length().value()),
        angle_(curve.arc_data().start_angle - shift),
        turning_(curve.arc_data().sweep / curve.length().value()) {}

  // dx/ds and d²x/ds².
  double slope(double s) const {
    return growth_ * std::cos(angle_at(s)) - radius_at(s) * turning_ * std::sin(angle_at(s));
  }
  double bend(double s) const {
    return -turning_ * (2 * growth_ * std::sin(angle_at(s)) + radius_at(s) * turning_ * std::cos(angle_at(s)));
  }

  // Upper bounds for any axis of the plane: the lengths of the vectors of which the slope, the bend and the next
  // derivative are components.
  double most_slope(Way way) const { return std::hypot(growth_, largest_radius(way) * turning_); }
  double most_bend(Way way) const {
    return std::abs(turning_) * std::hypot(2 * growth_, largest_radius(way) * turning_);
  }
  double most_twist(Way way) const {
    return turning_ * turning_ * std::hypot(3 * growth_, largest_radius(way) * turning_);
  }
  // The largest |a · slope + v² · bend|.
  double most_pull(double a, double v, Way way) const {
    const double radius = largest_radius(way);
    const double inward = a * std::abs(growth_) + v * v * radius * turning_ * turning_;
    const double along = (a * radius + 2 * v * v * std::abs(growth_)) * std::abs(turning_);
    return std::hypot(inward, along);
  }

 private:
  double radius_at(double s) const { return radius_ + growth_ * s; }
  double angle_at(double s) const { return angle_ + turning_ * s; }
  double largest_radius(Way way) const { return std::max(radius_at(way.from), radius_at(way.to)); }

  double radius_;
  double growth_;
  double angle_;
  double turning_;
};

// One axis of a cubic.
class CubicAxis {
 public:
  CubicAxis(const Curve& curve, Axis axis)
      : first_(curve.cubic_data().first[axis]),
        second_(2 * curve.cubic_data().second[axis]),
        third_(6 * curve.cubic_data().third[axis]) {}

  double slope(double s) const { return first_ + s * (second_ + s * third_ / 2); }
  double bend(double s) const { return second_ + s * third_; }

  double most_slope(Way way) const {
    const double most = std::max(std::abs(slope(way.from)), std::abs(slope(way.to)));
    const double vertex = third_ != 0 ? -second_ / third_ : way.to;
    return vertex > way.from && vertex < way.to ? std::max(most, std::abs(slope(vertex))) : most;
  }
  double most_bend(Way way) const { return std::max(std::abs(bend(way.from)), std::abs(bend(way.to))); }
  double most_twist(Way /*way*/) const { return std::abs(third_); }
  double most_pull(double a, double v, Way way) const { return a * most_slope(way) + v * v * most_bend(way); }

 private:
  double first_;  // the derivatives at s = 0
  double second_;
  double third_;
};

// The highest speed and acceleration of an axis in one phase, each to a thousandth. A stretch is halved until it cannot
// hold more than the highest value seen. The value at its middle and the highest rate of change bound all values in the
// stretch. On most curves the first look is enough.
template <class CurvedAxis>
class PeakSearch {
 public:
  PeakSearch(const CurvedAxis& axis, const Phase& phase) : axis_(axis), phase_(phase) {}

  void raise_speed(double& peak) {
    raise(peak, [this](const Look& look) {
      const double most = look.v * axis_.most_slope(look.way);
      const double change = axis_.most_pull(look.a, look.v, look.way);
      const double here = std::abs(look.middle_v * axis_.slope(look.middle_s));
      return Found{here, std::min(most, here + look.half * change)};
    });
  }
  void raise_acceleration(double& peak) {
    raise(peak, [this](const Look& look) {
      const double most = axis_.most_pull(look.a, look.v, look.way);
      const double change = std::abs(phase_.jerk.value()) * axis_.most_slope(look.way) +
                            3 * look.v * look.a * axis_.most_bend(look.way) +
                            look.v * look.v * look.v * axis_.most_twist(look.way);
      const double here = std::abs(look.middle_a * axis_.slope(look.middle_s) +
                                   look.middle_v * look.middle_v * axis_.bend(look.middle_s));
      return Found{here, std::min(most, here + look.half * change)};
    });
  }

 private:
  struct Look {  // what is known of a stretch: the path's largest speed and acceleration in it, its way, and the values
                 // at its middle
    double v, a;
    Way way;
    double half, middle_s, middle_v, middle_a;
  };
  struct Found {
    double here;   // at the middle
    double bound;  // upper bound in the whole stretch
  };

  Look look_at(Stretch time) const {
    const double middle = (time.begin + time.end) / 2;
    return {.v = highest_speed(phase_, time),
            .a = highest_acceleration(phase_, time),
            .way = {phase_.position_at(Seconds(time.begin)).value(), phase_.position_at(Seconds(time.end)).value()},
            .half = (time.end - time.begin) / 2,
            .middle_s = phase_.position_at(Seconds(middle)).value(),
            .middle_v = phase_.velocity_at(Seconds(middle)).value(),
            .middle_a = acceleration_at(phase_, middle)};
  }

  template <class Examine>
  void raise(double& peak, const Examine& examine) {
    left_ = 10'000;
    const double duration = phase_.duration.value();
    if (cannot_raise(examine(look_at({0, duration})), peak)) return;
    // The ends are examined first, because the highest acceleration of a ramp is at one of them.
    for (const double end : {0.0, duration}) peak = std::max(peak, examine(look_at({end, end})).here);
    search({0, duration}, peak, examine, 30);
  }
  static bool cannot_raise(const Found& found, double peak) {
    constexpr double precision = 1e-3;
    constexpr double nothing = 1e-9;
    return found.bound <= peak * (1 + precision) + nothing;
  }
  template <class Examine>
  void search(Stretch time, double& peak, const Examine& examine, int depth) {
    const Found found = examine(look_at(time));
    peak = std::max(peak, found.here);
    if (cannot_raise(found, peak) || depth == 0 || --left_ < 0) return;
    const double middle = (time.begin + time.end) / 2;
    search({time.begin, middle}, peak, examine, depth - 1);
    search({middle, time.end}, peak, examine, depth - 1);
  }

  const CurvedAxis& axis_;
  const Phase& phase_;
  int left_ = 0;  // how many more looks are allowed; ordinary curves need only a few
};

template <class CurvedAxis>
void raise_on_curve(const PlannedMove& move, const CurvedAxis& axis, double& speed, double& acceleration) {
  for (const Phase& phase : move) {
    PeakSearch search(axis, phase);
    search.raise_speed(speed);
    search.raise_acceleration(acceleration);
  }
}

}  // namespace

void AxisPeaks::watch(const PlannedMove& move) {
  const Curve& curve = move.segment.curve;
  if (!curve.has_length()) return;
  double speed = 0;
  double acceleration = 0;
  for (const Phase& phase : move) {
    const Stretch all{0, phase.duration.value()};
    speed = std::max(speed, highest_speed(phase, all));
    acceleration = std::max(acceleration, highest_acceleration(phase, all));
  }

  const bool arc = curve.shape() == Curve::Shape::arc;
  const bool cubic = curve.shape() == Curve::Shape::cubic;
  const Point slope = curve.tangent(Mm(0));
  for (const Axis axis : all_axes) {
    if (arc && axis == curve.arc_data().first) {
      raise_on_curve(move, ArcAxis(curve, 0), speed_[axis], acceleration_[axis]);
    } else if (arc && axis == curve.arc_data().second) {
      raise_on_curve(move, ArcAxis(curve, std::numbers::pi / 2), speed_[axis], acceleration_[axis]);
    } else if (cubic) {
      raise_on_curve(move, CubicAxis(curve, axis), speed_[axis], acceleration_[axis]);
    } else {
      speed_[axis] = std::max(speed_[axis], speed * std::abs(slope[axis]));
      acceleration_[axis] = std::max(acceleration_[axis], acceleration * std::abs(slope[axis]));
    }
  }
}

}  // namespace passo
