// LineStream: the session's stream of the sender's lines, from the request for it to its end. A stream whose lines are
// done is asked to end once, after a rest: a sender that is still there may go on with the same stream.
#pragma once

#include <optional>

#include "passo/session/machine_session.hpp"

namespace passo {

class LineStream {
 public:
  static constexpr Seconds longest_rest{1};

  // It was asked for. Empty: it was refused.
  void begin(std::optional<Ticket> ticket) {
    if (ticket) ticket_ = ticket;
    is_asked_to_end_ = false;
  }
  // This request is answered: if it was that for the stream, the stream has ended.
  void on_answer(Ticket ticket) {
    if (ticket_ == ticket) ticket_.reset();
  }
  // The stream waits for a line from this time on.
  void record_rest(Seconds time) { rests_since_ = time; }
  // For a stream that waits for a line: whether it has waited long enough.
  bool may_end(Seconds now, bool sender_is_here) const {
    if (!ticket_ || is_asked_to_end_) return false;
    return !sender_is_here || now - rests_since_ >= longest_rest;
  }
  void note_asked_to_end() { is_asked_to_end_ = true; }

 private:
  std::optional<Ticket> ticket_;
  bool is_asked_to_end_ = false;
  Seconds rests_since_{0};
};

}  // namespace passo
