// ServeDaemon: the main loop of `passo serve`. It receives from senders and web clients, polls the session, and
// responds. Only this thread accesses the machine. See docs/decisions/0090 and 0093.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "serve_web.hpp"
#include "served_pendant.hpp"
#include "served_status.hpp"

#include "passo/api/machine_control.hpp"
#include "passo/grbl/grbl_controller.hpp"
#include "passo/transport/sender_connection.hpp"
#include "passo/transport/service_notice.hpp"

namespace passo {

// Makes the time of a virtual machine follow the clock of this computer, or a clock that is so many times faster.
class WallClock {
 public:
  // A virtual machine with a larger delay, because the computer was busy or asleep, does not catch up.
  static constexpr Seconds most_late{0.2};

  explicit WallClock(double speed) : speed_(speed) {}

  // Returns how far the clock is ahead of `time`.
  Seconds ahead_of(Seconds time) {
    const auto now = std::chrono::steady_clock::now();
    const Seconds ahead = Seconds(std::chrono::duration<double>(now - start_).count() * speed_) - (time - from_);
    if (ahead <= most_late * speed_) return ahead;
    start_ = now;
    from_ = time;
    return Seconds(0);
  }

 private:
  double speed_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Seconds from_{0};
};

// The machine that is served.
struct ServedMachine {
  MachineSession& session;
  bool has_board = false;                    // not in this process: its time is that of this computer
  std::function<void()> keep_place = [] {};  // saves the position for the next command
  double speed = 1;                          // of the time of a virtual machine
};

class ServeDaemon {
 public:
  using Lines = std::vector<std::unique_ptr<SenderConnection>>;

  // All references must outlive the daemon. `web` may be null.
  ServeDaemon(ServedMachine machine, GrblController& grbl, MachineControl& owner, Lines lines, ServedWeb* web,
              ServiceNotice& service);

  // Publishes the status to a broker, too. `status` must outlive the daemon; null: not published.
  void tell(ServedStatus* status) { status_ = status; }
  // Acts for a pendant, too. `pendant` must outlive the daemon; null: there is none.
  void follow(ServedPendant* pendant) { pendant_ = pendant; }
  // Runs until a signal is received.
  void serve();
  // Brakes all motion, and waits until it has stopped.
  void stop();

 private:
  void wait();
  bool may_read(const SenderConnection& line) const;
  void attend(SenderConnection& line);
  void check_silent_driver(const SenderConnection& line);
  void check_owner();
  void poll();
  void hear_changes();
  void keep_place_if_changed();
  void reply();

  ServedMachine machine_;
  MachineSession& session_;
  GrblController& grbl_;
  MachineControl& owner_;
  Lines lines_;
  ServedWeb* web_;
  ServiceNotice& service_;
  ServedStatus* status_ = nullptr;
  ServedPendant* pendant_ = nullptr;
  SenderConnection* driver_ = nullptr;  // the interface with the active sender
  bool driver_spoke_ = false;           // and the sender has identified itself as one
  std::uint64_t kept_version_ = 0;      // version of the status with which the position was saved
  WallClock clock_;
};

}  // namespace passo
