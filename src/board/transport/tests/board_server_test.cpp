// BoardServer over the kernel's loopback: one host, any number that only look, and nobody whom the others wait for.
#include "passo/transport/board_server.hpp"

#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "passo/wire/message.hpp"

namespace passo {
namespace {

constexpr std::uint8_t motors = 3;

// Answers each question by a status that tells the question's number, and notes what else it hears.
class AnsweringBoard final : public BoardPort {
 public:
  void receive(std::span<const std::uint8_t> bytes) override {
    for (const std::uint8_t byte : bytes) {
      if (decoder_.feed(byte) != Decoded::frame) continue;
      const WireFrame& frame = decoder_.frame();
      heard.push_back(frame.type);
      if (frame.type == MessageType::hello) decoder_.set_motors(frame.payload[1]);
      if (frame.type != MessageType::ask) continue;
      std::uint8_t answer[largest_frame];
      const BoardStatus status{.motors = motors, .answers = frame.sequence};
      said_.insert(said_.end(), answer, answer + encode(status, frame.payload[1], std::uint8_t{0}, answer));
    }
  }
  bool run(Seconds) override { return !said_.empty(); }
  std::span<const std::uint8_t> replies() override {
    taken_ = std::exchange(said_, {});
    return taken_;
  }
  Seconds elapsed() const override { return Seconds(0); }

  std::vector<MessageType> heard;

