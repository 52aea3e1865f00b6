// --board grbl: a machine that speaks Grbl 1.1, for which passo serve stands.
#include <string>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using testing::HasSubstr;

// The machine lives as long as the command in `commands`, which finds its line as $L.
class GrblMachine : public passo::test::CommandLine {
 protected:
  passo::test::Outcome beside_a_machine(const std::string& commands) const {
    write("said", "");
    const std::string serve = std::string(PASSO_PROGRAM) + " serve --grbl-pty " + path("tty") + " >" + path("said");
    const std::string script = serve + " 2>&1 & daemon=$!; while ! grep -q Ctrl-C " + path("said") +
                               "; do sleep 0.02; done; L=grbl:" + path("tty") + "; ( " + commands + " ) >" +
                               path("out") + " 2>" + path("err") + "; code=$?; kill $daemon; wait $daemon; exit $code";
    const int status = std::system(script.c_str());
    return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            .out = passo::test::read(path("out")),
            .err = passo::test::read(path("err"))};
  }
  static std::string run(const std::string& program, const std::string& more) {
    return std::string(PASSO_PROGRAM) + " run " + program +
           " -m " PASSO_SOURCE_DIR "/examples/machines/router.toml --board $L " + more;
  }
};

// Loops, splines and arcs reach a machine that knows no loops and no splines.
TEST_F(GrblMachine, gets_programs_of_linuxcnc) {
  const std::string program =
      write("p.ngc",
            "G21 G90 G64 P0.05\no<f> sub\nG1 X[#1] Y[#1*2] F6000\no<f> endsub\nM3 S1000\nG0 Z2\n"
            "o<f> call [1]\no<f> call [3]\nG2 X13 Y6 I5 J0\nG5.1 X20 Y20 I2 J5\nG4 P0.05\n"
            "G0 X1 Y1.5 Z0\nM5\nM2\n");
  const auto outcome = beside_a_machine(run(program, "--json"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto all = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(all["position_mm"]["X"], 1.0);
  EXPECT_EQ(all["position_mm"]["Y"], 1.5);
  EXPECT_EQ(all["grbl"]["receive_buffer"], 128);
  EXPECT_GT(all["lines"], 15);
}

TEST_F(GrblMachine, is_held_and_slowed_and_a_hold_may_end_the_run) {
  const std::string program = write("p.ngc", "G21 G90 G1 X20 F6000\nX0\nX20\nX0\nM2\n");
  auto outcome = beside_a_machine(run(program, "-q --hold-at 0.2:0.1 --override 50@0.1"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  outcome = beside_a_machine(run(program, "-q --hold-at 0.2"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("held; the machine was last in the state Hold at X"));
}

TEST_F(GrblMachine, cannot_do_all_and_says_so) {
  const std::string probe = write("p.ngc", "G21 G90\nG38.2 Z-1 F10\nM2\n");
  const auto outcome = beside_a_machine(run(probe, "") + "; [ $? = 2 ] && " + run(probe, "--resume") +
                                        "; [ $? = 2 ] && " PASSO_PROGRAM " jog X1 -m " PASSO_SOURCE_DIR
                                        "/examples/machines/router.toml --board $L");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("p.ngc:2:1: error: a machine that speaks Grbl cannot do this: its probe"));
  EXPECT_THAT(outcome.err, HasSubstr("--resume and --journal"));
  EXPECT_THAT(outcome.err, HasSubstr("[board.grbl]"));
}

}  // namespace
