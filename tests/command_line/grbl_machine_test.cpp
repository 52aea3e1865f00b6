// --board grbl: a machine that speaks Grbl 1.1, for which passo serve stands, or a fake one with other firmware.
#include <string>

#include "kit/command_line.hpp"
#include "kit/fake_grbl.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::StrictGrbl;
using passo::test::FakeGrbl;
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

// Also without the web interface: a zero of zeros would move the machine elsewhere.
TEST_F(GrblMachine, gives_its_work_zero_to_the_senders_of_a_server) {
  const std::string other = path("other");
  const std::string serve = std::string(PASSO_PROGRAM) +
                            " serve -m " PASSO_SOURCE_DIR "/examples/machines/router.toml --board $L --grbl-pty " +
                            other;
  const auto outcome = beside_a_machine(
      "exec 3<>" + path("tty") + R"(; printf '$X\nG10L2P1X50\n' >&3; sleep 0.3; exec 3>&-; )" + serve + " >" +
      path("told") + " 2>&1 & server=$!; until grep -q Ctrl-C " + path("told") + "; do sleep 0.02; done; exec 4<>" +
      other + R"(; printf '$#\n' >&4; timeout 5 grep -m1 G54 <&4; code=$?; kill $server; wait $server; exit $code)");
  EXPECT_EQ(outcome.code, 0) << passo::test::read(path("told"));
  EXPECT_THAT(outcome.out, HasSubstr("[G54:50.000,"));
}

