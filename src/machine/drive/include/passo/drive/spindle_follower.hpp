// SpindleFollower: works out how fast a feed must be to follow the spindle, from the readings of the spindle's encoder.
//
// Motion after the committed motion is planned for the speed that the spindle has. Where the lock is one of place, the
// motion is planned a little faster or slower, until the tool is where the spindle's angle wants it:
//
//     turns wanted = turns of the spindle since its index - lag
//
// at the time when the committed motion ends, extrapolated from the last readings. The lag is the way that the tool
// loses while it speeds up to the programmed speed. The lag is the same in each pass, so that all passes of a thread
// lie in one groove.
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

  // Forgets the readings. May be called at any time.
  void restart();
  // The next locked move begins when the spindle has turned to `index`, in turns.
  void begin(double index);
  // From now on the moves go back the way they came, and the spindle turns back.
  void reverse() { direction_ = -1; }
  // The spindle's speed, by the last readings. Negative: the count goes down.
  double turns_per_second() const;
  // True: by the readings, the spindle stands or turns back at `committed` after the last reading.
  bool is_reversing(Seconds committed) const;
  // A move was committed.
  void watch(const PlannedMove& move);
  // A new reading.
  void read(const SpindleReading& reading);
  // The lock of the move that was committed last.
  SpindleLock lock() const { return lock_; }
  // The multiple of the programmed speed that follows the spindle. `committed`: how long after the last reading the
  // ratio takes effect. Empty: the ratio stays as it is, because under a limit of jerk a change of speed must be
  // complete before the next one.
  std::optional<double> ratio(Seconds committed);

  // By how many turns the tool is off when the committed motion ends. 0 until the tool has had a lead-in.
  double missing(Seconds committed) const;
  // True: the spindle is so fast that the axes cannot get the tool up to speed.
  bool outruns_axes(Seconds committed) const;
  // The least and the greatest ratio that ratio() gives. A spindle slower than `least_ratio` is not followed.
  static constexpr double least_ratio = 0.02;
  static constexpr double most_ratio = 2;

 private:
  // What the readings predict for a time after the last reading.
  struct Course {
    double turns = 0;  // since the index
    double speed = 0;  // turns a second; negative: back
  };
  Course course(Seconds later) const;
  double speed() const { return std::abs(turns_per_second()); }
  double wanted_ratio(Seconds committed) const;
  double lag_of(const PlannedMove& move) const;

  MotionLimits limits_;
  double patience_ = 0;  // seconds between two changes
  double changed_at_ = -1;
  double ratio_ = 1;
  std::deque<SpindleReading> readings_;  // the last few hundredths of a second
  SpindleLock lock_ = SpindleLock::none;
  double programmed_ = 0;  // turns a second
  double most_turns_ = 0;  // turns a second that the axes can follow on the move that was committed last
  double reached_ = 0;     // turns a second, at the end of the committed motion
  double index_ = 0;       // turns of the spindle where the locked move begins
  double way_ = 1;         // the spindle's direction then; -1: down
  double lag_ = -1;        // turns; negative: not known yet
  double followed_ = 0;    // turns made by the committed motion
  double direction_ = 1;   // direction of the moves; -1: back
  bool in_place_ = false;  // the tool has once been as fast as the spindle
};

}  // namespace passo
