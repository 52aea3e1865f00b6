// passo cam job, as a user starts it: from a job file to a program that cuts the part, and nothing else.
#include <cmath>
#include <functional>
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::checkout;
using passo::test::on_router;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;
using testing::Not;

struct JobExample {
  const char* name;
  const char* stock;  // for passo simulate: half a millimetre below it is the waste board
  const char* tools;
  int programs;
};

class CamJob : public passo::test::CommandLine {
 protected:
  static std::string example(const std::string& name) { return checkout + "/examples/jobs/" + name + ".toml"; }

  // A plate of 40 x 30 mm with a pocket of 10 x 10 mm. `more`: other elements, and other lines of the job file.
  std::string small_job(const std::string& more_svg = "", const std::string& more_toml = "", const char* depth = "-2") {
    write(
        "small.svg",
        "<svg xmlns='http://www.w3.org/2000/svg' "
        "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' width='60mm' height='50mm' viewBox='0 0 60 50'>\n"
        "<g inkscape:groupmode='layer' inkscape:label='cut'><rect x='10' y='10' width='40' height='30'/></g>\n"
        "<g inkscape:groupmode='layer' inkscape:label='pockets'><rect x='20' y='20' width='10' height='10'/>" +
            more_svg + "</g>\n</svg>\n");
    return write("small.toml",
                 "[job]\ndrawing = \"small.svg\"\nclearance = 5\n"
                 "[stock]\nsize = [60, 50]\nthickness = 4\n"
                 "[tool.1]\nshape = \"flat\"\ndiameter_mm = 3\nfeed_mm_min = 600\nplunge_mm_min = 200\n"
                 "[[operation]]\nkind = \"profile\"\ntool = 1\nlayer = \"cut\"\ndepth = -4.2\nstep = 2\n"
                 "[[operation]]\nkind = \"pocket\"\ntool = 1\nlayer = \"pockets\"\ndepth = " +
                     std::string(depth) + "\n" + more_toml);
  }
  nlohmann::json record(const std::string& name) const {
    return nlohmann::json::parse(read(path(name + ".job.json")), nullptr, false);
  }
};

TEST_F(CamJob, every_example_cuts_its_stock_and_nothing_else) {
  const std::vector<JobExample> examples = {
      {"plate", "X0:120,Y0:80,Z-8.5:0", "--tool 1=flat:6 --tool 2=flat:5", 1},
      {"sign", "X-3:183,Y-3:63,Z-12.5:0", "--tool 1=vee:60:12 --tool 2=flat:4", 1},
      {"finger-box", "X0:300,Y0:170,Z-6.5:0", "--tool 1=flat:3", 1},
      {"bracket", "X-10:100,Y-10:90,Z-10.5:0", "--tool 1=flat:8 --tool 2=flat:4 --tool 3=vee:90:8", 1},
      {"clock", "X-90:90,Y-90:90,Z-8.5:0", "--tool 1=vee:60:6:0.2 --tool 2=flat:3", 1},
      {"guitar", "X-12:218,Y-12:138,Z-20.5:0", "--tool 1=flat:8 --tool 2=flat:5", 1},
      {"coaster", "X-50:50,Y-50:50,Z-8.5:0", "--tool 1=flat:4 --tool 2=ball:4", 1},
      {"gear", "X-45:45,Y-45:45,Z-6.5:0", "--tool 1=flat:4 --tool 2=flat:2", 2},
      {"shelf-bracket", "X0:450,Y0:300,Z-9.5:0", "--tool 1=flat:5", 1}};
  for (const JobExample& one : examples) {
    SCOPED_TRACE(one.name);
    const Outcome made = passo("cam job " + example(one.name) + " -o " + path("p.ngc"));
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.err, "");
    const nlohmann::json job = record("p");
    ASSERT_EQ(job["programs"].size(), static_cast<std::size_t>(one.programs));
    for (const auto& operation : job["operations"]) {
      EXPECT_GT(operation["cut_mm"], 1.0) << operation["title"];
      // Dog-bones are cut into the part on purpose.
      const bool has_bones = operation["title"] == "profile sides";
      const double lost = operation.contains("figures") ? operation["figures"].value("lost_mm2", 0.0) : 0;
      EXPECT_TRUE(has_bones ? lost < 60 : lost == 0) << operation["title"];
    }
    for (const auto& program : job["programs"]) {
      const std::string file = path(program["file"]);
      const Outcome checked = passo("check " + file + on_router);
      EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
      const Outcome cut = passo("simulate " + file + " --cell 0.5 --stock " + one.stock + " " + one.tools);
      EXPECT_EQ(cut.code, 0) << cut.out << cut.err;
    }
  }
}

