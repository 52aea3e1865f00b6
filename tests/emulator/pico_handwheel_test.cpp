// The Pico's handwheel: no edge is lost while motors step at a million events a second, and no step moves by a cycle.
#include <cstdint>
#include <cstdio>
#include <random>

#include "emulator/pico_bench.hpp"
#include "emulator/turned_handwheel.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

#include "passo/wire/handwheel_count.hpp"

namespace passo {
namespace {

using test::TurnedHandwheel;

class PicoHandwheel : public ::testing::Test {
 protected:
  void SetUp() override {
    static const std::string why = PicoBench::missing(PASSO_MOTION_PICO_MPG);
    if (!why.empty()) GTEST_SKIP() << why;
  }
};

class TurnedPico {
 public:
  explicit TurnedPico(double rate)
      : bench(PASSO_MOTION_PICO_MPG, 4, pico_mpg, PicoSocket::usb),
        wheel(static_cast<double>(pico_clock_rate), rate, test::seed()) {}
  void turn() {
    bench.at_cycle = [this](std::uint64_t cycle) {
      const std::uint64_t next = wheel.turn();
      draw(wheel.a(), wheel.b());
      return cycle + next;
    };
  }
  void draw(bool a, bool b) {
    bench.press((a ? 0 : gpio_bit(pico_mpg.wheel.a)) | (b ? 0 : gpio_bit(pico_mpg.wheel.b)) | selected);
  }
  HandwheelCount stop_and_ask() {
    bench.at_cycle = {};
    bench.run(pico_clock_rate / 1000);
    bench.ask({.question = Question::handwheel});
    bench.run(pico_clock_rate / 250);
    EXPECT_TRUE(bench.turned().has_value());
    return bench.turned() ? handwheel_in(*bench.turned()) : HandwheelCount();
  }
  PicoBench bench;
  TurnedHandwheel wheel;
  std::uint32_t selected = 0;
};

TEST_F(PicoHandwheel, counts_every_edge_at_a_million_events_a_second) {
  std::mt19937_64 random(test::seed());
  TurnedPico pico(2000);
  pico.turn();
  for (const std::uint32_t interval : {16U, 200U}) {
    const StreamKind kind{.shortest_interval = interval,
                          .longest_interval = interval + interval / 4,
                          .shortest_segment = 120,
                          .segments = interval == 16 ? 200 : 20,
                          .ramp = 12};
    const EdgeCheck check = pico.bench.play(random_stream(random, 4, kind));
    EXPECT_TRUE(check.exact()) << check.steps << " of " << check.expected << " steps, finished " << check.finished;
    EXPECT_EQ(check.error, 0) << "each step is at its tick";
    EXPECT_EQ(check.complaints, 0U);
  }
  pico.bench.ask();
  pico.bench.run(pico_clock_rate / 500);
  ASSERT_TRUE(pico.bench.status().has_value());
  EXPECT_EQ(pico.bench.status()->state & board_slipped, 0);
  const HandwheelCount told = pico.stop_and_ask();
  std::printf("%lld edges, jumps %d\n", static_cast<long long>(pico.wheel.edges()), int{told.jumps});
  EXPECT_GT(pico.wheel.edges(), 100);
  EXPECT_EQ(told.jumps, 0);
  EXPECT_EQ(static_cast<std::int32_t>(told.count), pico.wheel.position());
}

// Noise of 400,000 edges a second at a line costs neither steps nor the answers of the board, and counts next to
// nothing.
TEST_F(PicoHandwheel, is_not_stopped_by_noise) {
  std::mt19937_64 random(test::seed());
  TurnedPico pico(1);
  bool is_high = true;
  pico.bench.at_cycle = [&](std::uint64_t cycle) {
    pico.draw(is_high = !is_high, true);
    return cycle + 320;
  };
  const StreamKind kind{
      .shortest_interval = 16, .longest_interval = 20, .shortest_segment = 200, .segments = 40, .ramp = 12};
  const EdgeCheck check = pico.bench.play(random_stream(random, 4, kind));
  EXPECT_TRUE(check.exact());
  EXPECT_EQ(check.error, 0);
  const auto count = static_cast<std::int32_t>(pico.stop_and_ask().count);
  EXPECT_LE(std::abs(count), 1);
}

TEST_F(PicoHandwheel, tells_its_selectors_and_a_missed_edge) {
  TurnedPico pico(1);
  EXPECT_EQ(pico.stop_and_ask().selected, 0);
  const std::pair<std::uint8_t, int> selectors[] = {
      {pico_mpg.wheel.axes[0], handwheel_axis},      {pico_mpg.wheel.axes[1], handwheel_axis << 1},
      {pico_mpg.wheel.axes[2], handwheel_axis << 2}, {pico_mpg.wheel.axes[3], handwheel_axis << 3},
      {pico_mpg.wheel.tenfold, handwheel_tenfold},   {pico_mpg.wheel.hundredfold, handwheel_hundredfold}};
  for (const auto& [gpio, bit] : selectors) {
    pico.selected = gpio_bit(gpio);
    pico.draw(true, true);
    EXPECT_EQ(pico.stop_and_ask().selected, bit);
  }
  pico.selected = 0;
  pico.draw(false, true);
  EXPECT_EQ(pico.stop_and_ask().count, 1U);
  pico.draw(true, false);
  EXPECT_EQ(pico.stop_and_ask().jumps, 1);
}

}  // namespace
}  // namespace passo
