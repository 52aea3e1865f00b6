// A virtual machine at the other end of a pseudo-terminal and of a connection: the bytes go through the kernel.
#include "passo/transport/stream_port.hpp"

#include <algorithm>
#include <atomic>
#include <thread>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <pty.h>
#include <sys/socket.h>
#include <unistd.h>

#include "passo/link/await.hpp"
#include "passo/machine/virtual_machine.hpp"

namespace passo {
namespace {

constexpr LinkTimeouts care{.answer_within = Seconds(0.3)};

// Plays the board on a descriptor until it is told to stop.
class Player {
 public:
  Player(VirtualMachine& machine, int descriptor)
      : thread_([this, &machine, descriptor] {
          while (!stop_) {
            pollfd one{.fd = descriptor, .events = POLLIN, .revents = 0};
            if (poll(&one, 1, 5) <= 0) continue;
            std::uint8_t bytes[256];
            const ssize_t got = read(descriptor, bytes, sizeof bytes);
            if (got <= 0) continue;
            machine.receive({bytes, static_cast<std::size_t>(got)});
            do {
              const auto replies = machine.replies();
              if (!replies.empty() && write(descriptor, replies.data(), replies.size()) <= 0) return;
            } while (machine.run(Seconds(1)));
          }
        }) {}
  ~Player() {
    stop_ = true;
    thread_.join();
  }
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

 private:
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

class StreamPorts : public testing::Test {
 protected:
  VirtualMachine machine_{3, Hertz(16e6)};
};

// Each of the two writes would end the program by SIGPIPE.
TEST_F(StreamPorts, a_side_that_has_closed_ends_nobody) {
  int ends[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  StreamPort port(ends[0]);
  close(ends[1]);
  const std::uint8_t bytes[] = {1, 2, 3};
  port.receive(bytes);
  port.receive(bytes);
  EXPECT_TRUE(port.broken());
  EXPECT_FALSE(port.run(Seconds(0.01)));
}

TEST_F(StreamPorts, a_board_on_a_serial_line_says_what_it_is_and_how_it_is) {
  int board = -1;
  int line = -1;
  char name[64];
  ASSERT_EQ(openpty(&board, &line, name, nullptr, nullptr), 0);
  const auto port = open_board({.kind = BoardAddress::Kind::serial, .place = name, .port = ""});
  ASSERT_TRUE(port) << port.error();
  {
    const Player player(machine_, board);
    BoardSession session(**port, care);
    const auto about = ask_about(session, Seconds(10));
    ASSERT_TRUE(about);
    EXPECT_NE(about->name[0], 0);
    const auto status = ask_status(session, Seconds(10));
    ASSERT_TRUE(status);
    EXPECT_EQ(status->positions[0], 0);
  }
  close(board);
  close(line);
}

TEST_F(StreamPorts, a_board_in_the_network_answers_and_one_that_has_gone_is_known) {
  const int listening = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(bind(listening, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(listening, 1), 0);
  ASSERT_EQ(getsockname(listening, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const BoardAddress where{
      .kind = BoardAddress::Kind::tcp, .place = "127.0.0.1", .port = std::to_string(ntohs(address.sin_port))};
  const auto port = open_board(where);
  ASSERT_TRUE(port) << port.error();
  const int board = accept(listening, nullptr, nullptr);
  ASSERT_GE(board, 0);
  {
    const Player player(machine_, board);
    BoardSession session(**port, care);
    EXPECT_TRUE(ask_status(session, Seconds(10)));
  }
  close(board);
  close(listening);
  EXPECT_FALSE((*port)->run(Seconds(10)));
  EXPECT_TRUE((*port)->broken());
  // It swallows what is sent, and nothing happens.
  const std::uint8_t byte = 0;
  for (int i = 0; i < 3; ++i) (*port)->receive({&byte, 1});
  EXPECT_FALSE(open_board(where));
}

TEST_F(StreamPorts, a_line_that_broke_is_opened_again) {
  int first[2];
  int second[2];
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, first), 0);
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, second), 0);
  int attempts = 0;
  StreamPort port(first[0], [&] { return ++attempts < 3 ? -1 : second[0]; });
  close(first[1]);
  EXPECT_FALSE(port.run(Seconds(1)));
  EXPECT_TRUE(port.broken());
  const std::uint8_t byte = 7;
  ASSERT_EQ(write(second[1], &byte, 1), 1);
  for (int i = 0; i < 3 && !port.run(Seconds(0.01)); ++i) {
  }
  EXPECT_EQ(attempts, 3);
  const auto replies = port.replies();
  ASSERT_EQ(replies.size(), 1);
  EXPECT_EQ(replies[0], byte);
  close(second[1]);
}

TEST_F(StreamPorts, what_cannot_be_opened_says_why) {
  const auto missing = open_board({.kind = BoardAddress::Kind::serial, .place = "/dev/no-such-line", .port = ""});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().find("/dev/no-such-line: No such file"), std::string::npos);
  const auto file = open_board({.kind = BoardAddress::Kind::serial, .place = "/dev/null", .port = ""});
  ASSERT_FALSE(file);
  EXPECT_NE(file.error().find("not a serial port"), std::string::npos);
  const auto rate = open_board({.kind = BoardAddress::Kind::serial, .place = "/dev/null", .port = "", .baud = 123'456});
  ASSERT_FALSE(rate);
  EXPECT_NE(rate.error().find("123456 baud"), std::string::npos);
}

}  // namespace
}  // namespace passo