 private:
  Decoder decoder_;
  std::vector<std::uint8_t> said_;
  std::vector<std::uint8_t> taken_;
};

class Caller {
 public:
  explicit Caller(unsigned port) : descriptor_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    EXPECT_EQ(connect(descriptor_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    decoder_.set_motors(max_motors);
  }
  ~Caller() { hang_up(); }
  Caller(const Caller&) = delete;
  Caller& operator=(const Caller&) = delete;

  void hang_up() {
    if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  }
  template <class Message, class... More>
  void say(const Message& message, More... more) {
    std::uint8_t frame[largest_frame];
    const std::size_t size = encode(message, more..., frame);
    put(std::span(frame).first(size));
  }
  void put(std::span<const std::uint8_t> bytes) {
    EXPECT_EQ(write(descriptor_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  void look(std::uint8_t number) { say(Ask{.motors = max_motors}, number); }
  void send_hello() {
    say(Hello{.motors = motors}, std::uint8_t{1});
    motors_ = motors;
    decoder_.set_motors(motors);
  }
  // The number of the question that was answered; -1: no answer is there; -2: the server has hung up.
  int answered() {
    for (;;) {
      pollfd one{.fd = descriptor_, .events = POLLIN, .revents = 0};
      if (poll(&one, 1, 0) <= 0) return -1;
      std::uint8_t byte = 0;
      if (read(descriptor_, &byte, 1) <= 0) return -2;
      if (decoder_.feed(byte) != Decoded::frame) continue;
      BoardStatus status;
      decode(decoder_.frame(), motors_, status);
      return status.answers;
    }
  }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  std::uint8_t motors_ = max_motors;
  Decoder decoder_;
};

class Served : public testing::Test {
 protected:
  Served() {
    auto server = BoardServer::listen(0);
    EXPECT_TRUE(server);
    server_ = std::move(*server);
  }
  // What was sent over the loopback is there at once.
  void attend() {
    for (int i = 0; i < 3; ++i) server_->attend(board_);
  }
  std::unique_ptr<Caller> call() {
    auto caller = std::make_unique<Caller>(server_->port());
    attend();
    return caller;
  }
  long heard(MessageType type) const { return std::ranges::count(board_.heard, type); }

  AnsweringBoard board_;
  std::unique_ptr<BoardServer> server_;
};

// The other end of a connection of this process.
int other_end_of(int descriptor) {
  sockaddr_in here{};
  socklen_t size = sizeof here;
  EXPECT_EQ(getsockname(descriptor, reinterpret_cast<sockaddr*>(&here), &size), 0);
  for (int other = 3; other < 256; ++other) {
    sockaddr_in there{};
    size = sizeof there;
    if (other == descriptor || getpeername(other, reinterpret_cast<sockaddr*>(&there), &size) != 0) continue;
    if (there.sin_family == AF_INET && there.sin_port == here.sin_port) return other;
  }
  return -1;
}

// A web page makes a browser send frames behind a head of HTTP.
TEST_F(Served, a_browser_is_sent_away_and_none_of_its_frames_reaches_the_board) {
  for (const std::string_view head : {"POST / HTTP/1.1\r\n\r\n", "\x16\x03\x01", "\n"}) {
    const auto browser = call();
    browser->put(std::span(reinterpret_cast<const std::uint8_t*>(head.data()), head.size()));
    browser->send_hello();
    attend();
    EXPECT_EQ(browser->answered(), -2);
  }
  EXPECT_EQ(heard(MessageType::hello), 0);
  const auto host = call();
  host->send_hello();
  attend();
  EXPECT_EQ(heard(MessageType::hello), 1);
}

// Two small answers one after the other: the second would wait 40 ms for the first to be acknowledged.
TEST_F(Served, answers_are_not_held_back) {
  const auto caller = call();
  int on = 0;
  socklen_t size = sizeof on;
  ASSERT_EQ(getsockopt(other_end_of(caller->descriptor()), IPPROTO_TCP, TCP_NODELAY, &on, &size), 0);
  EXPECT_NE(on, 0);
}

TEST_F(Served, many_may_look_while_one_drives_and_each_hears_its_own_answers) {
  const auto host = call();
  host->send_hello();
  std::vector<std::unique_ptr<Caller>> lookers;
  for (std::uint8_t i = 0; i < 8; ++i) {
    lookers.push_back(call());
    lookers.back()->look(static_cast<std::uint8_t>(100 + i));
  }
  host->say(Ask{.motors = motors}, std::uint8_t{7});
  attend();
  EXPECT_EQ(host->answered(), 7);
  EXPECT_EQ(host->answered(), -1);
  for (std::uint8_t i = 0; i < 8; ++i) {
    EXPECT_EQ(lookers[i]->answered(), 100 + i);
    EXPECT_EQ(lookers[i]->answered(), -1);
  }
}

TEST_F(Served, a_silent_one_blocks_nobody) {
  const auto silent = call();
  const auto chatter = call();
  const std::vector<std::uint8_t> noise(1000, 0x55);
  chatter->put(noise);
  const auto host = call();
  host->send_hello();
  host->say(Ask{.motors = motors}, std::uint8_t{7});
  attend();
  EXPECT_EQ(host->answered(), 7);
  EXPECT_EQ(silent->answered(), -1);
}

TEST_F(Served, half_a_frame_of_one_does_not_spoil_that_of_another) {
  const auto host = call();
  host->send_hello();
  attend();
  std::uint8_t frame[largest_frame];
  const std::size_t size = encode(BoardOutputs{.switches = 1, .spindle_rpm = 1000}, std::uint8_t{2}, frame);
  for (std::size_t cut = 1; cut < size; ++cut) {
    const long before = heard(MessageType::outputs);
    host->put(std::span(frame).first(cut));
    const auto looker = call();
    looker->look(9);
    attend();
    EXPECT_EQ(looker->answered(), 9);
    host->put(std::span(frame).subspan(cut, size - cut));
    attend();
    EXPECT_EQ(heard(MessageType::outputs), before + 1) << cut;
  }
}

TEST_F(Served, a_second_host_is_sent_away_and_one_that_has_gone_has_a_successor) {
  auto first = call();
  first->send_hello();
  const auto second = call();
  second->send_hello();
  attend();
  EXPECT_EQ(second->answered(), -2);
  EXPECT_EQ(heard(MessageType::hello), 1);
  // In the same instant, before anybody has noticed.
  const auto third = call();
  third->send_hello();
  first->hang_up();
  third->say(Ask{.motors = motors}, std::uint8_t{3});
  attend();
  EXPECT_EQ(third->answered(), 3);
  EXPECT_EQ(heard(MessageType::hello), 2);
}

// Its line was broken, and it goes on without a hello.
TEST_F(Served, a_host_that_calls_again_is_known_by_what_it_says) {
  auto host = call();
  host->send_hello();
  attend();
  host->hang_up();
  const auto again = call();
  again->say(BoardSegment{.events = 1, .interval = 1U << 20}, motors, std::uint8_t{2});
  attend();
  EXPECT_EQ(heard(MessageType::segment), 1);
}

TEST_F(Served, a_host_that_says_nothing_more_gives_way) {
  const auto stopped = call();
  stopped->send_hello();
  attend();
  usleep(static_cast<useconds_t>((BoardServer::most_silence.value() + 0.1) * 1e6));
  const auto next = call();
  next->send_hello();
  attend();
  EXPECT_EQ(heard(MessageType::hello), 2);
  EXPECT_EQ(stopped->answered(), -2);
}

TEST_F(Served, nobody_who_does_not_read_makes_the_board_wait) {
  const auto host = call();
  host->send_hello();
  attend();
  const std::vector<std::uint8_t> much(4096, 0x11);
  for (int i = 0; i < 10'000; ++i) server_->send_to_host(much);  // 40 MB: more than the kernel keeps
  const auto next = call();
  next->send_hello();
  attend();
  EXPECT_EQ(heard(MessageType::hello), 2);
}

TEST_F(Served, a_port_in_use_is_said_to_be) {
  const auto second = BoardServer::listen(server_->port());
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("in use by another program"), std::string::npos);
}

}  // namespace
}  // namespace passo
