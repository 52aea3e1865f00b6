#include "passo/link/handshake.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

using Phase = Handshake::Phase;

constexpr HelloReply suits{.motors = 3, .capacity = 20, .clock = 16'000'000};

TEST(Handshake, without_session_and_setup_is_over_with_the_hello) {
  Handshake handshake;
  EXPECT_EQ(handshake.positions(), max_motors);
  handshake.handle(suits);
  EXPECT_FALSE(handshake.reply()) << "nothing was asked";
  handshake.begin({.motors = 3});
  EXPECT_TRUE(handshake.is_under_way());
  EXPECT_EQ(handshake.positions(), 3);
  EXPECT_EQ(handshake.go_on(), std::nullopt);
  EXPECT_EQ(handshake.phase(), Phase::greeting) << "the board has not answered";
  handshake.handle(suits);
  EXPECT_EQ(handshake.go_on(), std::nullopt);
  EXPECT_EQ(handshake.phase(), Phase::ready);
  handshake.hang_up();
  EXPECT_TRUE(handshake.before_hello());
  EXPECT_FALSE(handshake.reply());
}

TEST(Handshake, names_the_session_and_waits_until_the_board_knows_it) {
  Handshake handshake;
  handshake.begin({.motors = 3, .session = 7});
  handshake.handle(suits);
  EXPECT_EQ(handshake.go_on(), std::nullopt);
  EXPECT_EQ(handshake.phase(), Phase::naming);
  handshake.handle(BoardStatus{.session = 6});
  EXPECT_EQ(handshake.phase(), Phase::naming);
  handshake.handle(BoardStatus{.session = 7});
  EXPECT_EQ(handshake.phase(), Phase::ready);
  handshake.rename(8);
  EXPECT_EQ(handshake.phase(), Phase::naming);
  EXPECT_EQ(handshake.session(), 8);
}

TEST(Handshake, refuses_a_board_that_does_not_suit) {
  Handshake handshake;
  handshake.begin({.motors = 4});
  handshake.handle(suits);
  EXPECT_EQ(handshake.go_on(), LinkError::too_few_motors);
  HelloReply other = suits;
  ++other.version;
  handshake.handle(other);
  EXPECT_EQ(handshake.go_on(), LinkError::wrong_version);
}

TEST(Handshake, says_hello_only_to_a_board_that_is_set_up) {
  const PinSetup wanted{.inputs = input_door | 3, .timing = {.pulse = 32}};
  Handshake handshake;
  handshake.begin({.motors = 3, .setup = wanted});
  EXPECT_FALSE(handshake.is_set_up());
  handshake.handle(suits);
  EXPECT_EQ(handshake.go_on(), std::nullopt);
  EXPECT_FALSE(handshake.reply()) << "an answer to an earlier hello";

  PinSetup done = wanted;
  done.inputs = 3;
  EXPECT_EQ(handshake.handle(done), LinkError::cannot_set_up);
  EXPECT_EQ(words_of_setup(handshake.undone_setup()), "door");
  done = wanted;
  done.timing.pulse = 31;
  EXPECT_EQ(handshake.handle(done), LinkError::cannot_time);
  done.timing.pulse = 40;
  EXPECT_EQ(handshake.handle(done), std::nullopt) << "a longer pulse serves as well";
  handshake.handle(suits);
  EXPECT_EQ(handshake.go_on(), std::nullopt);
  EXPECT_EQ(handshake.phase(), Phase::naming) << "the answer to the number tells how the switches are";
}

}  // namespace
}  // namespace passo