// 60 x 50 x 4 mm of stock, of which the pocket of 10 x 10 x 2 mm takes 200 mm³ less the corners that 1.5 mm of radius
// leave.
TEST_F(CamJob, the_report_says_how_much_stock_each_operation_leaves) {
  const Outcome made = passo("cam job " + small_job() + " -o " + path("p.ngc"));
  ASSERT_EQ(made.code, 0) << made.err;
  const nlohmann::json job = record("p");
  constexpr double stock = 60 * 50 * 4;
  constexpr double pi = 3.14159265358979;
  constexpr double pocket = (100 - 1.5 * 1.5 * (4 - pi)) * 2;
  EXPECT_NEAR(job["stock_mm3"], stock, 1);
  const auto& first = job["operations"][0];
  EXPECT_EQ(first["kind"], "pocket");
  EXPECT_NEAR(first["stock_left_mm3"], stock - pocket, 0.01 * pocket);
  EXPECT_NEAR(first["stock_left_percent"], 100 * (stock - pocket) / stock, 0.02);
  const auto& last = job["operations"][1];
  EXPECT_NEAR(last["stock_left_mm3"].get<double>(),
              first["stock_left_mm3"].get<double>() - last["removed_mm3"].get<double>(), 0.01);
  EXPECT_THAT(made.out, HasSubstr("stock %"));
  EXPECT_THAT(made.out, HasSubstr("98.3"));
}

// Where the cutter's centre may be while its tip is in the plate of examples/jobs/plate.svg, with 3 mm of radius.
bool may_cut_the_plate(double x, double y) {
  constexpr double slack = 0.01;
  const bool outside = x < 7 + slack || x > 113 - slack || y < 7 + slack || y > 73 - slack ||
                       std::hypot(std::max({18 - x, x - 102, 0.0}), std::max({18 - y, y - 62, 0.0})) > 11 - slack;
  const bool pocket = x > 33 - slack && x < 55 + slack && y > 25 - slack && y < 55 + slack;
  const bool circle = std::hypot(x - 82, y - 40) < 11 + slack;
  return outside || pocket || circle;
}

TEST_F(CamJob, the_plate_keeps_its_shape) {
  ASSERT_EQ(passo("cam job " + example("plate") + " -o " + path("p.ngc")).code, 0);
  const Outcome canon = passo("canon " + path("p.ngc"));
  ASSERT_EQ(canon.code, 0) << canon.err;
  std::istringstream lines(canon.out);
  std::string line;
  bool is_mill = false;
  std::size_t seen = 0;
  while (std::getline(lines, line)) {
    if (const std::size_t change = line.find("CHANGE_TOOL("); change != std::string::npos) {
      is_mill = line.compare(change, 14, "CHANGE_TOOL(1)") == 0;
    }
    const std::size_t feed = line.find("STRAIGHT_FEED(");
    double x = 0;
    double y = 0;
    double z = 0;
    if (!is_mill || feed == std::string::npos) continue;
    ASSERT_EQ(std::sscanf(line.c_str() + feed, "STRAIGHT_FEED(%lf, %lf, %lf", &x, &y, &z), 3) << line;
    if (z >= 0) continue;
    ++seen;
    EXPECT_TRUE(may_cut_the_plate(x, y)) << line;
  }
  EXPECT_GT(seen, 50U);
}

