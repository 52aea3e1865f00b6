// passo chords, as a user starts it.
#include <cmath>
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>

namespace {

using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::StartsWith;

class ChordsCommand : public passo::test::CommandLine {
 protected:
  Outcome chords(const std::string& arguments) const { return passo("chords --curve " + arguments); }

  static std::vector<std::vector<double>> rows(const std::string& csv) {
    std::istringstream lines(csv);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(lines, line);  // the header
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      rows.emplace_back();
      for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
    }
    return rows;
  }
};

TEST_F(ChordsCommand, prints_a_header_the_start_and_a_line_a_chord) {
  const Outcome line = chords("line --from 1,2 --to 4,-6.5,8");
  EXPECT_EQ(line.code, 0);
  EXPECT_EQ(line.out, "chord,x,y,z,deviation\n0,1,2,0,0\n1,4,-6.5,8,0\n");
  EXPECT_EQ(line.err, "");
}

TEST_F(ChordsCommand, an_arc_is_cut_by_its_sagitta) {
  const auto quarter = rows(chords("arc --from 10,0 --to 0,10 --center 0,0 --tolerance 0.1").out);
  ASSERT_EQ(quarter.size(), 7U);  // 90 degrees by 2 acos(1 - 0.1 / 10) = 16.2
  for (std::size_t i = 0; i < quarter.size(); ++i) {
    EXPECT_NEAR(quarter[i][1], 10 * std::cos(static_cast<double>(i) * M_PI / 12), 1e-12);
    EXPECT_NEAR(quarter[i][2], 10 * std::sin(static_cast<double>(i) * M_PI / 12), 1e-12);
  }
  EXPECT_NEAR(quarter[1][4], 10 * (1 - std::cos(M_PI / 24)), 1e-6);
  const auto the_other_way = rows(chords("arc --from 10,0 --to 0,10 --center 0,0 --tolerance 0.1 --cw").out);
  EXPECT_EQ(the_other_way.size(), 18U);
  EXPECT_LT(the_other_way[1][2], 0);
}

TEST_F(ChordsCommand, a_helix_counts_its_turns_as_g_code_does) {
  const auto helix = rows(chords("helix --from 8,0,1 --to 8,0,13 --center 0,0 --turns 4 --cw --tolerance 0.1").out);
  const auto circle = rows(chords("arc --from 8,0 --to 8,0 --center 0,0 --tolerance 0.1").out);
  EXPECT_NEAR(static_cast<double>(helix.size()), 4 * static_cast<double>(circle.size()), 5);
  EXPECT_EQ(helix.back()[3], 13);
}

TEST_F(ChordsCommand, every_kind_of_curve_ends_where_it_should) {
  const auto end = [&](const std::string& arguments) {
    const Outcome outcome = chords(arguments);
    EXPECT_EQ(outcome.code, 0) << arguments << "\n" << outcome.err;
    const auto all = rows(outcome.out);
    EXPECT_GT(all.size(), 4U) << arguments;
    return std::vector<double>(all.back().begin() + 1, all.back().begin() + 4);
  };
  using Values = std::vector<double>;
  EXPECT_EQ(end("bezier --from 0,0 --control 10,20 --to 20,0,5"), (Values{20, 0, 5}));
  EXPECT_EQ(end("bezier --from 0,0 --control 0,20 --control -30,20 --to -30,0.25"), (Values{-30, 0.25, 0}));
  EXPECT_EQ(end("nurbs --control 0,0 5,10 10,-10 15,10 20,0 --weights 1 2 1 2 1"), (Values{20, 0, 0}));
  EXPECT_EQ(end("nurbs --degree 2 --control 0,0 5,10 10,-10 20,0 --knots 0 0 0 1 3 3 3"), (Values{20, 0, 0}));
  EXPECT_EQ(end("ellipse --center 1,2 --radii 10,5"), (Values{11, 2, 0}));
  EXPECT_NEAR(end("ellipse --center 0,0 --radii 10,5 --rotate 90 --angles 0,-90")[0], 5, 1e-12);
  EXPECT_NEAR(end("parabola --vertex 0,0 --focus 0,10 --from -20,10 --to 30,22.5")[1], 22.5, 1e-12);
}

