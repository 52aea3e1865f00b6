// The time left of a job on a Grbl board is that of the board's own planner.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "kit/example_machine.hpp"
#include "kit/grbl_session_run.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "passo/api/web_api.hpp"
#include "passo/sender/grbl_times.hpp"

namespace passo::test {
namespace {

using Told = std::pair<Seconds, Seconds>;  // at that time so much was left
using Times = std::vector<Told>;

// Times programs at once, as the board plans them.
class GrblPromptTimer final : public MotionTimer {
 public:
  explicit GrblPromptTimer(const GrblSessionRun& run) : run_(run) {}
  void begin(MotionTiming wanted) override {
    GrblTiming timing = told();
    timing.limits.feed_factor = wanted.factors.feed;
    timing.limits.rapid_factor = wanted.factors.rapids;
    MotionTimes times;
    GrblTimes predicted(ProgramReader::from_text(wanted.name, wanted.text), run_.description, wanted.options, timing,
                        [&](Seconds nominal, Seconds planned) { times.add(nominal, planned); });
    while (!predicted.go_on(100)) continue;
    found_ = times;
  }
  std::optional<MotionTimes> take_times() override { return std::exchange(found_, std::nullopt); }
  std::uint64_t basis() override { return told().is_known() ? 1 : 0; }

 private:
  GrblTiming told() const {
    const GrblMachine& board = run_.session.board();
    return {.limits = limits_of(board),
            .line = {.bytes_per_second = 0, .buffer = board.bytes},
            .target = GrblTarget::of(board)};
  }
  const GrblSessionRun& run_;
  std::optional<MotionTimes> found_;
};

// An API on a Grbl board, in virtual time.
class GrblApiRun {
 public:
  GrblApiRun() {
    EXPECT_TRUE(run.go_online());
    key_ = ask("POST", "/owner", R"({"name": "test"})")["key"];
  }
  nlohmann::json ask(const std::string& method, const std::string& path, const std::string& body = "") {
    const std::size_t mark = std::min(path.find('?'), path.size());
    const WebAnswer answer = api.answer({.method = method,
                                         .path = "/api/v1" + path.substr(0, mark),
                                         .query = path.substr(std::min(mark + 1, path.size())),
                                         .key = key_,
                                         .type = "",
                                         .body = body});
    EXPECT_LT(answer.status, 300U) << path << ": " << answer.body;
    return nlohmann::json::parse(answer.body, nullptr, false);
  }
  void poll() {
    run.session.poll(Seconds(0.02));
    const auto changes = run.session.take_changes();
    api.on_change(changes);
    api.poll();
  }
  std::uint64_t upload(const std::string& text) { return ask("POST", "/programs", text)["id"]; }
  // Plays the job to its end, and returns what was told. `at_half` happens once.
  Times told_until_done(const std::function<void()>& at_half = {}) {
    Times all;
    bool is_before = true;
    while (api.job().state == JobState::checking || api.job().state == JobState::running) {
      poll();
      const auto left = api.time_left();
      if (left) all.emplace_back(run.session.now(), *left);
      const auto progress = run.session.status().progress;
      if (!is_before || !at_half || !progress || *progress < 0.5) continue;
      is_before = false;
      at_half();
    }
    EXPECT_EQ(api.job().state, JobState::done);
    return all;
  }

  GrblSessionRun run{example_machine("router")};
  GrblPromptTimer timer{run};
  MachineControl owner;
  WebApi api{run.description,
             run.session,
             owner,
             {.version = "1", .openapi = "{}", .make_key = [] { return "key"; }, .page = {}, .timer = &timer}};

 private:
  std::string key_;
};

double worst_of(const Times& all, Seconds end) {
  double worst = 0;
  for (const auto& [at, left] : all) worst = std::max(worst, std::abs((at + left - end).value()));
  return worst;
}

// Short lines with sharp corners, then a dwell, long lines, and arcs.
std::string uneven_program() {
  std::string text = "G21 G90 G1 F3000\n";
  for (int i = 1; i <= 300; ++i) text += fmt::format("X{:.2f} Y{}\n", i * 0.2, i % 2 == 0 ? 0 : 1);
  text += "G4 P5\n";
  for (int i = 0; i < 4; ++i) text += fmt::format("X{} F1500\n", i % 2 == 0 ? 0 : 150);
  for (int i = 0; i < 8; ++i)
    text += fmt::format("G2 X{} Y0 I{} J0 F900\n", i % 2 == 0 ? 190 : 150, i % 2 == 0 ? 20 : -20);
  return text + "G0 X0 Y0\nM2\n";
}

TEST(GrblTimeLeft, is_that_of_the_boards_planner) {
  GrblApiRun run;
  const std::uint64_t id = run.upload(uneven_program());
  run.ask("POST", fmt::format("/programs/{}/run", id));
  double planned = 0;
  const Times all =
      run.told_until_done([&] { planned = run.ask("GET", fmt::format("/programs/{}", id))["planned"].get<double>(); });
  const Seconds end = run.run.session.now();
  ASSERT_GT(all.size(), 1000U);
  const Seconds taken = end - all.front().first;
  EXPECT_NEAR(planned, taken.value(), 0.01 * taken.value());
  EXPECT_LT(worst_of(all, end), 0.01 * taken.value()) << "of " << taken.value() << " s";
}

TEST(GrblTimeLeft, follows_the_overrides) {
  GrblApiRun run;
  run.ask("POST", fmt::format("/programs/{}/run", run.upload(uneven_program())));
  Seconds since{0};
  Times all = run.told_until_done([&] {
    run.ask("POST", "/override", R"({"feed": 0.5, "rapids": 0.25})");
    since = run.run.session.now() + Seconds(0.5);  // the bytes go one after the other
  });
  std::erase_if(all, [&](const Told& one) { return one.first < since; });
  const Seconds end = run.run.session.now();
  ASSERT_GT(all.size(), 500U);
  const Seconds taken = end - all.front().first;
  EXPECT_LT(worst_of(all, end), 0.01 * taken.value()) << "of " << taken.value() << " s";
}

TEST(GrblTimeLeft, stands_still_in_a_hold) {
  GrblApiRun run;
  run.ask("POST", fmt::format("/programs/{}/run", run.upload(uneven_program())));
  const auto play = [&](double seconds) {
    for (const Seconds end = run.run.session.now() + Seconds(seconds); run.run.session.now() < end;) run.poll();
  };
  play(8);
  run.ask("POST", "/hold");
  play(2);
  const auto before = run.api.time_left();
  ASSERT_TRUE(before);
  play(30);
  EXPECT_EQ(run.api.time_left(), before);
  run.ask("POST", "/resume");
  const Seconds resumed = run.run.session.now();
  run.told_until_done();
  const Seconds taken = run.run.session.now() - resumed;
  EXPECT_NEAR(before->value(), taken.value(), 0.01 * taken.value());
}

TEST(GrblTimeLeft, of_a_job_that_begins_at_a_line_is_that_of_the_rest) {
  GrblApiRun run;
  run.ask("POST", fmt::format("/programs/{}/run?from_line=303", run.upload(uneven_program())));
  Times all = run.told_until_done();
  const Seconds end = run.run.session.now();
  // The way to the path is no part of the program.
  std::erase_if(all, [&](const Told& one) { return one.first < end - Seconds(30); });
  ASSERT_GT(all.size(), 500U);
  EXPECT_LT(worst_of(all, end), 0.3);
}

}  // namespace
}  // namespace passo::test
