// What an operator chooses before and amid a job: single block, optional stop, block delete.
#include <filesystem>
#include <memory>

#include "pipeline/api_kit.hpp"

namespace passo {
namespace {

using test::ApiRun;
using test::Json;

bool holds_at_line(ApiRun& run) {
  return run.turn_until([&] {
    const Json status = run.get("/status");
    return status["rests"] == true && status["holds"] == Json::array({"line-end"});
  });
}

TEST(ApiStops, single_block_rests_after_each_line_of_a_job) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload("G21 G90 G1 F1200\nX10\nX10 Y10\nM2\n");
  run.post("/stops", R"({"single_block": true})");
  EXPECT_EQ(run.get("/status")["stops"], Json({{"single_block", true}, {"optional_stop", true}}));
  run.post(fmt::format("/programs/{}/run", id));
  ASSERT_TRUE(holds_at_line(run));
  EXPECT_EQ(run.get("/status")["state"], "Hold");
  EXPECT_NEAR(run.get("/status")["place"]["x"].get<double>(), 10, 0.05);
  run.post("/stops", R"({"single_block": false})");
  EXPECT_EQ(run.get("/status")["state"], "Hold");
  run.post("/resume");
  EXPECT_EQ(run.status, 200U);
  ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "done"; }));
  EXPECT_EQ(run.get("/status")["place"]["y"], 10.0);
}

TEST(ApiStops, are_chosen_by_the_owner_of_motion) {
  ApiRun run;
  run.post("/stops", R"({"single_block": true})");
  EXPECT_EQ(run.status, 403U);
}

TEST(ApiStops, lines_with_a_slash_are_left_out_on_wish) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload("G21 G90 G1 F1200\nX3\n/X5\n /X7 (seven)\nM2\n");
  const std::string program = fmt::format("/programs/{}", id);
  EXPECT_EQ(run.get(program)["deleted_lines"], 2);
  EXPECT_EQ(run.get(program)["block_delete"], false);
  for (const bool leaves_out : {false, true, false}) {
    EXPECT_EQ(run.post(program + "/block-delete", Json({{"on", leaves_out}}).dump())["block_delete"], leaves_out);
    run.post(program + "/run");
    ASSERT_TRUE(run.turn_until_state("Run"));
    run.post(program + "/block-delete", Json({{"on", !leaves_out}}).dump());
    EXPECT_EQ(run.status, 409U) << "it runs";
    ASSERT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "done"; }));
    EXPECT_EQ(run.get("/status")["place"]["x"], leaves_out ? 3.0 : 7.0);
  }
}

TEST(ApiStops, grbl_runs_lines_with_a_slash) {
  ApiRun run;
  run.own();
  const std::uint64_t id = run.upload("G21 G90 G1 F1200\n/X5\n", "?dialect=grbl");
  EXPECT_EQ(run.get(fmt::format("/programs/{}", id))["deleted_lines"], 0);
  EXPECT_EQ(run.post(fmt::format("/programs/{}/block-delete", id), R"({"on": true})")["error"]["code"],
            "http.bad-body");
}

// While a job runs, the history keeps a text that means the same, whatever is chosen later.
TEST(ApiStops, a_job_keeps_the_choice_of_lines) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("passo-stops-" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  {
    const std::unique_ptr<JobHistory> history = std::move(*JobHistory::open((folder / "jobs").string()));
    ApiRun run(test::GrblRun::at_zero(), history.get());
    run.own();
    const std::uint64_t id = run.upload("G21 G90 G1 F1200\nX3\n/X5\nM2\n");
    run.post(fmt::format("/programs/{}/block-delete", id), R"({"on": true})");
    run.post(fmt::format("/programs/{}/run", id));
    ASSERT_TRUE(run.turn_until_state("Run"));
    EXPECT_EQ(history->program_of(1), "G21 G90 G1 F1200\nX3\n;/X5\nM2\n");
    run.ask("POST", "/queue?name=b.ngc&block_delete=true", "/G1 X9\nM2");
    EXPECT_EQ(history->program_of(2), ";/G1 X9\nM2");
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace passo