TEST_F(CamJob, the_report_explains_the_order_and_counts_the_changes) {
  const Outcome made = passo("cam job " + example("plate") + " -o " + path("p.ngc") + " -p " + path("p.png"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("order: 'cut out' is number 4 instead of 1: it frees the part, so it comes last\n"));
  EXPECT_THAT(made.out, HasSubstr("; 1 tool change\n"));
  EXPECT_THAT(made.out, HasSubstr("written: " + path("p.ngc")));
  EXPECT_GT(std::filesystem::file_size(path("p.png")), 10'000U);
  const std::string program = read(path("p.ngc"));
  EXPECT_LT(program.find("T2 M6"), program.find("T1 M6"));
  EXPECT_EQ(program.find("M2\n"), program.size() - 3) << "the program ends once";
}

TEST_F(CamJob, a_clamp_in_the_way_is_named_with_operation_and_line_and_nothing_is_written) {
  const std::string job =
      small_job("", "[[clamp]]\nname = \"toe clamp\"\nfrom = [50, 20]\nto = [60, 30]\nheight = 3\n");
  const Outcome made = passo("cam job " + job);
  EXPECT_EQ(made.code, 2) << made.out;
  EXPECT_THAT(made.err, HasSubstr("'profile cut', tool 1: a feed move goes"));
  EXPECT_THAT(made.err, HasSubstr("into 'toe clamp' at X"));
  EXPECT_THAT(made.err, HasSubstr("[job.clamp]"));
  EXPECT_THAT(made.err, testing::ContainsRegex("small.ngc:[0-9]+: error"));
  EXPECT_FALSE(std::filesystem::exists(path("small.ngc")));
  EXPECT_FALSE(std::filesystem::exists(path("small.job.json")));
}

TEST_F(CamJob, a_rapid_over_a_high_clamp_is_an_error_and_a_higher_clearance_solves_it) {
  // Between two pockets, where the cutter passes at the clearance.
  const std::string clamp = "[[clamp]]\nfrom = [33, 15]\nto = [35, 35]\nheight = 12\n";
  const Outcome low = passo("cam job " + small_job("<rect x='38' y='20' width='8' height='10'/>", clamp));
  EXPECT_EQ(low.code, 2) << low.out;
  EXPECT_THAT(low.err, HasSubstr("a rapid goes"));
  EXPECT_THAT(low.err, HasSubstr("a clearance above 12"));
  std::string text = read(path("small.toml"));
  text.replace(text.find("clearance = 5"), 13, "clearance = 13");
  write("small.toml", text);
  EXPECT_EQ(passo("cam job " + path("small.toml")).code, 0);
}

TEST_F(CamJob, the_advice_about_a_clamp_names_the_heights_that_are_too_low) {
  // Above the park position, where the cutter goes at the change height.
  const std::string clamp = "[[clamp]]\nfrom = [-5, -5]\nto = [5, 5]\nheight = 25\n";
  const Outcome low = passo("cam job " + small_job("", clamp));
  EXPECT_EQ(low.code, 2) << low.out;
  EXPECT_THAT(low.err, HasSubstr("expected: a change-height above 25, the top of"));
  std::string text = read(path("small.toml"));
  text.insert(text.find("clearance"), "change-height = 26\n");
  EXPECT_EQ(passo("cam job " + write("small.toml", text)).code, 0);
}

TEST_F(CamJob, a_changed_drawing_is_out_of_date_and_the_report_lists_the_differences) {
  const std::string job = small_job();
  EXPECT_EQ(passo("cam job " + job + " --check").code, 1) << "there is no program yet";
  ASSERT_EQ(passo("cam job " + job).code, 0);
  EXPECT_EQ(passo("cam job " + job + " --check").code, 0);
  EXPECT_THAT(passo("cam job " + job).out, HasSubstr("changed: nothing since the last run\n"));

  small_job("<rect x='35' y='20' width='8' height='6'/>");
  const Outcome stale = passo("cam job " + job + " --check");
  EXPECT_EQ(stale.code, 1);
  EXPECT_THAT(stale.err, HasSubstr("[job.out-of-date]"));
  const Outcome again = passo("cam job " + job);
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("changed: 'pocket pockets': moves "));
  EXPECT_THAT(again.out, HasSubstr("1 contour added: 8 x 6 mm at X35 Y24\n"));
  EXPECT_THAT(again.out, Not(HasSubstr("changed: 'profile cut'")));
  EXPECT_EQ(passo("cam job " + job + " --check").code, 0);

  write("small.ngc", read(path("small.ngc")) + "(edited)\n");
  EXPECT_THAT(passo("cam job " + job + " --check").err, HasSubstr("was edited"));
}

TEST_F(CamJob, the_same_inputs_give_the_same_program) {
  const std::string job = small_job();
  ASSERT_EQ(passo("cam job " + job).code, 0);
  const std::string first = read(path("small.ngc"));
  ASSERT_EQ(passo("cam job " + job).code, 0);
  EXPECT_EQ(read(path("small.ngc")), first);
}

TEST_F(CamJob, a_wrong_value_points_at_its_key) {
  const Outcome made = passo("cam job " + small_job("", "", "2"));
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("small.toml:22:9: error: 'pocket pockets' cannot have this depth [job.bad-value]"));
  EXPECT_THAT(made.err, HasSubstr("expected: a length below 0, e.g. -3, found '2'"));
  EXPECT_FALSE(std::filesystem::exists(path("small.ngc")));
}

