#include "passo/link/board_mirror.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(BoardMirror, tells_inputs_that_were_switched_on_once) {
  BoardMirror mirror;
  EXPECT_TRUE(mirror.update_inputs({.inputs = input_door}, 0));
  EXPECT_FALSE(mirror.update_inputs({.inputs = input_door}, 0)) << "still on";
  EXPECT_EQ(mirror.take_pressed(), input_door);
  EXPECT_EQ(mirror.take_pressed(), 0);
  EXPECT_EQ(mirror.inputs(), input_door);
  EXPECT_FALSE(mirror.update_inputs({.inputs = input_probe}, input_probe)) << "the probe is no switch";
  EXPECT_EQ(mirror.inputs(), input_probe);
  EXPECT_TRUE(mirror.record_pressed(input_hold));
  EXPECT_EQ(mirror.take_pressed(), input_hold);
  EXPECT_EQ(mirror.inputs(), input_probe | input_hold);
}

TEST(BoardMirror, knows_which_inputs_stopped_the_motors) {
  BoardMirror mirror;
  mirror.set_inputs(input_door | 2);
  mirror.record_stop();
  EXPECT_EQ(mirror.stopped_by(), 2) << "a door stops nothing at once";
  mirror.record_stop(input_emergency_stop);
  EXPECT_EQ(mirror.stopped_by(), input_emergency_stop);
  mirror.forget_events();
  EXPECT_EQ(mirror.stopped_by(), 0);
  EXPECT_EQ(mirror.inputs(), input_door | 2 | input_emergency_stop);
}

TEST(BoardMirror, learns_of_outputs_from_a_status_after_all_frames_only) {
  BoardMirror mirror;
  mirror.on_timeout({.taken = 4, .inputs = outputs_timed_out}, 5);
  EXPECT_FALSE(mirror.outputs_timed_out()) << "outputs may have been sent since";
  mirror.on_timeout({.taken = 5, .inputs = outputs_timed_out}, 256 + 5);
  EXPECT_TRUE(mirror.outputs_timed_out());
  mirror.end_timeout();
  EXPECT_FALSE(mirror.outputs_timed_out());
}

TEST(BoardMirror, sees_that_the_board_plays) {
  BoardMirror mirror;
  EXPECT_FALSE(mirror.update({.event = 3}, Seconds(1))) << "nothing was known before";
  EXPECT_FALSE(mirror.update({.event = 3}, Seconds(2)));
  EXPECT_TRUE(mirror.update({.event = 4}, Seconds(3)));
  EXPECT_EQ(mirror.status_time(), Seconds(3));
}

}  // namespace
}  // namespace passo
