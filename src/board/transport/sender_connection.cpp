#include "passo/transport/sender_connection.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>

#include "passo/transport/serial_line.hpp"

namespace passo {
namespace {

constexpr std::size_t most_read_at_once = 4096;
// So long a port waits that had no room for a caller: too many files are open, or memory is short.
constexpr std::chrono::milliseconds before_next_accept(50);
constexpr std::string_view busy_words = "[MSG:Another sender is connected]\r\n";

void set_flags(int descriptor) {
  fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) | O_NONBLOCK);
  fcntl(descriptor, F_SETFD, FD_CLOEXEC);
}

// Without echo, and without changes to any byte. Whoever closes the terminal sets it back to what it was.
void make_raw(int terminal) {
  termios mode{};
  tcgetattr(terminal, &mode);
  cfmakeraw(&mode);
  tcsetattr(terminal, TCSANOW, &mode);
}

// The first address of that name at which this computer can listen. A negative number: errno or `reason` tells why.
int bound(const std::string& host, unsigned port, std::string& reason) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found); error != 0) {
    reason = gai_strerror(error);
    return -1;
  }
  int listening = -1;
  for (const addrinfo* one = found; one != nullptr && listening < 0; one = one->ai_next) {
    listening = socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK, one->ai_protocol);
    if (listening < 0) continue;
    const int on = 1;
    setsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (bind(listening, one->ai_addr, one->ai_addrlen) == 0 && ::listen(listening, 4) == 0) break;
    reason = errno == EADDRINUSE ? "in use by another program" : std::strerror(errno);
    close(listening);
    listening = -1;
  }
  freeaddrinfo(found);
  return listening;
}

unsigned port_of(int listening) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  getsockname(listening, reinterpret_cast<sockaddr*>(&address), &size);
  if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port);
  return ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

}  // namespace

Result<std::unique_ptr<SenderConnection>, std::string> SenderConnection::listen(const std::string& host,
                                                                                unsigned port) {
  std::string reason;
  const int listening = bound(host, port, reason);
  if (listening < 0) return Failure{host + ":" + std::to_string(port) + ": " + reason};
  std::unique_ptr<SenderConnection> line(new SenderConnection);
  line->listening_ = listening;
  line->port_ = port_of(listening);
  const bool has_colon = host.find(':') != std::string::npos;
  line->name_ = "tcp:" + (has_colon ? "[" + host + "]" : host) + ":" + std::to_string(line->port_);
  return line;
}

Result<std::unique_ptr<SenderConnection>, std::string> SenderConnection::open_terminal(const std::string& link) {
  const int ours = posix_openpt(O_RDWR | O_NOCTTY);
  if (ours < 0 || grantpt(ours) != 0 || unlockpt(ours) != 0) return Failure{std::string(std::strerror(errno))};
  set_flags(ours);
  const std::string theirs = ptsname(ours);
  // A pseudo-terminal reports that nobody has it open only after somebody had.
  if (const int once = ::open(theirs.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC); once >= 0) close(once);
  // A link that an earlier program has left is replaced; a file never is.
  std::array<char, 16> target{};
  if (readlink(link.c_str(), target.data(), target.size() - 1) > 0 &&
      std::string_view(target.data()).starts_with("/dev/pts/")) {
    unlink(link.c_str());
  }
  if (symlink(theirs.c_str(), link.c_str()) != 0) {
    const std::string reason = std::strerror(errno);
    close(ours);
    return Failure{link + ": " + reason};
  }
  std::unique_ptr<SenderConnection> line(new SenderConnection);
  line->kind_ = Kind::terminal;
  line->sender_ = ours;
  line->name_ = line->link_ = link;
  return line;
}

Result<std::unique_ptr<SenderConnection>, std::string> SenderConnection::open_serial(const std::string& device,
                                                                                     unsigned baud) {
  const auto opened = open_serial_line(device, baud);
  if (!opened) return Failure{opened.error()};
  std::unique_ptr<SenderConnection> line(new SenderConnection);
  line->kind_ = Kind::serial;
  line->check_ = ClientFilter(ClientFilter::Noise::possible);
  line->sender_ = *opened;
  line->name_ = device;
  line->baud_ = baud;
  return line;
}

SenderConnection::~SenderConnection() {
  if (!link_.empty()) unlink(link_.c_str());
  if (sender_ >= 0) close(sender_);
  if (listening_ >= 0) close(listening_);
}

// A pseudo-terminal that nobody has open reports a hang-up.
bool SenderConnection::has_reader() const {
  pollfd one{.fd = sender_, .events = POLLIN, .revents = 0};
  static_cast<void>(::poll(&one, 1, 0));
  return (one.revents & POLLHUP) == 0;
}

