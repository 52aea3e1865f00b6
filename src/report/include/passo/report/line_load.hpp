// LineLoad: how many bytes go down the wire in a second, at most, as the board's time goes by.
#pragma once

#include <algorithm>
#include <cstdint>

#include "passo/units/units.hpp"

namespace passo {

class LineLoad {
 public:
  // `sent`: bytes up to `now`. Often; a look a second at least.
  void look(Seconds now, std::uint64_t sent) {
    if (now - since_ < Seconds(1)) return;
    const double rate = static_cast<double>(sent - before_) / (now - since_).value();
    busiest_ = std::max(busiest_, static_cast<std::uint64_t>(rate));
    since_ = now;
    before_ = sent;
  }
  // Bytes a second, over a second or what the looks were apart; 0 where it all took less.
  std::uint64_t busiest() const { return busiest_; }

 private:
  Seconds since_{0};
  std::uint64_t before_ = 0;
  std::uint64_t busiest_ = 0;
};

}  // namespace passo
