// A server of a machine is killed amid a job, and the next one resumes the job: the motors make the same steps in the
// same order as without trouble.
#include <cstdio>
#include <cstdlib>
#include <random>

#include "job_kit.hpp"
#include "kit/in_full.hpp"
#include "kit/seed.hpp"
#include "probe_kit.hpp"

namespace passo::test {
namespace {

const std::string part =
    "G21 G90 G64 P.02 F3000 M3 S1000\nG4 P.1\nG2 X6 Y0 I3 J0\nG3 X9 I1.5\nG1 X4 Y3\nM8\nG4 P.05\nX12 Z-1\nX2 Y2\n"
    "G0 X5 Y1 Z2\nM5 M9\nM2\n";

const StepLog& whole_run() {
  static const auto bench = [] {
    auto whole = std::make_unique<JobBench>(example_machine("router"));
    JobServer server(*whole);
    server.run(part);
    EXPECT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "done");
    return whole;
  }();
  return bench->log;
}

void expect_the_whole_way(const JobBench& bench) {
  expect_same_way(bench.log.steps, whole_run().steps);
  expect_within_limits(bench.description, bench.log.steps, 6);
  EXPECT_EQ(bench.log.place, whole_run().place);
}

class JobRestart : public testing::Test {
 protected:
  JobBench bench_{example_machine("router")};
};

TEST_F(JobRestart, tells_what_was_broken_off_and_goes_on_when_asked) {
  try {
    JobServer server(bench_, 150, HostEnd::behind_frame);
    server.run(part);
    server.to_end();
    FAIL() << "it lives";
  } catch (const HostDied&) {
  }
  JobServer server(bench_);
  const auto steps_before = bench_.log.place;
  const auto told = server.get("/interrupted")["interrupted"];
  ASSERT_TRUE(told.is_object()) << told;
  EXPECT_EQ(told["job"]["name"], "part.ngc");
  EXPECT_EQ(told["job"]["state"], "interrupted");
  EXPECT_EQ(told["goes_on"], true) << told;
  EXPECT_GT(told["line"], 2);
  EXPECT_EQ(told["steps"]["x"], bench_.log.place[0]);
  EXPECT_EQ(told["steps"]["y"], bench_.log.place[1]);
  server.turn_until([] { return false; }, Seconds(3));
  EXPECT_EQ(bench_.log.place, steps_before) << "never by itself";
  server.post("/interrupted/resume");
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done");
  expect_the_whole_way(bench_);
  EXPECT_EQ(server.get("/history")["jobs"][0]["state"], "done");
  EXPECT_TRUE(server.get("/interrupted")["interrupted"].is_null());
}

TEST_F(JobRestart, a_job_that_counts_from_a_zero_of_the_work_goes_on_from_the_same_zero) {
  const std::string far = R"({"place": {"z": 1}})";
  JobBench whole(example_machine("router"));
  {
    JobServer server(whole);
    server.post("/work", far);
    server.run(part);
    ASSERT_TRUE(server.to_end());
  }
  try {
    JobServer server(bench_, 150, HostEnd::behind_frame);
    server.post("/work", far);
    EXPECT_EQ(server.status, 200U);
    server.run(part);
    server.to_end();
    FAIL() << "it lives";
  } catch (const HostDied&) {
  }
  JobServer server(bench_);
  EXPECT_EQ(server.get("/interrupted")["interrupted"]["goes_on"], true);
  server.post("/work", R"({"place": {"x": 0}})");
  EXPECT_EQ(server.status, 409U) << "the job needs its zero";
  server.post("/interrupted/resume");
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done");
  expect_same_way(bench_.log.steps, whole.log.steps);
}

TEST_F(JobRestart, another_job_waits_until_the_old_one_is_resumed_or_dropped) {
  try {
    JobServer server(bench_, 150, HostEnd::behind_frame);
    server.run(part);
    server.to_end();
  } catch (const HostDied&) {
  }
  JobServer server(bench_);
  const auto program = server.ask("POST", "/programs", "G21 G91 G1 X1 F600\nM2\n");
  const std::string run = fmt::format("/programs/{}/run", program["id"].get<int>());
  EXPECT_EQ(server.post(run)["error"]["code"], "jobs.interrupted");
  EXPECT_EQ(server.status, 409U);
  server.ask("DELETE", "/interrupted");
  EXPECT_EQ(server.status, 200U);
  EXPECT_TRUE(server.get("/interrupted")["interrupted"].is_null());
  EXPECT_EQ(server.post("/interrupted/resume")["error"]["code"], "http.not-found");
  EXPECT_EQ(server.get("/history")["jobs"][0]["state"], "interrupted") << "the history keeps it";
  server.post(run);
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done");
}

TEST_F(JobRestart, the_machine_may_be_moved_away_and_back_before) {
  try {
    JobServer server(bench_, 150, HostEnd::behind_frame);
    server.run(part);
    server.to_end();
  } catch (const HostDied&) {
  }
  JobServer server(bench_);
  const auto jog = [&](double way) {
    server.post("/jog", fmt::format(R"({{"direction": {{"y": {}}}, "speed": 600, "distance": 1, "lease": 5}})", way));
    server.turn_until([&] { return server.session().state() == MachineState::idle; });
  };
  jog(1);
  EXPECT_EQ(server.get("/interrupted")["interrupted"]["code"], "resume.counts-differ");
  EXPECT_EQ(server.post("/interrupted/resume")["error"]["code"], "resume.counts-differ");
  jog(-1);
  EXPECT_EQ(server.get("/interrupted")["interrupted"]["goes_on"], true);
  server.post("/interrupted/resume");
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done");
  EXPECT_EQ(bench_.log.place, whole_run().place);
}

TEST_F(JobRestart, a_server_that_is_told_to_end_leaves_a_job_that_can_go_on) {
  {
    JobServer server(bench_);
    server.run(part);
    server.turn_until([&] { return bench_.log.place[0] > 900; });
    server.api().leave();
    server.post("/stop");
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "interrupted");
  }
  JobServer server(bench_);
  server.post("/interrupted/resume");
  EXPECT_EQ(server.status, 202U) << server.get("/interrupted");
  ASSERT_TRUE(server.to_end());
  expect_the_whole_way(bench_);
}

