// Each limit of a stranger's program, tried by one (stranger.cpp).
#include "passo/confinement/confined_run.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <unistd.h>

#include "passo/confinement/confinement.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;
using End = ConfinedRun::End;
using testing::HasSubstr;

class Stranger : public testing::Test {
 protected:
  Stranger() {
    fs::create_directories(dir_ / "own");
    fs::copy_file(PASSO_STRANGER, dir_ / "own" / "stranger");
    std::ofstream(dir_ / "secret") << "secret";
  }
  ~Stranger() override { fs::remove_all(dir_); }
  void SetUp() override {
    const Status<std::string> can = check_confinement();
    if (!can) GTEST_SKIP() << can.error();
  }

  // Limits that are quickly reached.
  static ProgramLimits short_limits() {
    return {.processor_seconds = 1, .waiting_seconds = 1, .total_seconds = 10, .memory = 64U << 20, .output = 1U << 20};
  }
  ConfinedProgram program(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "./stranger");
    return {.folder = (dir_ / "own").string(), .words = arguments, .input = "", .limits = short_limits()};
  }
  static ConfinedRun run(const ConfinedProgram& program) {
    const Result<ConfinedRun, std::string> done = run_confined(program);
    EXPECT_TRUE(done) << (done ? "" : done.error());
    return done ? *done : ConfinedRun{};
  }
  ConfinedRun tries(const std::vector<std::string>& arguments) const { return run(program(arguments)); }
  std::string answer(const std::vector<std::string>& arguments) const { return tries(arguments).output; }
  std::string secret() const { return (dir_ / "secret").string(); }

  fs::path dir_ = fs::temp_directory_path() / ("passo-stranger-" + std::to_string(getpid()));
};

TEST_F(Stranger, gets_its_input_and_answers) {
  ConfinedProgram copies = program({"copy"});
  copies.input = "10\n4\n\n";
  const ConfinedRun done = run(copies);
  EXPECT_EQ(done.end, End::exited);
  EXPECT_EQ(done.output, "10\n4\n\n");
  EXPECT_EQ(describe_end(done, copies.limits), "");
  EXPECT_EQ(describe_end(tries({"exit", "3"}), short_limits()), "ended with exit code 3");
}

TEST_F(Stranger, may_have_threads_but_starts_no_process) {
  EXPECT_EQ(answer({"threads"}), "done\n");
  EXPECT_EQ(answer({"fork"}), "refused: Operation not permitted\n");
}

TEST_F(Stranger, has_no_network) {
  EXPECT_EQ(answer({"socket"}), "refused: Operation not permitted\n");
  EXPECT_EQ(answer({"pair"}), "refused: Operation not permitted\n");
  EXPECT_EQ(answer({"streams"}), "done\n");
}

TEST_F(Stranger, reads_and_writes_in_its_own_folder_alone) {
  EXPECT_EQ(answer({"read", "stranger"}), "done\n");
  EXPECT_EQ(answer({"write", "note"}), "done\n");
  EXPECT_EQ(answer({"write", "/dev/null"}), "done\n");
  EXPECT_EQ(answer({"remove", "note"}), "done\n");
  const std::string outside = "refused: Permission denied\n";
  EXPECT_EQ(answer({"read", "/etc/passwd"}), outside);
  EXPECT_EQ(answer({"read", "/proc/self/environ"}), outside);
  EXPECT_EQ(answer({"read", secret()}), outside);
  EXPECT_EQ(answer({"write", secret()}), outside);
  EXPECT_EQ(answer({"write", (dir_ / "new").string()}), outside);
  EXPECT_EQ(answer({"write", "../new"}), outside);
  EXPECT_EQ(answer({"remove", secret()}), outside);
  EXPECT_FALSE(fs::exists(dir_ / "new"));
}

TEST_F(Stranger, changes_nothing_of_a_file_outside_its_folder) {
  for (const char* change : {"truncate", "chmod", "times"}) {
    EXPECT_THAT(answer({change, secret()}), HasSubstr("refused")) << change;
  }
  EXPECT_EQ(fs::file_size(secret()), 6U);
  EXPECT_NE(fs::status(secret()).permissions(), fs::perms::none);
}

