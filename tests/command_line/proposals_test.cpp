// What `passo check` proposes for a program that does not run on the machine: with it the program passes.
#include <algorithm>
#include <filesystem>
#include <random>
#include <string>

#include "kit/command_line.hpp"
#include "kit/seed.hpp"
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
  EXPECT_THAT(outcome.out, HasSubstr("proposal        with another work zero the program fits the travel (checked): "
                                     "G21 G10 L2 P1 X13\n"));
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

}  // namespace
