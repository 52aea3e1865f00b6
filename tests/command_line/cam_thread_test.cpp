// passo cam thread: the moves of its programs, beside the thread that was asked for.
#include <cmath>
#include <numbers>
#include <sstream>

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

struct Tip {
  double x = 0;
  double y = 0;
  double z = 0;
};

struct WantedThread {
  const char* words;
  const char* options;
  double major = 6;
  double pitch = 1;
  double cutter = 4.5;
  double neck = 3;
  double depth = 10;
  bool is_left_hand = false;
  bool is_climb = true;
  bool is_external = false;
  int teeth = 1;
  double unit = 1;  // mm
};

// What the feeds of a program do, around one axis.
struct ThreadCut {
  double farthest = 0;  // of the cutter's centre from the axis, mm
  double nearest = 1e9;
  double lowest = 1e9;
  double turns = 0;  // about the axis, at the largest (on a boss the smallest) radius
  double worst_pitch = 0;
  bool is_right_hand = true;
  bool is_left_hand = true;
  bool is_ccw = true;
  bool is_cw = true;
  bool has_side_feed = false;  // a feed in X or Y that is no arc
  double lowest_beside = 1e9;  // Z of rapids in X or Y
  double entry = 0;            // distance of vertical moves below Z0 from the axis
};

double word(const std::string& line, char letter, double otherwise) {
  const std::size_t at = line.find(std::string(" ") + letter);
  return at == std::string::npos ? otherwise : std::atof(line.c_str() + at + 2);
}

ThreadCut follow(const std::string& program, Tip axis, double unit, double radius, double pitch) {
  ThreadCut cut{.worst_pitch = pitch};
  std::istringstream lines(program);
  std::string line;
  Tip at{1e6, 1e6, 1e6};
  while (std::getline(lines, line)) {
    const std::string code = line.substr(0, line.find(' '));
    if (code != "G0" && code != "G1" && code != "G2" && code != "G3") continue;
    const Tip to{word(line, 'X', at.x / unit) * unit, word(line, 'Y', at.y / unit) * unit,
                 word(line, 'Z', at.z / unit) * unit};
    const bool is_level = std::hypot(to.x - at.x, to.y - at.y) > 1e-6;
    if (code == "G0" && is_level) cut.lowest_beside = std::min(cut.lowest_beside, to.z);
    if (code == "G1") cut.has_side_feed = cut.has_side_feed || is_level;
    if (!is_level && std::min(at.z, to.z) < 0) {
      cut.entry = std::max(cut.entry, std::hypot(to.x - axis.x, to.y - axis.y));
    }
    if (code == "G2" || code == "G3") {
      const Tip centre{at.x + word(line, 'I', 0) * unit, at.y + word(line, 'J', 0) * unit, 0};
      const double r = std::hypot(at.x - centre.x, at.y - centre.y);
      const double from = std::atan2(at.y - centre.y, at.x - centre.x);
      double sweep = std::remainder(std::atan2(to.y - centre.y, to.x - centre.x) - from, 2 * std::numbers::pi);
      if (code == "G3" && sweep <= 1e-9) sweep += 2 * std::numbers::pi;
      if (code == "G2" && sweep >= -1e-9) sweep -= 2 * std::numbers::pi;
      cut.is_ccw = cut.is_ccw && code == "G3";
      cut.is_cw = cut.is_cw && code == "G2";
      for (int i = 0; i <= 180; ++i) {
        const double angle = from + sweep * i / 180;
        const double far = std::hypot(centre.x + r * std::cos(angle) - axis.x, centre.y + r * std::sin(angle) - axis.y);
        cut.farthest = std::max(cut.farthest, far);
        cut.nearest = std::min(cut.nearest, far);
      }
      cut.lowest = std::min({cut.lowest, at.z, to.z});
      // Around the axis: the helix of the thread.
      if (std::hypot(centre.x - axis.x, centre.y - axis.y) < 0.002) {
        const double rise = (to.z - at.z) / sweep * 2 * std::numbers::pi;
        if (std::abs(std::abs(rise) - pitch) >= std::abs(cut.worst_pitch - pitch)) cut.worst_pitch = std::abs(rise);
        cut.is_right_hand = cut.is_right_hand && rise > 0;
        cut.is_left_hand = cut.is_left_hand && rise < 0;
        if (std::abs(r - radius) < 0.002) cut.turns += std::abs(sweep) / (2 * std::numbers::pi);
      }
    }
    at = to;
  }
  return cut;
}

