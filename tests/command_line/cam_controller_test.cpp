// passo cam --for CONTROLLER: every operation for every controller, checked by code that shares nothing with the
// post-processor, and by LinuxCNC's own interpreter, where it is installed.
#include <cstdlib>
#include <filesystem>

#include "kit/command_line.hpp"
#include "kit/controller_check.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace {

using passo::test::checkout;
using passo::test::controller_rules;
using passo::test::ControllerCheck;
using passo::test::ControllerRules;
using passo::test::Outcome;
using passo::test::read;
using passo::test::SafetyRules;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Operation {
  std::string words;
  SafetyRules safety = {};
  int changes = 0;
};

class CamController : public passo::test::CommandLine {
 protected:
  std::vector<Operation> operations() const {
    const SafetyRules pen{.has_z = false, .has_spindle = false};
    const SafetyRules relief{.lowest_crossing = 5};
    const std::string pads = write("pads.gbr",
                                   "%FSLAX46Y46*%\n%MOMM*%\n%ADD10C,2*%\nD10*\nX5000000Y5000000D03*\n"
                                   "X12000000Y5000000D03*\nM02*\n");
    return {
        {"drill examples/boards/timer.drl --tools 0.8,1.0 --mill 1", {}, 3},
        {"drill examples/boards/timer.drl --units inch --depth -2mm --clearance 2mm --drill 0.8mm --peck 0.5mm"},
        {"isolate " + pads + " --tool 0.2 --passes 2"},
        {"outline examples/boards/timer-Edge_Cuts.gbr"},
        {"profile examples/parts/bracket.svg --layer cut --tool 3 --depth -6 --step 2 --ramp 5 --lead 1"},
        {"pocket examples/parts/bracket.svg --layer pocket --tool 3 --depth -3 --step 1.5"},
        {"pocket examples/parts/bracket.svg --layer pocket --tool 3mm --depth -3mm --step 1.5mm --units inch"},
        {"engrave --text 'Ab1!?' --font simplex --depth -0.2"},
        {"plot examples/parts/bracket.svg --servo 300 --knife 0.5", pen},
        {"wire examples/foam/naca2412.dat --chord 100 --axes XY --heat 200", pen},
        {"laser examples/laser/key-tag.svg --score-color blue --kerf 0.2 --passes 2", pen},
        {"laser examples/laser/ball.png --width 8mm --units inch", pen},
        {"laser --grid 1x2 --cell 2mm --air flood --beam constant", pen},
        {"relief examples/reliefs/flower.png --width 20 --depth -3 --rough flat:3 --cutter ball:2 --pitch 0.2", relief,
         2},
        {"relief examples/reliefs/flower.png --width 20mm --depth -3mm --units inch --cutter ball:2 --pitch 0.2mm "
         "--way both",
         relief},
    };
  }
};

TEST_F(CamController, each_operation_writes_words_that_each_controller_knows_and_moves_safely) {
  for (const Operation& operation : operations()) {
    for (const ControllerRules& rules : controller_rules()) {
      SCOPED_TRACE(operation.words + " --for " + rules.name);
      const Outcome made =
          passo("cam " + operation.words + " --for " + rules.name + " -o " + path("c.nc"), "cd " + checkout + " &&");
      ASSERT_EQ(made.code, 0) << made.err;
      ControllerCheck check(rules, operation.safety);
      EXPECT_THAT(check.check(read(path("c.nc"))), IsEmpty());
      EXPECT_EQ(check.changes(), operation.changes);
    }
  }
}

TEST_F(CamController, a_program_for_passo_moves_as_safely) {
  ControllerRules rules = controller_rules().front();
  rules.name = "passo";
  rules.longest_line = 0;
  for (const Operation& operation : operations()) {
    SCOPED_TRACE(operation.words);
    const Outcome made = passo("cam " + operation.words + " -o " + path("c.nc"), "cd " + checkout + " &&");
    ASSERT_EQ(made.code, 0) << made.err;
    ControllerCheck check(rules, operation.safety);
    std::vector<std::string> complaints = check.check(read(path("c.nc")));
    std::erase_if(complaints, [](const std::string& why) { return why.find("not ASCII") != std::string::npos; });
    EXPECT_THAT(complaints, IsEmpty());
  }
}

TEST_F(CamController, the_heights_and_the_delay_can_be_chosen) {
  const std::string words = "cam outline " + checkout +
                            "/examples/boards/timer-Edge_Cuts.gbr --change-height 55 --park 3,4 --spindle-delay 7.5";
  const Outcome made = passo(words);
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("\nG0 Z55\nM3 S12000\nG4 P7.5 "));
  EXPECT_THAT(made.out, HasSubstr("\nG0 Z55\nM5\nG0 X3 Y4\nM2\n"));
  EXPECT_THAT(passo(words + " --for fanuc-like").out, HasSubstr(" G4 P7500 "));
  EXPECT_THAT(passo("cam outline " + checkout + "/examples/boards/timer-Edge_Cuts.gbr --clearance 40").out,
              HasSubstr("\nG0 Z40\nM3"));
}

