#include "passo/link/board_queries.hpp"

namespace passo {

std::uint8_t BoardQueries::put(Question question, ItemNumber behind, Seconds now) {
  behind_ = behind;
  last_ = question;
  if (std::exchange(answered_, false)) unanswered_since_ = now;
  return ++number_;
}

bool BoardQueries::settle(Question answered, Seconds now) {
  if (awaited_ != answered) return false;
  awaited_.reset();
  if (answered == Question::spindle && rehearsed_) answer_time_ = now - *std::exchange(rehearsed_, {});
  return true;
}

void BoardQueries::record_sent(Seconds now) {
  answered_ = false;
  unanswered_since_ = now;
}

bool BoardQueries::on_answered(Seconds now) {
  if (std::exchange(answered_, true)) return false;
  answer_time_ = now - unanswered_since_;
  return true;
}

void BoardQueries::forget() {
  usual_ = last_ = Question::status;
  held_back_ = false;
  awaited_.reset();
  rehearsed_.reset();
  turned_.reset();
  answered_ = true;
}

}  // namespace passo
