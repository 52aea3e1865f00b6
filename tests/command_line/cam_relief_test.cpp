// passo cam relief, as a user starts it: from a picture to a program that a machine can run.
#include "kit/command_line.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

const std::string flower = checkout + "/examples/reliefs/flower.png";

class CamRelief : public passo::test::CommandLine {
 protected:
  Outcome relief(const std::string& arguments) const { return passo("cam relief " + arguments); }
};

TEST_F(CamRelief, three_cutters_carve_a_picture_and_a_machine_can_run_it) {
  const Outcome made = relief(flower +
                              " --width 20 --depth -3 --rough flat:4 --cutter ball:2 --rest ball:0.8 --scallop 0.2 "
                              "--origin center --spindle 12000 -o " +
                              path("f.ngc") + " -p " + path("f.png"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_EQ(made.err, "");
  EXPECT_THAT(made.out, HasSubstr("240 x 240 pixels, 16 bit grey, luminance\n20 x 20 mm, "));
  EXPECT_THAT(made.out, HasSubstr("rest finishing: ball nose, 0.8 mm; stepover "));
  const std::string program = read(path("f.ngc"));
  EXPECT_THAT(program, HasSubstr("(from flower.png: 240 x 240 pixels, 16 bit grey, luminance)"));
  EXPECT_THAT(program, HasSubstr("(MSG, tool 3: ball nose, 0.8 mm)\nT3 M6\n"));
  EXPECT_GT(std::filesystem::file_size(path("f.png")), 10'000U);
  const Outcome checked = passo("check " + path("f.ngc") + on_router);
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("no errors"));
}

TEST_F(CamRelief, starts_the_spindle_unless_told_otherwise) {
  const std::string small = flower + " --width 10 --step 1 -o " + path("s.ngc");
  EXPECT_EQ(relief(small).code, 0);
  EXPECT_THAT(read(path("s.ngc")), HasSubstr("\nM3 S12000\n"));
  const Outcome checked = passo("check " + path("s.ngc") + on_router);
  EXPECT_THAT(checked.out + checked.err, Not(HasSubstr("spindle is stopped")));
  EXPECT_EQ(relief(small + " --spindle 0").code, 0);
  EXPECT_THAT(read(path("s.ngc")), Not(HasSubstr("M3")));
}

TEST_F(CamRelief, without_output_the_program_goes_to_standard_output_and_is_always_the_same) {
  const Outcome made = relief(flower + " --width 10 --way both --cutter vee:60:3:0.2 --step 1");
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("(finishing: V of 60 degrees, 3 mm, tip 0.2 mm)"));
  EXPECT_THAT(made.out, HasSubstr("\nM2\n"));
  EXPECT_EQ(relief(flower + " --width 10 --way both --cutter vee:60:3:0.2 --step 1").out, made.out);
}

TEST_F(CamRelief, contours_offsets_arcs_and_held_removal_run_on_a_machine_and_cut_no_gouge) {
  std::string map;
  std::string target;
  for (int y = 0; y <= 20; ++y) {
    for (int x = 0; x <= 20; ++x) {
      const double out = std::hypot(x - 10, y - 10);
      const double high = std::max(0.0, 4 - out * 0.6);
      map += fmt::format("{},{},{}\n", x, y, high);
      target += fmt::format("{},{},{}\n", x, y, high - 4);
    }
  }
  const std::string program = path("c.ngc");
  const Outcome made = relief(write("cone.csv", map) +
                              " --pitch 0.2 --cutter ball:2 --way contours --steep 25 --rough flat:4 --rough-way "
                              "offsets --rough-removal 900 --feed-most 2000 -o " +
                              program);
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr(" of them arcs, "));
  EXPECT_THAT(made.out, HasSubstr(" mm3/min\n"));
  const Outcome checked = passo("check " + program + on_router);
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_THAT(checked.err, Not(HasSubstr("warning")));
  const Outcome cut = passo("simulate " + program + " --tool 1=flat:4 --tool 2=ball:2 --cell 0.2 --compare " +
                            write("target.csv", target));
  EXPECT_THAT(cut.out, HasSubstr("gouges          none")) << cut.err;
  EXPECT_EQ(relief(flower + " --width 10 --way contours --moves lines -o " + program).code, 0);
  EXPECT_THAT(read(program), Not(testing::AnyOf(HasSubstr("G2 "), HasSubstr("G3 "), HasSubstr("G18"))));
}

