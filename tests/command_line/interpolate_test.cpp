// passo interpolate, as a user starts it.
#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::StartsWith;

class Interpolate : public passo::test::CommandLine {
 protected:
  Outcome interpolate(const std::string& arguments) const { return passo("interpolate " + arguments); }
};

TEST_F(Interpolate, prints_a_header_and_a_line_a_pulse) {
  const Outcome lean = interpolate("--method lean --to 3,-1");
  EXPECT_EQ(lean.code, 0);
  EXPECT_EQ(lean.out,
            "pulse,x,y,decision_x,decision_y\n"
            "1,1,0,-3,-1\n"
            "2,2,-1,-3,-5\n"
            "3,3,-1,-3,-3\n");
  EXPECT_EQ(lean.err, "");
}

TEST_F(Interpolate, positions_are_absolute) {
  EXPECT_EQ(interpolate("--method point-comparison --from 5,5 --to 4,6").out,
            "pulse,x,y,deviation\n1,4,5,-1\n2,4,6,0\n");
  EXPECT_THAT(interpolate("--method midpoint --from 15,5 --to 5,15 --center 5,5").out, HasSubstr("\n14,5,15,0\n"));
}

TEST_F(Interpolate, a_pulse_in_which_nothing_moves_is_a_line_too) {
  EXPECT_EQ(interpolate("--method dda --to 2,0").out,
            "pulse,x,y,accumulator_x,accumulator_y\n1,0,0,2,0\n2,1,0,0,0\n3,1,0,2,0\n4,2,0,0,0\n");
}

TEST_F(Interpolate, every_name_of_the_manual_is_a_method) {
  for (const char* name : {"master-slave", "lean", "dda", "dda --half-loaded", "slope-recalculated", "slope-blocks",
                           "point-comparison", "point-comparison --end projection"}) {
    const Outcome outcome = interpolate(std::string("--to 7,3 --method ") + name);
    EXPECT_EQ(outcome.code, 0) << name;
    EXPECT_THAT(outcome.out, HasSubstr(",7,3,")) << name;
  }
}

TEST_F(Interpolate, no_length_is_a_header_alone) {
  EXPECT_EQ(interpolate("--method slope-blocks --to 0,0").out, "pulse,x,y,plain,blocks\n");
}

TEST_F(Interpolate, compares_all_methods_that_take_the_move) {
  const Outcome table = interpolate("--compare --to 27,10");
  EXPECT_EQ(table.code, 0);
  EXPECT_THAT(table.out, HasSubstr("master-slave            0.452     4.52"));
  EXPECT_THAT(table.out, HasSubstr("point-comparison"));
  const auto json = nlohmann::json::parse(interpolate("--compare --json --to 27,10 --steps-per-mm 200").out);
  EXPECT_EQ(json["methods"].size(), 7U);
  EXPECT_EQ(json["step_um"], 5);
  EXPECT_EQ(json["methods"][0]["pulses"], 27);
  EXPECT_NEAR(json["methods"][0]["largest_deviation_um"].get<double>(), 5 * 0.452, 0.003);
}

TEST_F(Interpolate, draws_one_method_or_all) {
  EXPECT_EQ(interpolate("--method lean --to 27,10,5 --picture " + path("one.svg")).code, 0);
  EXPECT_THAT(read(path("one.svg")), HasSubstr("</svg>"));
  EXPECT_EQ(interpolate("--compare --from 5,0 --to 0,5 --center 0,0 --picture " + path("all.png")).code, 0);
  EXPECT_THAT(read(path("all.png")), StartsWith("\x89PNG"));
  EXPECT_EQ(interpolate("--method dda --to 0,0 --picture " + path("none.svg")).code, 0);
}

TEST_F(Interpolate, writes_a_file_whole_or_not_at_all) {
  EXPECT_EQ(interpolate("--method lean --to 2,1 -o " + path("pulses.csv")).out, "");
  EXPECT_EQ(read(path("pulses.csv")), "pulse,x,y,decision_x,decision_y\n1,1,1,-2,-4\n2,2,1,-2,-2\n");
  EXPECT_EQ(interpolate("--method lean --to 2,1 -o " + path("nowhere/pulses.csv")).code, 1);
}

TEST_F(Interpolate, prints_the_four_beats_of_point_comparison) {
  const Outcome beats = interpolate("--method point-comparison --beats --to 3,2");
  EXPECT_EQ(beats.code, 0);
  EXPECT_EQ(beats.out,
            "pulse,judge,feed,x,y,deviation,left\n"
            "1,F>=0,+x,1,0,-2,4\n"
            "2,F<0,+y,1,1,1,3\n"
            "3,F>=0,+x,2,1,-1,2\n"
            "4,F<0,+y,2,2,2,1\n"
            "5,F>=0,+x,3,2,0,0\n");
  EXPECT_THAT(interpolate("--method master-slave --beats --to 7,3").out, HasSubstr("\n3,3,1 2/7,2 1/2,1 1/2,+x,3,1,"));
}

