#include "passo/verdict/load_track.hpp"

#include <algorithm>

namespace passo {
namespace {

void join(LoadTrack::Stretch& one, const LoadTrack::Stretch& next) {
  if (next.load >= one.load) {
    one.load = next.load;
    one.line = next.line;
  }
  one.way += next.way;
  one.time += next.time;
}

}  // namespace

void LoadTrack::add(Seconds duration, Mm way, double load, std::uint32_t line) {
  const MmPerSecond speed = duration > Seconds(0) ? way / duration : MmPerSecond(0);
  constexpr double nothing = 1e-9;
  while (duration > Seconds(nothing)) {
    if (stretches_.empty() || stretches_.back().time >= length_ * (1 - nothing)) {
      if (stretches_.size() == most_stretches) make_room();
      stretches_.push_back({.load = load, .line = line});
    }
    Stretch& last = stretches_.back();
    const Seconds part = std::min(duration, length_ - last.time);
    join(last, {.load = load, .line = line, .way = speed * part, .time = part});
    duration -= part;
    // A long piece would fill one stretch after the other, only for them to be joined.
    while (duration > length_ * static_cast<double>(most_stretches) && length_ < Seconds(1e9)) make_room();
  }
}

void LoadTrack::make_room() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < stretches_.size(); i += 2) {
    Stretch one = stretches_[i];
    if (i + 1 < stretches_.size()) join(one, stretches_[i + 1]);
    stretches_[kept++] = one;
  }
  stretches_.resize(kept);
  length_ = length_ * 2;
}

}  // namespace passo