TEST_F(CamRelief, a_height_map_is_carved_too) {
  std::string map;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 4; ++x)
      map += std::to_string(x * 10) + "," + std::to_string(y * 10) + "," + std::to_string(x) + "\n";
  }
  const Outcome made = relief(write("map.csv", map) + " --cutter ball:6 --way spiral --pitch 1 -o " + path("m.ngc"));
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out,
              HasSubstr("12 triangles, seen from above\n30 x 20 mm, 3 mm deep; 31 x 21 grid points, 1 mm apart\n"));
}

struct Block {
  double low[3];
  double high[3];
};

// The text of an STL model.
std::string stl_of(const std::vector<Block>& blocks) {
  constexpr int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::string text = "solid part\n";
  for (const Block& block : blocks) {
    const auto corner = [&](int i) {
      return fmt::format("vertex {} {} {}\n", ((i & 1) != 0 ? block.high : block.low)[0],
                         ((i & 2) != 0 ? block.high : block.low)[1], ((i & 4) != 0 ? block.high : block.low)[2]);
    };
    const auto facet = [&](int a, int b, int c) {
      text += "facet normal 0 0 0\nouter loop\n" + corner(a) + corner(b) + corner(c) + "endloop\nendfacet\n";
    };
    for (const auto& side : sides) {
      facet(side[0], side[1], side[2]);
      facet(side[0], side[2], side[3]);
    }
  }
  return text + "endsolid part\n";
}

const std::vector<Block> rib_on_a_plate = {{{0, 0, -9}, {40, 12, -8}}, {{20.05, 1, -8}, {20.3, 11, 0}}};

TEST_F(CamRelief, a_rib_thinner_than_a_cell_stays_and_one_that_was_cut_away_is_found) {
  const std::string part = write("rib.stl", stl_of(rib_on_a_plate));
  const std::string plate = write("plate.stl", stl_of({rib_on_a_plate[0], {{39, 11, -8}, {40, 12, 0}}}));
  const std::string compare = " --tool ball:6 --cell 0.5 --tolerance 0.1 --compare " + part;
  for (const char* way : {"rows", "contours"}) {
    const Outcome made = relief(part + " --cutter ball:6 --way " + way + " -o " + path("r.ngc"));
    EXPECT_EQ(made.code, 0) << made.err;
    const Outcome good = passo("simulate " + path("r.ngc") + compare);
    EXPECT_EQ(good.code, 0) << good.err;
    EXPECT_THAT(good.out, HasSubstr("gouges          none deeper than "));
  }
  EXPECT_EQ(relief(plate + " --cutter ball:6 -o " + path("p.ngc")).code, 0);
  const Outcome bad = passo("simulate " + path("p.ngc") + compare);
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.err, HasSubstr("[simulate.gouge]"));
}

// Each side is compared with the model as it lies there: nothing is cut into.
TEST_F(CamRelief, both_sides_of_a_model_are_carved_with_dowel_holes_and_instructions) {
  const std::vector<Block> top = {{{-10, -6, -6}, {10, 6, -2}}, {{-6, -3, -2}, {4, 3, 0}}};
  const std::vector<Block> bottom = {{{-10, -6, -4}, {10, 6, 0}}, {{-4, -3, -6}, {6, 3, -4}}};
  const std::string part = write("part.stl", stl_of(top));
  const std::string job = path("job");
  const std::string options = " --two-sided x --origin center --rough flat:4 --cutter ball:3 --pitch 0.1 -o " + job;
  const Outcome made = relief(part + options);
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(read(job + "/1-dowels.ngc"), HasSubstr("X-26."));
  const std::string page = read(job + "/relief.html");
  EXPECT_THAT(page, HasSubstr("Flip it from left to right, about the line X0."));
  EXPECT_THAT(page, HasSubstr("The web is cut through except at 4 tabs"));
  EXPECT_THAT(page, HasSubstr("data:image/png"));
  EXPECT_THAT(read(job + "/3-flip.svg"), HasSubstr("<svg"));
  EXPECT_TRUE(std::filesystem::exists(job + "/2-top.png"));
  const std::string tools = " --tool 1=flat:4 --tool 2=ball:3 --cell 0.2 --stock X-20:20,Y-16:16,Z-6:0 --compare ";
  const Outcome first = passo("simulate " + job + "/2-top.ngc" + tools + part);
  EXPECT_EQ(first.code, 0) << first.err;
  const Outcome second = passo("simulate " + job + "/3-bottom.ngc" + tools + write("b.stl", stl_of(bottom)));
  EXPECT_EQ(second.code, 0) << second.err;

  EXPECT_EQ(relief(part + options + " --pins 0").code, 0);
  EXPECT_TRUE(std::filesystem::exists(job + "/1-top.ngc"));
  EXPECT_FALSE(std::filesystem::exists(job + "/1-dowels.ngc")) << "of the former job";
  EXPECT_FALSE(std::filesystem::exists(job + "/3-bottom.ngc"));

  const auto refused = [&](const std::string& arguments, const char* words) {
    const Outcome outcome = relief(arguments);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
  };
  refused(part + " --two-sided y", "--two-sided: expected --output FOLDER");
  refused(part + " --mirror" + options, "--two-sided: cannot be combined with --mirror");
  refused(part + " --tab-height 5" + options, "a lower --tab-height");
  refused(part + " --parting -0.5 --tab-height 1" + options, "no tab would hold the part");
  refused(flower + options, "has no other side");
}

