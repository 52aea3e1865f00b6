// A session tells what the board has executed, whatever lies between: a line whose refills come in pieces, holds, and
// rests because a refill came too late.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "kit/stage_test.hpp"
#include "pipeline/session_kit.hpp"

#include "passo/activity/program.hpp"

namespace passo {
namespace {

using test::SessionRun;
using test::start_of;

// All along one axis at one feed: the share of the steps is the share of the nominal time.
std::string program() {
  std::string text = "G21 G90 G61 G1 F1200\n";
  for (int i = 1; i <= 120; ++i) text += "X" + std::to_string(i % 2 == 0 ? i * 0.1 : i * 0.1 + 0.7) + "\n";
  return text + "X-30\nX30\nM2\n";
}

// The greatest difference between the progress that is told and the share of the steps that the board has made.
double worst_progress(bool over_a_line, const std::function<void(SessionRun&)>& at_a_third = {}) {
  const MachineDescription machine = test::short_router();
  const auto start = [&] {
    request::Start wanted = start_of(program());
    Diagnostics findings;
    wanted.nominal_time =
        check_program(ProgramReader::from_text("t", program()), machine, wanted.options, findings).nominal_time;
    return wanted;
  };
  std::int64_t whole = 0;
  double worst = 0;
  for (const bool looks : {false, true}) {
    SessionRun run(machine, {.line = over_a_line});
    run.make_ready();
    run.taken(start());
    bool is_before = true;
    while (run.session().busy()) {
      run.poll(Seconds(0.05));
      const auto progress = run.session().status().progress;
      if (!looks || !progress || !run.session().busy()) continue;
      const double made = static_cast<double>(run.steps_made()) / static_cast<double>(whole);
      worst = std::max(worst, std::abs(*progress - made));
      if (is_before && at_a_third && made > 0.33) {
        is_before = false;
        at_a_third(run);
      }
    }
    whole = run.steps_made();
  }
  return worst;
}

TEST(SessionProgress, is_what_the_board_has_executed) {
  EXPECT_LT(worst_progress(false), 0.02);
  EXPECT_LT(worst_progress(true), 0.02);
}

TEST(SessionProgress, is_right_behind_a_hold) {
  const auto hold = [](SessionRun& run) {
    run.taken(request::Hold{});
    run.pass(Seconds(3));
    run.taken(request::Resume{});
  };
  EXPECT_LT(worst_progress(false, hold), 0.02);
  EXPECT_LT(worst_progress(true, hold), 0.02);
}

TEST(SessionProgress, is_right_behind_a_rest_that_a_cut_line_has_made) {
  const auto cut = [](SessionRun& run) { run.line().cut(run.now(), Seconds(1)); };
  EXPECT_LT(worst_progress(true, cut), 0.02);
}

}  // namespace
}  // namespace passo