TEST_F(ChordsCommand, tells_the_steps_where_chords_end) {
  const Outcome outcome = chords("line --from 0,0 --to 0.25,-0.25,1.1 --steps-per-mm 10,10,5");
  EXPECT_EQ(outcome.out,
            "chord,x,y,z,deviation,steps_x,steps_y,steps_z\n"
            "0,0,0,0,0,0,0,0\n"
            "1,0.25,-0.25,1.1,0,3,-3,6\n");
  // Halves away from zero; and chords that are shorter than a step are in the next one.
  const std::string fine = "arc --from 10,0 --to 10,0 --center 0,0 --tolerance 0.0001";
  EXPECT_LT(rows(chords(fine + " --steps-per-mm 1").out).size(), rows(chords(fine).out).size() / 4);
}

TEST_F(ChordsCommand, a_period_and_a_feed_make_equal_chords) {
  // 600 mm/min for 0.1 s: 1 mm a chord.
  const auto all = rows(chords("arc --from 10,0 --to 0,10 --center 0,0 --feed 600 --period 0.1").out);
  ASSERT_EQ(all.size(), 17U);
  for (std::size_t i = 1; i + 1 < all.size(); ++i) {
    EXPECT_NEAR(std::hypot(all[i][1] - all[i - 1][1], all[i][2] - all[i - 1][2]), 1, 1e-9);
    EXPECT_NEAR(all[i][4], 10 - std::sqrt(99.75), 1e-6);
  }
  EXPECT_EQ(all.back()[2], 10);
  EXPECT_EQ(chords("ellipse --center 0,0 --radii 40,15 --feed 600 --period 0.5 --picture " + path("p.svg")).code, 0);
  EXPECT_THAT(read(path("p.svg")), HasSubstr("</svg>"));
}

TEST_F(ChordsCommand, a_fine_method_steps_along_the_chords_of_any_curve) {
  for (const char* curve :
       {"arc --from 10,0 --to 0,10 --center 0,0", "parabola --vertex 0,0 --focus 0,10 --from -20,10 --to 10,2.5",
        "ellipse --center 0,0 --radii 8,4 --angles 0,200", "bezier --from 0,0 --control 0,20 --control 30,20 --to 30,0",
        "nurbs --control 0,0 5,10 10,-10 15,10 20,0"}) {
    const std::string ends = chords(std::string(curve) + " --tolerance 0.05 --steps-per-mm 20").out;
    for (const char* method : {"bresenham", "master-slave", "dda", "slope-recalculated", "point-comparison"}) {
      const Outcome fine = chords(std::string(curve) + " --tolerance 0.05 --steps-per-mm 20 --fine " + method);
      EXPECT_EQ(fine.code, 0) << fine.err;
      EXPECT_THAT(fine.out, StartsWith("pulse,chord,steps_x,steps_y,steps_z,deviation\n1,1,"));
      const auto pulses = rows(fine.out);
      const auto chord_ends = rows(ends);
      for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(pulses.back()[2 + axis], chord_ends.back()[5 + axis]);
      for (const auto& pulse : pulses) EXPECT_LE(pulse[5], 0.05 + (std::sqrt(0.5) + 1) / 20);
    }
  }
}

TEST_F(ChordsCommand, draws_both_levels_together) {
  const std::string ellipse = "ellipse --center 0,0 --radii 8,4 --tolerance 0.1 --steps-per-mm 5 --fine lean ";
  EXPECT_EQ(chords(ellipse + "--picture " + path("b.svg") + " -o " + path("b.csv")).code, 0);
  EXPECT_THAT(read(path("b.svg")), HasSubstr("</svg>"));
  EXPECT_THAT(read(path("b.csv")), StartsWith("pulse,chord,"));
  EXPECT_EQ(chords("helix --from 8,0,0 --to 8,0,12 --center 0,0 --turns 2 --feed 600 --period 0.1 --steps-per-mm 5 "
                   "--fine dda --picture " +
                   path("h.png"))
                .code,
            0);
}

TEST_F(ChordsCommand, draws_a_picture_and_writes_files_whole) {
  const std::string ellipse = "ellipse --center 0,0 --radii 40,15 --tolerance 0.2 ";
  const Outcome drawn = chords(ellipse + "--picture " + path("e.svg"));
  EXPECT_EQ(drawn.code, 0);
  EXPECT_EQ(drawn.out, "");
  EXPECT_THAT(read(path("e.svg")), HasSubstr("</svg>"));
  EXPECT_EQ(chords(ellipse + "--picture " + path("e.png") + " -o " + path("e.csv")).code, 0);
  EXPECT_THAT(read(path("e.png")), StartsWith("\x89PNG"));
  EXPECT_THAT(read(path("e.csv")), StartsWith("chord,x,y,z,deviation\n0,40,0,0,0\n"));
  EXPECT_EQ(chords(ellipse + "-o " + path("nowhere/e.csv")).code, 1);
}