TEST_F(CamJob, all_wrong_operations_are_shown_at_once_and_an_old_program_stays) {
  ASSERT_EQ(passo("cam job " + small_job()).code, 0);
  const std::string before = read(path("small.ngc"));
  const Outcome made = passo("cam job " + small_job("",
                                                    "[[operation]]\nkind = \"pocket\"\ntool = 1\nlayer = \"pocketz\"\n"
                                                    "[[operation]]\nkind = \"drill\"\ntool = 1\nlayer = \"holes\"\n"));
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("has no layer 'pocketz' [job.no-such-layer]"));
  EXPECT_THAT(made.err, HasSubstr("perhaps pockets"));
  EXPECT_THAT(made.err, HasSubstr("has no layer 'holes'"));
  EXPECT_EQ(read(path("small.ngc")), before);
}

TEST_F(CamJob, a_clamp_that_cannot_be_checked_is_refused) {
  const Outcome made = passo(
      "cam job " + small_job("", "[[clamp]]\nname = \"wall\"\nfrom = [100, -5000]\nto = [5000, 5000]\nheight = 1\n"));
  EXPECT_EQ(made.code, 2) << made.out;
  EXPECT_THAT(made.err, HasSubstr("'wall' is too large [job.clamp-size]"));
}

TEST_F(CamJob, a_cut_far_below_the_stock_is_refused) {
  const Outcome made = passo("cam job " + small_job("", "", "-9"));
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("the tip goes 5.00 mm below the stock at X"))
      << "not the first layer that is too deep";
  EXPECT_THAT(made.err, HasSubstr("a depth of 4.5 mm or less"));
  EXPECT_THAT(made.err, HasSubstr("[job.below]"));
}

TEST_F(CamJob, a_key_without_effect_is_a_warning_unless_the_whole_job_has_it) {
  const std::string job = small_job(
      "", "[[operation]]\nkind = \"profile\"\ntool = 1\nlayer = \"pockets\"\nside = \"inside\"\nspring-passes = 2\n");
  const Outcome made = passo("cam job " + job);
  EXPECT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.err, HasSubstr("small.toml:28:17: warning: 'profile pockets': spring-passes has no effect: it works "
                                  "only with finish-pass [job.no-effect]"));
}

TEST_F(CamJob, a_key_of_the_whole_job_is_a_warning_if_no_operation_uses_it) {
  const auto with = [&](const std::string& keys, const std::string& more = "") {
    std::string text = read(small_job("", more));
    text.insert(text.find("clearance"), keys);
    return passo("cam job " + write("small.toml", text)).err;
  };
  EXPECT_THAT(with("spring-passes = 2\n"), HasSubstr("small.toml:3:17: warning: job.spring-passes has no effect: it "
                                                     "works only with finish-pass [job.no-effect]"));
  EXPECT_THAT(with("peck = 2\n"), HasSubstr("job.peck has no effect: no operation has this option"));
  EXPECT_EQ(with("spring-passes = 2\n",
                 "[[operation]]\nkind = \"profile\"\ntool = 1\nlayer = \"pockets\"\nside = \"inside\"\n"
                 "finish-pass = true\nallowance = 0.1\n"),
            "");
}

TEST_F(CamJob, a_colour_that_is_none_is_refused_with_what_is_one) {
  const Outcome made =
      passo("cam job " + small_job("", "[[operation]]\nkind = \"pocket\"\ntool = 1\ncolor = \"rde\"\ndepth = -1\n"));
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("small.toml:26:9: error: 'pocket rde' cannot have this color [job.bad-value]"));
  EXPECT_THAT(made.err, HasSubstr("a colour, e.g. red, #f00 or rgb(255, 0, 0), or a number of the palette of DXF"));
  const std::string drawing = path("small.svg");
  for (const char* const good : {"red", "DarkRed", "#F00", "'#ff0000'", "'rgb(255, 0, 0)'", "30"}) {
    const Outcome read = passo("cam profile " + drawing + " --color " + good + " -o /dev/null");
    EXPECT_THAT(read.err, Not(HasSubstr("expected a colour"))) << good;
  }
  for (const char* const wrong : {"rde", "'#ff00'", "257", "red,blue", "'rgb(1)'"}) {
    const Outcome read = passo("cam drill " + drawing + " --color " + wrong + " -o /dev/null");
    EXPECT_EQ(read.code, 2) << wrong;
    EXPECT_THAT(read.err, HasSubstr("--color: expected a colour")) << wrong;
  }
}

TEST_F(CamJob, an_operation_on_no_layer_has_its_number_as_its_name) {
  const Outcome made =
      passo("cam job " + small_job("", "[[operation]]\nkind = \"pocket\"\ntool = 1\nlayer = \"\"\ndepth = -1\n"));
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("'pocket 3' cannot be generated"));
}

