// The first board: its images against their vectors, each key by the windings and by the direction of the lines, how
// long the loop's turns are; and the board's own program, as listed, for comparison.
#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "follower/pic_run.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

const std::filesystem::path all_vectors = std::filesystem::path(PASSO_SOURCE_DIR) / "tests/follower/vectors";

// The images, by name: three of the build, and the listing.
std::filesystem::path image_of(const std::string& name) {
  const std::string folder = name == "first_board_listing" ? PASSO_TEST_IMAGES : PASSO_IMAGES;
  return std::filesystem::path(folder) / (name + ".cod");
}

class FirstBoard : public testing::Test {
 protected:
  void SetUp() override {
    if (!gpsim_is_here()) GTEST_SKIP() << "gpsim is not installed (scripts/install.sh installs it)";
  }
  static FollowerRun run(const std::string& image, const FollowerVector& vector, Turns turns = Turns::unwatched) {
    // Tests run beside one another.
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    const auto work = std::filesystem::path(PASSO_IMAGES) / ("gpsim_" + image + "_" + test);
    const PicFollower board = image.starts_with("first_board") ? PicFollower::first_board : PicFollower::at_20_mhz;
    return run_image_on_pic(board, image_of(image), vector, work, turns);
  }
};

void press(FollowerVector& vector, const std::string& line, int from_ms, int to_ms) {
  vector.lines.push_back({from_ms * Nanoseconds{1'000'000}, line, true});
  vector.lines.push_back({to_ms * Nanoseconds{1'000'000}, line, false});
}

// What an output showed, one value after the other. The listing switches windings one after the other; what lasts only
// as long as that is left out.
std::string shown(const FollowerRun& run, const std::string& output, int from_ms, int to_ms) {
  std::vector<OutputChange> changes;
  std::ranges::copy_if(run.changes, std::back_inserter(changes),
                       [&](const OutputChange& change) { return change.output == output; });
  std::string values;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const bool is_short = i + 1 < changes.size() && changes[i + 1].at < changes[i].at + 10'000;
    if (is_short || changes[i].at / 1'000'000 < from_ms || changes[i].at / 1'000'000 >= to_ms) continue;
    values += (values.empty() ? "" : " ") + changes[i].value;
  }
  return values;
}
// What it showed last; nothing if it never changed.
std::string last_shown(const FollowerRun& run, const std::string& output, int before_ms) {
  const std::string all = shown(run, output, 0, before_ms);
  return all.substr(all.rfind(' ') + 1);
}

// At least three steps that go round like `cycle`. No cycle: no step.
bool goes_round(const std::string& values, const std::string& cycle) {
  if (cycle.empty()) return values.empty();
  return values.size() >= 3 * 5 - 1 && (cycle + " " + cycle + " " + cycle).find(values) != std::string::npos;
}

// F1 F2 F3 F4, step by step.
const std::string on = "1100 0110 0011 1001";
const std::string back = "0110 1100 1001 0011";

struct Key {
  std::string key;
  std::string x;
  std::string y;
  std::string z;
  std::string meaning;
};
const Key keys_of_first_board[] = {
    {"1", back, on, "", "X down, Y up"}, {"2", "", on, "", "Y up"},     {"3", on, on, "", "X and Y up"},
    {"4", back, "", "", "X down"},       {"5", "", "", back, "Z up"},   {"6", on, "", "", "X up"},
    {"7", back, back, "", "X, Y down"},  {"8", "", back, "", "Y down"}, {"9", on, back, "", "X up, Y down"},
    {"0", "", "", on, "Z down"},
};

constexpr int pause_ms = 150;

// Each key is held for a while, one after the other.
FollowerVector play_keys(std::span<const Key> keys, int hold_ms) {
  FollowerVector vector{.name = "keys"};
  press(vector, "key.#", 10, 60);
  int now = 500;
  for (const Key& key : keys) {
    press(vector, "key." + key.key, now, now + hold_ms);
    now += hold_ms + pause_ms;
  }
  vector.end = now * Nanoseconds{1'000'000};
  return vector;
}

void check_keys(const FollowerRun& run, std::span<const Key> keys, int hold_ms) {
  int now = 500;
  for (const Key& key : keys) {
    for (const auto& [output, cycle] : {std::pair{"windings.x", key.x}, {"windings.y", key.y}, {"windings.z", key.z}}) {
      const std::string values = shown(run, output, now, now + hold_ms + pause_ms);
      EXPECT_TRUE(goes_round(values, cycle)) << key.key << ": " << key.meaning << ": " << output << ": " << values;
    }
    now += hold_ms + pause_ms;
  }
}

TEST_F(FirstBoard, turns_each_motor_by_its_keys_as_listed) {
  const FollowerVector vector = play_keys(keys_of_first_board, 96);
  for (const char* image : {"first_board", "first_board_listing"}) {
    SCOPED_TRACE(image);
    check_keys(run(image, vector), keys_of_first_board, 96);
  }
}

