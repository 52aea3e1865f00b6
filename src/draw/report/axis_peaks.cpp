#include "axis_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

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

// The first two derivatives of an axis by s.
struct Slopes {
  double slope = 0;
  double bend = 0;
};

double hypotenuse(double a, double b) {
  return std::sqrt(a * a + b * b);
}

// One axis of an arc's plane: x(s) = centre + r cos(angle), with r and angle linear in s.
class ArcAxis {
 public:
  ArcAxis() = default;
  ArcAxis(const Curve& curve, double shift)
      : radius_(curve.arc_data().start_radius),
        growth_((curve.arc_data().end_radius - curve.arc_data().start_radius) / curve.length().value()),
        angle_(curve.arc_data().start_angle - shift),
        turning_(curve.arc_data().sweep / curve.length().value()) {}

  // dx/ds and d²x/ds².
  Slopes at(double s) const {
    const double sine = std::sin(angle_at(s));
    const double cosine = std::cos(angle_at(s));
    return {growth_ * cosine - radius_at(s) * turning_ * sine,
            -turning_ * (2 * growth_ * sine + radius_at(s) * turning_ * cosine)};
  }

  // Upper bounds for any axis of the plane: the lengths of the vectors of which the slope, the bend and the next
  // derivative are components.
  double most_slope(Way way) const { return hypotenuse(growth_, largest_radius(way) * turning_); }
  double most_bend(Way way) const {
    return std::abs(turning_) * hypotenuse(2 * growth_, largest_radius(way) * turning_);
  }
  double most_twist(Way way) const {
    return turning_ * turning_ * hypotenuse(3 * growth_, largest_radius(way) * turning_);
  }
  // The largest |a · slope + v² · bend|.
  double most_pull(double a, double v, Way way) const {
    const double radius = largest_radius(way);
    const double inward = a * std::abs(growth_) + v * v * radius * turning_ * turning_;
    const double along = (a * radius + 2 * v * v * std::abs(growth_)) * std::abs(turning_);
    return hypotenuse(inward, along);
  }

 private:
  double radius_at(double s) const { return radius_ + growth_ * s; }
  double angle_at(double s) const { return angle_ + turning_ * s; }
  double largest_radius(Way way) const { return std::max(radius_at(way.from), radius_at(way.to)); }

  double radius_ = 0;
  double growth_ = 0;
  double angle_ = 0;
  double turning_ = 0;
};

// One axis of a cubic.
class CubicAxis {
 public:
  CubicAxis() = default;
  CubicAxis(const Curve& curve, Axis axis)
      : first_(curve.cubic_data().first[axis]),
        second_(2 * curve.cubic_data().second[axis]),
        third_(6 * curve.cubic_data().third[axis]) {}

  Slopes at(double s) const { return {slope(s), bend(s)}; }

  double most_slope(Way way) const {
    const double most = std::max(std::abs(slope(way.from)), std::abs(slope(way.to)));
    const double vertex = third_ != 0 ? -second_ / third_ : way.to;
    return vertex > way.from && vertex < way.to ? std::max(most, std::abs(slope(vertex))) : most;
  }
  double most_bend(Way way) const { return std::max(std::abs(bend(way.from)), std::abs(bend(way.to))); }
  double most_twist(Way /*way*/) const { return std::abs(third_); }
  double most_pull(double a, double v, Way way) const { return a * most_slope(way) + v * v * most_bend(way); }

 private:
  double slope(double s) const { return first_ + s * (second_ + s * third_ / 2); }
  double bend(double s) const { return second_ + s * third_; }

  double first_ = 0;  // the derivatives at s = 0
  double second_ = 0;
  double third_ = 0;
};

// What is known of a stretch: the path's largest speed and acceleration in it, its way, and the values at its middle.
struct Look {
  Look(const Phase& phase, Stretch time)
      : v(highest_speed(phase, time)),
        a(highest_acceleration(phase, time)),
        way{phase.position_at(Seconds(time.begin)).value(), phase.position_at(Seconds(time.end)).value()},
        half((time.end - time.begin) / 2) {
    const double middle = (time.begin + time.end) / 2;
    middle_s = phase.position_at(Seconds(middle)).value();
    middle_v = phase.velocity_at(Seconds(middle)).value();
    middle_a = acceleration_at(phase, middle);
  }
  double v, a;
  Way way;
  double half;
  double middle_s = 0, middle_v = 0, middle_a = 0;
};

// A value at the middle of a stretch, and an upper bound of it in the whole stretch.
struct Found {
  double here;
  double bound;
};

// The highest speed and acceleration of an axis in one phase, each to a thousandth. A stretch is halved until it cannot
// hold more than the highest value seen. The value at its middle and the highest rate of change bound all values in the
// stretch. On most curves the first look is enough, and most of the first looks need no more than the longest vector
// of which the value is a component.
template <class CurvedAxis>
class PeakSearch {
 public:
  // `whole`: the look at the whole phase.
  PeakSearch(const CurvedAxis& axis, const Phase& phase, const Look& whole)
      : axis_(axis), phase_(phase), whole_(whole) {}