TEST_F(CamJob, each_tool_has_its_program) {
  ASSERT_EQ(passo("cam job " + example("gear") + " -o " + path("g.ngc")).code, 0);
  const std::string first = read(path("g-1-T1.ngc"));
  const std::string second = read(path("g-2-T2.ngc"));
  EXPECT_THAT(first, HasSubstr("(MSG, tool 1: "));
  EXPECT_THAT(second, HasSubstr("(MSG, tool 2: "));
  EXPECT_THAT(second, HasSubstr("M2\n"));
}

TEST_F(CamJob, a_job_is_written_in_the_words_of_its_controller) {
  std::string text = read(small_job("<circle cx='40' cy='25' r='1.5'/>",
                                    "[[operation]]\nkind = \"drill\"\ntool = 1\nlayer = \"pockets\"\ndepth = -2\n"));
  text.replace(text.find("[job]"), 5, "[job]\nfor = \"grbl\"");
  const Outcome made = passo("cam job " + write("small.toml", text));
  ASSERT_EQ(made.code, 0) << made.err;
  const std::string program = read(path("small.ngc"));
  EXPECT_THAT(program, Not(HasSubstr("G81")));
  EXPECT_THAT(program, Not(HasSubstr("M6")));
  EXPECT_EQ(passo("check " + path("small.ngc") + on_router + " --dialect grbl").code, 0);

  text.replace(text.find("\"grbl\""), 6, "\"gbrl\"");
  EXPECT_THAT(passo("cam job " + write("small.toml", text)).err,
              HasSubstr("job.for is the text \"gbrl\" [job.bad-value]"));
}

TEST_F(CamJob, a_bore_that_is_not_wider_than_its_cutter_is_refused) {
  const std::string bore =
      "[[operation]]\nkind = \"bore\"\ntool = 1\nlayer = \"pockets\"\ndepth = -2\ndrawing = \"holes.svg\"\n";
  const auto holes = [&](const std::string& circles) {
    write("holes.svg",
          "<svg xmlns='http://www.w3.org/2000/svg' xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' "
          "width='60mm' height='50mm' viewBox='0 0 60 50'><g inkscape:groupmode='layer' inkscape:label='pockets'>" +
              circles + "</g></svg>\n");
  };
  holes("<circle cx='40' cy='25' r='1.5'/>\n<circle cx='15' cy='25' r='1'/>\n<circle cx='25' cy='25' r='3'/>");
  const Outcome made = passo("cam job " + small_job("", bore));
  EXPECT_EQ(made.code, 2) << made.out;
  EXPECT_THAT(made.err, HasSubstr("the circle of 3 mm at X40 Y25 mm is not wider than the cutter of 3 mm "
                                  "[drill.narrow-bore]"));
  EXPECT_THAT(made.err, HasSubstr("the circle of 2 mm at X15 Y25 mm is not wider"));
  EXPECT_THAT(made.err, HasSubstr("[job.operation]"));
  EXPECT_FALSE(std::filesystem::exists(path("small.ngc")));

  holes("<circle cx='25' cy='25' r='3'/>");
  const Outcome good = passo("cam job " + small_job("", bore));
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(read(path("small.ngc")), Not(HasSubstr("G81")));
}

TEST_F(CamJob, circles_that_their_drill_does_not_fit_are_named) {
  const std::string drill = "[[operation]]\nkind = \"drill\"\ntool = 1\nlayer = \"pockets\"\ndepth = -2\n";
  const std::string circles =
      "<circle cx='35' cy='25' r='1.5'/><circle cx='40' cy='25' r='2.5'/><circle cx='45' cy='25' r='2.5'/>";
  const Outcome made = passo("cam job " + small_job(circles, drill));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("warning: 2 circles have another diameter than the drill, 3 mm: 2 of 5 mm "
                                  "[drill.other-diameter]\n"));
  EXPECT_THAT(passo("cam job " + small_job(circles, drill + "tolerance = 3\n")).out, Not(HasSubstr("drill.other")));
  EXPECT_THAT(passo("cam job " + small_job("<circle cx='35' cy='25' r='1.51'/>", drill)).out,
              Not(HasSubstr("drill.other")));
}

TEST_F(CamJob, feeds_come_from_the_material_where_the_file_has_none) {
  std::string text = read(small_job());
  text.replace(text.find("feed_mm_min = 600\nplunge_mm_min = 200\n"), 38, "flutes = 2\n");
  text.replace(text.find("thickness = 4"), 13, "thickness = 4\nmaterial = \"plywood\"");
  const Outcome made = passo("cam job " + write("small.toml", text));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("mm per tooth in plywood"));
  EXPECT_THAT(made.out, Not(HasSubstr("tool.chip-small")));
}