class CamThread : public passo::test::CommandLine {
 protected:
  std::string circle(double diameter) {
    return write("holes.svg",
                 "<svg xmlns='http://www.w3.org/2000/svg' width='60mm' height='40mm' viewBox='0 0 60 40'>"
                 "<circle cx='20' cy='15' r='" +
                     std::to_string(diameter / 2) + "'/></svg>\n");
  }
};

TEST_F(CamThread, every_helix_has_the_pitch_and_stays_within_the_thread) {
  const std::vector<WantedThread> all = {
      {.words = "M6", .options = "--thread M6"},
      {.words = "M6 by the table", .options = "--diameter 6 --pitch 1 --passes 5"},
      {.words = "left-hand", .options = "--thread M6 --left-hand", .is_left_hand = true},
      {.words = "conventional", .options = "--thread M6 --conventional", .is_climb = false},
      {.words = "both", .options = "--thread M6 --left-hand --conventional", .is_left_hand = true, .is_climb = false},
      {.words = "1/4-20 in inches",
       .options = "--thread 1/4-20 --units inch",
       .major = 6.35,
       .pitch = 1.27,
       .unit = 25.4},
      {.words = "UNC", .options = "--thread '1/2 UNC'", .major = 12.7, .pitch = 25.4 / 13, .neck = 1.8},
      {.words = "full form", .options = "--thread M6 --teeth 4", .teeth = 4},
      {.words = "full form, down", .options = "--thread M6 --teeth 4 --conventional", .is_climb = false, .teeth = 4},
      {.words = "boss",
       .options = "--thread M20x1.5 --external",
       .major = 20,
       .pitch = 1.5,
       .neck = 2,
       .is_external = true},
      {.words = "boss, left-hand",
       .options = "--thread M20x1.5 --external --left-hand",
       .major = 20,
       .pitch = 1.5,
       .neck = 2,
       .is_left_hand = true,
       .is_external = true}};
  for (const WantedThread& one : all) {
    SCOPED_TRACE(one.words);
    const std::string drawing = circle(one.is_external ? one.major : one.major - 1.0825 * one.pitch);
    const std::string sizes = " --tool " + std::to_string(one.cutter) + "mm --neck " + std::to_string(one.neck) +
                              "mm --depth -" + std::to_string(one.depth) + "mm ";
    const Outcome made = passo("cam thread " + drawing + sizes + one.options + " -o " + path("p.ngc"));
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.err.find("the teeth reach ") != std::string::npos, one.is_external) << made.err;
    const double root = one.major - 1.2268693 * one.pitch;
    const double radius = one.is_external ? (root + one.cutter) / 2 : (one.major - one.cutter) / 2;
    const ThreadCut cut = follow(read(path("p.ngc")), {20, 25, 0}, one.unit, radius, one.pitch);
    EXPECT_NEAR(cut.worst_pitch, one.pitch, 2e-4);
    EXPECT_NEAR(cut.lowest, -one.depth, 1e-3);
    EXPECT_FALSE(cut.has_side_feed);
    EXPECT_GE(cut.lowest_beside, 0);
    EXPECT_TRUE(one.is_left_hand ? cut.is_left_hand : cut.is_right_hand);
    if (one.is_external) {
      EXPECT_NEAR(cut.nearest, radius, 1e-3) << "never into the core";
      EXPECT_GT(cut.entry, one.major / 2 + one.cutter / 2 + 0.4);
    } else {
      EXPECT_NEAR(cut.farthest, radius, 1e-3) << "never beyond the major diameter";
      EXPECT_LT(cut.entry, 1e-3);
      EXPECT_TRUE(one.is_climb ? cut.is_ccw : cut.is_cw);
    }
    const double stations = std::ceil(one.depth / (one.teeth * one.pitch) - 1e-6);
    EXPECT_NEAR(cut.turns, stations, 0.01) << "turns at full depth";
    const Outcome checked = passo("check " + path("p.ngc") + on_router);
    EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
  }
}

