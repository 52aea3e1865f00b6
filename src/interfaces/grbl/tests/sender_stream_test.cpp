#include "passo/grbl/sender_stream.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(SenderStream, may_end_when_it_has_waited_long_enough) {
  SenderStream stream;
  EXPECT_FALSE(stream.may_end(Seconds(9), true));
  stream.begin(Ticket(5));
  stream.record_rest(Seconds(2));
  EXPECT_FALSE(stream.may_end(Seconds(2.9), true));
  EXPECT_TRUE(stream.may_end(Seconds(2.9), false));  // the sender has gone
  EXPECT_TRUE(stream.may_end(Seconds(3), true));
}

TEST(SenderStream, is_asked_to_end_once) {
  SenderStream stream;
  stream.begin(Ticket(5));
  stream.note_asked_to_end();
  EXPECT_FALSE(stream.may_end(Seconds(9), true));
  stream.begin(Ticket(6));
  EXPECT_TRUE(stream.may_end(Seconds(9), true));
}

TEST(SenderStream, has_ended_with_the_answer_to_its_own_request) {
  SenderStream stream;
  stream.begin(Ticket(5));
  stream.on_answer(4);
  EXPECT_TRUE(stream.may_end(Seconds(9), true));
  stream.on_answer(5);
  EXPECT_FALSE(stream.may_end(Seconds(9), true));
  stream.begin(std::nullopt);  // refused
  EXPECT_FALSE(stream.may_end(Seconds(9), true));
}

}  // namespace
}  // namespace passo