TEST_F(CamController, texts_of_the_operator_are_written_in_the_right_places) {
  const std::string start = write("start.txt", "M8 (coolant for {tool_name}, {diameter} {units})\n");
  const std::string change = write("change.txt", "(fetch tool {tool} of {program}, {rpm} rpm)\nG53 G0 Z0\nM0\n");
  const std::string end = write("end.txt", "M9\nG53 G0 Z0\nM30\n");
  const std::string words = "cam drill " + checkout +
                            "/examples/boards/timer.drl --tools 0.8,1.0 --mill 1 --start-text " + start +
                            " --tool-change-text " + change + " --end-text " + end + " --for ";
  const Outcome made = passo(words + "grbl -o " + path("b.nc"));
  EXPECT_EQ(made.code, 0) << made.err;
  const std::string program = read(path("b.nc"));
  EXPECT_THAT(program, HasSubstr("\nM8 (coolant for drill 0.8 mm, 0.8 mm)\nG17 G21 "));
  EXPECT_THAT(
      program,
      HasSubstr("\nM5\nG0 X0 Y0\n(tool 2: drill 1 mm)\n(fetch tool 2 of b.nc, 12000 rpm)\nG53 G0 Z0\nM0\nG17 G21 "));
  EXPECT_THAT(program, HasSubstr("\nM9\nG53 G0 Z0\nM30\n"));
  EXPECT_THAT(program, Not(HasSubstr("M2\n")));
  EXPECT_EQ(passo(words + "passo").code, 0);
}

TEST_F(CamController, a_wrong_text_is_refused_with_its_place) {
  const auto refused = [&](const std::string& text, const std::string& controller,
                           const std::string& option = "--start-text") {
    std::filesystem::remove(path("c.nc"));
    const Outcome made = passo("cam outline " + checkout + "/examples/boards/timer-Edge_Cuts.gbr -o " + path("c.nc") +
                               " " + option + " " + write("t.txt", text) + " --for " + controller);
    EXPECT_EQ(made.code, 2);
    EXPECT_FALSE(std::filesystem::exists(path("c.nc")));
    return made.err;
  };
  const std::string wrong = refused("M8\nG0 Z{heigth} (up)\n", "linuxcnc");
  EXPECT_THAT(wrong, HasSubstr("t.txt:2:5: "));
  EXPECT_THAT(wrong, HasSubstr("post.unknown-placeholder"));
  EXPECT_THAT(refused("T{tol}\n", "passo"), HasSubstr("did you mean {tool}?"));
  EXPECT_THAT(refused("T{tool\n", "passo"), HasSubstr("post.open-placeholder"));
  EXPECT_THAT(refused("T{tool} M6\n", "grbl"), HasSubstr("t.txt:1:9: error: Grbl 1.1 does not know M6"));
  EXPECT_THAT(refused("G43 H1\n", "grbl"), HasSubstr("post.unknown-word"));
  EXPECT_THAT(refused("(ready?)\n", "grbl"), HasSubstr("Grbl 1.1 acts on '?' at once, also in a comment"));
  EXPECT_THAT(refused("M30\n", "mach3"), HasSubstr("post.early-end"));
  EXPECT_THAT(refused("go home\n", "mach3"), HasSubstr("post.bad-word"));
  EXPECT_THAT(refused("M9\nM30\nG0 X0\n", "mach3", "--end-text"), HasSubstr("t.txt:2:1: "));
  EXPECT_THAT(refused("M9\nM2\nG0 X[#<_x>]\n", "passo", "--end-text"), HasSubstr("post.early-end"));
}

TEST_F(CamController, what_an_operation_reads_is_not_overwritten) {
  const std::string text = write("t.ngc", "M8\n");
  const Outcome made =
      passo("cam outline " + checkout + "/examples/boards/timer-Edge_Cuts.gbr --start-text " + text + " -o " + text);
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("--start-text"));
  EXPECT_EQ(read(text), "M8\n");
  const std::string tools = write("tools.toml", "[tool.1]\nshape = \"flat\"\ndiameter_mm = 2\n");
  const std::string drawing = checkout + "/examples/parts/bracket.svg";
  EXPECT_EQ(passo("cam profile " + drawing + " --tool-table " + tools + " --tool T1 -o " + tools).code, 2);
  EXPECT_THAT(read(tools), HasSubstr("[tool.1]"));
}

TEST_F(CamController, programs_that_a_controller_cannot_run_are_refused) {
  const std::string wire =
      "cam wire examples/foam/naca2412.dat examples/foam/naca0010.dat --chord 100,60 --span 400 --width 300 -o " +
      path("w.nc");
  const Outcome four = passo(wire + " --for grbl", "cd " + checkout + " &&");
  EXPECT_EQ(four.code, 2);
  EXPECT_THAT(four.err, HasSubstr("--for grbl: Grbl 1.1 has no axes U and V"));
  EXPECT_EQ(passo(wire + " --for grblhal", "cd " + checkout + " &&").code, 0);
  const Outcome cm = passo("cam outline " + checkout + "/examples/boards/timer-Edge_Cuts.gbr --units cm --for mach3");
  EXPECT_EQ(cm.code, 2);
  EXPECT_THAT(cm.err, HasSubstr("--for mach3: expected --units mm or inch, found cm"));
}

// rs274 of the package linuxcnc-uspace prints the canonical calls, or an error.
TEST_F(CamController, linuxcnc_itself_accepts_the_programs) {
  if (std::system("rs274 -g /dev/null >/dev/null 2>&1; test $? -ne 127") != 0) {
    GTEST_SKIP() << "rs274 is not installed (linuxcnc-uspace)";
  }
  const std::string tools = write("tools.tbl", "T1 P1 Z0 D3\nT2 P2 Z0 D2\nT3 P3 Z0 D1\n");
  for (const Operation& operation : operations()) {
    SCOPED_TRACE(operation.words);
    const Outcome made =
        passo("cam " + operation.words + " --for linuxcnc -o " + path("c.nc"), "cd " + checkout + " &&");
    ASSERT_EQ(made.code, 0) << made.err;
    const std::string command = "rs274 -t " + tools + " -g " + path("c.nc") + " >" + path("canon") + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << read(path("canon")).substr(0, 500);
    EXPECT_THAT(read(path("canon")), HasSubstr("PROGRAM_END()"));
  }
}

}  // namespace