TEST_F(GrblMachine, is_held_and_slowed_and_a_hold_may_end_the_run) {
  const std::string program = write("p.ngc", "G21 G90 G1 X20 F6000\nX0\nX20\nX0\nM2\n");
  auto outcome = beside_a_machine(run(program, "-q --hold-at 0.2:0.1 --override 50@0.1"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  outcome = beside_a_machine(run(program, "-q --hold-at 0.2"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("held; the machine was last in state Idle at X"));
  outcome = beside_a_machine(run(write("m0.ngc", "G21 G90\nM0\nM2\n"), "-q </dev/null"));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("m0.ngc waits at line 2"));
  EXPECT_THAT(outcome.err, testing::Not(HasSubstr("--resume"))) << "a Grbl machine cannot";
}

TEST_F(GrblMachine, cannot_do_all_and_says_so) {
  const std::string thread = write("p.ngc", "G21 G90 G18\nM3 S100\nG33 Z-1 K0.5\nM2\n");
  const auto outcome = beside_a_machine(run(thread, "") + "; [ $? = 2 ] && " + run(thread, "--resume"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("p.ngc:3:1: error: a machine with Grbl cannot do this"));
  EXPECT_THAT(outcome.err, HasSubstr("--resume and --journal"));
}

TEST_F(GrblMachine, is_jogged) {
  const auto outcome = beside_a_machine(PASSO_PROGRAM " jog X3 Y-1 -m " PASSO_SOURCE_DIR
                                                      "/examples/machines/router.toml --board $L --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto all = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(all["ended_by"], "distance");
  EXPECT_NEAR(all["position_mm"]["X"].get<double>(), 3, 5e-3);
}

// Beside a fake machine, which is greeted without a delay.
class FakeGrblMachine : public passo::test::CommandLine {
 protected:
  passo::test::Outcome beside(const FakeGrbl& machine, const std::string& command) const {
    EXPECT_TRUE(machine.listens());
    return passo(command + " -m " PASSO_SOURCE_DIR "/examples/machines/router.toml --board " + machine.address());
  }
  std::string program() const { return write("p.ngc", "G21 G90 G1 X5 F6000\nM3 S1000\nX1\nM5\nM2\n"); }
};

TEST_F(FakeGrblMachine, with_grblhal_is_driven) {
  StrictGrbl grblhal(1023);
  grblhal.greeting = "GrblHAL 1.1f ['$' or '$HELP' for help]";
  grblhal.options = "VNML+,100,1024,3,0";
  grblhal.more_of_itself =
      "[AXS:3:XYZ]\r\n[NEWOPT:ENUMS,RT+,TC,SED]\r\n[FIRMWARE:grblHAL]\r\n[NVS STORAGE:*EEPROM]\r\n";
  const FakeGrbl machine(grblhal);
  const auto outcome = beside(machine, "run " + program() + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto all = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(all["grbl"]["firmware"], "grblHAL");
  EXPECT_EQ(all["grbl"]["receive_buffer"], 1023);
  EXPECT_EQ(all["position_mm"]["X"], 1.0);
}

// Without MPos, without an offset in the reports, in inches.
TEST_F(FakeGrblMachine, may_tell_the_work_place_alone) {
  StrictGrbl grbl;
  grbl.settings = "$10=0\r\n$13=1\r\n";
  grbl.own_report = [] { return std::string("<Idle|WPos:1.0000,0.0000,0.0000>"); };
  grbl.offsets = "[G54:0.0000,1.0000,0.0000]\r\n[G92:0.0000,0.0000,0.0000]\r\n[TLO:0.0000]\r\n";
  const FakeGrbl machine(grbl);
  const auto outcome = beside(machine, "run " + program() + " --json");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto all = nlohmann::json::parse(outcome.out);
  EXPECT_NEAR(all["position_mm"]["X"].get<double>(), 25.4, 1e-9);
  EXPECT_NEAR(all["position_mm"]["Y"].get<double>(), 25.4, 1e-9);
}

TEST_F(FakeGrblMachine, that_takes_no_program_is_refused_in_words) {
  const auto outcome_in = [&](StrictGrbl machine, const std::string& command) {
    const FakeGrbl fake(std::move(machine));
    const auto outcome = beside(fake, command);
    EXPECT_EQ(outcome.code, 1) << outcome.err;
    return outcome.err;
  };
  StrictGrbl asleep;
  asleep.own_report = [] { return std::string("<Sleep|MPos:0.000,0.000,0.000|FS:0,0>"); };
  EXPECT_THAT(outcome_in(asleep, "run " + program()), HasSubstr("[grbl.asleep]"));
  EXPECT_THAT(outcome_in(asleep, "home"), HasSubstr("[grbl.asleep]"));
  StrictGrbl nowhere;
  nowhere.own_report = [] { return std::string("<Idle|FS:0,0>"); };
  EXPECT_THAT(outcome_in(nowhere, "run " + program()), HasSubstr("$10=1 adds it [grbl.no-place]"));
  StrictGrbl locked;
  locked.more_of_itself = "[FIRMWARE:grblHAL]\r\n";
  locked.own_report = [] { return std::string("<Alarm:11|MPos:0.000,0.000,0.000|FS:0,0>"); };
  locked.state = "Alarm";
  EXPECT_THAT(outcome_in(locked, "run " + program()),
              HasSubstr("locked by an alarm (ALARM:11, it must be homed first). Home it with --home"));
  StrictGrbl bare;
  bare.has_switches = false;
  bare.put(22, 1);
  const std::string words = outcome_in(bare, "home");
  EXPECT_THAT(words, HasSubstr("ALARM:9, homing found no switch"));
  EXPECT_THAT(words, HasSubstr("[grbl.alarm]"));
}

TEST_F(FakeGrblMachine, is_known_where_a_board_is_expected) {
  const FakeGrbl machine((StrictGrbl()));
  const auto outcome = passo("board info --wait 0.5 " + machine.address().substr(5));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("is a machine with Grbl"));
}

TEST_F(FakeGrblMachine, that_is_held_by_somebody_is_waited_for_in_words) {
  int turns = 0;
  const FakeGrbl machine(StrictGrbl(), [turns, held = false](StrictGrbl& grbl) mutable {
    if (!held && grbl.state == "Run") {
      grbl.state = "Hold:0";
      held = true;
    }
    if (grbl.state == "Hold:0" && ++turns == 400) grbl.resume();
  });
  const auto outcome = beside(machine, "run " + program());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("note: the machine is in a feed hold (state Hold): resume it"));
}

}  // namespace