TEST_F(CamJob, the_json_is_the_record_with_the_changes) {
  const Outcome made = passo("cam job " + small_job() + " --json");
  ASSERT_EQ(made.code, 0) << made.err;
  const auto json = nlohmann::json::parse(made.out, nullptr, false);
  ASSERT_TRUE(json.is_object()) << made.out;
  EXPECT_EQ(json["operations"].size(), 2U);
  EXPECT_EQ(json["operations"][0]["title"], "pocket pockets");
  EXPECT_EQ(json["operations"][0]["contours"][0], "10 x 10 mm at X20 Y20");
  EXPECT_TRUE(json["changes"].is_array());
}

TEST_F(CamJob, a_job_of_a_stranger_reads_only_its_folder) {
  const std::string job = small_job("", "[[operation]]\nkind = \"pocket\"\ntool = 1\ndrawing = \"../other.svg\"\n");
  const Outcome made = passo("cam job small.toml --only-folder -o made.ngc", "cd " + path("") + " &&");
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("'../other.svg' is outside the job's folder [job.outside]"));
}

TEST_F(CamJob, a_job_of_a_stranger_writes_only_its_folder) {
  small_job();
  std::string text = read(path("small.toml"));
  write("small.toml", text.insert(6, "output = \"../made.ngc\"\n"));
  const Outcome made = passo("cam job small.toml --only-folder", "cd " + path("") + " &&");
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("'../made.ngc' is outside the job's folder [job.outside]"));
}

TEST_F(CamJob, a_drawing_beside_the_stock_is_a_warning) {
  small_job();
  EXPECT_THAT(passo("cam job " + path("small.toml")).err, testing::Not(HasSubstr("job.beside-stock")));
  std::string text = read(path("small.toml"));
  text.replace(text.find("size = [60, 50]"), 15, "size = [20, 20]");
  write("small.toml", text);
  EXPECT_THAT(passo("cam job " + path("small.toml")).err, HasSubstr("beside the stock [job.beside-stock]"));
}

struct CopyBox {
  double left, low, right, high;
};

// Where a part from X10 Y10 to X50 Y40 lies, turned by quarters and moved.
CopyBox box_of_copy(const nlohmann::json& copy) {
  const double angle = copy["degrees"].get<double>() * 3.14159265358979 / 180;
  const auto spot = [&](double x, double y) {
    return std::pair(x * std::cos(angle) - y * std::sin(angle) + copy["x_mm"].get<double>(),
                     x * std::sin(angle) + y * std::cos(angle) + copy["y_mm"].get<double>());
  };
  const auto [ax, ay] = spot(10, 10);
  const auto [bx, by] = spot(50, 40);
  return {std::min(ax, bx), std::min(ay, by), std::max(ax, bx), std::max(ay, by)};
}

