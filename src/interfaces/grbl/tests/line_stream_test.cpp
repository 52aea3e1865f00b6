#include "passo/grbl/line_stream.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(LineStream, may_end_when_it_has_waited_long_enough) {
  LineStream stream;
  EXPECT_FALSE(stream.may_end(Seconds(9), true));
  stream.begin(Ticket(5));
  stream.record_rest(Seconds(2));
  EXPECT_FALSE(stream.may_end(Seconds(2.9), true));
  EXPECT_TRUE(stream.may_end(Seconds(2.9), false));  // the sender has gone
  EXPECT_TRUE(stream.may_end(Seconds(3), true));
}

TEST(LineStream, is_asked_to_end_once) {
  LineStream stream;
  stream.begin(Ticket(5));
  stream.note_asked_to_end();
  EXPECT_FALSE(stream.may_end(Seconds(9), true));
  stream.begin(Ticket(6));
  EXPECT_TRUE(stream.may_end(Seconds(9), true));
}

TEST(LineStream, has_ended_with_the_answer_to_its_own_request) {
  LineStream stream;
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
