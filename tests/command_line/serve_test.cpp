// passo board serve: the board of a machine file, for many who look and one who drives, until it is told to end.
#include <csignal>
#include <filesystem>
#include <string>

#include "kit/served_board.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;

class ServeCommand : public passo::test::ServedBoard {
 protected:
  static std::string machine(const std::string& name) {
    return (std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "machines" / name).string();
  }
};

// The router's board counts 18 million ticks a second, the Uno's 16 million and holds 31 items.
TEST_F(ServeCommand, is_the_board_of_the_machine_file) {
  const std::string program = write("p.ngc", "G21 G90 G1 F3000 X3 Y1\nX0\nM2\n");
  for (const std::string name : {"router.toml", "uno.toml", "bench.toml"}) {
    const std::string board = serve("", machine(name));
    const Outcome outcome = passo("run " + program + " -q -m " + machine(name) + from_here + " --board " + board);
    EXPECT_EQ(outcome.code, 0) << name << outcome.err;
    EXPECT_THAT(read(path("said")), HasSubstr(name == "router.toml" ? "18000000 ticks" : "16000000 ticks"));
  }
  const std::string board = serve("12000000", machine("router.toml"));
  EXPECT_EQ(passo("run " + program + " -q -m " + machine("router.toml") + from_here + " --board " + board).code, 1);
}

TEST_F(ServeCommand, for_senders_an_address_that_others_reach_must_be_asked_for_in_words) {
  const auto outcome = passo("serve --grbl-tcp 0.0.0.0:0");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("serve.open-port"));
  EXPECT_EQ(passo("serve --grbl-tcp nowhere").code, 2);
}

TEST_F(ServeCommand, shows_itself_to_many_while_a_job_runs) {
  const std::string board = serve("", machine("router.toml"));
  const std::string program = write("p.ngc", "G21 G90 G1 F600 X2\nX0\nX2\nX0\nM2\n");
  const std::string command = std::string(PASSO_PROGRAM) + " run " + program + " -q -m " + machine("router.toml") +
                              from_here + " --board " + board + " >" + path("run.out") + " 2>" + path("run.err") +
                              "; echo $? >" + path("code");
  ASSERT_EQ(std::system(("( " + command + " ) &").c_str()), 0);
  const std::string monitor = std::string(PASSO_PROGRAM) + " board monitor --json --every 0.01 --count 40 " + board;
  ASSERT_EQ(
      std::system(("( " + monitor + " >" + path("one") + " ) & " + monitor + " >" + path("two") + "; wait").c_str()),
      0);
  bool moved = false;
  for (int i = 0; i < 600 && !std::filesystem::exists(path("code")); ++i, usleep(50'000)) {
    const Outcome info = passo("board info --json " + board);
    ASSERT_EQ(info.code, 0) << info.err;
    moved = moved || nlohmann::json::parse(info.out)["status"]["moves"] == true;
  }
  for (int i = 0; i < 100 && read(path("code")).empty(); ++i) usleep(50'000);
  EXPECT_TRUE(moved);
  EXPECT_EQ(read(path("code")), "0\n") << read(path("run.err"));
  const std::string two = read(path("two"));
  EXPECT_EQ(std::count(two.begin(), two.end(), '\n'), 40);
}

TEST_F(ServeCommand, ends_by_ctrl_c_by_kill_and_with_its_terminal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::string board = serve();
    ASSERT_EQ(passo("board info " + board).code, 0);
    EXPECT_EQ(end_server(signal), 128 + signal);
    EXPECT_EQ(passo("board info " + board).code, 1) << "it is gone";
  }
}

// A reader that has seen enough kills nobody: neither who looks, nor the board.
TEST_F(ServeCommand, outlives_readers_that_go) {
  const std::string board = serve();
  const std::string look = std::string("trap '' USR1; { ") + PASSO_PROGRAM +
                           " board monitor --every 0.01 --count 500 " + board + "; echo $? >" + path("code") +
                           "; } | head -n 2 >" + path("head");
  ASSERT_EQ(std::system(look.c_str()), 0);
  for (int i = 0; i < 200 && read(path("code")).empty(); ++i) usleep(50'000);
  EXPECT_EQ(read(path("code")), "141\n");
  EXPECT_EQ(passo("board info " + board).code, 0);
  signal_server(SIGPIPE);
  EXPECT_EQ(passo("board info " + board).code, 0);
}

}  // namespace
