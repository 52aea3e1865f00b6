// SenderStream: the session's stream of the sender's lines, from the request for it to its end. When its lines are done
// and the machine has been idle for a while, the stream is asked once to end; a sender that is still connected may
// continue with the same stream.
#pragma once

#include <optional>

#include "passo/session/machine_session.hpp"

namespace passo {

class SenderStream {
 public:
  static constexpr Seconds longest_rest{1};

  // Begins the stream that was requested. Empty: the request was refused.
  void begin(std::optional<Ticket> ticket) {
    if (ticket) ticket_ = ticket;
    is_asked_to_end_ = false;
  }
  // Notes that this request is complete: if it is the stream's, the stream has ended.
  void on_answer(Ticket ticket) {
    if (ticket_ == ticket) ticket_.reset();
  }
  // Notes that the stream waits for a line since this time.
  void record_rest(Seconds time) { rests_since_ = time; }
  // Returns whether a waiting stream has waited long enough to be ended.
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
