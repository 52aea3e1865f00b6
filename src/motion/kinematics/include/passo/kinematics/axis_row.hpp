// AxisRow: a sum over axes, each with a factor. It converts values of the axes (a position, distance, velocity or
// acceleration) into the value of one motor or one limit.
//
// Most rows have one axis. A motor of a CoreXY machine has two: it turns by X plus Y, or by X minus Y.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "passo/geometry/axes.hpp"

namespace passo {

class AxisRow {
 public:
  static constexpr std::size_t most_axes = 3;
  struct Share {
    Axis axis = Axis::x;
    double factor = 0;
  };

  // An empty row: the sum is 0.
  AxisRow() = default;
  AxisRow(Axis axis, double factor) { shares_[0] = {axis, factor}; }
  // Creates a row of one to most_axes shares, each of another axis. Further shares are ignored.
  AxisRow(std::initializer_list<Share> shares) {
    count_ = 0;
    for (const Share& share : shares) {
      if (count_ < most_axes) shares_[count_++] = share;
    }
  }

  std::span<const Share> shares() const { return {shares_.data(), count_}; }
  bool has_one_axis() const { return count_ == 1; }
  // The axis of a row with one axis, and its factor.
  Axis axis() const { return shares_[0].axis; }
  double factor() const { return shares_[0].factor; }
  // Returns the axis' factor; 0: the axis is not in the row.
  double factor_of(Axis axis) const {
    for (const Share& share : shares()) {
      if (share.axis == axis) return share.factor;
    }
    return 0;
  }

  double of(const PerAxis<double>& values) const {
    double sum = shares_[0].factor * values[shares_[0].axis];
    for (std::size_t i = 1; i < count_; ++i) sum += shares_[i].factor * values[shares_[i].axis];
    return sum;
  }
  // Returns a bound of the row's absolute value, from bounds of the axes' absolute values.
  double most_of(const PerAxis<double>& sizes) const {
    double sum = std::fabs(shares_[0].factor) * sizes[shares_[0].axis];
    for (std::size_t i = 1; i < count_; ++i) sum += std::fabs(shares_[i].factor) * sizes[shares_[i].axis];
    return sum;
  }

 private:
  std::array<Share, most_axes> shares_{};
  std::size_t count_ = 1;
};

}  // namespace passo
