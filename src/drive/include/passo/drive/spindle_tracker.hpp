// SpindleTracker: keeps motion in step with the spindle, by what the board's encoder tells: waits for the index, sets
// the ratio of the feed, finds out when a tap turns round, and gives up where nothing can be followed.
//
// Between the feed, which knows how far ahead motion is committed, and the planner, which is told how fast to go.
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
  // All stages outlive the tracker. `counts_per_turn`: 0, there is no encoder, and nothing follows.
  SpindleTracker(const Stages& stages, const MotionLimits& limits, int counts_per_turn, Hertz clock);
  bool exists() const { return encoder_.exists(); }

  void watch(const PlannedMove& move) { follower_.watch(move); }
  // What was planned last follows the spindle.
  SpindleLock lock() const { return follower_.lock(); }
  // Motion follows, or is about to.
  bool follows() const { return follows_; }

  // Between two steps of the drive. False: an answer of the board has to be waited for first.
  [[nodiscard]] bool follow();
  // Nothing follows any more, from here on; whether something did.
  [[nodiscard]] bool let_go();

  // At rest: the spindle gets up to speed, so many revolutions a minute, and its index comes by.
  void begin_await(double revolutions_per_minute);
  // Whether the motion is to begin now, or tracking has given up. Else look again when the board has answered, or at
  // looks_at().
  [[nodiscard]] bool await_index();
  Seconds looks_at() const { return looks_at_; }

  // A tap is on its way down, and the spindle was told to turn round; turned_back() tells, once, that the spindle does.
  void expect_turn() { turn_expected_ = true; }
  bool expects_turn() const { return turn_expected_; }
  [[nodiscard]] bool turned_back() { return std::exchange(turned_back_, false); }
  void turn_round();

  // Why nothing can be followed.
  const std::optional<LinkError>& trouble() const { return trouble_; }

 private:
  enum class AwaitStep : std::uint8_t { measure, measured_alone, measured_loaded, ask, answered };

  void begin_following();
  void note(const Turned& turned);
  void look_for_index();
  Seconds time_to_index(Seconds answer);
  void mind_start();
  bool mind_encoder(Seconds longest);

  Stages stages_;
  SpindleEncoder encoder_;
  SpindleFollower follower_;
  bool encoder_known_ = false;  // to be right
  bool follows_ = false;
  bool asked_ = false;  // and the answer not yet taken
  // By the board's clock, when the next thread is to begin; and how much later than by that the one before did.
  std::optional<Seconds> index_time_;
  Seconds late_{0};
  int looks_at_start_ = 0;
  bool turn_expected_ = false;
  bool turned_back_ = false;
  std::optional<LinkError> trouble_;

  // While the index is awaited.
  AwaitStep step_ = AwaitStep::ask;
  double wanted_ = 0;  // seconds a turn
  SpindleReading turn_begun_;
  double turn_before_ = 0;  // seconds
  int turns_ = 0;
  bool at_speed_ = false;
  bool begins_ = false;
  Seconds alone_{0};  // the answer's time without a refill before it
  Seconds looks_at_{0};
};

}  // namespace passo
