// SpindleFollower: computes the feed factor with which a feed follows the spindle, from the readings of the spindle's
// encoder.
//
// Motion after the committed motion is planned for the current spindle speed. If it is locked to the spindle's angle,
// it is planned slightly faster or slower until the tool matches the angle:
//
//     turns wanted = turns of the spindle since its index - lag
//
// at the time when the committed motion ends, extrapolated from the last readings. The lag is the angle that the tool
// loses while it accelerates to the programmed speed. The lag is the same in each pass, so that all passes of a thread
// follow the same groove.
#pragma once

#include <cmath>
#include <deque>
#include <optional>

#include "passo/drive/spindle_encoder.hpp"
#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class SpindleFollower {
 public:
  explicit SpindleFollower(const MotionLimits& limits);

  // Drops the readings. May be called at any time.
  void restart();
  // The next locked move begins at the spindle angle `index`, in revolutions.
  void begin(double index);
  // From now on the moves retract along the same path, and the spindle runs in reverse.
  void reverse() { direction_ = -1; }
  // The spindle's speed, from the last readings. Negative: the counts decrease.
  double turns_per_second() const;
  // Returns true if, according to the readings, the spindle is stopped or reversed `committed` after the last reading.
  bool is_reversing(Seconds committed) const;
  // Records a committed move.
  void watch(const PlannedMove& move);
  // Processes a new reading.
  void read(const SpindleReading& reading);
  // The lock of the last committed move.
  SpindleLock lock() const { return lock_; }
  // The multiple of the programmed speed that follows the spindle. `committed`: the time from the last reading until
  // the ratio takes effect. Empty: the ratio stays unchanged, because with a jerk limit a speed change must be complete
  // before the next one.
  std::optional<double> ratio(Seconds committed);

  // The angle error of the tool at the end of the committed motion, in revolutions. 0 until the tool has had a lead-in.
  double missing(Seconds committed) const;
  // Returns true if the spindle is too fast for the axes to reach its speed.
  bool outruns_axes(Seconds committed) const;
  // The smallest and the largest result of ratio(). A spindle slower than `least_ratio` is not followed.
  static constexpr double least_ratio = 0.02;
  static constexpr double most_ratio = 2;

 private:
  // The prediction from the readings for a later time.
  struct Course {
    double turns = 0;  // revolutions since the index
    double speed = 0;  // rev/s; negative: reverse
  };
  Course course(Seconds later) const;
  double speed() const { return std::abs(turns_per_second()); }
  double wanted_ratio(Seconds committed) const;
  double lag_of(const PlannedMove& move) const;

  MotionLimits limits_;
  double patience_ = 0;  // seconds between two speed changes
  double changed_at_ = -1;
  double ratio_ = 1;
  std::deque<SpindleReading> readings_;  // the last few hundredths of a second
  SpindleLock lock_ = SpindleLock::none;
  double programmed_ = 0;  // rev/s
  double most_turns_ = 0;  // rev/s that the axes can follow on the last committed move
  double reached_ = 0;     // rev/s at the end of the committed motion
  double index_ = 0;       // spindle angle at the start of the locked move, in revolutions
  double way_ = 1;         // counting direction of the spindle at that time; -1: down
  double lag_ = -1;        // revolutions; negative: unknown
  double followed_ = 0;    // revolutions covered by the committed motion
  double direction_ = 1;   // direction of the moves; -1: back
  bool in_place_ = false;  // the tool has reached the spindle's speed once
};

}  // namespace passo