TEST_F(CamJob, copies_lie_on_their_sheets_and_no_cut_enters_another_copy) {
  small_job("", "[nest]\nquantity = 10\ngap = 4\n[[clamp]]\nfrom = [0, 0]\nto = [20, 20]\nheight = 3\n");
  std::string text = read(path("small.toml"));
  text.replace(text.find("size = [60, 50]"), 15, "size = [150, 100]");
  write("small.toml", text);
  const Outcome made = passo("cam job " + path("small.toml") + " --picture " + path("small.svg.svg"));
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("nested: 10 copies of 1 part on 2 sheets of 150 x 100 mm, 4 mm apart"));
  const nlohmann::json job = record("small");
  ASSERT_EQ(job["programs"].size(), 2U);
  ASSERT_EQ(job["nest"]["sheets"].size(), 2U);
  EXPECT_NEAR(job["stock_mm3"], 2 * 150 * 100 * 4, 1) << "of both sheets";
  for (std::size_t sheet = 0; sheet < 2; ++sheet) {
    std::vector<CopyBox> boxes;
    for (const auto& copy : job["nest"]["sheets"][sheet]["copies"]) {
      boxes.push_back(box_of_copy(copy));
      const CopyBox& box = boxes.back();
      EXPECT_GE(std::min(box.left, box.low), 4 - 1e-3);
      EXPECT_LE(box.right, 146 + 1e-3);
      EXPECT_LE(box.high, 96 + 1e-3);
      EXPECT_GE(std::hypot(std::max(box.left - 20, 0.0), std::max(box.low - 20, 0.0)), 4 - 1e-3);
    }
    const Outcome canon = passo("canon " + path(job["programs"][sheet]["file"]));
    ASSERT_EQ(canon.code, 0) << canon.err;
    std::istringstream lines(canon.out);
    std::string line;
    std::size_t seen = 0;
    while (std::getline(lines, line)) {
      const std::size_t feed = line.find("STRAIGHT_FEED(");
      double x = 0;
      double y = 0;
      double z = 0;
      if (feed == std::string::npos) continue;
      ASSERT_EQ(std::sscanf(line.c_str() + feed, "STRAIGHT_FEED(%lf, %lf, %lf", &x, &y, &z), 3) << line;
      if (z >= 0) continue;
      ++seen;
      for (const CopyBox& box : boxes) {
        const double away =
            std::hypot(std::max({box.left - x, x - box.right, 0.0}), std::max({box.low - y, y - box.high, 0.0}));
        const double inside = std::min({x - box.left, box.right - x, y - box.low, box.high - y});
        EXPECT_TRUE(away > 1.5 - 1e-3 || inside > 10) << line;  // the pocket lies in the middle of the part
      }
    }
    EXPECT_GT(seen, 30U);
  }
  // Where the corner of the stock is elsewhere, so are the copies.
  write("moved.toml", read(path("small.toml")).replace(text.find("thickness"), 0, "corner = [500, 300]\n"));
  ASSERT_EQ(passo("cam job " + path("moved.toml")).code, 0) << read(path("err"));
  const nlohmann::json moved = record("moved")["nest"]["sheets"][0]["copies"][0];
  EXPECT_GT(moved["x_mm"], 500 - 50);
  EXPECT_GT(moved["y_mm"], 300 - 40);
  const std::string first = read(path("small-1.ngc"));
  ASSERT_EQ(passo("cam job " + path("small.toml")).code, 0);
  EXPECT_EQ(read(path("small-1.ngc")), first);
  EXPECT_EQ(passo("cam job " + path("small.toml") + " --check").code, 0);
}

// A part with a bay of 20 x 20 mm, whose mouth is 8 mm wide: the slot of 6 mm along its walls leaves 8 x 8 mm, and a
// cusp in the mouth.
TEST_F(CamJob, scrap_between_copies_that_comes_loose_is_reported) {
  write("bay.svg",
        "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='40mm' viewBox='0 0 40 40'>"
        "<path d='M0,0L40,0L40,16L30,16L30,10L10,10L10,30L30,30L30,24L40,24L40,40L0,40Z'/></svg>");
  write("tile.svg",
        "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='40mm' viewBox='0 0 40 40'>"
        "<rect width='40' height='40' rx='3'/></svg>");
  const auto job = [&](const std::string& drawing, const char* options) {
    return passo("cam job " + write("cut.toml", "[job]\ndrawing = \"" + drawing +
                                                    "\"\n[stock]\nsize = [120, 70]\nthickness = 3\n[tool.1]\nshape = "
                                                    "\"flat\"\ndiameter_mm = 6\n[nest]\nquantity = 2\n[[operation]]\n"
                                                    "kind = \"profile\"\ntool = 1\ndepth = -3.2\n" +
                                                    options));
  };
  const Outcome island = job("bay.svg", "no-tabs = true\n");
  EXPECT_EQ(island.code, 0) << island.err;
  EXPECT_THAT(island.err, HasSubstr("warning: 2 pieces of scrap come loose, the largest of 8"));
  EXPECT_THAT(island.err, HasSubstr("[job.loose]"));
  const nlohmann::json loose = record("cut")["loose"][0];
  ASSERT_EQ(loose.size(), 2U);
  for (const auto& piece : loose) {
    EXPECT_EQ(piece["part"], false);
    EXPECT_NEAR(std::min<double>(piece["width_mm"], piece["length_mm"]), 8, 0.5);
    EXPECT_NEAR(piece["area_mm2"], 68, 6);
  }
  EXPECT_THAT(job("tile.svg", "no-tabs = true\n").err, Not(HasSubstr("job.loose"))) << "tiles are meant to";
  EXPECT_THAT(job("tile.svg", "").err, Not(HasSubstr("job.loose")));
  // Two discs, which are drawn with chords of two lengths, are not put in the same place.
  write("disc.svg",
        "<svg xmlns='http://www.w3.org/2000/svg' width='40mm' height='40mm' viewBox='0 0 40 40'>"
        "<circle cx='20' cy='20' r='20'/></svg>");
  EXPECT_EQ(job("disc.svg", "no-tabs = true\n").err, "");
  EXPECT_LT(record("cut")["nest"]["density"], 0.6);
  const std::string nest = " --tool 6 --depth -3.2 --nest 120,70 --quantity 2 --no-tabs -o " + path("p.ngc");
  const Outcome profile = passo("cam profile " + path("bay.svg") + nest + " --json");
  EXPECT_EQ(profile.code, 0) << profile.err;
  EXPECT_THAT(profile.err, HasSubstr("warning: 2 pieces of scrap come loose, the largest of "));
  EXPECT_EQ(nlohmann::json::parse(profile.out)["nest"]["sheets"][0]["loose"].size(), 2U);
  const Outcome whole = passo("cam profile " + path("tile.svg") + nest + " --json");
  EXPECT_THAT(whole.err, Not(HasSubstr("nest.loose")));
  EXPECT_EQ(nlohmann::json::parse(whole.out)["nest"]["sheets"][0]["loose"].size(), 0U);
}

