#include "axis_peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace passo {
namespace {

double highest_speed(const Phase& phase) {
  const Seconds end = phase.duration;
  double highest = std::max(std::abs(phase.velocity.value()), std::abs(phase.velocity_at(end).value()));
  if (phase.jerk.value() != 0) {  // the speed may have an extreme value inside
    const Seconds turn(-phase.acceleration.value() / phase.jerk.value());
    if (turn > Seconds(0) && turn < end) highest = std::max(highest, std::abs(phase.velocity_at(turn).value()));
  }
  return highest;
}

double highest_acceleration(const Phase& phase) {
  return std::max(std::abs(phase.acceleration.value()), std::abs(phase.acceleration_at(phase.duration).value()));
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

  // Upper bounds for any axis of the plane: the lengths of the vectors of which the first four derivatives are
  // components.
  double most_slope(Way way) const { return hypotenuse(growth_, largest_radius(way) * turning_); }
  double most_bend(Way way) const {
    return std::abs(turning_) * hypotenuse(2 * growth_, largest_radius(way) * turning_);
  }
  double most_twist(Way way) const {
    return turning_ * turning_ * hypotenuse(3 * growth_, largest_radius(way) * turning_);
  }
  double most_of_fourth(Way way) const {
    return std::abs(turning_ * turning_ * turning_) * hypotenuse(4 * growth_, largest_radius(way) * turning_);
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
  double most_of_fourth(Way /*way*/) const { return 0; }
  double most_pull(double a, double v, Way way) const { return a * most_slope(way) + v * v * most_bend(way); }

 private:
  double slope(double s) const { return first_ + s * (second_ + s * third_ / 2); }
  double bend(double s) const { return second_ + s * third_; }

  double first_ = 0;  // the derivatives at s = 0
  double second_ = 0;
  double third_ = 0;
};

// What is known of a phase: the largest speed and acceleration along the path, and the way.
struct Look {
  Look(const Phase& phase, double end)
      : v(highest_speed(phase)), a(highest_acceleration(phase)), way{phase.start.value(), end} {}
  double v;
  double a;
  Way way;
};

// A moment of a phase, and the size of the axis's speed or acceleration there.
struct Sample {
  double t;
  double size;
};

// Raises `peak` to the highest size of a value in one phase, to a thousandth. `bend` is an upper bound of the value's
// second derivative by the time. So between two samples the value exceeds the larger of them by at most h²/8 of that,
// and a stretch is halved until it cannot hold more than the highest value seen. On most curves the ends of the phase
// are enough.
template <class SizeAt>
class PeakSearch {
 public:
  PeakSearch(double& peak, double bend, const SizeAt& size_at) : peak_(peak), bend_(bend), size_at_(size_at) {}

  void raise(const Sample& from, const Sample& to) {
    peak_ = std::max({peak_, from.size, to.size});
    search(from, to, 30);
  }

 private:
  void search(const Sample& from, const Sample& to, int depth) {
    constexpr double precision = 1e-3;
    constexpr double nothing = 1e-9;
    const double h = to.t - from.t;
    const double bound = std::max(from.size, to.size) + h * h / 8 * bend_;
    if (bound <= peak_ * (1 + precision) + nothing || depth == 0 || --left_ < 0) return;
    const double t = from.t + h / 2;
    const Sample middle{t, size_at_(t)};
    peak_ = std::max(peak_, middle.size);
    search(from, middle, depth - 1);
    search(middle, to, depth - 1);
  }

  double& peak_;
  double bend_;
  const SizeAt& size_at_;
  int left_ = 10'000;  // how many more samples are allowed; ordinary curves need only a few
};

// An axis along which a curve bends.
template <class CurvedAxis>
class Bending {
 public:
  Bending() = default;
  Bending(Axis bent, const CurvedAxis& shape) : axis(bent), shape_(shape) {}

  // With the axis's derivatives q', q'', ... by s, its speed is q' v and its acceleration f = q' a + q'' v². The second
  // derivative of its speed by the time is f' = q' j + 3 q'' a v + q''' v³. For the highest acceleration it is
  // f'' = q'' (4 j v + 3 a²) + 6 q''' a v² + q'''' v⁴.
  void raise(const Phase& phase, const Look& whole, double& speed, double& acceleration) {
    const double j = std::abs(phase.jerk.value());
    const double a = whole.a;
    const double v = whole.v;
    const Way way = whole.way;
    if (v * shape_.most_slope(way) > speed) {
      const double bend =
          j * shape_.most_slope(way) + v * (3 * a * shape_.most_bend(way) + v * v * shape_.most_twist(way));
      raise(speed, phase, way, bend,
            [](const Slopes& at, double path_speed, double /*along*/) { return std::abs(path_speed * at.slope); });
    }
    if (shape_.most_pull(a, v, way) > acceleration) {
      const double bend = (4 * j * v + 3 * a * a) * shape_.most_bend(way) +
                          v * v * (6 * a * shape_.most_twist(way) + v * v * shape_.most_of_fourth(way));
      raise(acceleration, phase, way, bend, [](const Slopes& at, double path_speed, double along) {
        return std::abs(along * at.slope + path_speed * path_speed * at.bend);
      });
    }
  }

  Axis axis = Axis::x;

 private:
  template <class SizeOf>
  void raise(double& peak, const Phase& phase, Way way, double bend, const SizeOf& size_of) {
    const auto size = [&](const Slopes& slopes, double t) {
      return size_of(slopes, phase.velocity_at(Seconds(t)).value(), phase.acceleration_at(Seconds(t)).value());
    };
    const auto size_at = [&](double t) { return size(shape_.at(phase.position_at(Seconds(t)).value()), t); };
    const double end = phase.duration.value();
    const Sample first{0, size(slopes_at(way.from), 0)};
    PeakSearch(peak, bend, size_at).raise(first, {end, size(slopes_at(way.to), end)});
  }
  // The end of a phase is the start of the next.
  const Slopes& slopes_at(double s) {
    if (s != known_at_) known_ = shape_.at(s);
    known_at_ = s;
    return known_;
  }

  CurvedAxis shape_ = {};
  double known_at_ = -1;
  Slopes known_;
};

template <class CurvedAxis>
void raise_on_curve(const PlannedMove& move, std::span<Bending<CurvedAxis>> bending, PerAxis<double>& speed,
                    PerAxis<double>& acceleration) {
  for (const Phase& phase : move) {
    const Mm end = &phase + 1 == move.end() ? move.to : (&phase + 1)->start;
    const Look whole(phase, end.value());
    for (Bending<CurvedAxis>& one : bending) one.raise(phase, whole, speed[one.axis], acceleration[one.axis]);
  }
}

}  // namespace

void AxisPeaks::watch(const PlannedMove& move) {
  const Curve& curve = move.segment.curve;
  if (!curve.has_length()) return;
  AxisSet bent;
  if (curve.shape() == Curve::Shape::arc) {
    const Curve::ArcData& arc = curve.arc_data();
    std::array<Bending<ArcAxis>, 2> plane{
        {{arc.first, ArcAxis(curve, 0)}, {arc.second, ArcAxis(curve, std::numbers::pi / 2)}}};
    raise_on_curve(move, std::span<Bending<ArcAxis>>(plane), speed_, acceleration_);
    for (const auto& one : plane) bent.add(one.axis);
    watch_straight(move, bent);
  } else if (curve.shape() == Curve::Shape::cubic) {
    std::array<Bending<CubicAxis>, axis_count> axes;
    std::size_t count = 0;
    for (const Axis axis : all_axes) {
      if (curve.moves(axis)) axes[count++] = {axis, CubicAxis(curve, axis)};
    }
    raise_on_curve(move, std::span<Bending<CubicAxis>>(axes).first(count), speed_, acceleration_);
  } else {
    watch_straight(move, bent);
  }
}

// The axes that are not bent have the same slope everywhere.
void AxisPeaks::watch_straight(const PlannedMove& move, AxisSet bent) {
  double speed = 0;
  double acceleration = 0;
  for (const Phase& phase : move) {
    speed = std::max(speed, highest_speed(phase));
    acceleration = std::max(acceleration, highest_acceleration(phase));
  }
  const Point slope = move.segment.curve.tangent(Mm(0));
  for (const Axis axis : all_axes) {
    if (bent.has(axis)) continue;
    speed_[axis] = std::max(speed_[axis], speed * std::abs(slope[axis]));
    acceleration_[axis] = std::max(acceleration_[axis], acceleration * std::abs(slope[axis]));
  }
}

}  // namespace passo
