// PollKeepAlive: the keep-alive timeout of a jog by a sender that polls the status. If nothing was received from the
// sender for its usual polling interval plus a quarter of a second, it hangs or is disconnected, and its key-up may
// never arrive.
#pragma once

#include <optional>

#include "passo/session/machine_status.hpp"

namespace passo {

class PollKeepAlive {
 public:
  // Note a byte, or a status query, received from the sender.
  void on_byte(Seconds now) { heard_at_ = now; }
  void on_question(Seconds now);
  // Resets the timeout for another sender.
  void end() { pace_.reset(); }
  // Returns true if the sender was polling, and has stopped. A sender that polls less than once a second does not count
  // as polling.
  bool is_over(Seconds now) const;

 private:
  Seconds heard_at_{0};
  Seconds asked_at_{0};
  std::optional<Seconds> pace_;
};

}  // namespace passo
