// FeedFactors: real-time factors on the programmed feeds. MidRunWishes: all real-time changes. Private to trajectory/.
#pragma once

#include <algorithm>
#include <limits>

#include "passo/path/segment.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// Below this factor the feed is 0, and the motion stops: overrides have a resolution of one percent (planner.hpp).
inline constexpr double least_feed_factor = 0.01;

struct FeedFactors {
  double override = 1;
  double adaptive = 1;
  double rapids = 1;                                     // at most 1: a factor of the speed that the axes allow
  const MotionLimits* limits = nullptr;                  // of the axes, if rapids are scaled
  double spindle = 1;                                    // factor on feeds that follow the spindle
  double top = std::numeric_limits<double>::infinity();  // mm/s: limits all speeds, including rapids

  // Returns the chosen factor, without the spindle: a slow spindle does not stop the motion. Adaptive feed applies to
  // rapids too.
  double chosen(const OverridePermissions& heeds) const { return (heeds.feed_override ? override : 1) * own(heeds); }
  double chosen_on(const Segment& segment) const { return segment.rapid ? own(segment.heeds) : chosen(segment.heeds); }
  // Returns the factor for planning. While the motion is stopped, the remaining path is planned for the slowest feed.
  double planned(const OverridePermissions& heeds, SpindleLock lock) const {
    return std::max(chosen(heeds) * (lock != SpindleLock::none ? spindle : 1), least_feed_factor);
  }
  // The programmed or rapid speed with the factors, in mm/s.
  double speed_on(const Segment& segment) const {
    const double speed = segment.speed.value();
    if (!segment.rapid) return std::min(speed * planned(segment.heeds, segment.lock), top);
    const double share = rapids * std::max(own(segment.heeds), least_feed_factor);
    if (share == 1) return std::min(speed, top);
    return std::min(share * speed_within(segment.curve.steepest(), speed, *limits), top);
  }
  // Returns the larger one of each pair of factors.
  static FeedFactors fastest_of(const FeedFactors& a, const FeedFactors& b) {
    return {.override = std::max(a.override, b.override),
            .adaptive = std::max(a.adaptive, b.adaptive),
            .rapids = std::max(a.rapids, b.rapids),
            .limits = a.limits != nullptr ? a.limits : b.limits,
            .spindle = std::max(a.spindle, b.spindle),
            .top = std::max(a.top, b.top)};
  }
  friend bool operator==(const FeedFactors&, const FeedFactors&) = default;

 private:
  double own(const OverridePermissions& heeds) const { return heeds.adaptive_feed ? adaptive : 1; }
};

// Real-time requests. any() returns whether a request may stop the motion.
struct MidRunWishes {
  FeedFactors feeds;
  bool hold = false;  // stops where the program enables holds
  bool stop = false;  // stops anywhere
  Seconds longest_move{std::numeric_limits<double>::infinity()};

  bool any() const {
    const double least = std::min({feeds.override, feeds.adaptive, feeds.override * feeds.adaptive});
    return hold || stop || least < least_feed_factor;
  }
  bool stands_before(const Action* action) const {
    return stop || (hold && (action == nullptr || action->heeds.feed_hold));
  }
  bool stands_on(const Segment& segment) const {
    const bool no_feed = feeds.chosen_on(segment) < least_feed_factor;
    return stop || (hold && segment.heeds.feed_hold) || no_feed;
  }
};

}  // namespace passo
