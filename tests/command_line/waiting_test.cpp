// passo run and passo jog with a person before them, or without: who waits for whom.
#include "kit/served_board.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::on_router;
using passo::test::Outcome;
using testing::HasSubstr;
using testing::Not;

const std::string stops = "G21 G90 G1 F3000 X2\nM0\nX3\nT2 M6\nX4\nM1\nX5\nM2\n";

class Waiting : public passo::test::ServedBoard {
 protected:
  // On a terminal of its own. `typed`: a shell command that prints what somebody types there.
  Outcome type(const std::string& typed, const std::string& arguments) const {
    const std::string command = "(" + typed + ") | script -qec '" PASSO_PROGRAM " " + arguments + "' " +
                                path("typescript") + " > " + path("screen") + " 2>&1";
    const int status = std::system(command.c_str());
    return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = screen(), .err = {}};
  }
  std::string screen() const { return passo::test::read(path("screen")); }
};

TEST_F(Waiting, a_run_on_a_terminal_asks_at_each_stop_of_the_program) {
  const std::string enters = "for i in 1 2 3; do sleep 0.5; echo; done; sleep 0.5";
  const Outcome outcome = type(enters, "run " + write("p.ngc", stops) + on_router);
  EXPECT_EQ(outcome.code, 0) << screen();
  EXPECT_THAT(screen(), HasSubstr("waits at line 2: program stop (M0). Press Enter to continue."));
  EXPECT_THAT(screen(), HasSubstr("waits at line 4: tool 2 (M6). Press Enter to continue."));
  EXPECT_THAT(screen(), HasSubstr("waits at line 6: optional stop (M1). Press Enter to continue."));
}

TEST_F(Waiting, with_yes_nobody_is_asked) {
  const Outcome outcome = type("sleep 0.2", "run --yes " + write("p.ngc", stops) + on_router);
  EXPECT_EQ(outcome.code, 0) << screen();
  EXPECT_THAT(screen(), Not(HasSubstr("waits at")));
}

TEST_F(Waiting, without_a_terminal_the_virtual_machine_goes_on_and_says_what_it_would_wait_for) {
  const Outcome outcome = passo("run --json " + write("p.ngc", stops) + on_router);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(
      outcome.err,
      HasSubstr(
          "stops for the operator at line 2: program stop (M0); line 4: tool 2 (M6); line 6: optional stop (M1)"));
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["position_mm"]["X"], 5);
}

TEST_F(Waiting, without_a_terminal_a_program_on_a_board_ends_at_its_stop_and_can_go_on_from_there) {
  const std::string command =
      "run --json " + write("p.ngc", stops) + on_router + "--board " + serve("18000000") + " --journal " + path("j");
  const Outcome waits = passo(command + from_here);
  EXPECT_EQ(waits.code, 1) << waits.err;
  EXPECT_THAT(waits.err, HasSubstr("waits at line 2: program stop (M0), but there is no terminal to ask the operator"));
  EXPECT_THAT(waits.err, HasSubstr("[run.waits]"));
  EXPECT_THAT(waits.err, HasSubstr("the machine is stopped at X2.000"));
  // What was not done yet is met again.
  const Outcome again = passo(command + " --resume");
  EXPECT_EQ(again.code, 1) << again.err;
  EXPECT_THAT(again.err, HasSubstr("waits at line 2"));
  const Outcome resumed = passo(command + " --resume --yes");
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_EQ(nlohmann::json::parse(resumed.out)["position_mm"]["X"], 5);
}

TEST_F(Waiting, a_check_says_where_a_program_waits) {
  const Outcome told = passo("check " + write("p.ngc", stops) + on_router);
  EXPECT_EQ(told.code, 0);
  EXPECT_THAT(told.out, HasSubstr("p.ngc: stops for the operator at line 2: program stop (M0); line 4: tool 2 (M6); "
                                  "line 6: optional stop (M1)\n"));
  const auto json = nlohmann::json::parse(passo("check --json " + path("p.ngc") + on_router).out);
  EXPECT_EQ(json["waits"], 3);
  EXPECT_EQ(json["waits_first_at"][1]["line"], 4);
  EXPECT_EQ(json["waits_first_at"][1]["for"], "M6");
  EXPECT_EQ(json["waits_first_at"][1]["tool"], 2);
}