TEST_F(Interpolate, divides_the_time_of_the_move_by_plain_and_diagonal_pulses) {
  // Six plain pulses and four diagonal ones: t = 1 s / (6 + 4 √2).
  const std::string by_time = interpolate("--method bresenham --to 10,4 --time 1").out;
  EXPECT_THAT(by_time, HasSubstr("decision_y,duration,t_end\n1,1,0,-10,-2,0.0857864376,0.0857864376\n"));
  EXPECT_THAT(by_time, HasSubstr("\n2,2,1,-10,-14,0.121320344,0.207106781\n"));
  EXPECT_THAT(by_time, HasSubstr(",1\n"));
  // 30 by 40 steps are 5 mm at 10 steps/mm; 600 mm/min takes half a second.
  EXPECT_THAT(interpolate("--method lean --to 30,40 --feed 600 --steps-per-mm 10").out, HasSubstr(",0.5\n"));
  EXPECT_THAT(interpolate("--method lean --to 4,1 --time 2 --rule beats").out, HasSubstr("1,1,0,-4,-2,0.5,0.5\n"));
}

TEST_F(Interpolate, with_a_picture_the_pulses_go_into_the_file_that_is_named) {
  const Outcome both = interpolate("--method lean --to 2,1 --picture " + path("p.svg") + " -o " + path("p.csv"));
  EXPECT_EQ(both.code, 0);
  EXPECT_EQ(both.out, "");
  EXPECT_EQ(read(path("p.csv")), "pulse,x,y,decision_x,decision_y\n1,1,1,-2,-4\n2,2,1,-2,-2\n");
  EXPECT_THAT(read(path("p.svg")), HasSubstr("</svg>"));
}

TEST_F(Interpolate, without_a_method_is_lean_and_for_an_arc_the_midpoint) {
  EXPECT_EQ(interpolate("--to 10,4").out, interpolate("--method lean --to 10,4").out);
  const std::string arc = "--from 10,0 --to 0,10 --center 0,0";
  EXPECT_EQ(interpolate(arc).out, interpolate("--method midpoint " + arc).out);
}

// The source's own program: it asks for each motor, and prints a line for each pulse, with a tab after each number.
TEST_F(Interpolate, without_arguments_asks_and_prints_the_sequence) {
  const auto dialogue = [&](const std::string& input, const std::string& language, const std::string& options = "") {
    return passo("interpolate " + options, "printf '" + input + "' | env -u LC_ALL -u LC_MESSAGES LANG=" + language);
  };
  const std::string sequence = "1\t0\t\n2\t1\t\n3\t1\t\n4\t2\t\n5\t2\t\n6\t2\t\n7\t3\t\n8\t3\t\n9\t4\t\n10\t4\t\n";
  const Outcome english = dialogue("10\\n4\\n\\nnot read\\n", "C");
  EXPECT_EQ(english.code, 0) << english.err;
  EXPECT_EQ(english.out, sequence);
  EXPECT_THAT(english.err, StartsWith("Steps of motor 1: \nSteps of motor 2 (an empty line ends the list): \n"));
  EXPECT_THAT(dialogue("10\\n4\\n", "it_IT.UTF-8").err, HasSubstr("Passi del motore 2"));
  EXPECT_THAT(dialogue("10\\n4\\n", "fr_CH").err, HasSubstr("Pas du moteur 2"));
  EXPECT_THAT(dialogue("10\\n4\\n", "zh_CN.UTF-8").err, HasSubstr("电机 2 的步数"));
  EXPECT_EQ(dialogue("10 4", "it").out, sequence) << "as cin reads it";
  EXPECT_THAT(dialogue("10 4", "it", "--method listing:shared-variable").out, testing::EndsWith("10\t5\t\n"));
  // More motors than a pulse has bits, some backwards.
  const Outcome many = dialogue("3 -2 1 0 3 3 2 1 1 -3 2", "C");
  EXPECT_THAT(many.out, testing::EndsWith("\n3\t-2\t1\t0\t3\t3\t2\t1\t1\t-3\t2\t\n"));
  EXPECT_THAT(many.out, StartsWith("1\t-1\t0\t0\t1\t1\t1\t0\t0\t-1\t1\t\n"));
  EXPECT_EQ(dialogue("", "C").code, 2);
  const Outcome wrong = dialogue("10\\nx\\n", "it");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("'x' non è un numero di passi"));
}

