// The axes of a machine, and values for each of them.
//
// Nine letters as in RS274/NGC: X Y Z and U V W are lengths in millimetres, A B C are angles in degrees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace passo {

enum class Axis : std::uint8_t { x, y, z, a, b, c, u, v, w };
inline constexpr std::size_t axis_count = 9;
inline constexpr std::array<Axis, axis_count> all_axes = {Axis::x, Axis::y, Axis::z, Axis::a, Axis::b,
                                                          Axis::c, Axis::u, Axis::v, Axis::w};

constexpr std::size_t index_of(Axis axis) {
  return static_cast<std::size_t>(axis);
}
constexpr char letter_of(Axis axis) {
  return "XYZABCUVW"[index_of(axis)];
}
constexpr bool is_rotary(Axis axis) {
  return axis >= Axis::a && axis <= Axis::c;
}
constexpr std::optional<Axis> axis_of(char letter) {
  for (const Axis axis : all_axes) {
    if (letter_of(axis) == letter || letter_of(axis) - 'A' + 'a' == letter) return axis;
  }
  return std::nullopt;
}

// One value per axis, indexed by Axis.
template <class T>
struct PerAxis {
  std::array<T, axis_count> values{};

  constexpr T& operator[](Axis axis) { return values[index_of(axis)]; }
  constexpr const T& operator[](Axis axis) const { return values[index_of(axis)]; }
  friend constexpr bool operator==(const PerAxis&, const PerAxis&) = default;
};

// A set of axes, as a bit mask with X in bit 0.
class AxisSet {
 public:
  constexpr AxisSet() = default;
  constexpr explicit AxisSet(std::uint16_t bits) : bits_(bits) {}
  constexpr bool has(Axis axis) const { return (bits_ >> index_of(axis) & 1U) != 0; }
  constexpr void add(Axis axis) { bits_ = static_cast<std::uint16_t>(bits_ | 1U << index_of(axis)); }
  constexpr void remove(Axis axis) { bits_ = static_cast<std::uint16_t>(bits_ & ~(1U << index_of(axis))); }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr std::uint16_t bits() const { return bits_; }
  friend constexpr bool operator==(AxisSet, AxisSet) = default;

 private:
  std::uint16_t bits_ = 0;
};

// A position of the tool: a value in millimetres or degrees for each axis. The name of the variable gives the
// coordinate system (machine or work).
struct Point : PerAxis<double> {
  friend constexpr Point operator+(Point a, const Point& b) {
    for (std::size_t i = 0; i < axis_count; ++i) a.values[i] += b.values[i];
    return a;
  }
  friend constexpr Point operator-(Point a, const Point& b) {
    for (std::size_t i = 0; i < axis_count; ++i) a.values[i] -= b.values[i];
    return a;
  }
  friend constexpr Point operator*(Point a, double k) {
    for (double& value : a.values) value *= k;
    return a;
  }
  friend constexpr bool operator==(const Point&, const Point&) = default;
};

}  // namespace passo
