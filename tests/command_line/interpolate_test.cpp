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

TEST_F(Interpolate, what_is_wrong_is_said_and_exits_with_2) {
  const auto wrong = [&](const std::string& arguments) {
    const Outcome outcome = interpolate(arguments + " --picture " + path("never.svg"));
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    return outcome.err;
  };
  EXPECT_THAT(wrong("--method lean --to 10,x"), HasSubstr("found 'x'"));
  EXPECT_THAT(wrong("--method wu --to 10,4"), HasSubstr("not one of master-slave, lean, dda"));
  EXPECT_THAT(wrong("--to 10,4"), HasSubstr("--method NAME, or --compare"));
  EXPECT_THAT(wrong("--method slope-blocks --to 1,2,3"), HasSubstr("two axes"));
  EXPECT_THAT(wrong("--method lean --from 10,0 --to 0,10 --center 0,0"), HasSubstr("for lines"));
  EXPECT_THAT(wrong("--method dda --from 10,0 --to 0,12 --center 0,0"), HasSubstr("does not end on its circle"));
  EXPECT_THAT(wrong("--method lean --to 2147483648,0"), HasSubstr("2147483647"));
  EXPECT_THAT(wrong("--method lean --half-loaded --to 3,3"), HasSubstr("--method dda"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --cw"), HasSubstr("--center"));
  EXPECT_THAT(wrong("--compare --method lean --to 3,3"), HasSubstr("cannot be combined with --method"));
  EXPECT_THAT(interpolate("--compare --to 3,3 --picture " + path("p.pdf")).err, HasSubstr(".svg or .png"));
  EXPECT_THAT(interpolate("--method lean --to 200000,3 --picture " + path("p.png")).err, HasSubstr("too many"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --time 1 --feed 2"), HasSubstr("give only one of them"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --time 0"), HasSubstr("--time: expected a number above 0"));
  EXPECT_THAT(wrong("--method lean --to 3,3 --rule exact"), HasSubstr("--time or --feed"));
  EXPECT_THAT(wrong("--compare --to 3,3 --beats"), HasSubstr("one method"));
  EXPECT_TRUE(files().empty());
}

}  // namespace