TEST_F(Interpolate, a_faulty_listing_is_shown_beside_the_right_method) {
  const Outcome listing = interpolate("--method listing:projection --to 4,4");
  EXPECT_EQ(listing.code, 0);
  EXPECT_EQ(listing.err, "listing:projection: pulse 8 is missing; it ends at (4, 3) instead of (4, 4)\n");
  const auto json = nlohmann::json::parse(interpolate("--method listing:shared-variable --to 10,4 --json").out);
  EXPECT_EQ(json["methods"][0]["listing"]["first_wrong_pulse"], 1);
  EXPECT_EQ(json["methods"][0]["listing"]["end"], nlohmann::json({10, 5}));
  EXPECT_THAT(interpolate("--compare --to 10,4").out, testing::Not(HasSubstr("listing:")));
  EXPECT_EQ(interpolate("--method listing:slope-blocks --to 3,29 --picture " + path("l.svg")).code, 0);
  EXPECT_THAT(read(path("l.svg")), HasSubstr("wrong step"));
  EXPECT_THAT(read(path("l.svg")), HasSubstr("listing:slope-blocks"));
}

// The foam cutter's own program: each point with its time, N1, N2 and the time of a step.
TEST_F(Interpolate, goes_from_point_to_point_at_one_speed) {
  // 60 mm/min at 100 steps/mm are 100 steps/s.
  EXPECT_EQ(interpolate("--to '27,3 27,30 0,0' --feed 60 --step-times").out,
            "point,x,y,length_steps,TPS_s,N1,N2,t_s\n"
            "1,27,3,27.1661554,0.271661554,24,3,0.00961884397\n"
            "2,27,30,27,0.27,27,0,0.01\n"
            "3,0,0,40.3608721,0.403608721,3,27,0.00980018971\n");
  const Outcome pulses = interpolate("--to '3,1 5,5' --time 2");
  EXPECT_THAT(pulses.out, StartsWith("point,pulse,x,y,decision_x,decision_y,duration,t_end\n1,1,1,0,"));
  EXPECT_THAT(pulses.out, HasSubstr("\n2,1,4,2,"));
  EXPECT_THAT(pulses.out, testing::EndsWith(",2\n"));
  const auto json = nlohmann::json::parse(interpolate("--to 10,4 --json --time 1").out);
  EXPECT_EQ(json["points"][0]["n1"], 6);
  EXPECT_EQ(json["points"][0]["n2"], 4);
  EXPECT_NEAR(json["points"][0]["step_time_s"].get<double>(), 0.0857864376, 1e-10);
}

TEST_F(Interpolate, what_is_wrong_is_said_and_exits_with_2) {
  const auto wrong = [&](const std::string& arguments) {
    const Outcome outcome = interpolate(arguments + " --picture " + path("never.svg"));
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    return outcome.err;
  };
  EXPECT_THAT(wrong("--method lean --to 10,x"), HasSubstr("found 'x'"));
  EXPECT_THAT(wrong("--method wu --to 10,4"), HasSubstr("not one of master-slave, lean, dda"));
  EXPECT_THAT(wrong(""), HasSubstr("--to is missing"));
  EXPECT_THAT(wrong("--to '10,4 3,x'"), HasSubstr("found 'x'"));
  EXPECT_THAT(wrong("--to '10,4 3'"), HasSubstr("starts with 2 axes and ends with 1"));
  EXPECT_THAT(wrong("--to '10,4 3,3'"), HasSubstr("are for one point"));
  EXPECT_THAT(interpolate("--to 10,4 --step-times").err, HasSubstr("needs --time or --feed"));
  EXPECT_THAT(wrong("--method listing:slope-blocks --to 5,0"), HasSubstr("divides by zero"));
  EXPECT_THAT(wrong("--method slope-blocks --to 1,2,3"), HasSubstr("two axes"));
  EXPECT_THAT(wrong("--method lean --from 10,0 --to 0,10 --center 0,0"), HasSubstr("for lines"));
  EXPECT_THAT(wrong("--method dda --from 10,0 --to 0,12 --center 0,0"), HasSubstr("does not end on its circle"));
  EXPECT_THAT(wrong("--method lean --to 2147483648,0"), HasSubstr("2147483647"));
  EXPECT_THAT(wrong("--method lean --half-loaded --to 3,3"), HasSubstr("--method dda"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --cw"), HasSubstr("--center"));
  EXPECT_THAT(wrong("--compare --method lean --to 3,3"), HasSubstr("cannot be combined with --method"));
  EXPECT_THAT(
      passo("chords --curve line --from 0,0 --to 5,5 --tolerance 1 --steps-per-mm 10 --fine listing:rounding").err,
      HasSubstr("expected a method"));
  EXPECT_THAT(interpolate("--compare --to 3,3 --picture " + path("p.pdf")).err, HasSubstr(".svg or .png"));
  EXPECT_THAT(interpolate("--method lean --to 200000,3 --picture " + path("p.png")).err, HasSubstr("too many"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --time 1 --feed 2"), HasSubstr("give only one of them"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --time 0"), HasSubstr("--time: expected a number above 0"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --rule exact"), HasSubstr("--time or --feed"));
  EXPECT_THAT(wrong("--compare --to 3,3 --beats"), HasSubstr("one method"));
  EXPECT_TRUE(files().empty());
}

}  // namespace