TEST_F(CamThread, what_does_not_fit_is_refused_with_what_does) {
  const std::string drawing = circle(4.917);
  struct Refused {
    const char* options;
    const char* words;
  };
  const std::vector<Refused> all = {
      {"--thread M6 --tool 4.5", "--neck: expected the diameter"},
      {"--thread M6.3 --tool 4.5 --neck 3", "--thread: expected a name like M6"},
      {"--thread 6 --tool 4.5 --neck 3", "--thread: expected a name like M6"},
      {"--tool 4.5 --neck 3", "--thread: expected the name"},
      {"--thread M6 --pitch 1 --tool 4.5 --neck 3", "cannot be combined"},
      {"--thread M6 --tool 4.9 --neck 3", "--tool: expected a diameter below that of the bore, 4.91747 mm"},
      {"--thread M6 --tool 4.5 --neck 3.4", "--neck: expected at most 3.37 mm"},
      {"--thread M6 --tool 1 --neck 0.5", "--tool: expected at least 1.14 mm, so that a neck does not touch the bore"},
      {"--thread M20x1.5 --external --tool 1 --neck 0.5", "--tool: expected at least 1.9 mm, so that a neck"},
      {"--thread M20x1.5 --external --tool 9 --neck 7 --hole 18", "--hole: expected more than the root of the thread"},
      {"--thread M6 --tool 4.5 --neck 3 --reach 8 --depth -9", "--depth: expected at most the reach"},
      {"--thread M6 --tool 4.5 --neck 3 --tooth-tip 0.2", "--tooth-tip: expected at most"},
      {"--thread M6 --tool 4.5 --neck 3 --depth -2000", "at most 1000 turns"}};
  for (const Refused& one : all) {
    const Outcome made = passo("cam thread " + drawing + " " + one.options + " -o " + path("p.ngc"));
    EXPECT_EQ(made.code, 2) << one.options;
    EXPECT_THAT(made.err, HasSubstr(one.words));
  }
  const Outcome other = passo("cam thread " + circle(9) + " --thread M6 --tool 4.5 --neck 3 -o " + path("p.ngc"));
  EXPECT_THAT(other.err, HasSubstr("thread.other-diameter"));
}

// The plate of the threads, without the operation that makes the bores.
TEST_F(CamThread, a_job_checks_that_the_bore_is_there) {
  const std::string drawing = circle(5);
  const std::string head =
      "[job]\ndrawing = \"holes.svg\"\n[stock]\nsize = [60, 40]\nthickness = 10\nbelow = 3\n"
      "[tool.1]\nshape = \"drill\"\ndiameter_mm = 5\n[tool.2]\nshape = \"thread-mill\"\ndiameter_mm = 4.5\n"
      "neck_diameter_mm = 3\n";
  const std::string thread = "[[operation]]\nkind = \"thread-mill\"\ntool = 2\nthread = \"M6\"\ndepth = -8\n";
  const auto drill = [](const char* depth) {
    return std::string("[[operation]]\nkind = \"drill\"\ntool = 1\ndepth = ") + depth + "\n";
  };
  const Outcome good = passo("cam job " + write("a.toml", head + thread + drill("-12")));
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, HasSubstr("it follows 'drill"));
  const Outcome missing = passo("cam job " + write("b.toml", head + thread));
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("job.rapid-in-stock"));
  const Outcome shallow = passo("cam job " + write("c.toml", head + thread + drill("-5")));
  EXPECT_EQ(shallow.code, 2);
  EXPECT_THAT(shallow.err, HasSubstr("job.rapid-in-stock"));
  const Outcome wrong = passo("cam job " + write("d.toml", head + "[[operation]]\nkind = \"pocket\"\ntool = 2\n"));
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("job.wrong-tool"));
}