// Each note and warning on standard error is in the summary too.
TEST_F(CamRelief, a_summary_as_json_has_all_notes_and_warnings) {
  std::string pyramid = "solid part\n";
  const char* const corners[] = {"-10 -8 0", "10 -8 0", "10 8 0", "-10 8 0"};
  const auto facet = [&](const char* a, const char* b, const char* c) {
    pyramid +=
        fmt::format("facet normal 0 0 0\nouter loop\nvertex {}\nvertex {}\nvertex {}\nendloop\nendfacet\n", a, b, c);
  };
  for (int i = 0; i < 4; ++i) facet(corners[i], corners[(i + 1) % 4], "0 0 12");
  facet(corners[0], corners[2], corners[1]);
  facet(corners[0], corners[3], corners[2]);
  const std::string part = write("pyramid.stl", pyramid + "endsolid part\n");
  const std::string coarse = " --cutter ball:3 --pitch 0.2 --scallop 0.2 ";
  const Outcome sides = relief(part + coarse + "--two-sided x --json -o " + path("job"));
  EXPECT_EQ(sides.code, 0) << sides.err;
  const nlohmann::json both = nlohmann::json::parse(sides.out);
  EXPECT_EQ(both["tabs"], 4);
  EXPECT_EQ(both["sides"][1]["program"], "3-bottom.ngc");
  ASSERT_EQ(both["notes"].size(), 2U) << sides.err;
  for (const std::string words : both["notes"]) EXPECT_THAT(sides.err, HasSubstr(words));

  const Outcome one = relief(part + coarse + "--json -o " + path("p.ngc"));
  EXPECT_EQ(one.code, 0) << one.err;
  const nlohmann::json summary = nlohmann::json::parse(one.out);
  EXPECT_EQ(summary["passes"][0]["what"], "finishing");
  EXPECT_GT(summary["passes"][0]["moves"], 20);
  EXPECT_FALSE(summary.contains("warnings"));
  EXPECT_THAT(relief(part + coarse + "--json").err, HasSubstr("the program needs --output FILE"));
}

TEST_F(CamRelief, a_model_is_turned_and_has_a_unit) {
  const std::string part = write("part.stl", stl_of({{{0, 0, 0}, {4, 1, 2}}}));
  const std::string out = " --cutter flat:3 -o " + path("t.ngc");
  EXPECT_THAT(relief(part + out).out, HasSubstr("\n4 x 1 mm, "));
  EXPECT_THAT(relief(part + " --up y" + out).out, HasSubstr("\n4 x 2 mm, "));
  EXPECT_THAT(relief(part + " --up -x --input-units inch" + out).out, HasSubstr("\n50.8 x 25.4 mm, "));
  const std::string tiny = write("tiny.stl", stl_of({{{0, 0, 0}, {0.01, 0.01, 0.001}}}));
  const Outcome asked = relief(tiny + out);
  EXPECT_EQ(asked.code, 2);
  EXPECT_THAT(asked.err, HasSubstr("the model is 0.01 by 0.01 mm: is it in metres or inches?"));
  EXPECT_EQ(relief(tiny + " --input-units m" + out).code, 0);
  const Outcome many = relief(tiny + " --width 1 --pitch 0.001 --overrun 20" + out);
  EXPECT_EQ(many.code, 2);
  EXPECT_THAT(many.err, HasSubstr("[relief.too-many-nodes]"));
}

