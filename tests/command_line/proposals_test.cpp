// What `passo check` proposes for a program that does not run on the machine: with it the program passes.
#include <algorithm>
#include <filesystem>
#include <random>
#include <string>

#include "kit/command_line.hpp"
#include "kit/seed.hpp"
#include "kit/served_http.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;

struct Travel {
  double low = 0;
  double high = 0;
  double length() const { return high - low; }
};

std::string axis_text(char letter, Travel travel) {
  return fmt::format(
      "[axis.{}]\nsteps_per_turn = 200\nmicrosteps = 8\nscrew_pitch_mm = 4\ntravel_mm = [{:.3f}, {:.3f}]\n"
      "max_velocity_mm_s = 50\nmax_acceleration_mm_s2 = 500\n",
      letter, travel.low, travel.high);
}

class Proposals : public passo::test::CommandLine {
 protected:
  nlohmann::json check(const std::string& program, const std::string& machine) const {
    return nlohmann::json::parse(passo("check " + program + " -m " + machine + " --json").out);
  }
  std::string machine(Travel x, Travel y) const {
    return write("m.toml", "name = \"drawn\"\n[board]\nclock_hz = 16_000_000\nmax_event_rate_hz = 100_000\n" +
                               axis_text('X', x) + axis_text('Y', y) + axis_text('Z', {-50, 50}));
  }
  static bool leaves_travel(const nlohmann::json& json) {
    return std::ranges::any_of(json["findings"],
                               [](const nlohmann::json& one) { return one["code"] == "travel.exceeded"; });
  }
  // What the words say to do, as a line of the program.
  static std::string told(const nlohmann::json& proposal) {
    const std::string words = proposal["words"];
    return words.substr(words.find("G21"));
  }
};

// Polygons and arcs of a drawn size at a drawn place, on machines of a drawn travel. Where there is room for the
// program, its proposal is a zero with which the same program passes; where there is none, the axis that is too short
// is named with the length that is missing.
TEST_F(Proposals, of_a_work_zero_pass_on_drawn_programs_and_machines) {
  std::mt19937_64 random(passo::test::seed());
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  int fitted = 0;
  int too_short = 0;
  for (int trial = 0; trial < 110; ++trial) {
    SCOPED_TRACE(trial);
    const Travel x{between(-300, 0), between(10, 300)};
    const Travel y{between(-300, 0), between(10, 300)};
    const Travel go_x{between(-400, 300), 0};
    const Travel go_y{between(-400, 300), 0};
    const double width = between(5, 1.1 * x.length());
    const double height = between(5, 1.1 * y.length());
    const double radius = std::min(width, height) / 2;
    const std::string body = fmt::format(
        "G21 G90 G17\nG0 X{0:.4f} Y{1:.4f}\nS100 M3\nG1 F900 X{2:.4f}\nY{3:.4f}\nX{0:.4f}\nY{1:.4f}\n"
        "G1 X{4:.4f}\nG2 X{4:.4f} Y{1:.4f} I0 J{5:.4f}\nM5\nM2\n",
        go_x.low, go_y.low, go_x.low + width, go_y.low + height, go_x.low + radius, radius);
    const std::string on = machine(x, y);
    const nlohmann::json json = check(write("p.ngc", body), on);
    const bool fits = width <= x.length() - 0.01 && height <= y.length() - 0.01;
    const bool cannot = width > x.length() + 0.01 || height > y.length() + 0.01;
    if (!leaves_travel(json)) {
      EXPECT_TRUE(json["proposals"].empty());
    } else if (fits) {
      ASSERT_EQ(json["proposals"].size(), 1U) << json;
      EXPECT_EQ(json["proposals"][0]["kind"], "work-zero");
      const nlohmann::json then = check(write("q.ngc", told(json["proposals"][0]) + "\n" + body), on);
      EXPECT_TRUE(then["good"]) << told(json["proposals"][0]) << "\n" << body << then;
      ++fitted;
    } else if (cannot) {
      ASSERT_FALSE(json["proposals"].empty()) << json;
      for (const nlohmann::json& one : json["proposals"]) {
        EXPECT_EQ(one["kind"], "axis-too-short");
        const bool is_x = one["axis"] == "X";
        EXPECT_NEAR(one["needed"], is_x ? width : height, 1e-3);
        EXPECT_NEAR(one["travel"], is_x ? x.length() : y.length(), 1e-2);
      }
      ++too_short;
    }
  }
  EXPECT_GT(fitted, 40);
  EXPECT_GT(too_short, 5);
}

TEST_F(Proposals, are_in_words) {
  const std::string on = machine({0, 100}, {0, 100});
  const Outcome outcome = passo("check " + write("p.ngc", "G21 G90\nG0 X-12.4 Y10\nX50\nM2\n") + " -m " + on);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(
      outcome.out,
      HasSubstr(
          "proposal        with another work zero, the program fits into the travel (checked): G21 G10 L2 P1 X13\n"));
}

