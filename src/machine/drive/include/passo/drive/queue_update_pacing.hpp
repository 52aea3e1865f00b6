// QueueUpdatePacing: determines the length of motion in the board's queue, and the time of the next queue update, from
// the requirements of the motion and the board's response times.
//
// Urgent motion (a probe move, a thread) is sent with a short lead: only the time until a queue update is acknowledged
// and the next one arrives.
#pragma once

#include <limits>
#include <utility>

#include "passo/drive/feed.hpp"
#include "passo/drive/stop_ramp_options.hpp"

namespace passo {

// The time by which a chip makes its events ahead.
inline constexpr Seconds made_ahead{0.003};

class QueueUpdatePacing {
 public:
  explicit QueueUpdatePacing(const StopRampOptions& options);

  Attention attention() const { return attention_; }
  bool follows() const { return attention_ == Attention::follows; }
  bool in_haste() const { return attention_ == Attention::probes || attention_ == Attention::follows; }
  // Sets the requirements of the motion. `answer`: the last response time.
  void attend(Attention attention, Seconds answer);

  // The time of motion after a queue update, without its stop ramp; the remaining time at which the next update is due;
  // the longest planned move.
  Seconds horizon() const;
  Seconds refill_at() const;
  Seconds longest_move() const { return longest_move_; }
  void record_refill();

  // Call when a query was sent after a queue update.
  void on_question() { asked_ = true; }
  // Returns true once, if the answer to that query must still be judged.
  [[nodiscard]] bool take_question() { return std::exchange(asked_, false); }
  // Judges a response time. Returns false if the answer took too long, so that its contents are out of date. Longer
  // response times are expected from now on.
  [[nodiscard]] bool judge(Seconds answer);

 private:
  void settle();

  Seconds horizon_;
  Seconds refill_at_;
  Seconds longest_;
  Attention attention_ = Attention::none;
  Seconds answer_{0};  // response time of a query sent with a queue update
  Seconds slowest_answer_{0};
  bool asked_ = false;
  Seconds longest_move_{0};
  Seconds reach_{std::numeric_limits<double>::infinity()};  // a temporarily shorter horizon
};

}  // namespace passo
