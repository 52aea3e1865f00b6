// TimeoutMonitor: measures for how long a board has sent or executed nothing, and decides when that is too long. It
// only handles times: the session reports the events, and asks for the verdict.
#pragma once

#include <limits>
#include <optional>

#include "passo/link/link.hpp"

namespace passo {

// Timeouts of a link on which bytes may be lost. The default is for a link that loses nothing.
struct LinkTimeouts {
  Seconds answer_within{std::numeric_limits<double>::infinity()};  // repeat a query after this time without an answer
  Seconds patience{3600};                                          // give up after this time without any message
};

class TimeoutMonitor {
 public:
  TimeoutMonitor(const LinkTimeouts& care, Seconds now) : care_(care), heard_(now), quiet_since_(now) {}

  bool may_lose() const { return care_.answer_within < Seconds(std::numeric_limits<double>::infinity()); }
  const LinkTimeouts& care() const { return care_; }

  // Starts measuring the silence.
  void begin(Seconds now) { progressed_ = heard_ = quiet_since_ = now; }
  // The board has sent a byte, or a complete frame. on_progress(): it has answered, accepted or executed something.
  void on_byte(Seconds now) { quiet_since_ = now; }
  void on_frame(Seconds now) { heard_ = now; }
  void on_progress(Seconds now) { progressed_ = now; }
  // A query was repeated. Its answer may take as long as the first one.
  void on_asked_again(Seconds now) { quiet_since_ = now; }
  // The board accepted something, or the host sent something.
  void on_traffic(Seconds now) { moved_on_ = now; }

  // The time until the next repeated query.
  Seconds until_question(Seconds now) const;
  // Returns true if the time since then is longer than an answer may take.
  bool is_overdue(Seconds since, Seconds now) const { return now - since > care_.answer_within; }
  Seconds traffic() const { return moved_on_; }
  Seconds silence(Seconds now) const { return now - heard_; }

  // Call it while something is expected from the board. `in_vain`: an infinite wait ended without a message.
  std::optional<LinkError> verdict(Seconds now, bool in_vain) const;
  // Returns true if it is time to repeat the query. `heard`: something arrived; `endless`: the wait was infinite.
  bool is_to_ask_again(Seconds now, bool heard, bool endless) const;

 private:
  LinkTimeouts care_;
  Seconds heard_;          // when the board last sent a frame
  Seconds quiet_since_;    // when the board last sent a byte, or was queried again
  Seconds progressed_{0};  // when the board last answered, accepted or executed something
  Seconds moved_on_{0};    // when the board last accepted something, or the host last sent something
};

}  // namespace passo