// Moves in machine coordinates and zeros that the program sets follow no zero of the operator.
TEST_F(Proposals, are_none_where_no_zero_helps) {
  const std::string on = machine({0, 100}, {0, 100});
  for (const std::string body : {"G21 G90\nG53 G0 X-5\nM2\n", "G21 G90\nG10 L2 P1 X-20\nG0 X5\nM2\n"}) {
    EXPECT_TRUE(check(write("p.ngc", body), on)["proposals"].empty()) << body;
  }
}

// Only the system that leaves the travel gets another zero.
TEST_F(Proposals, name_the_work_system) {
  const std::string on = machine({0, 100}, {0, 100});
  const std::string body = "G21 G90\nG0 X5 Y5\nG55 G0 X20 Y-30\nM2\n";
  const nlohmann::json json = check(write("p.ngc", body), on);
  ASSERT_EQ(json["proposals"].size(), 1U) << json;
  EXPECT_EQ(told(json["proposals"][0]), "G21 G10 L2 P2 Y30");
  EXPECT_EQ(json["proposals"][0]["zeros"]["G55"]["Y"], 30);
  EXPECT_TRUE(check(write("q.ngc", told(json["proposals"][0]) + "\n" + body), on)["good"]);
}

// A motor that loses steps is safe at the override that is proposed; where the load is too much, none is.
TEST_F(Proposals, of_an_override_are_safe) {
  const std::filesystem::path folder = std::filesystem::path(PASSO_SOURCE_DIR) / "examples" / "troubles";
  const auto of = [&](const std::string& name) {
    return check((folder / (name + ".ngc")).string(), (folder / (name + ".toml")).string())["proposals"];
  };
  const nlohmann::json rapids = of("too-fast");
  ASSERT_EQ(rapids.size(), 1U);
  EXPECT_EQ(rapids[0]["kind"], "override");
  EXPECT_EQ(rapids[0]["feed_percent"], 100);
  const double velocity = 90.0 * rapids[0]["rapid_percent"].get<double>() / 100;
  std::string text = passo::test::read(folder / "too-fast.toml");
  const std::string key = "max_velocity_mm_s = 90";
  text.replace(text.find(key), key.size(), fmt::format("max_velocity_mm_s = {}", velocity));
  const std::string slower = write("slower.toml", text);
  const std::string program = (folder / "too-fast.ngc").string();
  EXPECT_EQ(check(program, slower)["margin"]["verdict"], "safe");
  EXPECT_EQ(passo("run " + program + " -m " + slower + " --physics").code, 0);
  EXPECT_TRUE(of("binding").empty());
}

// Each tool that is missing is named, also beyond the twenty errors that a check lists, and with them the program
// passes.
TEST_F(Proposals, of_tools_pass) {
  const std::string on = machine({-100, 100}, {-100, 100});
  const std::string table = "T1 P1 Z10 D6\n";
  std::string body = "G21 G90 G17\nT1 M6\nG0 X1\n";
  for (int tool = 2; tool <= 31; ++tool) body += fmt::format("T{} M6\nG0 X{}\n", tool, tool);
  body += "S100 M3 G1 F100 X0\nG41 D77 X5 Y20\nX6 Y30\nG40 X0 Y0\nM5\nM2\n";
  const std::string program = write("p.ngc", body);
  const nlohmann::json json = check(program + " --tools " + write("t.tbl", table), on);
  EXPECT_FALSE(json["good"]);
  ASSERT_EQ(json["proposals"].size(), 1U) << json;
  EXPECT_EQ(json["proposals"][0]["kind"], "tools");
  std::string lines = table;
  for (const int tool : json["proposals"][0]["tools"]) lines += fmt::format("T{} P{}\n", tool, tool);
  EXPECT_EQ(json["proposals"][0]["tools"].size(), 31U);
  EXPECT_TRUE(check(program + " --tools " + write("more.tbl", lines), on)["good"]) << lines;
}

TEST_F(Proposals, of_tools_are_in_words) {
  const std::string on = machine({-100, 100}, {-100, 100});
  const Outcome outcome = passo("check " + write("p.ngc", "G21 G90\nT5 M6\nG0 X1\nM2\n") + " --tools " +
                                write("t.tbl", "T1 P1\n") + " -m " + on);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.out,
              HasSubstr("proposal        with this tool in the tool table, the program passes the check (checked with "
                        "length and diameter 0: add those of the real tool as Z and D): T5 P5\n"));
}