// On the other boards 5 raises Z forwards through the windings, as direction 0 does.
TEST_F(FirstBoard, is_the_only_board_on_which_5_turns_z_backwards) {
  const Key keys[] = {{"5", "", "", on, "Z up"}, {"0", "", "", back, "Z down"}};
  check_keys(run("follower_pic_two_on", play_keys(keys, 460)), keys, 460);
}

// So the same motion by the lines needs these levels on the directions: Z alone is the other way round.
TEST_F(FirstBoard, raises_z_by_the_lines_with_direction_1) {
  struct Row {
    char axis;
    bool direction;
    std::string cycle;
    const char* key;  // that moves the axis like this
  };
  const Row rows[] = {{'x', false, on, "6"},  {'x', true, back, "4"}, {'y', false, on, "2"},
                      {'y', true, back, "8"}, {'z', true, back, "5"}, {'z', false, on, "0"}};
  for (const char* image : {"first_board", "first_board_listing"}) {
    FollowerVector vector{.name = "directions"};
    press(vector, "key.*", 10, 60);
    int now = 100;
    for (const Row& row : rows) {
      const std::string axis(1, row.axis);
      vector.lines.push_back({(now - 10) * Nanoseconds{1'000'000}, "direction." + axis, row.direction});
      for (int pulse = 0; pulse < 4; ++pulse) press(vector, "clock." + axis, now + 2 * pulse, now + 2 * pulse + 1);
      now += 20;
    }
    vector.end = now * Nanoseconds{1'000'000};
    const FollowerRun seen = run(image, vector);
    now = 100;
    for (const Row& row : rows) {
      const std::string values = shown(seen, std::string("windings.") + row.axis, now, now + 20);
      EXPECT_TRUE(goes_round(values, row.cycle)) << image << ": like key " << row.key << ": " << values;
      const auto key = std::ranges::find(keys_of_first_board, row.key, &Key::key);
      EXPECT_EQ(row.axis == 'x' ? key->x : row.axis == 'y' ? key->y : key->z, row.cycle);
      now += 20;
    }
  }
}

TEST_F(FirstBoard, does_what_the_vectors_of_its_three_images_say) {
  int played = 0;
  for (const char* image : {"first_board", "first_board_copied", "first_board_as_listed"}) {
    for (const FollowerVector& vector : follower_vectors(all_vectors / image)) {
      EXPECT_EQ(difference(vector, run(image, vector).changes, first_board_outputs()), "") << image;
      ++played;
    }
  }
  EXPECT_GE(played, 7);
}

// Once somebody has pressed `*`, the lines mean the same to all boards.
TEST_F(FirstBoard, does_after_the_automatic_key_what_every_vector_of_lines_alone_says) {
  int played = 0;
  for (const FollowerVector& vector : follower_vectors(all_vectors)) {
    const auto is_reset = [](const LineChange& change) { return change.line == "reset" || change.at == 0; };
    if (vector.needs_keypad() || vector.drive != "two_on" || std::ranges::any_of(vector.lines, is_reset)) continue;
    const FollowerVector later = after_automatic_key(vector, 5);
    EXPECT_EQ(difference(later, run("first_board", later).changes, moved_outputs()), "");
    ++played;
  }
  EXPECT_GE(played, 4);
}

TEST_F(FirstBoard, loses_no_step_while_each_level_lasts_as_long_as_the_manual_says) {
  EXPECT_NE(
      text_of_file(std::filesystem::path(PASSO_SOURCE_DIR) / "docs/follower.md").find("| first board | 36, 39, 48 "),
      std::string::npos);
  const std::uint64_t seed = test::seed();
  for (const Edges edges : {Edges::together, Edges::apart}) {
    FollowerVector vector = after_automatic_key(random_steps(seed, 1'000, 9'600, edges), 5);
    add_fidgeting(vector, seed);
    EXPECT_EQ(difference(vector, run("first_board", vector).changes, moved_outputs()), "") << "PASSO_SEED=" << seed;
  }
}