  void raise_speed(double& peak) {
    if (whole_.v * axis_.most_slope(whole_.way) <= peak) return;
    raise(peak, [this](const Look& look) {
      const double most = look.v * axis_.most_slope(look.way);
      const double change = axis_.most_pull(look.a, look.v, look.way);
      const double here = std::abs(look.middle_v * axis_.at(look.middle_s).slope);
      return Found{here, std::min(most, here + look.half * change)};
    });
  }
  void raise_acceleration(double& peak) {
    if (axis_.most_pull(whole_.a, whole_.v, whole_.way) <= peak) return;
    raise(peak, [this](const Look& look) {
      const double most = axis_.most_pull(look.a, look.v, look.way);
      const double change = std::abs(phase_.jerk.value()) * axis_.most_slope(look.way) +
                            3 * look.v * look.a * axis_.most_bend(look.way) +
                            look.v * look.v * look.v * axis_.most_twist(look.way);
      const Slopes middle = axis_.at(look.middle_s);
      const double here = std::abs(look.middle_a * middle.slope + look.middle_v * look.middle_v * middle.bend);
      return Found{here, std::min(most, here + look.half * change)};
    });
  }

 private:
  template <class Examine>
  void raise(double& peak, const Examine& examine) {
    left_ = 10'000;
    const double duration = phase_.duration.value();
    if (cannot_raise(examine(whole_), peak)) return;
    // The ends are examined first, because the highest acceleration of a ramp is at one of them.
    for (const double end : {0.0, duration}) peak = std::max(peak, examine(Look(phase_, {end, end})).here);
    search({0, duration}, peak, examine, 30);
  }
  static bool cannot_raise(const Found& found, double peak) {
    constexpr double precision = 1e-3;
    constexpr double nothing = 1e-9;
    return found.bound <= peak * (1 + precision) + nothing;
  }
  template <class Examine>
  void search(Stretch time, double& peak, const Examine& examine, int depth) {
    const Found found = examine(Look(phase_, time));
    peak = std::max(peak, found.here);
    if (cannot_raise(found, peak) || depth == 0 || --left_ < 0) return;
    const double middle = (time.begin + time.end) / 2;
    search({time.begin, middle}, peak, examine, depth - 1);
    search({middle, time.end}, peak, examine, depth - 1);
  }

  const CurvedAxis& axis_;
  const Phase& phase_;
  const Look& whole_;
  int left_ = 0;  // how many more looks are allowed; ordinary curves need only a few
};

// An axis along which a curve bends.
template <class CurvedAxis>
struct Bending {
  Axis axis = Axis::x;
  CurvedAxis shape = {};
};

template <class CurvedAxis>
void raise_on_curve(const PlannedMove& move, std::span<const Bending<CurvedAxis>> bending, PerAxis<double>& speed,
                    PerAxis<double>& acceleration) {
  for (const Phase& phase : move) {
    const Look whole(phase, {0, phase.duration.value()});
    for (const auto& [axis, shape] : bending) {
      PeakSearch search(shape, phase, whole);
      search.raise_speed(speed[axis]);
      search.raise_acceleration(acceleration[axis]);
    }
  }
}

}  // namespace

void AxisPeaks::watch(const PlannedMove& move) {
  const Curve& curve = move.segment.curve;
  if (!curve.has_length()) return;
  AxisSet bent;
  if (curve.shape() == Curve::Shape::arc) {
    const Curve::ArcData& arc = curve.arc_data();
    const std::array<Bending<ArcAxis>, 2> plane{
        {{arc.first, ArcAxis(curve, 0)}, {arc.second, ArcAxis(curve, std::numbers::pi / 2)}}};
    raise_on_curve(move, std::span<const Bending<ArcAxis>>(plane), speed_, acceleration_);
    for (const auto& one : plane) bent.add(one.axis);
    watch_straight(move, bent);
  } else if (curve.shape() == Curve::Shape::cubic) {
    std::array<Bending<CubicAxis>, axis_count> axes;
    std::size_t count = 0;
    for (const Axis axis : all_axes) {
      if (curve.moves(axis)) axes[count++] = {axis, CubicAxis(curve, axis)};
    }
    raise_on_curve(move, std::span<const Bending<CubicAxis>>(axes).first(count), speed_, acceleration_);
  } else {
    watch_straight(move, bent);
  }
}

// The axes that are not bent have the same slope everywhere.
void AxisPeaks::watch_straight(const PlannedMove& move, AxisSet bent) {
  double speed = 0;
  double acceleration = 0;
  for (const Phase& phase : move) {
    const Stretch all{0, phase.duration.value()};
    speed = std::max(speed, highest_speed(phase, all));
    acceleration = std::max(acceleration, highest_acceleration(phase, all));
  }
  const Point slope = move.segment.curve.tangent(Mm(0));
  for (const Axis axis : all_axes) {
    if (bent.has(axis)) continue;
    speed_[axis] = std::max(speed_[axis], speed * std::abs(slope[axis]));
    acceleration_[axis] = std::max(acceleration_[axis], acceleration * std::abs(slope[axis]));
  }
}

}  // namespace passo
