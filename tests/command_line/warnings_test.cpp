// Warnings of what is allowed, but seldom meant: true ones, each with all its places; and messages that know other
// controls.
#include "kit/command_line.hpp"
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using passo::test::contains;
using passo::test::examples;
using passo::test::Outcome;
using passo::test::read;
using passo::test::router_file;

class Warnings : public passo::test::CommandLine {
 protected:
  Outcome check(const std::string& text, const std::string& options = "") const {
    return passo("check " + write("p.ngc", text) + " -m " + router_file + " " + options);
  }
  bool is_warned(const std::string& text, const std::string& code) const {
    return contains(check(text).err, "[" + code + "]");
  }
};

TEST_F(Warnings, a_feed_without_length_is_no_feed) {
  EXPECT_FALSE(is_warned("G21 G90\nG0 Z5\nG1 F600\nM3 S10000\nG0 X10\nG1 Z-1\nM2\n", "path.spindle-off-in-feed"));
  EXPECT_FALSE(
      is_warned("G21 G90\nG0 X1 Z5\nG55\nG1 F600\nG92 X3\nG1 F500\nM3 S9\nG1 Z-1\nM2\n", "path.spindle-off-in-feed"))
      << "nor in another frame";
  const Outcome outcome =
      check("G21 G90\nG0 Z5\nG1 F600\nM3 S10000\nG0 X10\nG1 Z-1\nG0 Z5\nT2 M6\nG0 X20\nG1 Z-3\nM2\n");
  EXPECT_TRUE(contains(outcome.err, "p.ngc:10:1: warning: a feed move while the spindle is stopped")) << outcome.err;
}

TEST_F(Warnings, name_their_other_lines) {
  const Outcome outcome = check("G21 G90\nG1 X1 F600\nX2\nX3\nX4\nX5\nM2\n", "--json");
  EXPECT_TRUE(contains(check("G21 G90\nG1 X1 F600\nX2\nX3\nX4\nX5\nM2\n").err, "= and 4 more, lines 3, 4, 5, ..."));
  const auto json = nlohmann::json::parse(outcome.out, nullptr, false);
  for (const auto& finding : json["findings"]) {
    if (finding["code"] != "path.spindle-off-in-feed") continue;
    EXPECT_EQ(finding["line"], 2);
    EXPECT_EQ(finding["more_lines"], nlohmann::json::parse("[3, 4, 5, 6]"));
    return;
  }
  FAIL() << outcome.out;
}

TEST_F(Warnings, a_line_in_a_loop_is_one_line) {
  const Outcome outcome = check("G21 G90 F600\no1 repeat [5]\nG1 X1\nX0\no1 endrepeat\nM2\n");
  EXPECT_TRUE(contains(outcome.err, "= and 1 more, line 4\n")) << outcome.err;
}

TEST_F(Warnings, a_place_of_the_machine_is_nowhere_in_an_unknown_work) {
  const std::string begin = "G21 G90 S1000 M3\nG0 X0 Y0\nG0 Z5\nG1 Z-1 F300\nX10\n";
  for (const char* end : {"G53 G0 Z0\nG0 X50 Y50\nM2\n", "G53 G0 Z-30\nG53 G0 X0 Y0\nM2\n", "G28\nG0 X5\nM2\n",
                          "G0 Z5\nG53 G0 Z-2\nM2\n"}) {
    EXPECT_FALSE(contains(check(begin + end).err, "rapid")) << end << check(begin + end).err;
  }
  EXPECT_TRUE(is_warned(begin + "G53 G0 Z0\nG0 X50 Z-1\nG0 X60\nM2\n", "path.low-rapid")) << "Z is said again";
  EXPECT_TRUE(is_warned("G10 L2 P1 Z0\nG10 L2 P1 Z-1\n" + begin + "G53 G0 Z-2\nG53 G0 X3\nM2\n", "path.low-rapid"))
      << "the program knows its zero";
}

TEST_F(Warnings, a_frame_that_stays_forgets_no_heights) {
  const std::string begin = "G21 G90 G54\nM3 S1000\nG0 X10 Y10 Z5\nG1 Z-10 F100\nG1 X20\nG0 Z5\n";
  const std::string end = "G0 X40\nG1 Z-5\nG0 Z5\nG0 X15\nG0 Z-9\nG1 X20\nG0 Z5\nM2\n";
  EXPECT_FALSE(is_warned(begin + "G10 L2 P1 X0\n" + end, "path.rapid-plunge"));
  EXPECT_TRUE(is_warned(begin + "G10 L2 P1 Z-3\n" + end, "path.rapid-plunge"));
}

TEST_F(Warnings, of_a_blank_in_a_number) {
  const Outcome outcome = check("G21 G90\nM3 S1000\nG1 X20 5 F100\nM2\n");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "p.ngc:3:5: warning: 20 5 is read as 205 [gcode.blank-in-number]")) << outcome.err;
  EXPECT_FALSE(is_warned("G 21 G 90\nM 3 S 1000\nG 1 X - 20 F 100\nM2\n", "gcode.blank-in-number"));
}

