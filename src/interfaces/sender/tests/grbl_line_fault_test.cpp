// Faults on the line to a machine that is followed: each one that matters is noticed, and nothing is sent twice.
#include <array>
#include <cmath>
#include <random>

#include "followed_pair.hpp"
#include "kit/in_full.hpp"
#include "kit/man_in_the_middle.hpp"
#include "kit/seed.hpp"
#include <gtest/gtest.h>

namespace passo {
namespace {

// What came of a fault.
enum class Outcome : std::uint8_t {
  noticed,
  harmless,  // the machine has made the same motion
  small,     // a deviation within the tolerance, or one that began and ended between two reports
  missed,
};
constexpr std::array outcome_names = {"noticed", "harmless", "too small or too short", "MISSED"};

struct Contour {
  std::vector<std::string> lines;
  std::vector<Point> points = {Point()};
};

// Random moves of 4 to 12 mm, at changing feeds and spindle speeds.
Contour random_contour(std::mt19937_64& random) {
  Contour contour{.lines = {"M3S1000"}};
  const auto number = [&](int from, int to) { return std::uniform_int_distribution<int>(from, to)(random); };
  Point place;
  for (int i = 0; i < 40; ++i) {
    const double angle = 0.001 * number(0, 6283);
    const double length = number(4, 12);
    place[Axis::x] += std::round(length * std::cos(angle) * 1e4) / 1e4;
    std::string line = i == 0 ? "G1F1500" : number(0, 9) == 0 ? fmt::format("F{}", number(6, 18) * 100) : "";
    line += fmt::format("X{:.4f}", place[Axis::x]);
    if (i == 0 || number(0, 4) != 0) {
      place[Axis::y] += std::round(length * std::sin(angle) * 1e4) / 1e4;
      line += fmt::format("Y{:.4f}", place[Axis::y]);
    }
    contour.lines.push_back(line);
    contour.points.push_back(place);
    if (number(0, 19) == 0) contour.lines.push_back(fmt::format("M3S{}", number(5, 20) * 100));
  }
  contour.lines.emplace_back("G4P0");
  return contour;
}

double beside(const Contour& contour, const Point& place) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < contour.points.size(); ++i) {
    const Point& from = contour.points[i - 1];
    const Point way = contour.points[i] - from;
    const Point to = place - from;
    const double length2 = way[Axis::x] * way[Axis::x] + way[Axis::y] * way[Axis::y];
    const double along = to[Axis::x] * way[Axis::x] + to[Axis::y] * way[Axis::y];
    const Point foot = from + way * std::clamp(length2 > 0 ? along / length2 : 0, 0.0, 1.0);
    nearest = std::min(
        nearest, std::hypot(place[Axis::x] - foot[Axis::x], place[Axis::y] - foot[Axis::y]) + std::abs(place[Axis::z]));
  }
  return nearest;
}

std::string spoilt(test::ManInTheMiddle& man, bool to_board, const std::string& bytes) {
  const test::Bytes passed = man(to_board, test::Bytes(bytes.begin(), bytes.end()));
  return {passed.begin(), passed.end()};
}

struct Trial {
  Outcome outcome = Outcome::missed;
  std::string told;
  double most_beside = 0;    // mm
  double noticed_after = 0;  // s from the fault
  bool sent_twice = false;
};

// One frame is spoilt, of the motion.
Trial try_fault(test::Mischief mischief, bool to_board, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const Contour contour = random_contour(random);
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
        const double off = beside(contour, pair.machine.place());
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
    trial.outcome = Outcome::noticed;
    trial.told = pair.sender.fault()->code;
  } else if (trial.most_beside < 0.005 && pair.machine.parser_modes().speed > 0) {
    trial.outcome = Outcome::harmless;
  } else if (longest_beside < 2 * GrblSender::between_questions.value() + 0.05) {
    trial.outcome = Outcome::small;
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
    EXPECT_NE(trial.outcome, Outcome::missed)
        << name_of(test::every_mischief[kind]) << ", seed " << seed << ": " << trial.most_beside << " mm beside";
    EXPECT_FALSE(trial.sent_twice) << "seed " << seed;
    if (trial.outcome == Outcome::noticed) latest = std::max(latest, trial.noticed_after);
  }
  for (std::size_t kind = 0; kind < table.size(); ++kind) {
    fmt::print("{:8}", name_of(test::every_mischief[kind]));
    for (std::size_t i = 0; i < outcome_names.size(); ++i) fmt::print("  {} {}", table[kind][i], outcome_names[i]);
    fmt::print("\n");
  }
  fmt::print("noticed within {:.2f} s\n", latest);
}

}  // namespace
}  // namespace passo
