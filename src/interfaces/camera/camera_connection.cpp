#include "camera_connection.hpp"

#include <cerrno>
#include <chrono>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace passo {
namespace {

constexpr int moment = 20;  // ms
constexpr std::size_t most_bytes = 65'536;

// Waits until the connection is there. Returns false if it failed or took too long.
bool is_connected(int socket, std::chrono::steady_clock::time_point until, const std::function<bool()>& gives_up) {
  pollfd one{.fd = socket, .events = POLLOUT, .revents = 0};
  while (poll(&one, 1, moment) <= 0) {
    if (gives_up() || std::chrono::steady_clock::now() > until) return false;
  }
  int error = 0;
  socklen_t size = sizeof error;
  return getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
}

std::string request_for(const HttpUrl& url) {
  return "GET " + url.target + " HTTP/1.1\r\nHost: " + url.host_and_port() +
         "\r\nUser-Agent: passo\r\nAccept: multipart/x-mixed-replace, image/jpeg\r\nConnection: close\r\n\r\n";
}

}  // namespace

std::optional<CameraConnection> CameraConnection::open(const HttpUrl& url, Seconds within,
                                                       const std::function<bool()>& gives_up) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (getaddrinfo(url.host.c_str(), std::to_string(url.port).c_str(), &hints, &found) != 0) return {};
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(found, freeaddrinfo);
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(within.value());
  const auto last = std::chrono::time_point_cast<std::chrono::steady_clock::duration>(until);
  for (const addrinfo* one = found; one != nullptr && !gives_up(); one = one->ai_next) {
    const int type = one->ai_socktype | SOCK_CLOEXEC | SOCK_NONBLOCK;
    CameraConnection connection(socket(one->ai_family, type, one->ai_protocol));
    if (connection.socket_ < 0) continue;
    const bool is_begun = connect(connection.socket_, one->ai_addr, one->ai_addrlen) == 0 || errno == EINPROGRESS;
    if (!is_begun || !is_connected(connection.socket_, last, gives_up)) continue;
    // A new connection has room for so few bytes.
    const std::string request = request_for(url);
    const ssize_t sent = send(connection.socket_, request.data(), request.size(), MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(request.size())) return connection;
  }
  return {};
}

CameraConnection::CameraConnection(CameraConnection&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

CameraConnection::~CameraConnection() {
  if (socket_ >= 0) close(socket_);
}

CameraConnection::Read CameraConnection::read(std::string& bytes) const {
  bytes.clear();
  pollfd one{.fd = socket_, .events = POLLIN, .revents = 0};
  if (poll(&one, 1, moment) <= 0) return Read::nothing;
  bytes.resize(most_bytes);
  const ssize_t got = recv(socket_, bytes.data(), bytes.size(), 0);
  bytes.resize(static_cast<std::size_t>(got > 0 ? got : 0));
  if (got > 0) return Read::bytes;
  return got < 0 && (errno == EAGAIN || errno == EINTR) ? Read::nothing : Read::closed;
}

}  // namespace passo