// A boss of 20 mm in a pocket of `width` mm, whose middle is `beside` mm to the left of the boss. The mill is 10 mm
// wide: its teeth reach 20.5 mm from the axis.
TEST_F(CamThread, a_job_checks_the_room_for_the_teeth_around_a_boss) {
  const auto job = [&](double width, double beside, const char* depth, const std::string& more = "") {
    const std::string layer = "<g inkscape:groupmode='layer' inkscape:label=";
    write("boss.svg",
          fmt::format("<svg xmlns='http://www.w3.org/2000/svg' "
                      "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' width='80mm' height='80mm' "
                      "viewBox='0 0 80 80'>{0}'clear'><rect x='{1}' y='10' width='{2}' height='60'/><circle cx='40' "
                      "cy='40' r='10'/>{3}</g>{0}'boss'><circle cx='40' cy='40' r='10'/></g></svg>",
                      layer, 40 - width / 2 - beside, width, more));
    return passo(
        "cam job " +
        write("boss.toml", fmt::format("[job]\ndrawing = \"boss.svg\"\n[stock]\nsize = [80, 80]\nthickness = 20\n"
                                       "[tool.1]\nshape = \"flat\"\ndiameter_mm = 6\n[tool.2]\nshape = "
                                       "\"thread-mill\"\ndiameter_mm = 10\nneck_diameter_mm = 7\n"
                                       "[[operation]]\nkind = \"pocket\"\ntool = 1\nlayer = \"clear\"\ndepth = {}\n"
                                       "step = 5\n[[operation]]\nkind = \"thread-mill\"\ntool = 2\nlayer = "
                                       "\"boss\"\nthread = \"M20x1.5\"\nexternal = true\ndepth = -8\n",
                                       depth)));
  };
  const Outcome good = job(42, 0, "-8.5");
  EXPECT_EQ(good.code, 0) << good.err;
  EXPECT_THAT(good.out, Not(HasSubstr("the teeth reach")));
  // The mill comes down at the right. The wall at the left is 18 mm from the axis: only the teeth meet it.
  const Outcome near_wall = job(42, -3, "-8.5");
  EXPECT_EQ(near_wall.code, 2) << near_wall.out;
  EXPECT_THAT(near_wall.err, HasSubstr(" mm into the stock at X21."));
  EXPECT_THAT(near_wall.err, HasSubstr("beside the boss at X40.00 Y40.00 [job.teeth]"));
  EXPECT_THAT(near_wall.err, HasSubstr("cleared before, to 20.50 mm from its axis"));
  EXPECT_THAT(near_wall.err, Not(HasSubstr("job.rapid-in-stock")));
  // Another boss, of 4 mm, at the left.
  const Outcome other_boss = job(60, 0, "-8.5", "<circle cx='20' cy='40' r='2'/>");
  EXPECT_EQ(other_boss.code, 2) << other_boss.out;
  EXPECT_THAT(other_boss.err, HasSubstr("job.teeth"));
  const Outcome far_boss = job(60, 0, "-8.5", "<circle cx='16' cy='40' r='2'/>");
  EXPECT_EQ(far_boss.code, 0) << far_boss.err;
  // The floor is higher than the lowest tooth.
  const Outcome shallow = job(42, 0, "-7.8");
  EXPECT_EQ(shallow.code, 2) << shallow.out;
  EXPECT_THAT(shallow.err, HasSubstr("the teeth go 0.20 mm into the stock"));
}

