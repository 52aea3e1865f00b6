// RefillPace: how much motion a board is to have ahead, and when the next refill is due, by what the motion needs of
// the board and by how long the board's answers take.
//
// Motion in haste (a probe move, a thread) has little ahead: no more than while one refill is sent and answered and the
// next one has not arrived yet.
#pragma once

#include <limits>
#include <utility>

#include "passo/drive/feed.hpp"
#include "passo/drive/tail_options.hpp"

namespace passo {

// How far ahead a chip makes its events.
inline constexpr Seconds made_ahead{0.003};

class RefillPace {
 public:
  explicit RefillPace(const TailOptions& options);

  Attention attention() const { return attention_; }
  bool follows() const { return attention_ == Attention::follows; }
  bool in_haste() const { return attention_ == Attention::probes || attention_ == Attention::follows; }
  // `answer`: how long the last one took.
  void attend(Attention attention, Seconds answer);

  // Motion after a refill, without its tail; the next refill is due when so much is left; no planned move is longer.
  Seconds horizon() const;
  Seconds refill_at() const;
  Seconds longest_move() const { return longest_move_; }
  void record_refill();

  // A question was put behind a refill.
  void on_question() { asked_ = true; }
  // True: its answer is not judged yet.
  [[nodiscard]] bool take_question() { return std::exchange(asked_, false); }
  // False: the answer took too long, and tells of a time too long ago. Slower answers are expected from now on.
  [[nodiscard]] bool judge(Seconds answer);

 private:
  void settle();

  Seconds horizon_;
  Seconds refill_at_;
  Seconds longest_;
  Attention attention_ = Attention::none;
  Seconds answer_{0};  // how long the answer takes to a question sent with a refill
  Seconds slowest_answer_{0};
  bool asked_ = false;
  Seconds longest_move_{0};
  Seconds reach_{std::numeric_limits<double>::infinity()};  // a shorter horizon, for a while
};

}  // namespace passo
