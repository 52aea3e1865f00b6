// LineLoad: the most bytes sent in any second of the board's time.
#pragma once

#include <algorithm>
#include <cstdint>

#include "passo/units/units.hpp"

namespace passo {

class LineLoad {
 public:
  // `sent` counts the bytes sent up to `now`. Call this often, at least once a second.
  void update(Seconds now, std::uint64_t sent) {
    if (now - since_ < Seconds(1)) return;
    const double rate = static_cast<double>(sent - before_) / (now - since_).value();
    busiest_ = std::max(busiest_, static_cast<std::uint64_t>(rate));
    since_ = now;
    before_ = sent;
  }
  // The highest rate in bytes a second, measured over a second or, if looks are farther apart, between two looks. 0 if
  // the whole run took less than a second.
  std::uint64_t busiest() const { return busiest_; }

 private:
  Seconds since_{0};
  std::uint64_t before_ = 0;
  std::uint64_t busiest_ = 0;
};

}  // namespace passo
