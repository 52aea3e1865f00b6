// The time left of a job is that of its planned motion: what is told at any moment comes true to the second.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "api_kit.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace passo::test {
namespace {

// First short lines with sharp corners, which hardly reach their feed, then long ones: a pace that changes.
std::string uneven_program() {
  std::string text = "G21 G90 G64 G1 F6000\n";
  for (int i = 1; i <= 300; ++i) text += fmt::format("X{:.2f} Y{}\n", i * 0.2, i % 2 == 0 ? 0 : 1);
  text += "G4 P2\n";
  for (int i = 0; i < 4; ++i) text += fmt::format("X{} F3000\n", i % 2 == 0 ? 0 : 150);
  return text + "G0 X0 Y0\nM2\n";
}

struct Told {
  Seconds at{0};
  Seconds left{0};
};

// What is told while the job runs; `at_half` happens once.
std::vector<Told> told_until_done(ApiRun& run, const std::function<void()>& at_half = {}) {
  std::vector<Told> all;
  bool is_before = true;
  while (run.api.job().state == JobState::checking || run.api.job().state == JobState::running) {
    run.pass(Seconds(0.05));
    const Json status = run.get("/status");
    if (status["left"].is_number()) all.push_back({run.run.session().now(), Seconds(status["left"].get<double>())});
    if (is_before && at_half && status["progress"].is_number() && status["progress"] > 0.5) {
      is_before = false;
      at_half();
    }
  }
  EXPECT_EQ(run.api.job().state, JobState::done);
  return all;
}

void expect_true(const std::vector<Told>& all, Seconds end, Seconds within = Seconds(1)) {
  ASSERT_GT(all.size(), 100U);
  double worst = 0;
  for (const Told& one : all) worst = std::max(worst, std::abs((one.at + one.left - end).value()));
  EXPECT_LT(worst, within.value());
}

TEST(TimeLeft, comes_true_to_the_second_wherever_the_pace_changes) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload(uneven_program());
  const Seconds begin = run.run.session().now();
  run.post(fmt::format("/programs/{}/run", id));
  double planned = 0;
  const std::vector<Told> all =
      told_until_done(run, [&] { planned = run.get(fmt::format("/programs/{}", id))["planned"]; });
  const Seconds end = run.run.session().now();
  expect_true(all, end);
  EXPECT_NEAR(planned, (end - begin).value(), 0.5);
  EXPECT_LT(run.get(fmt::format("/programs/{}", id))["seconds"].get<double>(), planned / 2) << "ramps take their time";
  EXPECT_TRUE(run.get("/status")["left"].is_null());
  EXPECT_EQ(run.get(fmt::format("/programs/{}", id))["state"], "good") << "it has changed no offset";
}

TEST(TimeLeft, follows_the_overrides) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload(uneven_program());
  run.post(fmt::format("/programs/{}/run", id));
  Seconds since{0};
  std::vector<Told> all = told_until_done(run, [&] {
    run.post("/override", R"({"feed": 0.4, "rapids": 0.25})");
    // What is planned already goes on at the speed of before.
    since = run.run.session().now() + Seconds(0.5);
  });
  std::erase_if(all, [&](const Told& one) { return one.at < since; });
  expect_true(all, run.run.session().now());
}

TEST(TimeLeft, stands_still_in_a_hold) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload(uneven_program());
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["progress"].is_number(); }));
  run.pass(Seconds(2));
  run.post("/hold");
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["rests"] == true; }));
  const double before = run.get("/status")["left"];
  run.pass(Seconds(30));
  EXPECT_EQ(run.get("/status")["left"], before);
  run.post("/resume");
  const std::vector<Told> all = told_until_done(run);
  expect_true(all, run.run.session().now());
}

TEST(TimeLeft, of_a_job_that_begins_at_a_line_is_that_of_the_rest) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload(uneven_program());
  run.post(fmt::format("/programs/{}/run?from_line=303&after=70", id));
  ASSERT_EQ(run.status, 202U);
  std::vector<Told> all = told_until_done(run);
  // The way back onto the path is no part of the program.
  const Seconds end = run.run.session().now();
  std::erase_if(all, [&](const Told& one) { return one.at < end - Seconds(8); });
  expect_true(all, end);
}

TEST(MotionTimes, are_bounded_and_exact_between_their_points) {
  MotionTimes times;
  EXPECT_EQ(times.left_from(Seconds(0)), Seconds(0));
  const int moves = 300'000;
  for (int i = 1; i <= moves; ++i) times.add(Seconds(i * 0.5), Seconds(i));
  EXPECT_LE(times.points(), MotionTimes::most_points);
  EXPECT_GT(times.points(), MotionTimes::most_points / 8);
  EXPECT_EQ(times.whole(), Seconds(moves));
  EXPECT_EQ(times.left_from(Seconds(-1)), Seconds(moves));
  EXPECT_EQ(times.left_from(Seconds(1e9)), Seconds(0));
  for (const double at : {0.0, 0.3, 1000.25, 77'777.7, 149'999.9}) {
    EXPECT_NEAR(times.left_from(Seconds(at)).value(), moves - 2 * at, 1e-6) << at;
  }
}

TEST(MotionTimes, are_given_up_when_nobody_wants_them_any_more) {
  const MachineDescription machine = example_machine("router");
  const MotionTiming wanted{
      .name = "a", .text = uneven_program(), .options = {}, .check = {.good = true}, .factors = {}};
  int looks = 0;
  EXPECT_FALSE(time_motion(wanted, machine, [&] { return ++looks < 3; }));
  EXPECT_EQ(looks, 3);
  EXPECT_TRUE(time_motion(wanted, machine, [] { return true; }));
}

}  // namespace
}  // namespace passo::test
