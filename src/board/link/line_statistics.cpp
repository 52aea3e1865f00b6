#include "passo/link/line_statistics.hpp"

#include <algorithm>

namespace passo {
namespace {

// So many frames tell how fast the board takes frames. The rate at which a slow burst is forgotten.
constexpr std::size_t long_burst = 8;
constexpr double patience_with_bursts = 0.95;

}  // namespace

void LineStatistics::end_burst(Seconds now) {
  const Seconds each = (now - burst_began_) / static_cast<double>(burst_);
  if (burst_ >= long_burst) time_a_frame_ = std::max(each, time_a_frame_ * patience_with_bursts);
  burst_ = 0;
}

void LineStatistics::forget_pace() {
  burst_ = 0;
  time_a_frame_ = Seconds(0);
}

}  // namespace passo
