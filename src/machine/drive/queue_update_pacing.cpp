#include "passo/drive/queue_update_pacing.hpp"

#include <algorithm>

namespace passo {
namespace {

// Waiting for answers between refills. `behind_a_refill`: an answer takes this many times longer when a refill goes
// before the question. `patience`: the rate at which slow answers are forgotten.
constexpr double behind_a_refill = 3;
constexpr double patience = 0.9;
constexpr double late_answer = 2;
constexpr double slower_answer = 1.5;
constexpr double moves_an_answer = 3;
constexpr Seconds shortest_answer{0.003};
// After motion that followed the spindle, refills become longer bit by bit. Little motion is ahead there, so a long
// refill would come too late.
constexpr double longer = 1.5;
constexpr Seconds longest_following{0.01};
constexpr double answers_ahead = 2.5;
constexpr Seconds spare{0.003};  // a tail may have many more items than the tail before
constexpr double patience_following = 0.95;

}  // namespace

QueueUpdatePacing::QueueUpdatePacing(const StopRampOptions& options)
    : horizon_(options.horizon), refill_at_(options.refill_at), longest_(options.longest_move) {
  settle();
}

void QueueUpdatePacing::attend(Attention attention, Seconds answer) {
  if (follows()) reach_ = horizon();
  attention_ = attention;
  if (in_haste()) {
    // Before a thread, the question was sent after as many bytes as a refill has.
    const double times = follows() ? 1 : behind_a_refill;
    answer_ = std::max(slowest_answer_, std::min(times * answer, refill_at_));
  }
  settle();
}

void QueueUpdatePacing::settle() {
  answer_ = std::max(answer_, shortest_answer);
  const Seconds longest = follows() ? longest_following : longest_;
  longest_move_ = in_haste() ? std::min(longest, answer_ / moves_an_answer) : longest_;
}

Seconds QueueUpdatePacing::horizon() const {
  if (follows()) return answers_ahead * answer_ + longest_move_ + made_ahead + spare;
  return in_haste() ? 2 * answer_ + longest_move_ + made_ahead : std::min(horizon_, reach_);
}

Seconds QueueUpdatePacing::refill_at() const {
  return in_haste() ? horizon() - longest_move_ : std::min(refill_at_, reach_ - longest_move_);
}

void QueueUpdatePacing::record_refill() {
  reach_ = reach_ * longer;
}

bool QueueUpdatePacing::judge(Seconds answer) {
  if (answer > late_answer * answer_) {
    answer_ = slower_answer * answer_;
    return false;
  }
  const double kept = follows() ? patience_following : patience;
  slowest_answer_ = std::max(answer, slowest_answer_ * kept);
  answer_ = std::max(answer, answer_ * kept);
  settle();
  return true;
}

}  // namespace passo
