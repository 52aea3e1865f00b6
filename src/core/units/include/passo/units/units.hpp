// Strong units: a length cannot be passed as a speed. They add no instructions.
//
// All stages after interpreter/ use millimetres and seconds. Millimetres per minute and inches exist only in gcode/,
// interpreter/ and the user interface. For a rotary axis, degrees replace millimetres.
#pragma once

#include <compare>
#include <cstdint>

namespace passo {

// A measured quantity of dimension length^L * time^T.
template <int L, int T>
class Quantity {
 public:
  constexpr Quantity() = default;
  constexpr explicit Quantity(double value) : value_(value) {}
  constexpr double value() const { return value_; }

  constexpr Quantity operator-() const { return Quantity(-value_); }
  constexpr Quantity& operator+=(Quantity other) {
    value_ += other.value_;
    return *this;
  }
  constexpr Quantity& operator-=(Quantity other) {
    value_ -= other.value_;
    return *this;
  }
  friend constexpr Quantity operator+(Quantity a, Quantity b) { return Quantity(a.value_ + b.value_); }
  friend constexpr Quantity operator-(Quantity a, Quantity b) { return Quantity(a.value_ - b.value_); }
  friend constexpr Quantity operator*(Quantity a, double k) { return Quantity(a.value_ * k); }
  friend constexpr Quantity operator*(double k, Quantity a) { return Quantity(k * a.value_); }
  friend constexpr Quantity operator/(Quantity a, double k) { return Quantity(a.value_ / k); }
  friend constexpr auto operator<=>(Quantity a, Quantity b) = default;  // NOLINT(modernize-use-nullptr): not a pointer

 private:
  double value_ = 0;
};

template <int L1, int T1, int L2, int T2>
constexpr auto operator*(Quantity<L1, T1> a, Quantity<L2, T2> b) {
  if constexpr (L1 + L2 == 0 && T1 + T2 == 0) {
    return a.value() * b.value();
  } else {
    return Quantity<L1 + L2, T1 + T2>(a.value() * b.value());
  }
}
template <int L1, int T1, int L2, int T2>
constexpr auto operator/(Quantity<L1, T1> a, Quantity<L2, T2> b) {
  if constexpr (L1 == L2 && T1 == T2) {
    return a.value() / b.value();
  } else {
    return Quantity<L1 - L2, T1 - T2>(a.value() / b.value());
  }
}

using Mm = Quantity<1, 0>;
using MmPerSecond = Quantity<1, -1>;
using MmPerSecond2 = Quantity<1, -2>;
using MmPerSecond3 = Quantity<1, -3>;
using Seconds = Quantity<0, 1>;
using Hertz = Quantity<0, -1>;

// An angle is a dimensionless number. The type prevents confusion with degrees.
struct Radians {
  double value = 0;
  friend constexpr auto operator<=>(Radians, Radians) = default;
};

// The quantities of a motor and its load. Speeds are radians per second, not revolutions.
struct RadiansPerSecond {
  double value = 0;
  friend constexpr auto operator<=>(RadiansPerSecond, RadiansPerSecond) = default;  // NOLINT(modernize-use-nullptr)
};
struct RadiansPerSecond2 {
  double value = 0;
  friend constexpr auto operator<=>(RadiansPerSecond2, RadiansPerSecond2) = default;
};
struct NewtonMetres {
  double value = 0;
  friend constexpr auto operator<=>(NewtonMetres, NewtonMetres) = default;  // NOLINT(modernize-use-nullptr)
};
struct KilogramMetres2 {
  double value = 0;
  friend constexpr auto operator<=>(KilogramMetres2, KilogramMetres2) = default;
};
struct RadiansPerSecond3 {
  double value = 0;
  friend constexpr auto operator<=>(RadiansPerSecond3, RadiansPerSecond3) = default;
};

// Counts rather than measurements: motor steps, and counts of the board's timer.
struct Steps {
  std::int64_t count = 0;
  friend constexpr auto operator<=>(Steps, Steps) = default;
};
struct Ticks {
  std::int64_t count = 0;
  friend constexpr auto operator<=>(Ticks, Ticks) = default;
};

inline constexpr double mm_per_inch = 25.4;
inline constexpr double seconds_per_minute = 60.0;

}  // namespace passo
