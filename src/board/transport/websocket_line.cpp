#include "passo/transport/websocket_line.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <memory>
#include <thread>
#include <utility>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace passo {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using Error = beast::error_code;

constexpr auto longest_handshake = std::chrono::seconds(5);
constexpr std::size_t longest_message = 65'536;

class WebsocketPump {
 public:
  // Takes over the descriptor.
  explicit WebsocketPump(int connection) : socket_(context_) {
    Error error;
    socket_.next_layer().assign(tcp::v4(), connection, error);
  }

  // Returns the reason of a failure; empty: done.
  std::string shake_hands(const std::string& host) {
    std::string reason = "no answer to the handshake";
    socket_.read_message_max(longest_message);
    socket_.async_handshake(host, "/", [&reason](Error error) { reason = error ? error.message() : std::string(); });
    context_.run_for(longest_handshake);
    context_.restart();
    return reason;
  }

  // Moves bytes until one side closes. Takes over the descriptor.
  void run(int local) {
    Error error;
    local_.assign(asio::local::stream_protocol(), local, error);
    if (error) return;
    socket_.binary(true);
    read_local();
    read_network();
    context_.run();
  }

 private:
  void read_local() {
    local_.async_read_some(asio::buffer(sent_), [this](Error error, std::size_t count) {
      if (error) return close();
      socket_.async_write(asio::buffer(sent_.data(), count), [this](Error failed, std::size_t) {
        if (failed) return close();
        read_local();
      });
    });
  }
  void read_network() {
    socket_.async_read(came_, [this](Error error, std::size_t count) {
      if (error) return close();
      text_.assign(static_cast<const char*>(came_.data().data()), count);
      came_.consume(count);
      if (socket_.got_text() && !text_.ends_with('\n')) text_ += '\n';
      asio::async_write(local_, asio::buffer(text_), [this](Error failed, std::size_t) {
        if (failed) return close();
        read_network();
      });
    });
  }
  void close() {
    Error ignored;
    socket_.next_layer().close(ignored);
    local_.close(ignored);
  }

  asio::io_context context_{1};
  websocket::stream<tcp::socket> socket_;
  asio::local::stream_protocol::socket local_{context_};
  std::array<char, 4096> sent_{};
  beast::flat_buffer came_{longest_message};
  std::string text_;
};

}  // namespace

Result<int, std::string> open_websocket(int connection, const std::string& host) {
  const auto pump = std::make_shared<WebsocketPump>(connection);
  if (const std::string reason = pump->shake_hands(host); !reason.empty())
    return Failure{host + ": no WebSocket: " + reason};
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return Failure{host + ": " + std::strerror(errno)};
  }
  fcntl(ends[0], F_SETFL, fcntl(ends[0], F_GETFL) | O_NONBLOCK);
  // It ends when the owner closes its end of the pair.
  std::thread([pump, local = ends[1]] { pump->run(local); }).detach();
  return ends[0];
}

}  // namespace passo
