// Faults on the line to Grbl 1.1h on the emulated Uno, one in each trial, with the steps counted at its pins: each
// fault is noticed, or the steps are those of the program. PASSO_RUNS=1000 runs 1,000 trials (about an hour).
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <random>

#include "kit/command_line.hpp"
#include "kit/grbl_contour.hpp"
#include "kit/man_in_the_middle.hpp"
#include "kit/real_grbl.hpp"
#include "kit/seed.hpp"

#include "passo/sender/grbl_sender.hpp"

namespace {

using passo::Axis;
using passo::GrblSender;
using passo::Seconds;
namespace test = passo::test;

constexpr double steps_per_mm = 250;

// The steps of X, Y and Z at the pins.
using Steps = std::array<long, 3>;

class FollowedUno {
 public:
  explicit FollowedUno(const std::string& folder, const std::string& program)
      : counts_(folder + "/counts"),
        process_({program, test::grbl_peers + "/grbl-1.1h-uno.elf", folder + "/tty", "--speed", "1"}, folder, counts_),
        line_(test::open_when_there(folder + "/tty")) {
    // A new EEPROM takes a while.
    test::RealTalker talker(dup(line_));
    talker.listen(40, std::chrono::seconds(15));
    for (const char* setting : {"$120=500\n", "$121=500\n", "$110=6000\n", "$111=6000\n"}) talker.ask(setting, 1);
  }
  ~FollowedUno() { close(line_); }
  FollowedUno(const FollowedUno&) = delete;
  FollowedUno& operator=(const FollowedUno&) = delete;

  // A clean start at the present place.
  bool begin() {
    test::RealTalker talker(dup(line_));
    talker.ask("\x18", 2);
    talker.ask("$X\n", 1);
    talker.ask("G92X0Y0Z0\n", 1);
    sender = std::make_unique<GrblSender>(GrblSender::on_open_line(now()));
    if (!play(Seconds(20), [&] { return sender->ready() || sender->fault(); }) || !sender->ready()) return false;
    sender->follow(*sender->place());
    return true;
  }
  template <class IsSo>
  bool play(Seconds most, IsSo is_so, const std::function<void()>& each = {}) {
    for (const Seconds end = now() + most; now() < end;) {
      if (is_so()) return true;
      if (each) each();
      const std::string bytes = pass(true, sender->take_bytes(now()));
      if (!bytes.empty()) static_cast<void>(!::write(line_, bytes.data(), bytes.size()));
      pollfd wanted{.fd = line_, .events = POLLIN, .revents = 0};
      std::string came;
      if (poll(&wanted, 1, 5) > 0) {
        std::array<char, 4096> buffer{};
        const ssize_t count = ::read(line_, buffer.data(), buffer.size());
        if (count > 0) came.assign(buffer.data(), static_cast<std::size_t>(count));
      }
      sender->receive(pass(false, came), now());
    }
    return is_so();
  }
  Steps steps() {
    process_.write("counts\n");
    for (int i = 0; i < 100; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const std::string all = test::read(counts_);
      const auto lines = static_cast<std::size_t>(std::count(all.begin(), all.end(), '\n'));
      if (lines <= lines_seen_) continue;
      lines_seen_ = lines;
      Steps steps{};
      const std::size_t at = all.rfind("steps");
      if (at != std::string::npos &&
          std::sscanf(all.c_str() + at, "steps %ld %ld %ld", &steps[0], &steps[1], &steps[2]) == 3) {
        return steps;
      }
    }
    return {};
  }
  Seconds now() const {
    return Seconds(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count());
  }

  std::function<std::string(bool, const std::string&)> between = {};
  std::unique_ptr<GrblSender> sender;

