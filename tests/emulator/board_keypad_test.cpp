// The keypad of the emulated Megas: what comes out of the pins is within the ramp that the pin map states, and counted.
#include <cmath>
#include <cstdio>

#include "emulator/streamed_run.hpp"
#include <gtest/gtest.h>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/mega_windings.hpp"
#include "passo/firmware/jog_keys.hpp"

namespace passo {
namespace {

constexpr double clock_rate = 16e6;
constexpr std::uint64_t millisecond = 16'000;

class Person {
 public:
  Person(const BoardUnderTest& board, const KeypadPins& pins) : bench_(board), pins_(pins) { run(50); }

  void run(double milliseconds) { bench_.run(static_cast<std::uint64_t>(milliseconds * millisecond)); }
  void hold(char key, bool down = true) {
    const Key place = key_named(key);
    bench_.ports().connect(pins_.rows[place / keypad_columns], pins_.columns[place % keypad_columns], down);
  }
  void press(char key, double milliseconds = 60) {
    hold(key);
    run(milliseconds);
    hold(key, false);
    run(900);  // down the ramp
  }
  bool lit(Pin pin) const { return (bench_.ports().outputs(pin.port) & pin.mask()) != 0; }
  BoardStatus status() {
    bench_.ask();
    run(20);
    EXPECT_TRUE(bench_.status().has_value());
    return bench_.status().value_or(BoardStatus{});
  }
  BoardBench& bench() { return bench_; }
  const KeypadPins& pins() const { return pins_; }