TEST_F(Stranger, does_not_touch_other_processes) {
  const std::string tests = std::to_string(getpid());
  for (const char* way : {"kill", "owner", "limit", "trace"}) {
    EXPECT_EQ(answer({way, tests}), "refused: Operation not permitted\n") << way;
  }
  EXPECT_EQ(answer({"kill", "-1"}), "refused: Operation not permitted\n");
}

TEST_F(Stranger, reads_other_folders_that_are_named) {
  ConfinedProgram reads = program({"read", secret()});
  reads.readable = {dir_.string()};
  EXPECT_EQ(run(reads).output, "done\n");
  ConfinedProgram writes = program({"write", secret()});
  writes.readable = {dir_.string()};
  EXPECT_EQ(run(writes).output, "refused: Permission denied\n");
}

TEST_F(Stranger, is_stopped_when_it_uses_up_its_processor_time) {
  for (const char* way : {"spin", "deaf-spin"}) {
    const ConfinedRun spun = tries({way});
    EXPECT_EQ(spun.end, End::processor_time) << way;
    EXPECT_EQ(describe_end(spun, short_limits()), "used more than 1 s of processor time");
  }
}

TEST_F(Stranger, is_stopped_when_it_waits_without_an_end) {
  EXPECT_EQ(tries({"sleep"}).end, End::waits);
  EXPECT_EQ(tries({"deaf"}).end, End::waits);  // whatever signals it ignores
}

TEST_F(Stranger, is_stopped_when_it_writes_too_much) {
  const ConfinedRun endless = tries({"endless"});
  EXPECT_EQ(endless.end, End::too_much_output);
  EXPECT_EQ(endless.output.size(), std::size_t{1} << 20);
  EXPECT_EQ(tries({"complain"}).end, End::too_much_output);
  EXPECT_EQ(tries({"folder"}).end, End::too_much_output);
  EXPECT_EQ(describe_end(endless, short_limits()), "wrote more than 1 MB");
}

TEST_F(Stranger, gets_no_more_memory_than_its_limit) {
  const ConfinedRun eaten = tries({"memory"});
  EXPECT_EQ(eaten.end, End::crashed);
  EXPECT_EQ(eaten.code, SIGABRT);
  EXPECT_LT(eaten.peak_memory, std::uint64_t{64} << 20);
  EXPECT_THAT(describe_end(eaten, short_limits()), HasSubstr("64 MB are allowed"));
}

TEST_F(Stranger, that_crashes_or_cannot_be_started_is_a_result) {
  const ConfinedRun crashed = tries({"crash"});
  EXPECT_EQ(crashed.end, End::crashed);
  EXPECT_EQ(describe_end(crashed, short_limits()), "crashed: Segmentation fault");
  ConfinedProgram missing = program({});
  missing.words = {"./missing"};
  EXPECT_EQ(describe_end(run(missing), short_limits()), "cannot be started: No such file or directory");
}

TEST_F(Stranger, that_is_a_script_runs_in_the_systems_shell) {
  std::ofstream(dir_ / "own" / "script") << "#!/bin/sh\nread a; echo \"$a $HOME\"\n";
  fs::permissions(dir_ / "own" / "script", fs::perms::owner_all);
  ConfinedProgram script = program({});
  script.words = {"./script"};
  script.input = "7\n";
  EXPECT_EQ(run(script).output, "7 " + script.folder + "\n");
}

// Without confinement the limits hold, and nothing of it remains.
TEST_F(Stranger, that_is_not_confined_is_killed_with_what_it_has_started) {
  ConfinedProgram free = program({"fork"});
  free.unconfined = true;
  EXPECT_EQ(run(free).output, "done\n");
  free.words = {"./stranger", "leave"};
  EXPECT_EQ(run(free).end, End::exited);
  free.words = {"./stranger", "sleep"};
  EXPECT_EQ(run(free).end, End::waits);
}

}  // namespace
}  // namespace passo