TEST_F(CamRelief, is_cut_within_a_curve_in_rows_of_all_kinds_and_no_deeper_than_a_z) {
  const std::string oval = write("oval.svg",
                                 "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='20mm' viewBox='0 0 20 "
                                 "20'><circle cx='10' cy='10' r='5'/></svg>");
  const std::string small = flower + " --width 20 --depth -2 --cutter ball:2 --scallop 0.1 -o " + path("s.ngc");
  const auto simulated = [&] { return passo("simulate " + path("s.ngc") + " --tool ball:2 --cell 0.1 --json").out; };
  for (const std::string options : {" --angle 30", " --one-way climb", " --spacing slope", " --way both"}) {
    const Outcome made = relief(small + options + " --within " + oval);
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.err, "") << options;
    // The circle of the axis, and the cutter's radius around it: X4 to X16.
    EXPECT_THAT(passo("simulate " + path("s.ngc") + " --tool ball:2").out, HasSubstr("X 4")) << options;
    EXPECT_THAT(simulated(), Not(HasSubstr("simulate.rapid"))) << options;
  }
  EXPECT_THAT(relief(small + " --lowest-z -1.2").out, HasSubstr("\n20 x 20 mm, 1.2 mm deep"));
  const auto refused = [&](const std::string& options, const std::string& words) {
    const Outcome outcome = relief(small + options);
    EXPECT_EQ(outcome.code, 2) << options;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << options;
  };
  refused(" --lowest-z 1", "--lowest-z: expected a Z below the top at Z0, found '1'; write --lowest-z -1");
  refused(" --within " + oval + " --origin 100,0", "lie beside the relief");
  refused(" --within " + write("line.svg", "<svg xmlns='http://www.w3.org/2000/svg' width='9mm' height='9mm'/>"),
          "there is no closed curve");
  refused(" --within " + oval + " --way spiral", "--within: expected --way rows, columns, both or contours");
  refused(" --angle 30 --way columns", "--angle: expected --way rows, found columns");
  refused(" --one-way climb --way contours", "--one-way: expected --way rows, columns or both, found contours");
  EXPECT_THAT(relief(flower + " --spacing slope --cutter flat:2").err,
              HasSubstr("--spacing slope: expected a cutter with a round tip"));
  refused(" --background 100", "--background");
}

TEST_F(CamRelief, what_is_wrong_is_told_and_nothing_is_written) {
  const std::string out = " -o " + path("r.ngc");
  const auto refused = [&](const std::string& arguments, const std::string& words) {
    const Outcome outcome = relief(arguments + out);
    EXPECT_EQ(outcome.code, 2) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(words)) << arguments;
  };
  refused(path("none.png"), "[picture.unreadable]");
  refused(write("cut.png", read(flower).substr(0, 20'000)), "the picture cannot be read: the file ends too early");
  refused(write("noise.png", std::string("\x7f\0\1", 3)), "[surface.unknown-kind]");
  const std::string essay = write("essay.txt", "Dear reader,\nthis is no relief.\nNot at all.\n");
  refused(essay, "this is not a height map: 'this' is not a valid length");
  EXPECT_THAT(relief(essay).err, HasSubstr("1 error"));
  refused(write("logo.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>\n"), "this is an SVG drawing");
  refused(flower + " --channel alpha", "it has no alpha channel");
  refused(flower + " --cutter ball", "--cutter: 'ball': expected ball:DIAMETER");
  refused(flower + " --rest drill:1", "--rest: 'drill:1' is not a valid cutter");
  refused(flower + " --depth -300", "--depth: expected -250 to -0.001 mm, found '-300'");
  refused(flower + " --depth 4", "--depth: expected a Z below the top at Z0, found '4'; write --depth -4");
  refused(flower + " --pitch 0.001", "[relief.too-many-nodes]");
  refused(flower + " --origin top", "--origin: expected lower-left");
  refused(flower + " --way waterline", "--way: waterline not in");
  refused(flower + " --removal=-1", "--removal: expected a number from 0");
  refused(flower + " --feed-most 0", "--feed-most: expected 1 to 100000 mm, found '0'");
  refused(flower + " -p view.svg", "expected a name that ends with .png");
  EXPECT_EQ(relief(flower + " -o " + flower).code, 2) << "the picture itself would be overwritten";
  EXPECT_FALSE(std::filesystem::exists(path("r.ngc")));
}

}  // namespace
