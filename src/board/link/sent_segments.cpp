#include "passo/link/sent_segments.hpp"

#include <algorithm>
#include <limits>

#include "passo/link/link.hpp"
#include "passo/wire/plain_parts.hpp"

namespace passo {
namespace {

// As the board's player has them after a hello.
constexpr std::uint16_t half = 0x8000;

bool has(std::uint8_t motors, std::size_t motor) {
  return (motors >> motor & 1U) != 0;
}

}  // namespace

void SentSegments::keep(Hertz rate) {
  tick_ = Seconds(rate.value() > 0 ? 1 / rate.value() : 0);
  kept_.clear();
}

void SentSegments::begin(std::uint8_t motors) {
  motors_ = motors;
  kept_.clear();
  end_.fractions.fill(half);
  end_.counts = {};
}

void SentSegments::add(std::uint16_t number, const BoardSegment& segment, Seconds now) {
  if (!keeps()) return;
  if (kept_.size() == most) kept_.pop_front();
  const auto sent = static_cast<std::int64_t>(now / tick_) * whole_tick + half;
  end_.time = std::max(end_.time, sent);
  kept_.push_back({number, segment, end_});
  end_ = after(end_, segment);
}

void SentSegments::drop_behind(std::uint16_t number) {
  while (!kept_.empty() && later_by(kept_.back().number, number) > 0) {
    end_ = kept_.back().place;
    kept_.pop_back();
  }
}

void SentSegments::stop(Seconds now) {
  if (!keeps()) return;
  const auto time = static_cast<std::int64_t>(now / tick_) * whole_tick;
  while (!kept_.empty() && kept_.back().place.time > time) {
    end_ = kept_.back().place;
    kept_.pop_back();
  }
  if (!kept_.empty()) kept_.back().until = std::min(kept_.back().until, time);
  end_.time = std::min(end_.time, time);
}

void SentSegments::stand_at(const std::int32_t* counts) {
  std::copy(counts, counts + motors_, end_.counts.begin());
}

SentSegments::Place SentSegments::after(const Place& place, const BoardSegment& segment) const {
  Place end = place;
  end.time += duration(segment, std::numeric_limits<std::int32_t>::max());
  for_each_plain_part(segment, [&](const BoardSegment& part) {
    for (std::size_t motor = 0; motor < motors_; ++motor) {
      const std::uint32_t added = end.fractions[motor] + std::uint32_t{part.increments[motor]} * part.events;
      end.fractions[motor] = static_cast<std::uint16_t>(added);
      const auto carries = static_cast<std::int32_t>(added >> 16);
      const std::int32_t steps = has(part.flips, motor) ? part.events - carries : carries;
      end.counts[motor] += has(part.directions, motor) ? -steps : steps;
    }
  });
  return end;
}

PulseWindow SentSegments::window(Seconds from, Seconds to, Seconds now, std::size_t most_pulses) const {
  PulseWindow window;
  window.newest = std::min(now, time_of(end_.time));
  window.oldest = kept_.empty() ? window.newest : time_of(kept_.front().place.time);
  window.begin = std::clamp(from, window.oldest, std::max(window.oldest, window.newest));
  window.end = std::clamp(to, window.begin, std::max(window.begin, now));
  // The last segment that begins before the window.
  const auto later = std::upper_bound(kept_.begin(), kept_.end(), window.begin,
                                      [&](Seconds time, const Kept& one) { return time < time_of(one.place.time); });
  auto at = later == kept_.begin() ? later : later - 1;
  window.counts = at == kept_.end() ? end_.counts : at->place.counts;
  for (; at != kept_.end() && time_of(at->place.time) <= window.end; ++at) {
    list(*at, window.begin, window.end, most_pulses, window);
  }
  return window;
}

// As the board's player (firmware/player.hpp) plays it.
void SentSegments::list(const Kept& kept, Seconds from, Seconds to, std::size_t most_pulses,
                        PulseWindow& window) const {
  Place at = kept.place;
  for_each_plain_part(kept.segment, [&](const BoardSegment& part) {
    std::uint32_t interval = part.interval;
    for (std::uint16_t event = 0; event < part.events; ++event) {
      at.time += interval;
      interval += static_cast<std::uint32_t>(part.change);
      std::uint8_t carries = 0;
      for (std::size_t motor = 0; motor < motors_; ++motor) {
        const std::uint16_t before = at.fractions[motor];
        at.fractions[motor] = static_cast<std::uint16_t>(before + part.increments[motor]);
        if (at.fractions[motor] < before) carries = static_cast<std::uint8_t>(carries | 1U << motor);
      }
      const auto stepped = static_cast<std::uint8_t>(carries ^ part.flips);
      const Seconds time = time_of(at.time);
      if (stepped == 0 || at.time > kept.until || time > to || time > window.end) continue;
      if (time >= from && window.pulses.size() == most_pulses) {
        window.end = window.pulses.empty() ? window.begin : window.pulses.back().time;
        continue;
      }
      if (time >= from) {
        window.pulses.push_back({time, stepped, part.directions});
        continue;
      }
      for (std::size_t motor = 0; motor < motors_; ++motor) {
        if (has(stepped, motor)) window.counts[motor] += has(part.directions, motor) ? -1 : 1;
      }
    }
  });
}

}  // namespace passo
