// Single pulses by the API are those that the board makes, at its times.
#include <cstring>

#include "api_kit.hpp"
#include <gtest/gtest.h>

#include "passo/machine/machine_observer.hpp"

namespace passo::test {
namespace {

struct Step {
  std::int64_t tick = 0;
  std::uint8_t stepped = 0;
  std::uint8_t down = 0;
};

class Watcher final : public MachineObserver {
 public:
  void on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) override {
    steps.push_back({time.count, stepped, static_cast<std::uint8_t>(directions & stepped)});
  }
  std::vector<Step> steps;
};

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

struct Answer {
  double begin = 0;
  double end = 0;
  double newest = 0;
  std::vector<std::int32_t> counts;
  std::vector<Step> steps;  // ticks since `begin`
};
Answer pulses(ApiRun& run, const std::string& query) {
  const std::string body = run.api.answer({.method = "GET", .path = "/api/v1/pulses", .query = query}).body;
  Answer answer;
  EXPECT_GE(body.size(), 80U) << body;
  if (body.size() < 80) return answer;
  answer.begin = number_at<double>(body, 0);
  answer.end = number_at<double>(body, 8);
  answer.newest = number_at<double>(body, 24);
  for (std::size_t i = 0; i < 8; ++i) answer.counts.push_back(number_at<std::int32_t>(body, 40 + 4 * i));
  for (std::size_t at = 80; at < body.size(); at += 8) {
    const auto stepped = number_at<std::uint8_t>(body, at + 4);
    const auto down = static_cast<std::uint8_t>(number_at<std::uint8_t>(body, at + 5) & stepped);
    answer.steps.push_back({number_at<std::uint32_t>(body, at), stepped, down});
  }
  return answer;
}

TEST(ApiPulses, are_those_of_the_board_to_the_tick) {
  ApiRun run;
  Watcher watcher;
  run.run.board().add_observer(watcher);
  run.own();
  run.turn_until_state("Idle");
  const std::uint64_t id = run.upload("G21 G1 X3 Y-2 F600\nG2 X5 Y0 I2 J0\nG1 X4.9 F100\nM2\n");
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(run.turn_until([&] { return run.api.job().state == JobState::done; })) << run.get("/status");
  ASSERT_GT(watcher.steps.size(), 1000U);
  std::vector<Step> told;
  Answer part = pulses(run, "from=0&to=20");
  const double begin = part.begin;
  const double tick = 1 / run.run.description().board.clock.value();
  for (int parts = 0; parts < 100; ++parts) {
    for (Step step : part.steps) {
      step.tick += std::llround((part.begin - begin) / tick);
      if (told.empty() || step.tick > told.back().tick) told.push_back(step);
    }
    if (part.end >= part.newest - 1e-9) break;
    part = pulses(run, fmt::format("from={:.9f}&to={:.9f}", part.end, part.end + 20));
  }
  ASSERT_EQ(told.size(), watcher.steps.size());
  const std::int64_t off = told.front().tick - watcher.steps.front().tick;
  for (std::size_t i = 0; i < told.size(); ++i) {
    ASSERT_NEAR(static_cast<double>(told[i].tick - watcher.steps[i].tick - off), 0, 2) << i;
    ASSERT_EQ(told[i].stepped, watcher.steps[i].stepped) << i;
    ASSERT_EQ(told[i].down, watcher.steps[i].down) << i;
  }
  // The counts at the end are where the machine stands: 4.9 mm and 0 mm.
  const Answer end = pulses(run, fmt::format("from={0:.9f}&to={0:.9f}", part.newest));
  EXPECT_NEAR(end.counts[0] / run.run.description().axes[0].steps_per_unit, 4.9, 0.01);
  EXPECT_NEAR(end.counts[1], 0, 1);
}

TEST(ApiPulses, refuse_what_is_no_time_and_know_a_machine_that_never_moved) {
  ApiRun run;
  EXPECT_TRUE(pulses(run, "").steps.empty());
  EXPECT_TRUE(pulses(run, "from=-5&to=-9").steps.empty());
  EXPECT_TRUE(pulses(run, "from=1e300&to=1e308").steps.empty());
  for (const char* const query : {"from=x", "to=1e", "from=1&to=nanny", "from=nan", "to=inf"}) {
    EXPECT_EQ(run.api.answer({.method = "GET", .path = "/api/v1/pulses", .query = query}).status, 400U) << query;
  }
}

}  // namespace
}  // namespace passo::test