// Another error stays, or the number of the tool is worked out.
TEST_F(Proposals, of_tools_are_none_where_more_is_wrong) {
  const std::string on = machine({-100, 100}, {-100, 100});
  const std::string tools = " --tools " + write("t.tbl", "T1 P1\n");
  for (const std::string body : {"G21 G90\nT5 M6\nG53 G0 X900\nM2\n", "G21 G90\n#1=5\nT#1 M6\nG0 X1\nM2\n"}) {
    EXPECT_TRUE(check(write("p.ngc", body) + tools, on)["proposals"].empty()) << body;
  }
}

// The highest whole speed at which every thread can be followed: one turn a minute more is too much.
TEST_F(Proposals, of_a_spindle_speed_let_the_axes_follow) {
  const std::string on = machine({-100, 100}, {-100, 100});
  std::mt19937_64 random(passo::test::seed());
  const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(trial);
    const double fast = between(1600, 5000);
    const auto body = [pitch = between(2, 6), x = between(0, 40)](double rpm) {
      return fmt::format("G21 G90\nS{:.2f} M3\nG0 Z10\nG33 X{:.3f} Z-10 K{:.4f}\nG0 Z10\nG33 Z-20 K1\nM5\nM2\n", rpm, x,
                         pitch);
    };
    const nlohmann::json json = check(write("p.ngc", body(fast)), on);
    EXPECT_FALSE(json["good"]);
    ASSERT_EQ(json["proposals"].size(), 1U) << json;
    EXPECT_EQ(json["proposals"][0]["kind"], "spindle-speed");
    const double rpm = json["proposals"][0]["spindle_rpm"];
    EXPECT_TRUE(check(write("q.ngc", body(rpm)), on)["good"]) << rpm;
    EXPECT_FALSE(check(write("q.ngc", body(rpm + 1)), on)["good"]) << rpm;
  }
}

// A spindle that is slower than S cuts thicker chips, unless the feeds are slower too.
TEST_F(Proposals, of_a_slower_feed_where_the_spindle_is_slower) {
  const std::string on = machine({-100, 100}, {-100, 100});
  const std::string limited = write("limited.toml", passo::test::read(on) + "\n[tool]\nmax_rpm = 10000\n");
  const std::string body = "G21 G90\nS{} M3\nG4 P1\nG1 X50 F600\nM5\nM2\n";
  const nlohmann::json json = check(write("p.ngc", fmt::format(fmt::runtime(body), 13'000)), limited);
  EXPECT_TRUE(json["good"]);
  ASSERT_EQ(json["proposals"].size(), 1U) << json;
  EXPECT_EQ(json["proposals"][0]["kind"], "spindle-speed");
  EXPECT_EQ(json["proposals"][0]["spindle_rpm"], 10'000);
  EXPECT_EQ(json["proposals"][0]["feed_percent"], 76);
  EXPECT_TRUE(check(write("p.ngc", fmt::format(fmt::runtime(body), 10'000)), limited)["proposals"].empty());
  const std::string by_turn = "G21 G90\nS13000 M3\nG4 P1\nG95 G1 X50 F0.1\nM5\nM2\n";
  EXPECT_TRUE(check(write("p.ngc", by_turn), limited)["proposals"].empty()) << "such feeds are slower by themselves";
}

// What the daemon works out beside the machine has the same proposals.
class ServedProposals : public passo::test::ServedHttp {
 protected:
  nlohmann::json proposals_for(const std::string& program) {
    const auto id = json("POST", "/programs?name=p.ngc", program).value("id", 0);
    json("POST", "/study", fmt::format(R"({{"study": "motors", "program": {}}})", id));
    EXPECT_TRUE(until([&] { return json("GET", "/study")["state"] != "running"; }));
    const nlohmann::json study = json("GET", "/study");
    EXPECT_EQ(study["state"], "done") << study;
    return study["report"]["proposals"];
  }
};

TEST_F(ServedProposals, come_with_the_report_of_a_study) {
  std::filesystem::create_directories(path("data"));
  write("data/tool.tbl", "T1 P1 Z10 D6\n");
  const std::string machine = write("m.toml",
                                    "name = \"served\"\n[board]\nclock_hz = 16_000_000\n"
                                    "max_event_rate_hz = 100_000\n" +
                                        axis_text('X', {0, 100}) + axis_text('Z', {-50, 50}));
  serve({"-m", machine, "--data", path("data")});
  const nlohmann::json zero = proposals_for("G21 G90\nG0 X-12.4\nX50\nM2\n");
  ASSERT_EQ(zero.size(), 1U) << zero;
  EXPECT_EQ(zero[0]["zeros"]["G54"]["X"], 13);
  const nlohmann::json tools = proposals_for("G21 G90\nT4 M6\nG0 X5\nM2\n");
  ASSERT_EQ(tools.size(), 1U) << tools;
  EXPECT_EQ(tools[0]["tools"], nlohmann::json({4}));
  EXPECT_TRUE(proposals_for("G21 G90\nT1 M6\nG0 X5\nM2\n").empty());
}

}  // namespace
