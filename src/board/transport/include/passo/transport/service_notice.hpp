// ServiceNotice: notifies the service manager (systemd) that a daemon is ready, is alive, or is stopping, as
// sd_notify(3) does: one datagram to the socket given by $NOTIFY_SOCKET. Without that variable nothing is sent.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace passo {

class ServiceNotice {
 public:
  // Reads $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID, and removes them, so that child processes cannot send
  // notices in its name.
  ServiceNotice();
  ~ServiceNotice();
  ServiceNotice(const ServiceNotice&) = delete;
  ServiceNotice& operator=(const ServiceNotice&) = delete;

  // `words`: the status text shown by `systemctl status`.
  void ready(std::string_view words) const;
  void stopping() const { tell("STOPPING=1"); }
  // Call in each pass of the daemon's loop. A watchdog restarts the daemon if it gets no notice within its time;
  // notices are sent after half of that time.
  void alive();

 private:
  void tell(const std::string& text) const;

  int socket_ = -1;
  std::string address_;
  std::chrono::microseconds watchdog_{0};  // 0: there is no watchdog
  std::chrono::steady_clock::time_point told_;
};

}  // namespace passo