// The relay's line changes all the time, too. A person at the keypad makes no turn longer.
TEST_F(FirstBoard, turns_in_35_38_47_cycles_with_one_two_three_motors) {
  struct Row {
    const char* axes;
    std::uint64_t most;
  };
  const std::uint64_t seed = test::seed();
  for (const Row& row : {Row{"x", 35}, {"z", 35}, {"xy", 38}, {"yz", 38}, {"xyz", 47}}) {
    for (const bool busy : {false, true}) {
      FollowerVector vector = random_steps(seed, 200, 10'000, Edges::together, row.axes);
      for (int i = 0; i < 200; ++i) vector.lines.push_back({i * vector.end / 200, "relay", i % 2 == 1});
      if (busy) add_fidgeting(vector, seed);
      std::ranges::stable_sort(vector.lines, {}, &LineChange::at);
      vector = after_automatic_key(vector, 5);
      const FollowerRun seen = run("first_board", vector, Turns::watched);
      EXPECT_LE(seen.longest_turn, row.most) << row.axes << (busy ? ", busy" : "") << ", PASSO_SEED=" << seed;
      EXPECT_EQ(difference(vector, seen.changes, winding_outputs()), "") << "PASSO_SEED=" << seed;
    }
  }
}

// 20 ms, and as long as the scan of the keypad takes at most, while three motors step one after the other.
TEST_F(FirstBoard, hears_the_keypad_while_three_motors_step_at_the_highest_rate) {
  FollowerVector vector = manual_mode_at_full_rate(9'600);
  vector = after_automatic_key(vector, 5);
  vector.expected = {{{220'000'000, "led.1", "0"}, 9'100'000}};
  const FollowerRun seen = run("first_board", vector);
  EXPECT_EQ(shown(seen, "led.1", 100, 220), "");
  EXPECT_EQ(shown(seen, "led.1", 220, 230), "0");
}

// ---- The board's own program
// -------------------------------------------------------------------------------------------

constexpr const char* listing = "first_board_listing";

TEST_F(FirstBoard, as_listed_closes_its_relay_while_the_line_is_low) {
  FollowerVector vector{.name = "relay", .end = 300'000'000};
  press(vector, "key.*", 10, 60);
  press(vector, "relay", 100, 200);
  for (const char* image : {"first_board_as_listed", listing}) {
    const FollowerRun seen = run(image, vector);
    EXPECT_EQ(last_shown(seen, "relay", 99), "1") << image;
    EXPECT_EQ(shown(seen, "relay", 100, 300), "0 1") << image;
    EXPECT_EQ(shown(seen, "indicator.relay", 100, 300), "0 1") << image;
    EXPECT_EQ(shown(seen, "led.0", 0, 300), "") << image;
  }
  // The text, which says that the line is copied, contradicts it. Our own image wants an edge.
  for (const char* image : {"first_board", "first_board_copied"}) {
    EXPECT_EQ(shown(run(image, vector), "relay", 0, 300), "1 0") << image;
  }
}

TEST_F(FirstBoard, as_listed_begins_manual_mode_with_the_relays_led_lit_so_that_the_first_push_does_nothing_else) {
  FollowerVector vector{.name = "button", .end = 600'000'000};
  press(vector, "key.#", 10, 60);
  press(vector, "button", 200, 260);
  press(vector, "button", 400, 460);
  for (const char* image : {"first_board_as_listed", listing}) {
    const FollowerRun seen = run(image, vector);
    EXPECT_EQ(last_shown(seen, "indicator.relay", 199), "1") << image;
    EXPECT_EQ(shown(seen, "indicator.relay", 200, 600), "0 1") << image;
    EXPECT_EQ(shown(seen, "relay", 0, 600), "1") << image;
    EXPECT_EQ(last_shown(seen, "led.1", 600), "0") << image;
  }
  EXPECT_EQ(shown(run("first_board", vector), "relay", 0, 600), "1 0");
}

// The counts of manual and automatic mode are separate. The first step up by the lines shows 0110, wherever keys have
// left the motor: it may be right by chance, stand still, go the other way, or turn by two steps.
TEST_F(FirstBoard, as_listed_turns_a_motor_by_up_to_two_steps_after_a_change_of_mode) {
  const std::map<std::string, int> turn = {{"1100", 1}, {"0110", 0}, {"0011", -1}, {"1001", 2}};
  std::set<int> turns;
  for (const int hold : {22, 42, 62}) {
    FollowerVector vector{.name = "modes", .end = 360'000'000};
    press(vector, "key.#", 10, 60);
    press(vector, "key.4", 100, 100 + hold);
    press(vector, "key.*", 250, 310);
    press(vector, "clock.x", 350, 351);
    const FollowerRun seen = run(listing, vector);
    EXPECT_EQ(last_shown(seen, "windings.x", 360), "0110");
    turns.insert(turn.at(last_shown(seen, "windings.x", 250)));
    if (hold != 42) continue;
    const FollowerRun ours = run("first_board", vector);
    const std::string moved = shown(ours, "windings.x", 250, 360);
    EXPECT_TRUE((on + " " + on).find(last_shown(ours, "windings.x", 250) + " " + moved) != std::string::npos) << moved;
  }
  EXPECT_EQ(turns, (std::set<int>{0, 1, 2}));
}

// Its loop never looks at the keypad again: only a reset ends automatic mode.
TEST_F(FirstBoard, as_listed_does_not_leave_automatic_mode_by_a_key) {
  FollowerVector vector{.name = "stays", .end = 500'000'000};
  press(vector, "key.*", 10, 60);
  press(vector, "key.#", 100, 200);
  press(vector, "clock.x", 300, 301);
  EXPECT_EQ(shown(run(listing, vector), "windings.x", 0, 500), "0110");
  EXPECT_EQ(shown(run("first_board", vector), "windings.x", 0, 500), "");
}

}  // namespace
}  // namespace passo
