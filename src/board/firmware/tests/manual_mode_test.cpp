#include "passo/firmware/manual_mode.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "board_bench.hpp"

namespace passo {
namespace {

constexpr std::int64_t clock_rate = 16'000'000;
constexpr JogSpeeds speeds = {.start_stop = 400, .highest = 4'000, .acceleration = 16'000, .tap = 4};
constexpr JogRamp ramp = jog_ramp(speeds, clock_rate);
static_assert(can_ramp(speeds, clock_rate));
static_assert(!can_ramp({.start_stop = 200, .highest = 4'000, .acceleration = 16'000}, clock_rate),
              "longer intervals than a segment has");
static_assert(!can_ramp({.start_stop = 400, .highest = 400, .acceleration = 16'000}, clock_rate));

// The person at the keypad.
struct Keys {
  static uint8_t rows() {
    unsigned down = 0;
    for (const char key : held) {
      const Key place = key_named(key);
      if (place % keypad_columns == drawn) down |= 1U << (place / keypad_columns);
    }
    return static_cast<uint8_t>(down);
  }
  static void draw_column(uint8_t column) { drawn = column; }
  static bool tool_button() { return button; }
  static void indicators(bool automatic, bool manual) { lit = automatic ? manual ? "both" : "automatic" : "manual"; }

  static inline std::set<char> held;
  static inline uint8_t drawn = 0;
  static inline bool button = false;
  static inline std::string lit;
};

// The board's output, in ticks.
struct Log {
  void step(std::uint8_t stepped, std::uint8_t directions) {
    for (unsigned m = 0; m < 4; ++m) {
      if ((stepped >> m & 1U) == 0) continue;
      times[m].push_back(now);
      places[m] += (directions >> m & 1U) != 0 ? -1 : 1;
    }
  }
  void outputs(const BoardOutputs& outputs) { switches = outputs.switches; }
  void send(std::uint8_t byte) {
    if (decoder.feed(byte) == Decoded::frame) replies.push_back(decoder.frame());
  }

  std::int64_t now = 0;
  std::vector<std::int64_t> times[4];
  std::int64_t places[4] = {};
  unsigned switches = 0;
  Decoder decoder;
  std::vector<WireFrame> replies;
};

class ManualModeTest : public testing::Test {
 protected:
  using JogBoard = Board<Log, 8>;

  ManualModeTest() {
    Keys::held.clear();
    Keys::button = false;
    log_.decoder.set_motors(4);
    manual_.begin();
  }

  void run(double milliseconds) {
    const std::int64_t end = log_.now + static_cast<std::int64_t>(milliseconds * clock_rate / 1000);
    while (log_.now < end) {
      manual_.feed();
      if (!board_.idle() && due_ == 0) due_ = log_.now + board_.ticks_to_next_event();
      if (due_ != 0 && due_ <= tick_) {
        log_.now = due_;
        due_ = 0;
        board_.on_event();
      } else {
        log_.now = tick_;
        tick_ += 65'536;
        manual_.tick();
      }
    }
  }
  void press(char key, double milliseconds = 60) {
    Keys::held = {key};
    run(milliseconds);
    Keys::held.clear();
    run(600);
  }
  template <class... What>
  void send(const What&... what) {
    send_to(board_, what...);
  }
  BoardStatus status() {
    send(Ask{.motors = 4}, std::uint8_t{0});
    BoardStatus status;
    EXPECT_EQ(log_.replies.back().type, MessageType::status);
    decode(log_.replies.back(), 4, status);
    return status;
  }
  std::string places() {
    const BoardStatus told = status();
    for (unsigned m = 0; m < 4; ++m) EXPECT_EQ(told.positions[m], log_.places[m]) << "the board counts what it steps";
    return std::to_string(told.positions[0]) + " " + std::to_string(told.positions[1]) + " " +
           std::to_string(told.positions[2]);
  }
  void forget_steps() {
    for (auto& times : log_.times) times.clear();
  }

  Log log_;
  JogBoard board_{log_, {.motors = 4, .clock = clock_rate}};
  ManualMode<Keys, JogBoard> manual_{board_, ramp};
  std::int64_t due_ = 0;
  std::int64_t tick_ = 65'536;
};

// Accelerations between stretches of `steps` steps, computed from the times of the steps.
double largest_acceleration(const std::vector<std::int64_t>& times, std::size_t steps) {
  double largest = 0;
  for (std::size_t i = 2 * steps; i < times.size(); ++i) {
    const auto seconds = [&](std::size_t from, std::size_t to) {
      return static_cast<double>(times[to] - times[from]) / clock_rate;
    };
    const double first = seconds(i - 2 * steps, i - steps);
    const double second = seconds(i - steps, i);
    const double change = static_cast<double>(steps) / second - static_cast<double>(steps) / first;
    largest = std::max(largest, std::abs(change) / ((first + second) / 2));
  }
  return largest;
}

// From rest to rest: no step follows another sooner than the start-stop speed and the acceleration allow. The oracle
// knows only times, in whole ticks. From one step to the next, a tick is half of the acceleration at the highest speed.
void expect_within_ramp(const std::vector<std::int64_t>& times) {
  ASSERT_GT(times.size(), 2U);
  const auto speed = [&](std::size_t step) {
    return static_cast<double>(clock_rate) / static_cast<double>(times[step] - times[step - 1]);
  };
  EXPECT_LE(speed(1), speeds.start_stop * 1.05);
  EXPECT_LE(speed(times.size() - 1), speeds.start_stop * 1.05);
  for (std::size_t i = 1; i < times.size(); ++i) ASSERT_LE(speed(i), speeds.highest * 1.001) << "step " << i;
  EXPECT_LE(largest_acceleration(times, 1), speeds.acceleration * 1.6);
  EXPECT_LE(largest_acceleration(times, 4), speeds.acceleration * 1.05);
  EXPECT_LE(largest_acceleration(times, 16), speeds.acceleration * 1.01);
}

TEST_F(ManualModeTest, is_entered_and_left_by_its_keys) {
  run(50);
  EXPECT_EQ(Keys::lit, "automatic");
  press('6');
  EXPECT_EQ(places(), "0 0 0");
  press('#');
  EXPECT_EQ(Keys::lit, "manual");
  EXPECT_EQ(status().state & board_manual, board_manual);
  press('6');
  EXPECT_EQ(places(), "4 0 0");
  press('*');
  EXPECT_EQ(Keys::lit, "automatic");
  EXPECT_EQ(status().state & board_manual, 0);
  press('6');
  EXPECT_EQ(places(), "4 0 0");
}

TEST_F(ManualModeTest, moves_what_the_keys_say) {
  press('#');
  const std::map<char, std::string> moves = {{'1', "-4 4 0"}, {'2', "0 4 0"}, {'3', "4 4 0"},   {'4', "-4 0 0"},
                                             {'5', "0 0 4"},  {'6', "4 0 0"}, {'7', "-4 -4 0"}, {'8', "0 -4 0"},
                                             {'9', "4 -4 0"}, {'0', "0 0 -4"}};
  const std::map<char, char> back = {{'1', '9'}, {'2', '8'}, {'3', '7'}, {'4', '6'}, {'5', '0'},
                                     {'6', '4'}, {'7', '3'}, {'8', '2'}, {'9', '1'}, {'0', '5'}};
  for (const auto& [key, place] : moves) {
    press(key);
    EXPECT_EQ(places(), place) << key;
    press(back.at(key));
    EXPECT_EQ(places(), "0 0 0") << key;
  }
}

TEST_F(ManualModeTest, goes_on_within_its_ramp_while_a_key_is_held) {
  press('#');
  for (const double held : {60.0, 390.0, 480.0, 550.0, 700.0, 2'000.0}) {
    forget_steps();
    const std::int64_t before = log_.places[0];
    press('6', held);
    run(500);
    expect_within_ramp(log_.times[0]);
    EXPECT_EQ(log_.places[0] - before, static_cast<std::int64_t>(log_.times[0].size()));
    EXPECT_EQ(log_.times[0].size() == 4, held < 400) << held;
    places();
  }
  EXPECT_GT(log_.times[0].size(), 4'000U) << "two seconds, most of them at the highest speed";
}

TEST_F(ManualModeTest, stops_when_a_second_finger_comes_down) {
  press('#');
  Keys::held = {'2'};
  run(1'000);
  Keys::held = {'2', '6'};
  run(700);
  const std::size_t steps = log_.times[1].size();
  run(500);
  EXPECT_EQ(log_.times[1].size(), steps);
  EXPECT_TRUE(log_.times[0].empty());
  expect_within_ramp(log_.times[1]);
}

TEST_F(ManualModeTest, takes_a_contact_for_pressed_when_it_has_rested_for_20_milliseconds) {
  press('#');
  for (int i = 0; i < 200; ++i) {
    Keys::held = i % 2 == 0 ? std::set<char>{'6'} : std::set<char>{};
    run(9);
  }
  Keys::held.clear();
  run(100);
  EXPECT_EQ(places(), "0 0 0");
  const std::int64_t pressed = log_.now;
  Keys::held = {'6'};
  run(100);
  const double until_step = static_cast<double>(log_.times[0].front() - pressed) / clock_rate * 1000;
  EXPECT_GE(until_step, 20);
  EXPECT_LE(until_step, 60);
}

TEST_F(ManualModeTest, begins_only_at_rest) {
  send(Hello{.motors = 3}, std::uint8_t{0});
  send(BoardSegment{.events = 2'000, .flips = 1, .interval = 16'000 << 16}, std::uint8_t{3}, std::uint8_t{1});
  press('#');
  EXPECT_EQ(status().state & board_manual, 0) << "it moves";
  run(3'000);
  EXPECT_EQ(places(), "2000 0 0");
  send(Replace{.after = 1, .count = 2}, std::uint8_t{2});
  press('#');
  EXPECT_EQ(status().state & board_manual, 0) << "there is more to come";
}

TEST_F(ManualModeTest, does_not_begin_or_move_at_a_switch_that_stops) {
  for (const std::uint16_t input :
       {std::uint16_t{input_limit}, std::uint16_t{input_limit << 2}, std::uint16_t{input_emergency_stop}}) {
    board_.set_inputs(input);
    press('#');
    EXPECT_EQ(status().state & board_manual, 0) << input;
    board_.set_inputs(0);
    press('#');
    EXPECT_NE(status().state & board_manual, 0) << input;
    board_.set_inputs(input);
    press('6');
    EXPECT_EQ(places(), "0 0 0") << input;
    board_.set_inputs(0);
    press('*');
  }
}

TEST_F(ManualModeTest, is_stopped_by_a_limit_switch_and_begins_anew_behind_it) {
  press('#');
  Keys::held = {'6'};
  run(1'000);
  board_.stop_at_once(input_limit);
  manual_.stopped();
  due_ = 0;
  const std::size_t steps = log_.times[0].size();
  EXPECT_GT(steps, 1'000U);
  run(1'000);
  EXPECT_EQ(log_.times[0].size(), steps) << "though the key is held";
  EXPECT_EQ(status().state & board_trusted, 0);
  Keys::held.clear();
  run(100);
  forget_steps();
  press('4', 800);
  expect_within_ramp(log_.times[0]);
}

TEST_F(ManualModeTest, tells_a_host_and_plays_nothing_of_its_own) {
  const BoardSegment segment{.events = 5, .flips = 1, .interval = 16'000 << 16};
  send(Hello{.motors = 3}, std::uint8_t{0});
  send(Session{.number = 77}, std::uint8_t{0});
  press('#');
  const auto expect_refused = [&](std::uint8_t number) {
    send(segment, std::uint8_t{3}, number);
    ErrorReport error;
    ASSERT_EQ(log_.replies.back().type, MessageType::error);
    decode(log_.replies.back(), error);
    EXPECT_EQ(error.reason, WireError::manual);
    run(100);
    EXPECT_EQ(places(), "0 0 0");
  };
  expect_refused(1);
  EXPECT_EQ(status().session, 0) << "what the host knows is over";
  send(Hello{.motors = 3}, std::uint8_t{9});
  EXPECT_EQ(log_.replies.back().type, MessageType::hello_reply) << "it may ask who that is";
  expect_refused(10);
  press('*');
  send(segment, std::uint8_t{3}, std::uint8_t{10});
  run(100);
  EXPECT_EQ(places(), "0 0 0") << "not before it has said hello";
  send(Hello{.motors = 3}, std::uint8_t{20});
  send(segment, std::uint8_t{3}, std::uint8_t{21});
  run(100);
  EXPECT_EQ(places(), "5 0 0");
}

TEST_F(ManualModeTest, switches_the_tool_by_its_button_once_a_push) {
  const auto push = [this] {
    Keys::button = true;
    run(300);
    Keys::button = false;
    run(100);
  };
  push();
  EXPECT_EQ(log_.switches, 0U);
  press('#');
  push();
  EXPECT_EQ(log_.switches, unsigned{spindle_on});
  push();
  EXPECT_EQ(log_.switches, 0U);
  push();
  press('*');
  EXPECT_EQ(log_.switches, 0U) << "off with manual mode";
}

}  // namespace
}  // namespace passo
