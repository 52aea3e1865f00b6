// SilenceWatch: for how long a board has said or done nothing, and when that is too long. It knows times and no frames:
// the session tells it what happens, and asks for its verdict.
#pragma once

#include <limits>
#include <optional>

#include "passo/link/link.hpp"

namespace passo {

// How to handle a line on which bytes may get lost. The default is for a line that loses nothing.
struct LineCare {
  Seconds answer_within{std::numeric_limits<double>::infinity()};  // after so long without an answer, ask again
  Seconds patience{3600};                                          // after so long without any word, give up
};

class SilenceWatch {
 public:
  SilenceWatch(const LineCare& care, Seconds now) : care_(care), heard_(now), quiet_since_(now) {}

  bool may_lose() const { return care_.answer_within < Seconds(std::numeric_limits<double>::infinity()); }
  const LineCare& care() const { return care_; }

  // Silence counts from now on.
  void begin(Seconds now) { progressed_ = heard_ = quiet_since_ = now; }
  // A byte came; a whole frame came; the board answered, took or executed something.
  void on_byte(Seconds now) { quiet_since_ = now; }
  void on_frame(Seconds now) { heard_ = now; }
  void on_progress(Seconds now) { progressed_ = now; }
  // The board was asked again. The next answer may take as long as the one before.
  void on_asked_again(Seconds now) { quiet_since_ = now; }
  // The board took something, or the host asked or sent.
  void on_traffic(Seconds now) { moved_on_ = now; }

  // How long to wait until the board is to be asked again.
  Seconds until_question(Seconds now) const;
  // True: since that time the board has had longer than an answer may take.
  bool is_overdue(Seconds since, Seconds now) const { return now - since > care_.answer_within; }
  Seconds traffic() const { return moved_on_; }
  Seconds silence(Seconds now) const { return now - heard_; }

  // Something is expected of the board. `in_vain`: an endless wait has brought nothing.
  std::optional<LinkError> verdict(Seconds now, bool in_vain) const;
  // True: it is time to ask again. `heard`: something came; `endless`: the wait for it was.
  bool is_to_ask_again(Seconds now, bool heard, bool endless) const;

 private:
  LineCare care_;
  Seconds heard_;          // when the board last said anything
  Seconds quiet_since_;    // when the board did, or was asked again
  Seconds progressed_{0};  // when the board last answered, took or executed something
  Seconds moved_on_{0};    // when the board last took something, or the host asked or sent
};

}  // namespace passo
