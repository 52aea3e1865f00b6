// The cutting loads that a survey asks for, move by move.
#include <algorithm>
#include <cmath>

#include "passo/cutting/cut_loads.hpp"

namespace passo {

std::size_t CutLoads::add(const Segment& feed) {
  loads_.push_back({feed.source.line, static_cast<float>(feed.curve.length().value()), 0});
  return loads_.size() - 1;
}

void CutLoads::raise(std::size_t index, double newtons_per_speed) {
  float& load = loads_[index].newtons_per_speed;
  load = std::max(load, static_cast<float>(newtons_per_speed));
}

bool CutLoads::fits(const Load& load, const Segment& feed) const {
  constexpr double of_a_float = 1e-5;
  const double length = feed.curve.length().value();
  return load.line == feed.source.line && std::abs(double{load.length} - length) <= of_a_float * (1 + length);
}

double CutLoads::of(const PlannedMove& move) {
  const Segment& segment = move.segment;
  if (segment.rapid || segment.takes_up_backlash) return 0;
  const bool is_next_part = move.from() > Mm(0);
  if (is_next_part) return present_;
  // A feed that is missing on one side must not shift all that follow.
  constexpr std::size_t most_ahead = 64;
  for (std::size_t i = next_; i < std::min(next_ + most_ahead, loads_.size()); ++i) {
    if (!fits(loads_[i], segment)) continue;
    next_ = i + 1;
    present_ = loads_[i].newtons_per_speed;
    return present_;
  }
  ++unknown_;
  present_ = 0;
  return 0;
}

}  // namespace passo