TEST_F(CamJob, more_sheets_than_wanted_are_refused) {
  const std::string order = "cam profile " + checkout +
                            "/examples/jobs/shelf-bracket.svg --layer outline --nest 450,300 "
                            "--tool 5 --depth -9.3 --step 3.1 -o " +
                            path("b.ngc");
  const Outcome made = passo(order + " --quantity 20 --most-sheets 1");
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("--most-sheets: expected at least 2 for 20 copies of each part, found 1"));
  EXPECT_FALSE(std::filesystem::exists(path("b-1.ngc")));
  EXPECT_EQ(passo(order + " --quantity 2 --most-sheets 1").code, 0);
}

// A key that no operation can have is not dropped in silence.
TEST_F(CamJob, keys_of_whole_programs_are_none_of_jobs_or_operations) {
  for (const char* key : {"mirror = \"x\"", "sheet = [10, 10]", "chamfer = 0.5"}) {
    const std::string job = small_job();
    write("small.toml", read(job).replace(0, 5, std::string("[job]\n") + key));
    const Outcome made = passo("cam job " + job);
    EXPECT_EQ(made.code, 2) << key;
    EXPECT_THAT(made.err, HasSubstr("small.toml:2:1: error: a job file has no key job.")) << key;
  }
  for (const char* key : {"nest = \"80,70\"", "quantity = 4", "gap = 9", "rotations = 2"}) {
    small_job();
    write("small.toml",
          read(path("small.toml")) + "[[operation]]\nkind = \"profile\"\ntool = 1\nlayer = \"cut\"\n" + key);
    const Outcome made = passo("cam job " + path("small.toml"));
    EXPECT_EQ(made.code, 2) << key;
    EXPECT_THAT(made.err, HasSubstr("[job.unknown-key]")) << key;
  }
}

TEST_F(CamJob, a_part_that_cannot_be_nested_is_named_with_sizes) {
  small_job("", "[nest]\nquantity = 2\nmargin = 15\n");
  const Outcome made = passo("cam job " + path("small.toml"));
  EXPECT_EQ(made.code, 2);
  EXPECT_THAT(made.err, HasSubstr("of 40 x 30 mm does not fit on a sheet of 60 x 50 mm with a margin of 15 mm"));
  EXPECT_THAT(made.err, HasSubstr("small.toml:23:"));
  small_job("", "[nest]\nquantity = 2\n");
  std::string text = read(path("small.toml"));
  text.replace(text.find("size = [60, 50]"), 15, "size = [150, 100]");
  write("small.toml", text);
  const Outcome apart = passo("cam job " + path("small.toml"));
  EXPECT_THAT(apart.out, HasSubstr("7 mm apart")) << apart.err;
  EXPECT_EQ(apart.err, "");
  write("small.toml", text.replace(text.find("quantity = 2"), 12, "quantity = 2\ngap = 5"));
  EXPECT_THAT(passo("cam job " + path("small.toml") + " --force").err, HasSubstr("[job.nest-tabs]"));
  small_job("", "[nest]\nquantity = 2\ngap = 2\n");
  EXPECT_THAT(passo("cam job " + path("small.toml")).err, HasSubstr("at least 3 mm"));
  small_job("", "[nest]\nquantity = 2\nsheet = [200, 100]\n");
  EXPECT_THAT(passo("cam job " + path("small.toml")).err, HasSubstr("both stock.size and nest.sheet are given"));
  small_job("", "[nest]\nquantity = 0\n");
  EXPECT_THAT(passo("cam job " + path("small.toml")).err, HasSubstr("[job.out-of-range]"));
}

}  // namespace