TEST_F(Warnings, of_a_number_that_was_never_set) {
  const Outcome outcome = check("G21 G90\nM3 S1000\nG1 Z-#2 F100\nM2\n");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "p.ngc:3:6: warning: #2 was never set, and is 0 [gcode.unset-parameter]"))
      << outcome.err;
  EXPECT_FALSE(is_warned("#2=3\n#[1+2]=#2\nG21 M3 S9\nG1 Z-#3 F#2\nG0 X#5220\nM2\n", "gcode.unset-parameter"));
  const std::string sub = "o1 sub\nG1 X#1 Y#2 F9\no1 endsub\nG21 M3 S9\no1 call [1]\n";
  EXPECT_FALSE(is_warned(sub + "M2\n", "gcode.unset-parameter")) << "an argument that is not given";
  EXPECT_TRUE(is_warned(sub + "G1 X#1\nM2\n", "gcode.unset-parameter")) << "of the sub, not of the program";
  const std::string saved = write("p.var", "100\t5.0\n");
  EXPECT_FALSE(contains(check("G21 G0 X#100\nM2\n", "--parameters " + saved).err, "unset-parameter"));
}

TEST_F(Warnings, of_moves_after_the_end) {
  const Outcome outcome = check("G21 G90\nG0 X1\nM30\n(tool 2)\nG0 X2\nX3\n");
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(contains(outcome.err, "p.ngc:5:4: warning: this move comes after the end")) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "and 1 more, line 6")) << outcome.err;
  EXPECT_FALSE(is_warned("%\nG21 G90\nG0 X1\nM2\n%\nG0 X2\n", "gcode.move-after-end"));
  EXPECT_FALSE(is_warned("G21 G90\no1 call\nM2\no1 sub\nG0 X2\no1 endsub\n", "gcode.move-after-end")) << "a sub";
  EXPECT_FALSE(is_warned("G21 G90\nM98 P100\nM30\nO100\nG0 X2\nM99\n", "gcode.move-after-end")) << "a program";
}

TEST_F(Warnings, of_a_spindle_that_the_end_leaves_on) {
  EXPECT_TRUE(is_warned("%\nG21 G90\nM3 S1000\nG1 Z-1 F100\n%\n", "path.spindle-left-on"));
  EXPECT_FALSE(is_warned("%\nG21 G90\nM3 S1000\nG1 Z-1 F100\nM5\n%\n", "path.spindle-left-on"));
  EXPECT_FALSE(is_warned("%\nG21 G90\nM3 S1000\nG1 Z-1 F100\nM2\n%\n", "path.spindle-left-on"));
}

TEST_F(Warnings, of_a_rapid_down_before_any_place) {
  EXPECT_TRUE(is_warned("G21 G90\nM3 S1000\nG0 Z-2\nG1 X5 F100\nM2\n", "path.blind-plunge"));
  EXPECT_FALSE(is_warned("G21 G90\nM3 S1000\nG0 Z5\nG0 X0 Y0\nG0 Z-2\nM2\n", "path.blind-plunge"));
  EXPECT_FALSE(is_warned("G21 G90\nG53 G0 Z-2\nG0 X1\nM2\n", "path.blind-plunge")) << "a place of the machine";
}

TEST_F(Warnings, of_depths_that_are_all_above_zero) {
  const Outcome outcome = check("G21 G90\nM3 S1000\nG0 X0 Y0\nG0 Z5\nG1 Z2 F100\nX10\nG0 Z5\nM2\n");
  EXPECT_TRUE(
      contains(outcome.err, "p.ngc:5:1: warning: no feed move goes below Z0: the lowest is at Z2 [path.no-depth]"))
      << outcome.err;
  EXPECT_FALSE(is_warned("G21 G90\nM3 S1000\nG0 X0 Y0\nG0 Z5\nG1 Z2 F100\nX10\nZ-1\nM2\n", "path.no-depth"));
  EXPECT_FALSE(is_warned("G21 G90\nM3 S1000\nG0 X0 Y0\nG0 Z5\nG1 X10 F100\nM2\n", "path.no-depth"))
      << "nothing goes down";
}

TEST_F(Warnings, of_an_arc_that_is_nearly_a_circle) {
  const std::string begin = "G21 G90\nM3 S1000\nG0 X0 Y0\n";
  EXPECT_TRUE(is_warned(begin + "G2 X0 Y-0.002 I50 F100\nM2\n", "path.nearly-circle"));
  EXPECT_TRUE(is_warned(begin + "G3 X0 Y0.002 I50 F100\nM2\n", "path.nearly-circle") ||
              is_warned(begin + "G3 X0 Y-0.002 I-50 F100\nM2\n", "path.nearly-circle"));
  EXPECT_FALSE(is_warned(begin + "G2 I50 F100\nM2\n", "path.nearly-circle")) << "a circle";
  EXPECT_FALSE(is_warned(begin + "G2 X0 Y0.002 I50 F100\nM2\n", "path.nearly-circle")) << "a short arc";
}

