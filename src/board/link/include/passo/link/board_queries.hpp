// BoardQueries: the host's open queries to its board, and the response time.
//
// A query has a number, which its answer repeats. The host can wait for one query: it continues after that answer.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "passo/link/link.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class BoardQueries {
 public:
  // Registers a query that is sent now, after frame `behind`. Returns its number.
  std::uint8_t put(Question question, ItemNumber behind, Seconds now);
  // The newest query, its number, and the frame that it follows.
  Question last() const { return last_; }
  std::uint8_t number() const { return number_; }
  ItemNumber behind() const { return behind_; }

  // Sets the query that ask() sends.
  void ask_usually(Question question) { usual_ = question; }
  Question usual() const { return usual_; }
  // Delays the usual query until all frames are sent. `waits`: some of them are not sent yet.
  void hold_back(bool waits) { held_back_ = waits; }
  // Returns true if a delayed query is to be sent now.
  bool release() { return std::exchange(held_back_, false); }

  void await(Question question) { awaited_ = question; }
  const std::optional<Question>& awaited() const { return awaited_; }
  // Registers an answer. Returns true if the host was waiting for this one.
  bool settle(Question answered, Seconds now);
  // Starts the measurement of a response time with filler bytes.
  void begin_rehearsal(Seconds now) { rehearsed_ = now; }

  // Registers a sent frame: earlier answers are out of date.
  void record_sent(Seconds now);
  // Registers that the board has answered after all frames. Returns false if this was already known.
  bool on_answered(Seconds now);
  // Forgets the sent frames.
  void forget_sent() { answered_ = true; }
  bool answered() const { return answered_; }
  // The response time of the last such answer.
  Seconds answer_time() const { return answer_time_; }

  // The newest answer about the spindle.
  void record_turned(const Turned& turned) { turned_ = turned; }
  std::optional<Turned> take_turned() { return std::exchange(turned_, std::nullopt); }

  // Drops all open queries. Numbers and the response time are kept.
  void forget();
  // Starts with this frame number.
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