void SenderConnection::add_to(std::vector<pollfd>& all, bool reads) const {
  // A caller who cannot be let in yet would let nobody sleep.
  if (listening_ >= 0 && Clock::now() >= accepts_at_) all.push_back({.fd = listening_, .events = POLLIN, .revents = 0});
  // A terminal without a reader is always ready, and would not let anybody sleep.
  if (sender_ < 0 || (kind_ == Kind::terminal && !connected_)) return;
  short events = reads ? POLLIN : short{0};
  if (!unsent_.empty()) events = static_cast<short>(events | POLLOUT);
  if (events != 0) all.push_back({.fd = sender_, .events = events, .revents = 0});
}

SenderConnection::News SenderConnection::poll(bool reads) {
  News news;
  if (kind_ == Kind::serial) {
    hear_serial(news, reads);
  } else if (kind_ == Kind::terminal) {
    const bool is_open = has_reader();
    news.came = is_open && !connected_;
    if (news.came) make_raw(sender_);
    broken_ = broken_ || (!is_open && connected_);
    connected_ = connected_ || is_open;
  } else {
    accept_client(news);
  }
  if (connected_ && !broken_) send_unsent();
  if (connected_ && !broken_ && reads && kind_ != Kind::serial) read_bytes(news);
  if (broken_) {
    news.went = true;
    close_sender();
  }
  return news;
}

// What is said first makes a sender.
void SenderConnection::hear_serial(News& news, bool reads) {
  constexpr std::chrono::seconds between_attempts{1};
  if (sender_ < 0) {
    if (Clock::now() - tried_ < between_attempts) return;
    tried_ = Clock::now();
    const auto again = open_serial_line(name_, baud_);
    sender_ = again ? *again : -1;
    return;
  }
  // A device that was unplugged reports a hang-up, and reads as one where nobody speaks.
  broken_ = !has_reader();
  if (broken_ || !reads) return;
  // A program that puts the port into a network connects one caller after the other, and says nothing of it.
  if (Clock::now() - heard_ > serial_pause) check_.begin_anew();
  read_bytes(news);
  if (news.bytes.empty()) return;
  news.came = !connected_;
  connected_ = true;
}

void SenderConnection::accept_client(News& news) {
  if (Clock::now() < accepts_at_) return;
  const int descriptor = accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
  if (descriptor < 0) {
    if (errno != EAGAIN && errno != EINTR) accepts_at_ = Clock::now() + before_next_accept;
    return;
  }
  if (connected_) {
    static_cast<void>(::send(descriptor, busy_words.data(), busy_words.size(), MSG_NOSIGNAL));
    close(descriptor);
    return;
  }
  const int on = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  sender_ = descriptor;
  connected_ = news.came = true;
}

void SenderConnection::read_bytes(News& news) {
  std::array<char, most_read_at_once> bytes;
  const ssize_t got = read(sender_, bytes.data(), bytes.size());
  if (got > 0) {
    heard_ = Clock::now();
    news.bytes = check_.pass({bytes.data(), static_cast<std::size_t>(got)});
    // Nobody can be sent away from a terminal or a serial port. There, what a stranger says is dropped.
    if (check_.caller() == ClientFilter::Caller::stranger && kind_ == Kind::network) broken_ = true;
  } else if ((got == 0 && kind_ != Kind::serial) || (got < 0 && errno != EAGAIN && errno != EINTR)) {
    broken_ = true;
  }
}

void SenderConnection::send(std::string_view text) {
  if (!connected_ || broken_) return;
  unsent_ += text;
  send_unsent();
  if (unsent_.size() > most_unsent) broken_ = true;
}

void SenderConnection::send_unsent() {
  while (!unsent_.empty()) {
    const ssize_t sent = kind_ == Kind::network ? ::send(sender_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL)
                                                : write(sender_, unsent_.data(), unsent_.size());
    if (sent < 0) {
      if (errno == EINTR) continue;
      broken_ = broken_ || errno != EAGAIN;
      return;
    }
    unsent_.erase(0, static_cast<std::size_t>(sent));
  }
}

// A pseudo-terminal stays for the next sender.
void SenderConnection::close_sender() {
  if (kind_ == Kind::terminal) {
    tcflush(sender_, TCIOFLUSH);
  } else {
    close(sender_);
    sender_ = -1;
  }
  unsent_.clear();
  check_.reset();
  connected_ = broken_ = false;
}

}  // namespace passo
