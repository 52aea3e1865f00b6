// FeedFactors: factors on the programmed feeds, changed in mid-run. MidRunWishes: all that is changed in mid-run.
// Private to trajectory/.
#pragma once

#include <algorithm>
#include <limits>

#include "passo/path/segment.hpp"
#include "passo/trajectory/motion_limits.hpp"

namespace passo {

// Below this factor there is no feed, and the motion stands still: knobs turn by whole percents (planner.hpp).
inline constexpr double least_feed_factor = 0.01;

struct FeedFactors {
  double override = 1;
  double adaptive = 1;
  double rapids = 1;                                     // at most 1: a factor of the speed that the axes allow
  const MotionLimits* limits = nullptr;                  // of the axes, where rapids != 1
  double spindle = 1;                                    // factor of feeds that follow the spindle
  double top = std::numeric_limits<double>::infinity();  // mm/s: limits all speeds, rapids included

  // The factor that was chosen for feeds. The spindle is left out: a slow spindle does not make the motion stand still.
  double chosen(const Heeds& heeds) const {
    return (heeds.feed_override ? override : 1) * (heeds.adaptive_feed ? adaptive : 1);
  }
  // The factor to plan with. Where the motion stands still, the rest is planned for the slowest feed.
  double planned(const Heeds& heeds, SpindleLock lock) const {
    return std::max(chosen(heeds) * (lock != SpindleLock::none ? spindle : 1), least_feed_factor);
  }
  // The programmed or rapid speed with the factors, in mm/s.
  double speed_on(const Segment& segment) const {
    const double speed = segment.speed.value();
    if (!segment.rapid) return std::min(speed * planned(segment.heeds, segment.lock), top);
    if (rapids == 1) return std::min(speed, top);
    return std::min(rapids * speed_within(segment.curve.steepest(), speed, *limits), top);
  }
  // Each factor of the two that is the faster one.
  static FeedFactors fastest_of(const FeedFactors& a, const FeedFactors& b) {
    return {.override = std::max(a.override, b.override),
            .adaptive = std::max(a.adaptive, b.adaptive),
            .rapids = std::max(a.rapids, b.rapids),
            .limits = a.limits != nullptr ? a.limits : b.limits,
            .spindle = std::max(a.spindle, b.spindle),
            .top = std::max(a.top, b.top)};
  }
  friend bool operator==(const FeedFactors&, const FeedFactors&) = default;
};

// What was asked for in mid-run. any() tells whether something may keep the motion from going on.
struct MidRunWishes {
  FeedFactors feeds;
  bool hold = false;  // stops where the program heeds a hold
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
    const bool no_feed = !segment.rapid && feeds.chosen(segment.heeds) < least_feed_factor;
    return stop || (hold && segment.heeds.feed_hold) || no_feed;
  }
};

}  // namespace passo
