// PollLease: a sender that asks for the status again and again holds a lease on its jog. When nothing was heard of it
// for its own pace of asking and a quarter of a second more, it hangs or is out of reach, and its key-up may never
// come.
#pragma once

#include <optional>

#include "passo/session/machine_status.hpp"

namespace passo {

class PollLease {
 public:
  // The sender has sent something, or a question for the status.
  void on_byte(Seconds now) { heard_at_ = now; }
  void on_question(Seconds now);
  // Another sender.
  void end() { pace_.reset(); }
  // True: the sender was asking, and no longer does. A sender that asks more slowly than once a second does not ask.
  bool is_over(Seconds now) const;

 private:
  Seconds heard_at_{0};
  Seconds asked_at_{0};
  std::optional<Seconds> pace_;
};

}  // namespace passo
