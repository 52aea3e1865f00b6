// Faults on the line to a machine that is followed: each one that matters is noticed, and nothing is sent twice.
#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "followed_pair.hpp"
#include "kit/grbl_contour.hpp"
#include "kit/in_full.hpp"
#include "kit/man_in_the_middle.hpp"
#include "kit/seed.hpp"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace passo {
namespace {

// What came of a fault.
enum class FaultOutcome : std::uint8_t {
  noticed,
  harmless,  // the machine has made the same motion
  small,     // a deviation within the tolerance, or one that began and ended between two reports
  missed,
};
constexpr std::array outcome_names = {"noticed", "harmless", "too small or too short", "MISSED"};

std::string spoilt(test::ManInTheMiddle& man, bool to_board, const std::string& bytes) {
  const test::Bytes passed = man(to_board, test::Bytes(bytes.begin(), bytes.end()));
  return {passed.begin(), passed.end()};
}

struct Trial {
  FaultOutcome outcome = FaultOutcome::missed;
  std::string told;
  double most_beside = 0;    // mm
  double noticed_after = 0;  // s from the fault
  bool sent_twice = false;
};

// One frame is spoilt, of the motion.
Trial try_fault(test::Mischief mischief, bool to_board, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const test::GrblContour contour = test::random_grbl_contour(random);
  const int at = std::uniform_int_distribution<int>(100, 1800)(random);
  FollowedPair pair;
  EXPECT_TRUE(pair.begin());
  test::ManInTheMiddle man(mischief, seed, 1, 1);
  Trial trial;
  int step = 0;
  Seconds spoilt_at{-1};
  double beside_since = -1;
  double longest_beside = 0;
  int looks = 0;
  Seconds asked_since{0};
  bool late = false;
  pair.between = [&](bool to, const std::string& bytes) {
    if (to) ++step;
    const bool is_chosen = man.faults == 0 && step >= at && bytes.size() >= 2;
    if (to != to_board || (!is_chosen && !late) || (late && bytes.empty())) return bytes;
    const std::string passed = spoilt(man, to, bytes);
    if (spoilt_at < Seconds(0)) spoilt_at = pair.now;
    late = passed.empty() && (mischief == test::Mischief::swap || mischief == test::Mischief::delay);
    return passed;
  };
  const bool ends = pair.run(
      contour.lines,
      [&] {
        // An operator, who is asked to go on.
        if (pair.sender.waits_for().empty()) asked_since = pair.now;
        if (pair.now - asked_since > Seconds(1)) pair.sender.resume();
        if (++looks % 4 != 0) return;
        const double off = test::beside(contour, pair.machine.place());
        trial.most_beside = std::max(trial.most_beside, off);
        if (off < 0.05) beside_since = -1;
        if (off >= 0.05 && beside_since < 0) beside_since = pair.now.value();
        if (beside_since >= 0) longest_beside = std::max(longest_beside, pair.now.value() - beside_since);
        if (pair.sender.fault() && trial.noticed_after == 0) trial.noticed_after = (pair.now - spoilt_at).value();
      },
      Seconds(120));
  EXPECT_TRUE(ends) << "it does not end: seed " << seed;
  trial.sent_twice = pair.sender.lines_sent() > contour.lines.size() + 4;  // $I $$ $# $G
  if (pair.sender.fault()) {
    trial.outcome = FaultOutcome::noticed;
    trial.told = pair.sender.fault()->code;
  } else if (trial.most_beside < 0.005 && pair.machine.parser_modes().speed > 0) {
    trial.outcome = FaultOutcome::harmless;
  } else if (longest_beside < 2 * GrblSender::between_questions.value() + 0.05) {
    trial.outcome = FaultOutcome::small;
  }
  return trial;
}

// Each kind of fault in turn, in both directions.
TEST(GrblLineFaults, are_noticed_or_do_nothing) {
  const int trials = test::in_full() > 0 ? 1000 : 48;
  std::array<std::array<int, 4>, test::every_mischief.size()> table{};
  double latest = 0;
  for (int i = 0; i < trials; ++i) {
    const std::size_t kind = static_cast<std::size_t>(i) % test::every_mischief.size();
    const std::uint64_t seed = test::first_seed(4900) + static_cast<std::uint64_t>(i);
    const bool to_board = i / static_cast<int>(test::every_mischief.size()) % 4 != 0;
    const Trial trial = try_fault(test::every_mischief[kind], to_board, seed);
    ++table[kind][static_cast<std::size_t>(trial.outcome)];
    EXPECT_NE(trial.outcome, FaultOutcome::missed)
        << name_of(test::every_mischief[kind]) << ", seed " << seed << ": " << trial.most_beside << " mm beside";
    EXPECT_FALSE(trial.sent_twice) << "seed " << seed;
    if (trial.outcome == FaultOutcome::noticed) latest = std::max(latest, trial.noticed_after);
  }
  for (std::size_t kind = 0; kind < table.size(); ++kind) {
    fmt::print("{:8}", name_of(test::every_mischief[kind]));
    for (std::size_t i = 0; i < outcome_names.size(); ++i) fmt::print("  {} {}", table[kind][i], outcome_names[i]);
    fmt::print("\n");
  }
  fmt::print("noticed within {:.2f} s\n", latest);
}

// What happens at the board during motion, and when and how it is told.
struct Accident {
  const char* name;
  std::function<void(FollowedPair&)> happens;
  std::vector<std::string> codes;
};

TEST(GrblLineFaults, an_accident_in_motion_ends_in_a_stated_state_within_two_seconds) {
  const auto unplug = [](FollowedPair& pair) { pair.between = [](bool, const std::string&) { return std::string(); }; };
  const std::vector<Accident> accidents = {
      {"a reset by DTR", [](FollowedPair& pair) { pair.machine.restart(); }, {"grbl.restarted"}},
      {"a reset with a slow start",
       [](FollowedPair& pair) {
         pair.machine.boot_time = 1.6;
         pair.machine.restart();
       },
       {"grbl.restarted"}},
      {"a banner", [](FollowedPair& pair) { pair.machine.say("\r\nGrbl 1.1h ['$' for help]"); }, {"grbl.restarted"}},
      {"a device that vanishes", [](FollowedPair& pair) { pair.sender.lose(); }, {"grbl.line-lost"}},
      {"a line that is cut", unplug, {"grbl.no-answer"}},
      {"a line that is cut for a second",
       [](FollowedPair& pair) {
         const Seconds end = pair.now + Seconds(1);
         pair.between = [&pair, end](bool, const std::string& bytes) { return pair.now < end ? std::string() : bytes; };
       },
       {"grbl.lost-lines", "grbl.off-path", "grbl.lost-bytes", "grbl.error", "grbl.no-answer"}},
      {"another program resets it",
       [](FollowedPair& pair) { pair.machine.receive("\x18"); },
       {"grbl.alarm", "grbl.restarted"}},
      {"another program moves it",
       [](FollowedPair& pair) { pair.machine.receive("G91G0X5Y5\nG90\n"); },
       {"grbl.lost-lines", "grbl.off-path", "grbl.changed-line", "grbl.error"}},
  };
  for (const Accident& accident : accidents) {
    for (unsigned at = 1; at <= 5; ++at) {
      std::mt19937_64 random(at);
      const test::GrblContour contour = test::random_grbl_contour(random);
      FollowedPair pair;
      ASSERT_TRUE(pair.begin());
      static_cast<void>(pair.run(contour.lines, {}, Seconds(1.37 * at)));
      ASSERT_FALSE(pair.sender.fault()) << accident.name;
      const std::uint64_t sent = pair.sender.lines_sent();
      accident.happens(pair);
      const Seconds happened = pair.now;
      static_cast<void>(pair.play_for(Seconds(5), [&] { return pair.sender.fault().has_value(); }));
      ASSERT_TRUE(pair.sender.fault()) << accident.name << " at " << happened.value();
      EXPECT_LE((pair.now - happened).value(), 2) << accident.name;
      EXPECT_THAT(accident.codes, testing::Contains(pair.sender.fault()->code)) << accident.name;
      const bool told_lines = pair.sender.fault()->last_line > 0;
      EXPECT_TRUE(told_lines) << accident.name;
      EXPECT_LE(pair.sender.lines_sent(), sent + 20) << "a few lines at most after it";
      ASSERT_TRUE(pair.play_for(Seconds(20), [&] { return pair.sender.stopped(); })) << accident.name;
      pair.machine.run(3);
      EXPECT_EQ(pair.machine.speed(), 0) << accident.name;
      const std::size_t done = pair.machine.done().size();
      static_cast<void>(pair.play_for(Seconds(3), [] { return false; }));
      EXPECT_EQ(pair.machine.done().size(), done) << "nothing is sent after it: " << accident.name;
    }
  }
}

}  // namespace
}  // namespace passo
