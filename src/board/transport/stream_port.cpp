#include "passo/transport/stream_port.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "passo/transport/serial_line.hpp"
#include "passo/transport/websocket_line.hpp"

namespace passo {
namespace {

constexpr std::size_t most_bytes_at_once = 4096;
// The longest wait for a line that accepts nothing, before it counts as broken.
constexpr Seconds longest_write{2};
constexpr Seconds between_attempts{0.2};
constexpr timeval longest_connect{.tv_sec = 5, .tv_usec = 0};

// As write(), but a connection that the other side has closed is an error and no signal: the program goes on.
ssize_t put(int descriptor, std::span<const std::uint8_t> bytes) {
  const ssize_t sent = send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  return sent < 0 && errno == ENOTSOCK ? write(descriptor, bytes.data(), bytes.size()) : sent;
}

Result<int, std::string> connect_tcp(const BoardAddress& address) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const std::string name = address.place + ":" + address.port;
  const int error = getaddrinfo(address.place.c_str(), address.port.c_str(), &hints, &found);
  if (error != 0) return Failure{name + ": " + gai_strerror(error)};
  int descriptor = -1;
  for (const addrinfo* one = found; one != nullptr && descriptor < 0; one = one->ai_next) {
    const int socket_ = socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, one->ai_protocol);
    if (socket_ < 0) continue;
    // Without a limit connect() waits two minutes for an address that does not answer.
    setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &longest_connect, sizeof longest_connect);
    if (connect(socket_, one->ai_addr, one->ai_addrlen) == 0) {
      descriptor = socket_;
    } else {
      const int kept = errno == EINPROGRESS ? ETIMEDOUT : errno;
      close(socket_);
      errno = kept;
    }
  }
  freeaddrinfo(found);
  if (descriptor < 0) return Failure{name + ": " + std::strerror(errno)};
  // Frames are small and must not wait for more data.
  const int on = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
  return descriptor;
}

}  // namespace

StreamPort::StreamPort(int descriptor, std::function<int()> open_again)
    : descriptor_(descriptor), open_again_(std::move(open_again)) {}

StreamPort::~StreamPort() {
  if (descriptor_ >= 0) close(descriptor_);
}

void StreamPort::open_again(Seconds most) {
  if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  poll(nullptr, 0, static_cast<int>(std::min(most, between_attempts).value() * 1e3));
  descriptor_ = open_again_();
  broken_ = descriptor_ < 0;
}

bool StreamPort::wait_for(short events, Seconds most) const {
  pollfd one{.fd = descriptor_, .events = events, .revents = 0};
  const double milliseconds = std::ceil(most.value() * 1e3);
  return poll(&one, 1, milliseconds < 1e9 ? static_cast<int>(milliseconds) : -1) > 0;
}

void StreamPort::receive(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty() && !broken_) {
    const ssize_t written = put(descriptor_, bytes);
    if (written > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN || errno == EINTR) {
      broken_ = !wait_for(POLLOUT, longest_write);
    } else {
      broken_ = true;
    }
  }
}

bool StreamPort::run(Seconds most) {
  if (broken_ && open_again_) open_again(most);
  if (broken_ || !wait_for(POLLIN, most)) return false;
  const std::size_t before = arrived_.size();
  arrived_.resize(before + most_bytes_at_once);
  const ssize_t got = read(descriptor_, arrived_.data() + before, most_bytes_at_once);
  arrived_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  // The line is readable but has no data: the other side has closed.
  if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR)) broken_ = hung_up_ = true;
  if (got > 0) hung_up_ = false;
  return got > 0;
}

std::span<const std::uint8_t> StreamPort::replies() {
  taken_ = std::exchange(arrived_, {});
  return taken_;
}

Seconds StreamPort::elapsed() const {
  return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
}

Result<std::unique_ptr<StreamPort>, std::string> open_board(const BoardAddress& address) {
  const auto open_it = [address]() -> Result<int, std::string> {
    if (address.kind == BoardAddress::Kind::serial) return open_serial_line(address.place, address.baud);
    Result<int, std::string> connected = connect_tcp(address);
    const bool is_plain = !connected || address.kind == BoardAddress::Kind::tcp;
    return is_plain ? connected : open_websocket(*connected, address.place + ":" + address.port);
  };
  const Result<int, std::string> opened = open_it();
  if (!opened) return Failure{opened.error()};
  return std::make_unique<StreamPort>(*opened, [open_it] {
    const Result<int, std::string> again = open_it();
    return again ? *again : -1;
  });
}

}  // namespace passo
