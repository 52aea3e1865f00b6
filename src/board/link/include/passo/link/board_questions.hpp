// BoardQuestions: the questions that a host has put to its board, and how long the answers take.
//
// A question has a number of its own, and its answer repeats that number. The host may await one question: it goes on
// when that one is answered.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "passo/link/link.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class BoardQuestions {
 public:
  // Counts a question that is put now, after frame `behind`. Returns its number.
  std::uint8_t put(Question question, ItemNumber behind, Seconds now);
  // The newest question, its number, and the frame that it was put after.
  Question last() const { return last_; }
  std::uint8_t number() const { return number_; }
  ItemNumber behind() const { return behind_; }

  // What a plain ask() asks.
  void ask_usually(Question question) { usual_ = question; }
  Question usual() const { return usual_; }
  // The usual question is to go behind all frames. `wait`: some of them are not on the wire yet.
  void hold_back(bool waits) { held_back_ = waits; }
  // True: the question was held back, and is to be put now.
  bool release() { return std::exchange(held_back_, false); }

  void await(Question question) { awaited_ = question; }
  const std::optional<Question>& awaited() const { return awaited_; }
  // The board has answered. True: this is what was awaited.
  bool settle(Question answered, Seconds now);
  // The answer's time is counted from now on: behind it, bytes go over the line that say nothing.
  void begin_rehearsal(Seconds now) { rehearsed_ = now; }

  // A frame was sent: answers from before it do not count.
  void record_sent(Seconds now);
  // The board has answered after all frames. False: that was known.
  bool on_answered(Seconds now);
  // What went before is over.
  void forget_sent() { answered_ = true; }
  bool answered() const { return answered_; }
  // How long the last such answer took.
  Seconds answer_time() const { return answer_time_; }

  // The newest answer about the spindle.
  void record_turned(const Turned& turned) { turned_ = turned; }
  std::optional<Turned> take_turned() { return std::exchange(turned_, std::nullopt); }

  // No question is open. Numbers and the answer's time stay.
  void forget();
  // Counts questions from this frame on.
  void begin(ItemNumber number) { behind_ = number; }

 private:
  std::uint8_t number_ = 0;
  Question last_ = Question::status;
  Question usual_ = Question::status;
  ItemNumber behind_ = 0;
  bool held_back_ = false;
  std::optional<Question> awaited_;
  std::optional<Seconds> rehearsed_;  // when the rehearsal began
  std::optional<Turned> turned_;
  bool answered_ = true;
  Seconds unanswered_since_{0};
  Seconds answer_time_{0};
};

}  // namespace passo