 private:
  BoardBench bench_;
  const KeypadPins& pins_;
};

// As in manual_mode_test.cpp: times are all that it knows, and they are some cycles off.
void expect_within_ramp(const SeenSteps& steps, const JogSpeeds& speeds) {
  const std::size_t stretch = speeds.highest / 125;  // 8 milliseconds at the least
  ASSERT_GT(steps.size(), 3 * stretch);
  const auto seconds = [&](std::size_t from, std::size_t to) {
    return static_cast<double>(steps[to].time - steps[from].time) / clock_rate;
  };
  EXPECT_LE(1 / seconds(0, 1), speeds.start_stop * 1.05);
  EXPECT_LE(1 / seconds(steps.size() - 2, steps.size() - 1), speeds.start_stop * 1.05);
  const auto count = static_cast<double>(stretch);
  double fastest = 0;
  double largest = 0;
  for (std::size_t i = 2 * stretch; i < steps.size(); ++i) {
    const double first = seconds(i - 2 * stretch, i - stretch);
    const double second = seconds(i - stretch, i);
    fastest = std::max(fastest, count / second);
    largest = std::max(largest, std::abs(count / second - count / first) / ((first + second) / 2));
  }
  std::printf("%zu steps, %.0f a second at the most, acceleration %.0f at the most\n", steps.size(), fastest, largest);
  EXPECT_NEAR(fastest, speeds.highest, speeds.highest * 0.01);
  EXPECT_LE(largest, speeds.acceleration * 1.02);
}

struct Keypad {
  BoardUnderTest board;
  KeypadPins pins;
  Pin limit;
  Pin relay;
};
Keypad ramps() {
  return {.board = mega_under_test(PASSO_MOTION_MEGA, 6),
          .pins = mega_ramps.keypad,
          .limit = mega_ramps.limits[0],
          .relay = mega_ramps.spindle_relay};
}
Keypad windings() {
  return {
      .board = mega_windings_under_test(PASSO_MOTION_MEGA_HALF_STEP, std::vector<DriveMode>(4, DriveMode::half_step)),
      .pins = mega_windings.keypad,
      .limit = mega_windings.limits[3],
      .relay = mega_windings.spindle_relay};
}

class KeypadOf : public testing::TestWithParam<const char*> {
 protected:
  static Keypad keypad() { return GetParam() == std::string("ramps") ? ramps() : windings(); }
};

TEST_P(KeypadOf, moves_within_its_ramp_and_counts_every_step) {
  const Keypad under_test = keypad();
  Person person(under_test.board, under_test.pins);
  // A host knows the board, so that the status is read.
  static_cast<void>(person.bench().play({{.events = 50, .flips = 1, .interval = 20'000 << 16}}));
  EXPECT_TRUE(person.lit(under_test.pins.automatic_indicator));
  const std::int32_t from = person.status().positions[0];
  person.bench().ports().forget_changes();
  person.press('6', 800);
  EXPECT_EQ(person.status().positions[0], from) << "automatic";
  person.press('#');
  EXPECT_TRUE(person.lit(under_test.pins.manual_indicator));
  EXPECT_FALSE(person.lit(under_test.pins.automatic_indicator));
  EXPECT_NE(person.status().state & board_manual, 0);
  for (const char key : {'6', '9', '1', '0'}) {
    const BoardStatus before = person.status();
    person.bench().ports().forget_changes();
    person.press(key, 1'800);
    const BoardStatus after = person.status();
    const KeyMove jog = jog_of_key.of[key_named(key)];
    const std::vector<SeenSteps> seen = person.bench().seen();
    for (std::size_t m = 0; m < under_test.board.motors.size(); ++m) {
      if ((jog.steps >> m & 1) == 0) {
        EXPECT_TRUE(seen[m].empty()) << key << " motor " << m;
        continue;
      }
      expect_within_ramp(seen[m], under_test.pins.speeds);
      std::int32_t steps = 0;
      for (const SeenStep& step : seen[m]) steps += step.down ? -1 : 1;
      EXPECT_EQ(steps < 0, (jog.down >> m & 1) != 0) << key;
      EXPECT_EQ(after.positions[m] - before.positions[m], steps) << key << " motor " << m;
    }
  }
  EXPECT_LE(person.bench().uart().longest_unwatched(), 600U);
}

TEST_P(KeypadOf, steps_at_once_when_a_key_is_touched_and_by_a_tap_only) {
  const Keypad under_test = keypad();
  Person person(under_test.board, under_test.pins);
  person.press('#');
  person.bench().ports().forget_changes();
  const std::uint64_t touched = person.bench().cycles();
  person.press('8', 200);
  const std::vector<SeenSteps> seen = person.bench().seen();
  ASSERT_EQ(seen[1].size(), under_test.pins.speeds.tap);
  EXPECT_TRUE(seen[1].front().down);
  const double until_step = (static_cast<double>(seen[1].front().time) - static_cast<double>(touched)) / millisecond;
  EXPECT_GE(until_step, 20);
  EXPECT_LE(until_step, 60);
}

TEST_P(KeypadOf, is_stopped_by_a_limit_switch) {
  const Keypad under_test = keypad();
  Person person(under_test.board, under_test.pins);
  person.press('#');
  person.hold('4');
  person.run(1'000);
  person.bench().follow_windings();
  person.bench().ports().forget_changes();
  const auto closed = static_cast<std::int64_t>(person.bench().cycles());
  person.bench().ports().set_input(under_test.limit.port, under_test.limit.bit, false);
  person.run(500);
  const std::vector<SeenSteps> seen = person.bench().seen();
  if (!seen[0].empty()) {
    EXPECT_LE(seen[0].back().time - closed, 60);
  }
  ASSERT_TRUE(person.bench().fault().has_value());
  EXPECT_EQ(person.bench().fault()->reason, FaultReason::limit);
  person.hold('4', false);
  person.run(100);
  person.press('4', 600);
  EXPECT_LE(person.bench().seen()[0].size(), 1U) << "not while the switch is closed";
}

TEST_P(KeypadOf, switches_the_tool_and_tells_a_host) {
  const Keypad under_test = keypad();
  Person person(under_test.board, under_test.pins);
  const Pin button = under_test.pins.tool_button;
  const auto push = [&] {
    person.bench().ports().set_input(button.port, button.bit, false);
    person.run(200);
    person.bench().ports().set_input(button.port, button.bit, true);
    person.run(200);
  };
  push();
  EXPECT_FALSE(person.lit(under_test.relay)) << "automatic";
  person.press('#');
  push();
  EXPECT_TRUE(person.lit(under_test.relay));
  push();
  EXPECT_FALSE(person.lit(under_test.relay));
  push();
  person.bench().start({{.events = 50, .flips = 1, .interval = 20'000 << 16}});
  person.run(200);
  ASSERT_TRUE(person.bench().error().has_value());
  EXPECT_EQ(person.bench().error()->reason, WireError::manual);
  EXPECT_TRUE(person.bench().seen()[0].empty());
  person.press('*');
  EXPECT_FALSE(person.lit(under_test.relay)) << "off with manual mode";
  EXPECT_TRUE(person.bench().play({{.events = 50, .flips = 1, .interval = 20'000 << 16}}).exact());
}

INSTANTIATE_TEST_SUITE_P(Mega, KeypadOf, testing::Values("ramps", "windings"),
                         [](const auto& board) { return std::string(board.param); });

}  // namespace
}  // namespace passo