TEST_F(JobRestart, a_job_that_somebody_stopped_is_not_taken_up) {
  {
    JobServer server(bench_);
    server.run(part);
    server.turn_until([&] { return bench_.log.place[0] > 900; });
    server.post("/stop");
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "stopped");
  }
  JobServer server(bench_);
  EXPECT_TRUE(server.get("/interrupted")["interrupted"].is_null());
}

// The cable is out for longer than the server waits. After a reset the job goes on, in the same server.
TEST_F(JobRestart, a_job_whose_board_was_silent_goes_on_after_a_reset) {
  JobServer server(bench_);
  server.run(part);
  server.turn_until([&] { return bench_.log.place[0] > 900; });
  bench_.line->cut(bench_.board->elapsed(), Seconds(6));
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "interrupted");
  bench_.let_pass(Seconds(7));
  server.post("/reset");
  ASSERT_TRUE(server.turn_until([&] { return server.session().state() == MachineState::idle; }));
  server.poll();
  EXPECT_EQ(server.get("/interrupted")["interrupted"]["goes_on"], true) << server.get("/interrupted");
  server.post("/interrupted/resume");
  ASSERT_TRUE(server.to_end());
  EXPECT_EQ(server.job_state(), "done");
  expect_the_whole_way(bench_);
}

// The last line tells where each of both probe moves met the plate.
TEST(JobRestartAmidProbing, goes_on_from_what_was_found) {
  const std::string probing =
      "G21 G90 G0 X1 Y1 Z2\nF600 G38.2 Z-8\n#31=#5063\nG0 Z1\nX5\nF200 G38.2 Z-8\nG0 Z1\nG1 X[9+#31] Y[9+#5063] "
      "F3000\nM2\n";
  const std::vector<Touchable> things = {below(Axis::z, -3.75)};
  JobBench whole(example_machine("router"), things);
  std::uint64_t moments = 0;
  {
    JobServer server(whole);
    server.run(probing);
    ASSERT_TRUE(server.to_end());
    moments = server.moments();
  }
  for (std::uint64_t life = moments / 4; life < moments; life += moments / 4) {
    SCOPED_TRACE(life);
    JobBench bench(example_machine("router"), things);
    try {
      JobServer server(bench, life, HostEnd::behind_frame);
      server.run(probing);
      server.to_end();
    } catch (const HostDied&) {
    }
    JobServer server(bench);
    const auto told = server.get("/interrupted")["interrupted"];
    ASSERT_EQ(told["goes_on"], true) << told;
    server.post("/interrupted/resume");
    ASSERT_TRUE(server.to_end());
    EXPECT_EQ(server.job_state(), "done") << server.get("/status");
    EXPECT_EQ(bench.log.place, whole.log.place);
  }
}

// Servers die at random moments, up to five in a row; the first that nobody kills ends the job.
void die_at_random(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  JobBench bench(example_machine("router"));
  const int deaths = 1 + static_cast<int>(random() % 5);
  bool done = false;
  for (int life = 0; !done && life < 60; ++life) {
    const std::uint64_t dies_at = life < deaths ? 20 + random() % 400 : never;
    const auto end = static_cast<HostEnd>(random() % 3);
    try {
      JobServer server(bench, dies_at, end);
      if (server.get("/interrupted")["interrupted"].is_object()) {
        server.post("/interrupted/resume");
        ASSERT_EQ(server.status, 202U) << server.get("/interrupted");
      } else if (bench.log.steps[0].empty()) {
        server.run(part);
      } else {
        break;  // it had come to its end
      }
      ASSERT_TRUE(server.to_end());
      ASSERT_EQ(server.job_state(), "done") << server.get("/status")["job"];
      done = true;
    } catch (const HostDied&) {
      bench.let_pass(Seconds(0.02 * static_cast<double>(random() % 40)));
    }
  }
  expect_the_whole_way(bench);
}

TEST(JobRestartAtRandom, ends_as_if_nothing_had_been) {
  for (std::uint64_t i = 0; i < test::number_of("PASSO_RUNS", 12) && !testing::Test::HasFailure(); ++i) {
    SCOPED_TRACE(fmt::format("PASSO_SEED={}, trial {}", seed(), i));
    die_at_random(seed() + i);
  }
}

}  // namespace
}  // namespace passo::test