TEST_F(ChordsCommand, what_is_wrong_is_said_and_exits_with_2) {
  const auto wrong = [&](const std::string& arguments) {
    const Outcome outcome = chords(arguments + " -o " + path("never.csv"));
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_EQ(outcome.out, "") << arguments;
    return outcome.err;
  };
  EXPECT_THAT(wrong("spiral --from 0,0"), HasSubstr("'spiral' is not one of line, arc, helix, ellipse"));
  EXPECT_THAT(wrong("arc --from 10,0 --to 0,10"), HasSubstr("--center is missing: X,Y or X,Y,Z in mm"));
  EXPECT_THAT(wrong("arc --from 10,0 --to '0;10' --center 0,0"),
              HasSubstr("--to: expected X,Y or X,Y,Z in mm, found '0;10'"));
  EXPECT_THAT(wrong("arc --from 10,0 --to 0,11 --center 0,0"), HasSubstr("an arc has one radius"));
  EXPECT_THAT(wrong("arc --from 0,0 --to 0,0 --center 0,0"), HasSubstr("the arc has no radius"));
  EXPECT_THAT(wrong("arc --from 10,0 --to 0,10 --center 0,0 --radii 1,2"), HasSubstr("--radii is not for --curve arc"));
  EXPECT_THAT(wrong("ellipse --center 0,0 --radii 10,0"), HasSubstr("above 0 mm"));
  EXPECT_THAT(wrong("ellipse --center 0,0 --radii 10,5 --angles 30,30"), HasSubstr("an angle other than 0"));
  EXPECT_THAT(wrong("parabola --vertex 0,0 --focus 0,10 --from -20,11 --to 0,0"),
              HasSubstr("at that height is -20,10"));
  EXPECT_THAT(wrong("parabola --vertex 0,0 --focus 0,0 --from 0,0 --to 1,1"), HasSubstr("two different points"));
  EXPECT_THAT(wrong("bezier --from 0,0 --to 1,1"), HasSubstr("one --control"));
  EXPECT_THAT(wrong("nurbs --control 0,0 1,1"), HasSubstr("at least 4 control points, not 2"));
  EXPECT_THAT(wrong("nurbs --control 0,0 1,1 2,0 3,0 --knots 0 1 2"), HasSubstr("needs 8 knots, not 3"));
  EXPECT_THAT(wrong("line --from 0,0 --to 1e9,1"), HasSubstr("100000 mm"));
  EXPECT_THAT(wrong("line --from 0,0 --to 1,1 --tolerance 0"), HasSubstr("0.000001 mm or more"));
  EXPECT_THAT(wrong("line --from 0,0 --to 1,1 --tolerance nan"), HasSubstr("--tolerance"));
  EXPECT_THAT(wrong("line --from 0,0 --to 1,1 --steps-per-mm 0"), HasSubstr("above 0"));
  EXPECT_THAT(wrong("line --from 0,0 --to 50000,1 --steps-per-mm 100000"), HasSubstr("2147483647 steps on X"));
  EXPECT_THAT(wrong("line --from 0,0 --to 1,1 --picture " + path("p.pdf")), HasSubstr(".svg or .png"));
  EXPECT_THAT(wrong("helix --from 100,0 --to 100,0,9 --center 0,0 --turns 1000 --picture " + path("p.svg")),
              HasSubstr("too many"));
  const std::string arc = "arc --from 10,0 --to 10,0 --center 0,0 ";
  EXPECT_THAT(wrong(arc + "--period 0.1"), HasSubstr("--feed"));
  EXPECT_THAT(wrong(arc + "--feed 600"), HasSubstr("--period"));
  EXPECT_THAT(wrong(arc + "--feed 600 --period 0.1 --tolerance 0.1"), HasSubstr("excludes"));
  EXPECT_THAT(wrong(arc + "--feed 600 --period 0"), HasSubstr("above 0"));
  EXPECT_THAT(wrong(arc + "--feed 600 --period 5"), HasSubstr("shorter --period"));
  EXPECT_THAT(wrong(arc + "--fine lean"), HasSubstr("--steps-per-mm"));
  EXPECT_THAT(wrong(arc + "--steps-per-mm 10 --fine wu"), HasSubstr("not one of master-slave"));
  EXPECT_THAT(wrong(arc + "--steps-per-mm 10 --fine midpoint"), HasSubstr("for arcs"));
  EXPECT_THAT(wrong("line --from 0,0 --to 5,5,5 --steps-per-mm 10 --fine slope-blocks"), HasSubstr("two axes"));
  EXPECT_TRUE(files().empty());
}

}  // namespace
