// A WebSocket as a line of bytes, against a server in this process that behaves like FluidNC's.
#include "passo/transport/websocket_line.hpp"

#include <string>
#include <thread>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <gtest/gtest.h>

#include "passo/transport/stream_port.hpp"

namespace passo {
namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;
using Error = boost::beast::error_code;

class FluidServer {
 public:
  // `answers`: false for a server that speaks no WebSocket.
  explicit FluidServer(bool answers = true) : acceptor_(context_, tcp::endpoint(asio::ip::address_v4::loopback(), 0)) {
    thread_ = std::thread([this, answers] { serve(answers); });
  }
  ~FluidServer() { thread_.join(); }
  FluidServer(const FluidServer&) = delete;
  FluidServer& operator=(const FluidServer&) = delete;

  BoardAddress address() const {
    const std::string port = std::to_string(acceptor_.local_endpoint().port());
    return *parse_board_address("grbl:ws://127.0.0.1:" + port);
  }

 private:
  void serve(bool answers) {
    boost::beast::websocket::stream<tcp::socket> socket(context_);
    Error error;
    acceptor_.accept(socket.next_layer(), error);
    if (!answers) {
      asio::write(socket.next_layer(), asio::buffer(std::string("HTTP/1.1 404 Not Found\r\n\r\n")), error);
      return;
    }
    socket.accept(error);
    socket.text(true);
    socket.write(asio::buffer(std::string("currentID:7")), error);
    socket.binary(true);
    socket.write(asio::buffer(std::string("Grbl 4.0 [FluidNC v4.0.1 (wifi) '$' for help]\r\n")), error);
    // Echoes until a line "close".
    for (boost::beast::flat_buffer buffer; !error;) {
      socket.read(buffer, error);
      const std::string text(static_cast<const char*>(buffer.data().data()), buffer.size());
      buffer.consume(buffer.size());
      if (text == "close\n") return;
      if (!error) socket.write(asio::buffer((socket.got_binary() ? "binary:" : "text:") + text), error);
    }
  }

  asio::io_context context_{1};
  tcp::acceptor acceptor_;
  std::thread thread_;
};

std::string heard_until(StreamPort& port, const std::string& end) {
  std::string heard;
  for (int i = 0; i < 500 && heard.find(end) == std::string::npos && !port.broken(); ++i) {
    if (!port.run(Seconds(0.02))) continue;
    const auto came = port.replies();
    heard.append(reinterpret_cast<const char*>(came.data()), came.size());
  }
  return heard;
}

void send(StreamPort& port, const std::string& text) {
  port.receive({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

TEST(WebsocketLine, carries_lines_and_real_time_bytes) {
  FluidServer server;
  auto port = open_board(server.address());
  ASSERT_TRUE(port) << port.error();
  EXPECT_EQ(heard_until(**port, "help]\r\n"), "currentID:7\nGrbl 4.0 [FluidNC v4.0.1 (wifi) '$' for help]\r\n");
  send(**port, "$I\n\x90");
  EXPECT_EQ(heard_until(**port, "\x90"), "binary:$I\n\x90");
  EXPECT_FALSE((*port)->broken());
  send(**port, "close\n");
  heard_until(**port, "never");
  EXPECT_TRUE((*port)->broken()) << "the board has closed";
}

TEST(WebsocketLine, a_server_without_websockets_is_refused_in_words) {
  FluidServer server(false);
  const auto port = open_board(server.address());
  ASSERT_FALSE(port);
  EXPECT_NE(port.error().find("127.0.0.1:"), std::string::npos) << port.error();
  EXPECT_NE(port.error().find("WebSocket"), std::string::npos) << port.error();
}

}  // namespace
}  // namespace passo