TEST_F(Waiting, what_the_program_says_is_told_where_it_waits) {
  const std::string tools = " --tools " + write("tools.tbl", "T2 P2 D3 ; 3 mm, two flutes\nT3 P3 D3\n");
  const std::string program =
      write("p.ngc", "G21 G90 F3000\n(MSG, Turn the plate)\n(MSG,and clamp it)\nM0\nG1 X3\nT2 M6\nT3 M6 (spare)\nM2\n");
  const std::string words =
      "line 4: program stop (M0): Turn the plate, and clamp it; line 6: tool 2 (M6): 3 mm, two flutes; line 7: tool 3 "
      "(M6): spare";
  EXPECT_THAT(passo("check " + program + on_router + tools).out,
              HasSubstr("stops for the operator at " + words + "\n"));
  const auto json = nlohmann::json::parse(passo("check --json " + program + on_router + tools).out);
  EXPECT_EQ(json["waits_first_at"][0]["message"], "Turn the plate\nand clamp it");
  EXPECT_THAT(passo("run " + program + on_router + tools).err, HasSubstr("stops for the operator at " + words));
  const Outcome outcome =
      type("for i in 1 2 3; do sleep 0.5; echo; done; sleep 0.5", "run " + program + on_router + tools);
  EXPECT_EQ(outcome.code, 0) << screen();
  EXPECT_THAT(screen(), HasSubstr("waits at line 4: program stop (M0): Turn the plate, and clamp it. Press Enter"));
  EXPECT_THAT(screen(), HasSubstr("waits at line 6: tool 2 (M6): 3 mm, two flutes. Press Enter"));
}

// The first loop is never through the check; the second one is, and runs for days.
TEST_F(Waiting, a_program_without_end_is_ended_by_ctrl_c_at_rest_and_writes_nothing) {
  for (const std::string endless : {"o1 while [1]\nG1 X1 F600\nX0\no1 endwhile\nM2\n", "G1 X1 F6\nX0\nM99\n"}) {
    const std::string run =
        "run --json --passes 5000000 " + write("p.ngc", endless) + on_router + "-r " + path("r.txt");
    const std::string line =
        "(sleep 2; kill -INT $$) & exec " PASSO_PROGRAM " " + run + " >" + path("out") + " 2>" + path("err");
    const int status = std::system(("sh -c '" + line + "'").c_str());
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 130);
    EXPECT_EQ(passo::test::read(path("out")), "") << "no summary of an unfinished run";
    EXPECT_THAT(passo::test::read(path("err")), HasSubstr("nothing was written"));
    EXPECT_EQ(files(), std::vector<std::string>{});
  }
}

TEST_F(Waiting, a_jog_moves_a_board_over_a_line) {
  const std::string board = " --board " + serve("18000000");
  const Outcome outcome = passo("jog" + on_router + "X+3 Y-4 -F 3000 --json" + board);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const nlohmann::json json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["ended_by"], "distance");
  EXPECT_NEAR(json["position_mm"]["X"], 3, 1e-3);
  const auto info = nlohmann::json::parse(passo("board info --json " + board.substr(9)).out);
  EXPECT_EQ(info["status"]["positions"][0], 3 * 640);
  const Outcome lease = passo("jog" + on_router + "X+ -F 600 --held 0.2 --lease 0.3 --json" + board);
  ASSERT_EQ(lease.code, 0) << lease.err;
  EXPECT_EQ(nlohmann::json::parse(lease.out)["ended_by"], "lease");
}

TEST_F(Waiting, a_jog_by_keys_moves_while_keys_come) {
  // Held for a moment: a key that a terminal repeats.
  const std::string keys =
      "sleep 0.3; for i in 1 2 3 4 5; do printf \"\\033[C\"; sleep 0.03; done; sleep 0.5; printf \"\\033[5~\"; sleep "
      "0.5; printf q; sleep 0.2";
  const Outcome outcome = type(keys, "jog" + on_router);
  EXPECT_EQ(outcome.code, 0) << screen();
  const std::string last = screen().substr(screen().rfind("Idle"));
  EXPECT_THAT(last, Not(HasSubstr("X0.000"))) << screen();
  EXPECT_THAT(last, HasSubstr("Y0.000"));
  EXPECT_THAT(last, Not(HasSubstr("Z0.000"))) << screen();
}

}  // namespace