TEST_F(CamThread, coolant_runs_only_where_it_is_wanted) {
  circle(5);
  const std::string text =
      "[job]\ndrawing = \"holes.svg\"\n[stock]\nsize = [60, 40]\nthickness = 10\nbelow = 3\n"
      "[tool.1]\nshape = \"drill\"\ndiameter_mm = 5\n[tool.2]\nshape = \"flat\"\ndiameter_mm = 4\n"
      "[[operation]]\nkind = \"drill\"\ntool = 1\ndepth = -3\ncoolant = \"mist\"\n"
      "[[operation]]\nkind = \"drill\"\ntool = 1\ndepth = -6\ncoolant = \"mist\"\n"
      "[[operation]]\nkind = \"drill\"\ntool = 1\ndepth = -9\n"
      "[[operation]]\nkind = \"pocket\"\ntool = 2\ndepth = -1\ncoolant = \"flood\"\n";
  ASSERT_EQ(passo("cam job " + write("a.toml", text) + " -o " + path("p.ngc")).code, 0) << read(path("err"));
  std::istringstream lines(read(path("p.ngc")));
  std::string line;
  std::string words;
  while (std::getline(lines, line)) {
    if (line == "M7" || line == "M8" || line == "M9" || line == "M5" || line == "M2") words += line + " ";
  }
  EXPECT_EQ(words, "M7 M9 M5 M8 M9 M5 M2 ");
  const Outcome refused = passo("cam drill " + path("holes.svg") + " --coolant mist --for grbl -o " + path("g.nc"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("ENABLE_M7"));
  EXPECT_EQ(passo("cam drill " + path("holes.svg") + " --coolant flood --for grbl -o " + path("g.nc")).code, 0);
  EXPECT_THAT(read(path("g.nc")), HasSubstr("M8"));
}

// The rim of the tip is 0.1 mm beside the edge: the axis runs around the hole of 5 mm at 2.4 mm, 0.8 mm deep.
TEST_F(CamThread, a_chamfer_of_a_job_has_a_width_or_the_depth_of_the_tip) {
  circle(5);
  const std::string head =
      "[job]\ndrawing = \"holes.svg\"\n[stock]\nsize = [60, 40]\nthickness = 10\n"
      "[tool.3]\nshape = \"vee\"\ndiameter_mm = 8\nangle_deg = 90\n[[operation]]\nkind = \"chamfer\"\ntool = 3\n";
  const Outcome wide = passo("cam job " + write("a.toml", head + "side = \"inside\"\nchamfer = 0.7\n") + " --json");
  ASSERT_EQ(wide.code, 0) << wide.err;
  EXPECT_NEAR(nlohmann::json::parse(wide.out)["operations"][0]["depth_mm"], 0.8, 1e-3);
  const ThreadCut cut = follow(read(path("a.ngc")), {20, 25, 0}, 1, 2.4, 0);
  EXPECT_NEAR(cut.nearest, 2.4, 0.003);
  EXPECT_NEAR(cut.farthest, 2.4, 0.003);
  const Outcome old = passo("cam job " + write("b.toml", head + "depth = -0.5\n") + " --json");
  ASSERT_EQ(old.code, 0) << old.err;
  EXPECT_NEAR(nlohmann::json::parse(old.out)["operations"][0]["depth_mm"], 0.5, 1e-3);
  EXPECT_THAT(old.out, Not(HasSubstr("neither chamfer nor depth")));
  const Outcome usual = passo("cam job " + write("e.toml", head) + " --json");
  ASSERT_EQ(usual.code, 0) << usual.err;
  EXPECT_NEAR(nlohmann::json::parse(usual.out)["operations"][0]["depth_mm"], 0.3, 1e-3);
  EXPECT_THAT(usual.out,
              HasSubstr("neither chamfer nor depth is given: the tip of the tool follows the edges at a depth "
                        "of 0.3 mm"));
  const Outcome both = passo("cam job " + write("c.toml", head + "chamfer = 0.5\ndepth = -0.5\n"));
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("the depth follows from the angle"));
  const Outcome large = passo("cam job " + write("d.toml", head + "chamfer = 4.5\n"));
  EXPECT_EQ(large.code, 2);
  EXPECT_THAT(large.err, HasSubstr("at most 3.9 mm"));
}

}  // namespace