TEST_F(Warnings, an_arc_with_the_centre_meant_the_other_way_names_the_code) {
  EXPECT_TRUE(contains(check("G21 G90\nM3 S1000\nG0 X30 Y20\nG2 X40 Y30 I40 J20 F100\nM2\n").err,
                       "expected: G90.1 before the arc"));
  EXPECT_TRUE(contains(check("G21 G90 G90.1\nM3 S1000\nG0 X30 Y20\nG2 X40 Y30 I10 J0 F100\nM2\n").err,
                       "expected: G91.1 before the arc"));
}

TEST_F(Warnings, g0_beside_g28_is_accepted) {
  const Outcome outcome = check("G21 G90\nG0 X5 Y5\nG0 G91 G28 X0\nG90\nX7\nM2\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.err, "p.ngc:3:1: warning: G28 uses the axis words of the block")) << outcome.err;
  const Outcome apart = passo("canon " + write("a.ngc", "G21 G90\nG0 X5 Y5\nG91 G28 X0\nG90\nX7\nM2\n"));
  const Outcome beside = passo("canon " + write("b.ngc", "G21 G90\nG0 X5 Y5\nG0 G91 G28 X0\nG90\nX7\nM2\n"));
  EXPECT_EQ(apart.out, beside.out);
  EXPECT_NE(check("G21 G90\nF9 G1 G28 X0\nM2\n").code, 0) << "a feed";
}

TEST_F(Warnings, words_of_other_controls_are_named) {
  const Outcome macro = check("#1=0\nWHILE [#1 LT 3] DO1\n#1=[#1+1]\nEND1\nIF [#1 GT 2] GOTO 10\nN10 M2\n");
  EXPECT_EQ(macro.code, 2);
  EXPECT_TRUE(contains(macro.err, "p.ngc:2:1: error: WHILE belongs to Fanuc's macro language")) << macro.err;
  EXPECT_TRUE(contains(macro.err, "p.ngc:4:1: error: END belongs")) << macro.err;
  EXPECT_TRUE(contains(macro.err, "p.ngc:5:1: error: IF belongs")) << macro.err;
  EXPECT_TRUE(contains(macro.err, "o1 endwhile"));
  EXPECT_TRUE(contains(check("GOTO 10\nM2\n").err, "GOTO belongs to Fanuc's macro language"));
  EXPECT_TRUE(contains(check("G2 X10 I F100\nM2\n").err, "'I' has no value"));
  EXPECT_FALSE(contains(check("; Curated by hand\nG21 G0 X1\nM2\n").err, "printer"));
  EXPECT_TRUE(contains(check(":0491\nM2\n").err, "O instead of ':'"));
  EXPECT_TRUE(contains(check("G4 X2\nM2\n").err, "other controls use X or U"));
  EXPECT_TRUE(contains(check("G17 G21 F400\nG0 X10\nG2 X0 Y-10 I-10 J0 K0.000\nM2\n").err, "--dialect grbl"));
  const Outcome printer = check("; generated by PrusaSlicer 2.7.1\nM104 S215\nG28\nG1 X1 E2 F1800\nG1 X2 E3\n");
  EXPECT_EQ(printer.code, 2);
  EXPECT_TRUE(contains(printer.err, "this is a program for a 3D printer")) << printer.err;
  EXPECT_TRUE(contains(printer.err, "1 error\n")) << printer.err;
}

TEST_F(Warnings, the_programs_of_the_collection) {
  const fs::path cases = fs::path(PASSO_SOURCE_DIR) / "../shared/cases/language";
  if (!fs::exists(cases)) GTEST_SKIP() << "no ../shared/cases beside this checkout";
  const struct {
    const char* file;
    const char* part;
    bool is_there;
  } expected[] = {{"spindle-false-alarm.ngc", "warning", false},
                  {"spindle-masked.ngc", "ngc:10:1: warning: a feed move while the spindle is stopped", true},
                  {"ff2.ngc", "rapid-plunge", false},
                  {"blank-in-number.ngc", "20 5 is read as 205", true},
                  {"unset-number.ngc", "#2 was never set", true},
                  {"absolute-centre.ngc", "G90.1 before the arc", true},
                  {"fanuc-macro.ngc", "WHILE belongs to Fanuc's macro language", true},
                  {"freecad-k0.ngc", "--dialect grbl", true}};
  for (const auto& one : expected) {
    const Outcome outcome = passo("check " + (cases / one.file).string() + " -m " + router_file);
    EXPECT_EQ(contains(outcome.err, one.part), one.is_there) << one.file << "\n" << outcome.err;
  }
}

}  // namespace
