#include "passo/link/send_window.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace passo {
namespace {

// Notes which frames come, by their first bytes.
class NotingPort final : public BoardPort {
 public:
  void receive(std::span<const std::uint8_t> bytes) override { came.push_back(bytes[0]); }
  bool run(Seconds most) override {
    time += most;
    return false;
  }
  std::span<const std::uint8_t> replies() override { return {}; }
  Seconds elapsed() const override { return time; }

  std::vector<int> came;
  Seconds time{0};
};

SendWindow::Frame numbered_frame(ItemNumber number, std::uint8_t size = 10) {
  SendWindow::Frame frame{.number = number, .size = size};
  frame.bytes[0] = static_cast<std::uint8_t>(number);
  return frame;
}
void push_frames(SendWindow& window, int frames) {
  for (int i = 0; i < frames; ++i) window.push(numbered_frame(window.next()));
}

TEST(SendWindow, without_loss_sends_at_once_and_keeps_nothing) {
  NotingPort port;
  SendWindow window(port, false);
  window.begin(4);
  push_frames(window, 2);
  EXPECT_EQ(port.came, (std::vector{5, 6}));
  EXPECT_FALSE(window.keeps_any());
  EXPECT_FALSE(window.waits());
  EXPECT_EQ(window.untaken(), 2);
  EXPECT_TRUE(window.on_accepted(6));
  EXPECT_EQ(window.untaken(), 0);
}

TEST(SendWindow, has_no_more_bytes_under_way_than_the_board_can_keep) {
  NotingPort port;
  SendWindow window(port, true);
  window.begin(0);
  push_frames(window, 5);
  EXPECT_FALSE(window.fill(35));
  EXPECT_EQ(port.came, (std::vector{1, 2, 3}));
  EXPECT_TRUE(window.waits());
  EXPECT_TRUE(window.on_accepted(2));
  EXPECT_TRUE(window.fill(35));
  EXPECT_EQ(port.came, (std::vector{1, 2, 3, 4, 5}));
  EXPECT_FALSE(window.waits());
}

TEST(SendWindow, repeats_from_the_first_frame_that_is_missing_and_then_waits_for_the_answer) {
  NotingPort port;
  SendWindow window(port, true);
  window.begin(0);
  push_frames(window, 4);
  EXPECT_TRUE(window.fill(SendWindow::no_limit));
  EXPECT_TRUE(window.on_accepted(2));
  port.came.clear();
  window.repeat(SendWindow::no_limit);
  window.await_answer(7);
  EXPECT_EQ(port.came, (std::vector{3, 4}));
  EXPECT_EQ(window.statistics().repeated(), 2U);
  EXPECT_TRUE(window.awaits_answer(7));
  EXPECT_FALSE(window.awaits_answer(6));
  push_frames(window, 1);
  EXPECT_FALSE(window.fill(SendWindow::no_limit)) << "before the answer nothing is sent";
  window.go_on();
  EXPECT_TRUE(window.fill(SendWindow::no_limit));
  EXPECT_EQ(port.came, (std::vector{3, 4, 5}));
}

TEST(SendWindow, ignores_what_the_board_cannot_have_taken) {
  NotingPort port;
  SendWindow window(port, true);
  window.begin(250);
  push_frames(window, 10);
  EXPECT_TRUE(window.fill(SendWindow::no_limit));
  EXPECT_FALSE(window.on_accepted(250)) << "old";
  EXPECT_FALSE(window.on_accepted(5)) << "260 is the last one";
  EXPECT_TRUE(window.on_accepted(4));
  EXPECT_EQ(window.taken(), 260);
  EXPECT_FALSE(window.on_accepted(3)) << "overtaken";
  EXPECT_FALSE(window.keeps_any());
}

TEST(SendWindow, knows_the_boards_pace_from_long_bursts_only) {
  NotingPort port;
  SendWindow window(port, true);
  window.begin(0);
  const auto burst = [&](int frames, Seconds time) {
    push_frames(window, frames);
    EXPECT_TRUE(window.fill(SendWindow::no_limit));
    static_cast<void>(port.run(time));
    EXPECT_TRUE(window.on_accepted(static_cast<std::uint8_t>(window.sent())));
  };
  burst(2, Seconds(1));
  EXPECT_EQ(window.statistics().time_a_frame(), Seconds(0));
  burst(10, Seconds(0.1));
  EXPECT_NEAR(window.statistics().time_a_frame().value(), 0.01, 1e-12);
  burst(10, Seconds(0.01));
  EXPECT_NEAR(window.statistics().time_a_frame().value(), 0.0095, 1e-12) << "a slow burst is forgotten slowly";
  EXPECT_EQ(window.statistics().frames(), 22U);
  EXPECT_EQ(window.statistics().bytes(), 220U);
  window.begin(0);
  EXPECT_EQ(window.statistics().time_a_frame(), Seconds(0));
}

}  // namespace
}  // namespace passo
