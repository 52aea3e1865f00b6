// PendingResponse: the state of the only line that may be waiting for its response: whether there is one, and which
// event completes it: the probe, homing, a setting that the board has read back, or standstill.
#pragma once

#include <functional>
#include <utility>
#include <variant>

#include "passo/session/machine_session.hpp"

namespace passo {

class PendingResponse {
 public:
  bool is_due() const { return !std::holds_alternative<std::monostate>(waits_for_); }
  // Cancels the pending response. Returns true if there was one.
  bool call_off() { return !std::holds_alternative<std::monostate>(std::exchange(waits_for_, std::monostate())); }

  void wait_for_probe() { waits_for_ = Probe(); }
  bool waits_for_probe() const { return std::holds_alternative<Probe>(waits_for_); }

  void wait_for_homing(Ticket ticket) { waits_for_ = ticket; }
  bool waits_for_homing() const { return std::holds_alternative<Ticket>(waits_for_); }
  // Returns true if the response was waiting for the homing of this ticket, which has ended.
  [[nodiscard]] bool take_homing(Ticket ended) {
    const auto* const ticket = std::get_if<Ticket>(&waits_for_);
    return ticket != nullptr && *ticket == ended && call_off();
  }

  void wait_for_setting() { waits_for_ = Setting(); }
  bool waits_for_setting() const { return std::holds_alternative<Setting>(waits_for_); }

  // `then` is called when the machine has stopped.
  void wait_for_rest(std::function<void()> then) { waits_for_ = std::move(then); }
  // Returns the function to call now that the machine has stopped. Empty if the response does not wait for that.
  [[nodiscard]] std::function<void()> take_rest() {
    auto* const then = std::get_if<std::function<void()>>(&waits_for_);
    if (then == nullptr) return {};
    std::function<void()> next = std::move(*then);
    call_off();
    return next;
  }

 private:
  struct Probe {};
  struct Setting {};
  std::variant<std::monostate, Probe, Setting, Ticket, std::function<void()>> waits_for_;
};

}  // namespace passo
