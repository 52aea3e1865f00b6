// FourLanes: four doubles that are computed side by side. Each gives the same result as a single double.
//
// Every 64-bit processor has vectors of two doubles. Compilers that must find vectors by themselves find only some of
// them.
#pragma once

#include <cstring>

namespace passo {

class FourLanes {
 public:
  FourLanes() = default;
  static FourLanes load(const double* from) {
    FourLanes lanes;
    std::memcpy(&lanes.low_, from, sizeof(Pair));
    std::memcpy(&lanes.high_, from + 2, sizeof(Pair));
    return lanes;
  }
  void store(double* to) const {
    std::memcpy(to, &low_, sizeof(Pair));
    std::memcpy(to + 2, &high_, sizeof(Pair));
  }

  friend FourLanes operator+(FourLanes a, FourLanes b) { return {a.low_ + b.low_, a.high_ + b.high_}; }
  friend FourLanes operator*(FourLanes a, FourLanes b) { return {a.low_ * b.low_, a.high_ * b.high_}; }
  friend FourLanes operator*(FourLanes a, double b) { return {a.low_ * b, a.high_ * b}; }
  // Whether any lane of `a` is above those of `b` and of `c`.
  friend bool any_above(FourLanes a, FourLanes b, FourLanes c) {
    const Mask mask = ((a.low_ > b.low_) & (a.low_ > c.low_)) | ((a.high_ > b.high_) & (a.high_ > c.high_));
    return (mask[0] | mask[1]) != 0;
  }

 private:
  using Pair [[gnu::vector_size(16)]] = double;
  using Mask [[gnu::vector_size(16)]] = long long;
  FourLanes(Pair low, Pair high) : low_(low), high_(high) {}

  Pair low_{};
  Pair high_{};
};

}  // namespace passo
