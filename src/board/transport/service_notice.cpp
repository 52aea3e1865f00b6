#include "passo/transport/service_notice.hpp"

#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <optional>

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace passo {
namespace {

std::string take_variable(const char* name) {
  const char* const text = std::getenv(name);
  std::string value = text == nullptr ? "" : text;
  unsetenv(name);
  return value;
}

std::optional<long long> number_in(const std::string& text) {
  long long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

ServiceNotice::ServiceNotice() : address_(take_variable("NOTIFY_SOCKET")) {
  const auto time = number_in(take_variable("WATCHDOG_USEC"));
  const auto process = number_in(take_variable("WATCHDOG_PID"));
  // A path, or a name without a file, which begins with '@'.
  const bool is_address = address_.starts_with('/') || address_.starts_with('@');
  if (!is_address || address_.size() < 2 || address_.size() >= sizeof(sockaddr_un::sun_path)) return;
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (time && *time > 0 && (!process || *process == getpid())) watchdog_ = std::chrono::microseconds(*time);
}

ServiceNotice::~ServiceNotice() {
  if (socket_ >= 0) close(socket_);
}

void ServiceNotice::ready(std::string_view words) const {
  tell("READY=1\nSTATUS=" + std::string(words));
}

void ServiceNotice::alive() {
  const auto now = std::chrono::steady_clock::now();
  if (watchdog_.count() == 0 || now - told_ < watchdog_ / 2) return;
  told_ = now;
  tell("WATCHDOG=1");
}

// A manager that does not listen is no reason to wait.
void ServiceNotice::tell(const std::string& text) const {
  if (socket_ < 0) return;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, address_.data(), address_.size());
  if (address.sun_path[0] == '@') address.sun_path[0] = '\0';
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + address_.size());
  static_cast<void>(
      sendto(socket_, text.data(), text.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address), size));
}

}  // namespace passo
