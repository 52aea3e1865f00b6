#include "passo/machine/virtual_line.hpp"

#include <gtest/gtest.h>

#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {
namespace {

constexpr Hertz clock_rate{16e6};
constexpr LineOptions slow{.baud = 10'000, .latency = Seconds(0.002)};  // a millisecond a byte

class VirtualLineTest : public testing::Test {
 protected:
  void send_hello() {
    std::uint8_t frame[largest_frame];
    const std::uint8_t size = encode(Hello{.motors = 1}, std::uint8_t{0}, frame);
    sent_ = size;
    line_.receive({frame, size});
  }
  // Of a whole answer; 0: none.
  std::size_t hear() {
    const auto bytes = line_.replies();
    Decoder decoder;
    for (const std::uint8_t byte : bytes) {
      if (decoder.feed(byte) == Decoded::frame) return bytes.size();
    }
    return 0;
  }

  VirtualMachine machine_{1, clock_rate};
  VirtualLine line_{machine_, clock_rate, slow};
  std::size_t sent_ = 0;
};

TEST_F(VirtualLineTest, takes_a_bytes_time_for_each_byte_and_its_latency_both_ways) {
  send_hello();
  ASSERT_TRUE(line_.run(Seconds(1)));
  const double there = 0.001 * static_cast<double>(sent_) + 0.002;
  const double elapsed = line_.elapsed().value();
  const std::size_t answer = hear();
  ASSERT_GT(answer, 0U);
  EXPECT_NEAR(elapsed, there + 0.001 * static_cast<double>(answer) + 0.002, 1e-6);
}

TEST_F(VirtualLineTest, lets_the_time_pass_that_it_is_given_and_no_more) {
  send_hello();
  EXPECT_FALSE(line_.run(Seconds(0.005))) << "the question is still under way";
  EXPECT_NEAR(line_.elapsed().value(), 0.005, 1e-7);
  EXPECT_EQ(hear(), 0U);
}

TEST_F(VirtualLineTest, swallows_what_is_sent_while_it_is_cut_and_what_is_on_the_way_when_that_begins) {
  line_.cut(Seconds(0.004), Seconds(0.1));
  send_hello();  // arrives after more than 4 ms
  EXPECT_FALSE(line_.run(Seconds(0.05)));
  send_hello();
  EXPECT_FALSE(line_.run(Seconds(0.1)));
  send_hello();
  EXPECT_TRUE(line_.run(Seconds(0.1))) << "it is whole again";
  EXPECT_GT(hear(), 0U);
}

TEST_F(VirtualLineTest, puts_what_trouble_makes_of_the_bytes_in_their_place) {
  int to_board = 0;
  int to_host = 0;
  line_.set_trouble([&](bool board, VirtualLine::Bytes bytes) {
    ++(board ? to_board : to_host);
    if (board && to_board == 1) bytes.back() ^= 1;
    return bytes;
  });
  send_hello();
  static_cast<void>(line_.run(Seconds(0.1)));
  Decoder decoder;
  for (const std::uint8_t byte : line_.replies()) {
    if (decoder.feed(byte) != Decoded::frame) continue;
    EXPECT_NE(decoder.frame().type, MessageType::hello_reply);
  }
  send_hello();
  ASSERT_TRUE(line_.run(Seconds(0.1)));
  EXPECT_GT(hear(), 0U);
  EXPECT_EQ(to_board, 2);
  EXPECT_GE(to_host, 1);
}

}  // namespace
}  // namespace passo
