// HandwheelQuery: the host's query about the handwheel at the board's pins. At most one is open at a time.
//
// It is apart from BoardQueries, whose newest query tells which frames have arrived: a handwheel is read also while the
// host waits for another answer. So its numbers are the opposite of those of the other queries.
//
// A board without a handwheel, or with firmware that does not know the question, answers with a status.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "passo/units/units.hpp"
#include "passo/wire/handwheel_count.hpp"

namespace passo {

class HandwheelQuery {
 public:
  // An answer that takes longer was lost.
  static constexpr Seconds answer_within{0.05};

  bool is_open(Seconds now) const { return asked_at_ && now - *asked_at_ < answer_within; }
  // Registers a query that is sent now. `newest`: the number of the newest other query. Returns its number.
  std::uint8_t put(std::uint8_t newest, Seconds now) {
    asked_at_ = now;
    return number_ = static_cast<std::uint8_t>(newest + opposite);
  }
  // Registers an answer. Returns false if it answers another query.
  bool record(const Turned& turned) {
    if (!take_answer(turned.answers)) return false;
    reading_ = handwheel_in(turned);
    statuses_ = 0;
    return true;
  }
  void record_status(std::uint8_t answers) {
    if (take_answer(answers)) ++statuses_;
  }

  // The newest reading since the last call.
  std::optional<HandwheelCount> take_reading() { return std::exchange(reading_, std::nullopt); }
  // The board has none: it has answered twice with a status.
  bool is_missing() const { return statuses_ >= sure_of_none; }

  // The board was reset, or is another one.
  void forget() { *this = {}; }

 private:
  static constexpr unsigned opposite = 128;
  static constexpr int sure_of_none = 2;

  bool take_answer(std::uint8_t answers) {
    if (!asked_at_ || answers != number_) return false;
    asked_at_.reset();
    return true;
  }

  std::uint8_t number_ = 0;
  std::optional<Seconds> asked_at_;
  std::optional<HandwheelCount> reading_;
  int statuses_ = 0;
};

}  // namespace passo
