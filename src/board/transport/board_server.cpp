#include "passo/transport/board_server.hpp"

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace passo {
namespace {

constexpr std::size_t most_at_once = 4096;

// True: only a host says this. A program that only looks asks for the motors of every board (link/board_session.hpp).
bool is_of_a_host(const WireFrame& frame) {
  return frame.type != MessageType::ask || frame.payload[1] != max_motors;
}

}  // namespace

Result<std::unique_ptr<BoardServer>, std::string> BoardServer::listen(unsigned port) {
  const int listening = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int on = 1;
  setsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  auto* const plain = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  if (bind(listening, plain, size) != 0 || ::listen(listening, SOMAXCONN) != 0 ||
      getsockname(listening, plain, &size) != 0) {
    const bool is_used = errno == EADDRINUSE;
    const std::string reason = is_used ? "in use by another program" : std::strerror(errno);
    close(listening);
    return Failure{"127.0.0.1:" + std::to_string(port) + ": " + reason};
  }
  return std::unique_ptr<BoardServer>(new BoardServer(listening, ntohs(address.sin_port)));
}

BoardServer::~BoardServer() {
  for (const auto& client : clients_) close(client->descriptor);
  close(listening_);
}

void BoardServer::wait(Seconds most) const {
  std::vector<pollfd> all;
  // A caller who cannot be let in yet would let nobody sleep.
  if (Clock::now() >= accepts_at_) all.push_back({.fd = listening_, .events = POLLIN, .revents = 0});
  for (const auto& client : clients_) all.push_back({.fd = client->descriptor, .events = POLLIN, .revents = 0});
  static_cast<void>(poll(all.data(), all.size(), static_cast<int>(std::ceil(most.value() * 1e3))));
}

void BoardServer::attend(BoardPort& board) {
  accept_clients();
  for (const auto& client : clients_) {
    if (!client->gone) hear(*client, board);
  }
  part_with_the_gone();
}

void BoardServer::accept_clients() {
  constexpr std::chrono::milliseconds before_next(50);
  while (Clock::now() >= accepts_at_) {
    const int descriptor = accept4(listening_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (descriptor < 0) {
      // For instance too many open files: that may pass.
      if (errno != EAGAIN && errno != EINTR) accepts_at_ = Clock::now() + before_next;
      return;
    }
    if (clients_.size() == most_clients) {
      close(descriptor);
      continue;
    }
    // Answers are small. Without this the second of two would wait until the first is acknowledged, 40 ms later.
    const int on = 1;
    setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    auto client = std::make_unique<Client>();
    client->descriptor = descriptor;
    client->motors = motors_;
    client->decoder.set_motors(motors_);
    clients_.push_back(std::move(client));
    anybody_came_ = true;
  }
}

void BoardServer::hear(Client& client, BoardPort& board) {
  std::array<std::uint8_t, most_at_once> bytes;
  const ssize_t got = read(client.descriptor, bytes.data(), bytes.size());
  if (got <= 0) {
    client.gone = got == 0 || (errno != EAGAIN && errno != EINTR);
    return;
  }
  client.heard = Clock::now();
  // TCP loses nothing, so whatever begins otherwise is no host. A browser lets a web page send any bytes to a port of
  // this computer, behind a head of HTTP; frames among them would move the machine.
  if (!std::exchange(client.has_spoken, true) && bytes[0] != sync_byte) {
    client.gone = true;
    return;
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(got) && !client.gone; ++i) {
    client.last_bytes.push_back(bytes[i]);
    if (client.decoder.feed(bytes[i]) == Decoded::frame) handle(client, client.decoder.frame(), board);
  }
  const std::size_t kept = client.last_bytes.size();
  if (kept > largest_frame) {
    client.last_bytes.erase(client.last_bytes.begin(), client.last_bytes.end() - std::ptrdiff_t{largest_frame});
  }
}

// Gives the board the frame as it came: the last bytes are the frame.
void BoardServer::handle(Client& client, const WireFrame& frame, BoardPort& board) {
  const std::size_t size =
      std::size_t{frame_overhead} + payload_size(static_cast<std::uint8_t>(frame.type), client.motors);
  if (is_of_a_host(frame)) {
    if (!may_drive(client)) {
      client.gone = true;
      return;
    }
    host_ = &client;
    if (frame.type == MessageType::hello || frame.type == MessageType::ask) {
      client.motors = motors_ = frame.payload[1];
      client.decoder.set_motors(motors_);
    }
  }
  send_to_host(board.replies());
  board.receive(std::span(client.last_bytes).last(size));
  tell(client, board.replies());
}

// The host that was there before may have gone, and nobody has noticed yet.
bool BoardServer::may_drive(const Client& client) {
  if (host_ == nullptr || host_ == &client || host_->gone) return true;
  std::uint8_t byte = 0;
  host_->gone = recv(host_->descriptor, &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0 ||
                std::chrono::duration<double>(Clock::now() - host_->heard).count() > most_silence.value();
  return host_->gone;
}

void BoardServer::send_to_host(std::span<const std::uint8_t> bytes) {
  if (host_ != nullptr) tell(*host_, bytes);
}

void BoardServer::tell(Client& client, std::span<const std::uint8_t> bytes) {
  if (client.gone || bytes.empty()) return;
  const ssize_t sent = send(client.descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  client.gone = sent != static_cast<ssize_t>(bytes.size());
}

void BoardServer::part_with_the_gone() {
  std::erase_if(clients_, [this](const std::unique_ptr<Client>& client) {
    if (!client->gone) return false;
    if (client.get() == host_) host_ = nullptr;
    close(client->descriptor);
    return true;
  });
}

}  // namespace passo
