// TwoLanes and FourLanes: vectors of doubles (SIMD). Each lane gives the same result as a single double.
//
// Every 64-bit processor has vectors of two doubles, but automatic vectorisation finds only some of the opportunities.
#pragma once

#include <cstring>

namespace passo {

class TwoLanes {
 public:
  TwoLanes() = default;
  TwoLanes(double first, double second) : lanes_{first, second} {}
  explicit TwoLanes(double both) : lanes_{both, both} {}
  static TwoLanes load(const double* from) {
    TwoLanes lanes;
    std::memcpy(&lanes.lanes_, from, sizeof(Pair));
    return lanes;
  }
  void store(double* to) const { std::memcpy(to, &lanes_, sizeof(Pair)); }

  double first() const { return lanes_[0]; }
  double second() const { return lanes_[1]; }
  double sum() const { return lanes_[0] + lanes_[1]; }
  double largest() const { return lanes_[0] > lanes_[1] ? lanes_[0] : lanes_[1]; }

  TwoLanes& operator+=(TwoLanes other) { return *this = *this + other; }
  friend TwoLanes operator+(TwoLanes a, TwoLanes b) { return TwoLanes(a.lanes_ + b.lanes_); }
  friend TwoLanes operator-(TwoLanes a, TwoLanes b) { return TwoLanes(a.lanes_ - b.lanes_); }
  friend TwoLanes operator*(TwoLanes a, TwoLanes b) { return TwoLanes(a.lanes_ * b.lanes_); }
  friend TwoLanes operator*(TwoLanes a, double b) { return TwoLanes(a.lanes_ * b); }
  friend TwoLanes operator/(TwoLanes a, TwoLanes b) { return TwoLanes(a.lanes_ / b.lanes_); }
  friend TwoLanes larger(TwoLanes a, TwoLanes b) { return TwoLanes(a.lanes_ > b.lanes_ ? a.lanes_ : b.lanes_); }
  // Whether any lane of `a` is above the corresponding lanes of `b` and of `c`.
  friend bool any_above(TwoLanes a, TwoLanes b, TwoLanes c) {
    const Mask mask = (a.lanes_ > b.lanes_) & (a.lanes_ > c.lanes_);
    return (mask[0] | mask[1]) != 0;
  }

 private:
  using Pair [[gnu::vector_size(16)]] = double;
  using Mask [[gnu::vector_size(16)]] = long long;
  explicit TwoLanes(Pair lanes) : lanes_(lanes) {}

  Pair lanes_{};
};

class FourLanes {
 public:
  FourLanes() = default;
  FourLanes(TwoLanes low, TwoLanes high) : low_(low), high_(high) {}
  static FourLanes load(const double* from) { return {TwoLanes::load(from), TwoLanes::load(from + 2)}; }
  void store(double* to) const {
    low_.store(to);
    high_.store(to + 2);
  }

  TwoLanes low() const { return low_; }
  TwoLanes high() const { return high_; }
  double sum() const { return (low_ + high_).sum(); }

  FourLanes& operator+=(FourLanes other) { return *this = *this + other; }
  friend FourLanes operator+(FourLanes a, FourLanes b) { return {a.low_ + b.low_, a.high_ + b.high_}; }
  friend FourLanes operator-(FourLanes a, FourLanes b) { return {a.low_ - b.low_, a.high_ - b.high_}; }
  friend FourLanes operator*(FourLanes a, FourLanes b) { return {a.low_ * b.low_, a.high_ * b.high_}; }
  friend FourLanes operator*(FourLanes a, double b) { return {a.low_ * b, a.high_ * b}; }
  // Whether any lane of `a` is above the corresponding lanes of `b` and of `c`, without a branch between the halves.
  friend bool any_above(FourLanes a, FourLanes b, FourLanes c) {
    const int low = any_above(a.low_, b.low_, c.low_) ? 1 : 0;
    const int high = any_above(a.high_, b.high_, c.high_) ? 1 : 0;
    return (low | high) != 0;
  }

 private:
  TwoLanes low_;
  TwoLanes high_;
};

}  // namespace passo
