// SpindleTracker: synchronises motion with the spindle, using the board's encoder. The tracker waits for the index,
// sets the feed ratio, detects the reversal of the spindle during tapping, and gives up if it cannot follow the
// spindle.
//
// The tracker mediates between the feed, which knows how far ahead motion is committed, and the planner, whose speed it
// sets.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "passo/drive/feed.hpp"
#include "passo/drive/spindle_encoder.hpp"
#include "passo/drive/spindle_follower.hpp"
#include "passo/drive/spindle_run_up.hpp"
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
  // All stages must outlive the tracker. `counts_per_turn` 0: there is no encoder, and nothing follows the spindle.
  SpindleTracker(const Stages& stages, const MotionLimits& limits, int counts_per_turn, Hertz clock);
  bool exists() const { return encoder_.exists(); }

  void watch(const PlannedMove& move) { follower_.watch(move); }
  // How the last planned motion follows the spindle.
  SpindleLock lock() const { return follower_.lock(); }
  // Returns true if motion follows the spindle, or is about to.
  bool follows() const { return follows_; }

  // Call between two steps of the drive. Returns false if the board has to answer first.
  [[nodiscard]] bool follow();
  // Stops following if the last planned motion does not follow the spindle and no thread is about to begin. Returns
  // true if motion followed the spindle until now.
  [[nodiscard]] bool let_go();

  // Starts to wait, at standstill, until the spindle reaches this speed and its index passes.
  void begin_await(double revolutions_per_minute);
  // Returns true if the motion must start now, or the tracker has given up. Otherwise call again when the board has
  // answered, or at next_poll().
  [[nodiscard]] bool await_index();
  Seconds next_poll() const { return looks_at_; }

  // Tapping down, with the spindle commanded to reverse. turned_back() reports once that the spindle has reversed.
  void expect_turn() { turn_expected_ = true; }
  bool expects_turn() const { return turn_expected_; }
  [[nodiscard]] bool turned_back() { return std::exchange(turned_back_, false); }
  void reverse();

  // Why the tracker cannot follow the spindle. Empty: it can.
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
  bool encoder_known_ = false;  // the encoder is known to count correctly
  bool follows_ = false;
  bool asked_ = false;  // a reading was queried, and the answer is not processed yet
  // The start time of the next thread, by the board's clock. late_: the delay of the previous thread's start.
  std::optional<Seconds> index_time_;
  Seconds late_{0};
  int looks_at_start_ = 0;
  std::optional<Seconds> outruns_since_;  // since when the spindle is too fast for the axes
  bool turn_expected_ = false;
  bool turned_back_ = false;
  std::optional<LinkError> trouble_;

  // State while the tracker waits for the index.
  AwaitStep step_ = AwaitStep::ask;
  SpindleRunUp run_up_;
  bool begins_ = false;
  Seconds alone_{0};  // response time without a preceding queue update
  Seconds looks_at_{0};
};

}  // namespace passo
