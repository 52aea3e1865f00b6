// FeedFactors: what multiplies the programmed feeds in mid-run. Private to trajectory/.
#pragma once

#include <algorithm>

#include "passo/path/segment.hpp"

namespace passo {

// Below it a feed is none, and the motion stands.
inline constexpr double least_feed_factor = 0.01;

struct FeedFactors {
  double override = 1;
  double adaptive = 1;
  double spindle = 1;  // of feeds that follow it

  double of(const Heeds& heeds, SpindleLock lock) const {
    return (heeds.feed_override ? override : 1) * (heeds.adaptive_feed ? adaptive : 1) *
           (lock != SpindleLock::none ? spindle : 1);
  }
  double of(const Segment& segment) const { return segment.rapid ? 1 : of(segment.heeds, segment.lock); }
  // As it is planned with: where nothing moves, what follows is planned for the slowest feed.
  double planned(const Heeds& heeds, SpindleLock lock) const { return std::max(of(heeds, lock), least_feed_factor); }
  double planned(const Segment& segment) const { return std::max(of(segment), least_feed_factor); }
  friend bool operator==(const FeedFactors&, const FeedFactors&) = default;
};

// What was asked for in mid-run.
// `any()` is what a planner asks first.
struct MidRunWishes {
  FeedFactors feeds;
  bool hold = false;  // where the program heeds it
  bool stop = false;  // wherever it is

  bool any() const {
    return hold || stop || feeds.override * feeds.adaptive * feeds.spindle < least_feed_factor ||
           feeds.override < least_feed_factor || feeds.adaptive < least_feed_factor ||
           feeds.spindle < least_feed_factor;
  }
  bool stands_before(const Action* action) const {
    return stop || (hold && (action == nullptr || action->heeds.feed_hold));
  }
  bool stands_on(const Segment& segment) const {
    return stop || (hold && segment.heeds.feed_hold) || feeds.of(segment) < least_feed_factor;
  }
};

}  // namespace passo
