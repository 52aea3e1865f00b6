// The count of a handwheel: each edge of both lines, in either direction, and how a board tells it.
#include <random>

#include "board_bench.hpp"

#include "passo/firmware/quadrature_counter.hpp"

namespace passo {
namespace {

// The levels of a wheel that has been turned by so many edges: A is before B.
constexpr std::uint8_t levels_at(std::int64_t edges) {
  constexpr std::uint8_t cycle[] = {0, QuadratureCounter::line_a, QuadratureCounter::line_a | QuadratureCounter::line_b,
                                    QuadratureCounter::line_b};
  return cycle[edges & 3];
}

TEST(QuadratureCounter, counts_each_edge_in_both_directions_from_any_level) {
  for (std::int64_t start = 0; start < 4; ++start) {
    QuadratureCounter counter;
    counter.begin(levels_at(start));
    counter.update(levels_at(start));
    EXPECT_EQ(counter.count(), 0U);
    for (std::int64_t i = 1; i <= 9; ++i) {
      counter.update(levels_at(start + i));
      EXPECT_EQ(counter.count(), static_cast<std::uint32_t>(i));
    }
    for (std::int64_t i = 8; i >= -9; --i) {
      counter.update(levels_at(start + i));
      EXPECT_EQ(static_cast<std::int32_t>(counter.count()), i);
    }
    EXPECT_EQ(counter.jumps(), 0);
  }
}

TEST(QuadratureCounter, counts_a_bouncing_edge_once) {
  std::mt19937 random(7);
  QuadratureCounter counter;
  counter.begin(levels_at(0));
  std::int64_t at = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::int64_t next = at + (random() % 3 == 0 ? -1 : 1);
    for (auto bounces = random() % 5; bounces > 0; --bounces) {
      counter.update(levels_at(next));
      counter.update(levels_at(at));
    }
    counter.update(levels_at(next));
    at = next;
    ASSERT_EQ(static_cast<std::int32_t>(counter.count()), at);
  }
  EXPECT_EQ(counter.jumps(), 0);
}

TEST(QuadratureCounter, tells_how_often_both_lines_have_changed_and_counts_nothing_then) {
  QuadratureCounter counter;
  counter.begin(levels_at(0));
  counter.update(levels_at(2));
  counter.update(levels_at(0));
  EXPECT_EQ(counter.jumps(), 2);
  EXPECT_EQ(counter.count(), 0U);
  counter.update(levels_at(1));
  EXPECT_EQ(counter.count(), 1U) << "and counts on";
}

struct WheelBench : Bench {
  bool has_handwheel() const { return fitted; }
  HandwheelCount handwheel() const { return wheel; }
  bool fitted = true;
  HandwheelCount wheel = {.count = 0xFFFFFFF0, .jumps = 65535, .selected = handwheel_axis << 2 | handwheel_tenfold};
};

class HandwheelTest : public BoardOn<WheelBench> {
 protected:
  WireFrame asked(std::uint8_t question) { return answer_to(Question::handwheel, question); }
};

TEST_F(HandwheelTest, is_told_as_it_is) {
  bench_.decoder.set_motors(3);
  send(Hello{.motors = 3}, std::uint8_t{0});
  const WireFrame frame = asked(200);
  ASSERT_EQ(frame.type, MessageType::turned);
  Turned turned;
  decode(frame, turned);
  EXPECT_EQ(turned.answers, 200);
  EXPECT_EQ(turned.progress.free, capacity);
  const HandwheelCount told = handwheel_in(turned);
  EXPECT_EQ(told.count, 0xFFFFFFF0);
  EXPECT_EQ(told.jumps, 65535);
  EXPECT_EQ(told.selected, handwheel_axis << 2 | handwheel_tenfold);
}

TEST_F(HandwheelTest, without_one_the_answer_is_the_status) {
  bench_.decoder.set_motors(3);
  send(Hello{.motors = 3}, std::uint8_t{0});
  bench_.fitted = false;
  EXPECT_EQ(asked(2).type, MessageType::status);
}

}  // namespace
}  // namespace passo
