// SpindleTracker: keeps motion in step with the spindle, by what the board's encoder tells. The tracker waits for the
// index, sets the ratio of the feed, finds out when the spindle reverses in a tap, and gives up where it cannot follow
// the spindle.
//
// The tracker stands between the feed, which knows how far ahead motion is committed, and the planner, which is told
// how fast to go.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "passo/drive/feed.hpp"
#include "passo/drive/spindle_encoder.hpp"
#include "passo/drive/spindle_follower.hpp"
#include "passo/link/link.hpp"
#include "passo/trajectory/planner.hpp"

namespace passo {

class SpindleTracker {
 public:
  struct Stages {
    Planner& planner;
    Feed& feed;
    Link& link;
  };
  // All stages outlive the tracker. `counts_per_turn` 0: there is no encoder, and nothing follows the spindle.
  SpindleTracker(const Stages& stages, const MotionLimits& limits, int counts_per_turn, Hertz clock);
  bool exists() const { return encoder_.exists(); }

  void watch(const PlannedMove& move) { follower_.watch(move); }
  // How the motion planned last follows the spindle.
  SpindleLock lock() const { return follower_.lock(); }
  // True: motion follows the spindle, or is about to.
  bool follows() const { return follows_; }

  // Called between two steps of the drive. False: the board has to answer first.
  [[nodiscard]] bool follow();
  // Stops following where the motion planned last does not follow and no thread is about to begin. True: motion
  // followed until now.
  [[nodiscard]] bool let_go();

  // Begins, at rest, to wait for the spindle to reach this speed and for its index to come by.
  void begin_await(double revolutions_per_minute);
  // True: the motion is to begin now, or the tracker has given up. False: call again when the board has answered, or at
  // next_poll().
  [[nodiscard]] bool await_index();
  Seconds next_poll() const { return looks_at_; }

  // A tap is on its way down, and the spindle was told to reverse. turned_back() tells, once, that the spindle has
  // reversed.
  void expect_turn() { turn_expected_ = true; }
  bool expects_turn() const { return turn_expected_; }
  [[nodiscard]] bool turned_back() { return std::exchange(turned_back_, false); }
  void reverse();

  // Why the tracker cannot follow the spindle. Empty: no trouble.
  const std::optional<LinkError>& trouble() const { return trouble_; }

 private:
  enum class AwaitStep : std::uint8_t { measure, measured_alone, measured_loaded, ask, answered };

  void begin_following();
  void update(const Turned& turned);
  void find_index();
  Seconds time_to_index(Seconds answer);
  void check_start();
  void check_lag(Seconds ahead);
  bool check_encoder(Seconds longest);

  Stages stages_;
  SpindleEncoder encoder_;
  SpindleFollower follower_;
  bool encoder_known_ = false;  // the encoder is known to be right
  bool follows_ = false;
  bool asked_ = false;  // a reading was asked for, and the answer not yet taken
  // When the next thread is to begin, by the board's clock. late_: how much later than planned the thread before began.
  std::optional<Seconds> index_time_;
  Seconds late_{0};
  int looks_at_start_ = 0;
  std::optional<Seconds> outruns_since_;  // the spindle is faster than the axes can follow
  bool turn_expected_ = false;
  bool turned_back_ = false;
  std::optional<LinkError> trouble_;

  // State while the tracker waits for the index.
  AwaitStep step_ = AwaitStep::ask;
  double wanted_ = 0;  // seconds a turn
  SpindleReading turn_begun_;
  double turn_before_ = 0;  // seconds
  int turns_ = 0;
  bool at_speed_ = false;
  bool begins_ = false;
  Seconds alone_{0};  // how long an answer takes without a refill before it
  Seconds looks_at_{0};
};

}  // namespace passo
