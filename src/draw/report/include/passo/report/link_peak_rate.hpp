// LinkPeakRate: the maximum number of bytes sent over the serial link in any second of the board's time.
#pragma once

#include <algorithm>
#include <cstdint>

#include "passo/units/units.hpp"

namespace passo {

class LinkPeakRate {
 public:
  // `sent` is the number of bytes sent up to `now`. Must be called at least once a second.
  void update(Seconds now, std::uint64_t sent) {
    if (now - since_ < Seconds(1)) return;
    const double rate = static_cast<double>(sent - before_) / (now - since_).value();
    busiest_ = std::max(busiest_, static_cast<std::uint64_t>(rate));
    since_ = now;
    before_ = sent;
  }
  // Returns the maximum rate in bytes/s, measured over one second, or between two samples if they are farther apart. 0
  // if the whole run took less than a second.
  std::uint64_t busiest() const { return busiest_; }

 private:
  Seconds since_{0};
  std::uint64_t before_ = 0;
  std::uint64_t busiest_ = 0;
};

}  // namespace passo