 private:
  std::string pass(bool to_board, const std::string& bytes) const { return between ? between(to_board, bytes) : bytes; }

  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
  std::string counts_;
  test::ChildProcess process_;
  int line_;
  std::size_t lines_seen_ = 1;  // the first one is the name of the terminal
};

enum class Outcome : std::uint8_t { noticed, harmless, missed };
constexpr std::array outcome_names = {"noticed", "all steps made", "MISSED"};

class RealGrblLineFaults : public test::CommandLine {
 protected:
  void SetUp() override {
    if (!test::has_grbl_peers()) GTEST_SKIP() << "no ../shared/peers/grbl beside the checkout";
  }
};

Outcome try_fault(FollowedUno& uno, test::Mischief mischief, bool to_board, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const test::GrblContour contour = test::random_grbl_contour(random, 8);
  const double at = std::uniform_real_distribution<double>(0.05, 2)(random);
  uno.between = {};
  EXPECT_TRUE(uno.begin()) << (uno.sender->fault() ? uno.sender->fault()->message : "");
  const Steps before = uno.steps();
  const Seconds begun = uno.now();
  test::ManInTheMiddle man(mischief, seed, 1, 1);
  bool late = false;
  uno.between = [&](bool to, const std::string& bytes) -> std::string {
    const bool is_chosen = man.faults == 0 && (uno.now() - begun).value() >= at && bytes.size() >= 2;
    if (to != to_board || (!is_chosen && !late) || (late && bytes.empty())) return bytes;
    const test::Bytes passed = man(to, test::Bytes(bytes.begin(), bytes.end()));
    late = passed.empty() && (mischief == test::Mischief::swap || mischief == test::Mischief::delay);
    return {passed.begin(), passed.end()};
  };
  std::size_t next = 0;
  const bool ends = uno.play(
      Seconds(60), [&] { return (next == contour.lines.size() && uno.sender->at_rest()) || uno.sender->stopped(); },
      [&] {
        for (; uno.sender->wants_lines() && next < contour.lines.size() && !uno.sender->fault(); ++next) {
          uno.sender->add(contour.lines[next], static_cast<std::uint32_t>(next + 1));
        }
        if (!uno.sender->waits_for().empty()) uno.sender->resume();
      });
  EXPECT_TRUE(ends) << "it does not end: seed " << seed;
  EXPECT_LE(uno.sender->lines_sent(), contour.lines.size() + 4) << "a line was sent twice: seed " << seed;
  uno.between = {};
  const Steps after = uno.steps();
  if (uno.sender->fault()) return Outcome::noticed;
  const passo::Point& end = contour.points.back();
  const bool is_there = std::abs(after[0] - before[0] - std::lround(end[Axis::x] * steps_per_mm)) <= 1 &&
                        std::abs(after[1] - before[1] - std::lround(end[Axis::y] * steps_per_mm)) <= 1 &&
                        after[2] == before[2];
  if (!is_there) {
    ADD_FAILURE() << name_of(mischief) << ", seed " << seed << ": " << after[0] - before[0] << " "
                  << after[1] - before[1] << " steps instead of " << end[Axis::x] * steps_per_mm << " "
                  << end[Axis::y] * steps_per_mm;
  }
  return is_there ? Outcome::harmless : Outcome::missed;
}

TEST_F(RealGrblLineFaults, are_noticed_or_all_steps_are_made) {
  const std::string program = test::built_uno(path(""));
  if (program.empty()) GTEST_SKIP() << "grbl_on_uno does not build here: libsimavr is missing";
  FollowedUno uno(path(""), program);
  const std::uint64_t trials = test::number_of("PASSO_RUNS", 3);
  std::array<std::array<int, 3>, test::every_mischief.size()> table{};
  for (std::uint64_t i = 0; i < trials; ++i) {
    const std::size_t kind = i % test::every_mischief.size();
    const bool to_board = i / test::every_mischief.size() % 4 != 3;
    const Outcome outcome = try_fault(uno, test::every_mischief[kind], to_board, test::first_seed(4900) + i);
    ++table[kind][static_cast<std::size_t>(outcome)];
  }
  for (std::size_t kind = 0; kind < table.size(); ++kind) {
    fmt::print("{:8}", name_of(test::every_mischief[kind]));
    for (std::size_t i = 0; i < outcome_names.size(); ++i) fmt::print("  {:4} {}", table[kind][i], outcome_names[i]);
    fmt::print("\n");
  }
}

}  // namespace
