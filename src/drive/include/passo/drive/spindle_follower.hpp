// SpindleFollower: how fast a feed must be that follows the spindle, from what the spindle's encoder says.
//
// The motion behind what is committed is planned for the speed that the spindle has, and where the lock is one of
// place, a little faster or slower until the tool is where the spindle's angle wants it:
//
//     turns wanted = turns of the spindle since its index - lag
//
// at the time when the committed motion ends, as the last readings go on. The lag is what speeding up to the programmed
// speed costs: the same in each pass, so that all passes of a thread lie in one groove.
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

  // Readings begin anew, at any time.
  void restart();
  // The next locked move begins when the spindle has turned so far: to an index.
  void begin(double index);
  // From now on the moves go back the way that they came, as the spindle does.
  void turn_round() { direction_ = -1; }
  // Of the spindle, by the last readings; below 0: down.
  double turns_a_second() const;
  // As the readings go on, so long after the last one the spindle stands or turns back.
  bool turns_back(Seconds committed) const;
  // A move was committed.
  void watch(const PlannedMove& move);
  // A new reading.
  void read(const SpindleReading& reading);
  // Of the move that was committed last.
  SpindleLock lock() const { return lock_; }
  // The multiple of the programmed speed that follows the spindle; `committed`: how long after the reading it counts.
  // Nothing where it is to stay: a change of speed under a limit of jerk is not to be changed before it is made.
  std::optional<double> ratio(Seconds committed);

  // Turns by which the tool is not where it should be when what is committed ends, once it has had a lead-in.
  double missing(Seconds committed) const;
  // Below it a spindle is not followed.
  static constexpr double least_ratio = 0.02;
  static constexpr double most_ratio = 2;

 private:
  // What the readings make of a time after the last of them.
  struct Course {
    double turns = 0;  // since the index
    double speed = 0;  // turns a second; below 0: back
  };
  Course course(Seconds later) const;
  double speed() const { return std::abs(turns_a_second()); }
  double wanted_ratio(Seconds committed) const;
  double lag_of(const PlannedMove& move) const;

  MotionLimits limits_;
  double patience_ = 0;  // seconds between two changes
  double changed_at_ = -1;
  double ratio_ = 1;
  std::deque<SpindleReading> readings_;  // of the last few hundredths of a second
  SpindleLock lock_ = SpindleLock::none;
  double programmed_ = 0;  // turns a second
  double reached_ = 0;     // turns a second, at the end of what is committed
  double index_ = 0;       // turns of the spindle there
  double way_ = 1;         // that it turned then; -1: down
  double lag_ = -1;        // turns; below 0: not known yet
  double followed_ = 0;    // turns, by what is committed
  double direction_ = 1;   // of the moves; -1: back
  bool in_place_ = false;  // has once been as fast as the spindle
};

}  // namespace passo
