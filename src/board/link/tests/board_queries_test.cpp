#include "passo/link/board_queries.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(BoardQueries, have_numbers_and_one_of_them_is_awaited) {
  BoardQueries questions;
  questions.await(Question::watch);
  EXPECT_EQ(questions.put(Question::watch, 9, Seconds(1)), 1);
  EXPECT_EQ(questions.put(Question::status, 10, Seconds(1)), 2);
  EXPECT_EQ(questions.behind(), 10);
  EXPECT_EQ(questions.last(), Question::status);
  EXPECT_FALSE(questions.settle(Question::status, Seconds(2)));
  EXPECT_TRUE(questions.awaited());
  EXPECT_TRUE(questions.settle(Question::watch, Seconds(2)));
  EXPECT_FALSE(questions.awaited());
}

TEST(BoardQueries, time_an_answer_from_the_first_question_or_the_last_frame) {
  BoardQueries questions;
  questions.put(Question::status, 1, Seconds(1));
  questions.put(Question::status, 1, Seconds(2));
  EXPECT_FALSE(questions.answered());
  EXPECT_TRUE(questions.on_answered(Seconds(4)));
  EXPECT_EQ(questions.answer_time(), Seconds(3));
  EXPECT_FALSE(questions.on_answered(Seconds(5))) << "known";
  questions.record_sent(Seconds(6));
  questions.put(Question::status, 2, Seconds(7));
  EXPECT_TRUE(questions.on_answered(Seconds(8)));
  EXPECT_EQ(questions.answer_time(), Seconds(2));
}

TEST(BoardQueries, time_a_rehearsal_from_its_first_byte) {
  BoardQueries questions;
  questions.begin_rehearsal(Seconds(1));
  questions.await(Question::spindle);
  questions.put(Question::spindle, 1, Seconds(3));
  EXPECT_TRUE(questions.settle(Question::spindle, Seconds(4)));
  EXPECT_EQ(questions.answer_time(), Seconds(3));
}

TEST(BoardQueries, are_held_back_until_the_frames_before_them_are_on_the_wire) {
  BoardQueries questions;
  EXPECT_FALSE(questions.release());
  questions.hold_back(true);
  EXPECT_TRUE(questions.release());
  EXPECT_FALSE(questions.release());
}

}  // namespace
}  // namespace passo
