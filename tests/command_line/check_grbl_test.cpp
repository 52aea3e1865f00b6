// passo check --board grbl: what a board with Grbl, which plans by itself, takes for a program.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "kit/command_line.hpp"
#include "kit/in_full.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using passo::test::Outcome;
using testing::HasSubstr;

class CheckGrbl : public passo::test::CommandLine {
 protected:
  const std::string machines_ = PASSO_SOURCE_DIR "/examples/machines/";

  nlohmann::json json_of(const std::string& program, const std::string& machine) const {
    const Outcome outcome = passo("check " + program + " -m " + machines_ + machine + " --board grbl --json");
    EXPECT_EQ(outcome.code, 0) << program << outcome.out << outcome.err;
    return nlohmann::json::parse(outcome.out);
  }
};

TEST_F(CheckGrbl, tells_the_time_of_the_motion_of_grbl) {
  const auto json = json_of(write("p.ngc", "G21 G90 F3000\nG1 X50\nG4 P2\nG1 X0\nM2\n"), "bench.toml");
  const double move = 50.0 / 50 + 50.0 / 500;
  EXPECT_NEAR(json["board"]["time_s"], 2 * move + 2, 0.005) << "the first line must arrive";
  EXPECT_NEAR(json["time_s"], 2 * move, 1e-6);
  EXPECT_NEAR(json["dwell_s"], 2, 1e-6);
  EXPECT_NEAR(json["axes"]["X"]["peak_speed"], 50, 1e-6);
  EXPECT_EQ(json["board"]["blocks"], 15);
}

TEST_F(CheckGrbl, knows_the_motors_of_a_core_xy) {
  std::ifstream file(machines_ + "bench.toml");
  std::string text(std::istreambuf_iterator<char>(file), {});
  const std::string plain = write("plain.toml", text);
  const std::string core = write("core.toml", "kinematics = \"corexy\"\n" + text);
  const std::string program = write("p.ngc", "G21 G90\nG0 X50 Y50\nG1 X0 Y0 F3000\nM2\n");
  const auto time = [&](const std::string& machine) {
    const Outcome outcome = passo("check " + program + " -m " + machine + " --board grbl --json");
    EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
    return nlohmann::json::parse(outcome.out)["board"]["time_s"].get<double>();
  };
  // 100 mm/s, 500 mm/s2. The rapid: 50 mm in each axis at once, or 100 mm of one motor.
  const double feed = std::sqrt(2) * 50 / 50;
  EXPECT_NEAR(time(plain), 50.0 / 100 + 100.0 / 500 + feed + 50 / (500 * std::sqrt(2)), 0.01);
  EXPECT_NEAR(time(core), 100.0 / 100 + 100.0 / 500 + feed + 50 * std::sqrt(2) / 500, 0.01);
  const Outcome own = passo("check " + program + " -m " + core);
  EXPECT_EQ(own.code, 3);
  EXPECT_THAT(own.err, HasSubstr("core.toml:1:14: error: the boards of Passo"));
  EXPECT_THAT(own.err, HasSubstr("[machine.kinematics]"));
  EXPECT_EQ(passo("machine " + core).code, 0);
}

TEST_F(CheckGrbl, tells_that_the_connection_is_too_slow) {
  std::string program = "G21 G90 F6000\nG1\n";
  for (int i = 1; i <= 6000; ++i) program += fmt::format("X{0:.4f} Y{0:.4f}\n", 10 + 0.0177 * i);
  const std::string file = write("dense.ngc", program + "M2\n");
  const Outcome outcome = passo("check " + file + " -m " + machines_ + "bench.toml --board grbl");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("board           Grbl 1.1, 15 blocks: 0:00:"));
  EXPECT_THAT(outcome.out, HasSubstr("connection      115200 baud: too slow for this program, which takes "));
}

// The motion of Grbl jumps at each corner: motors that our planner drives safely may lose steps.
TEST_F(CheckGrbl, judges_the_motors_with_that_motion) {
  std::string program = "G21 G90 F6000\nG1\n";
  for (int i = 1; i <= 100; ++i) program += fmt::format("X{} Y{}\n", i, 3 * (i % 2));
  const std::string check =
      "check " + write("zigzag.ngc", program + "M2\n") + " -m " + machines_ + "strong-router.toml";
  EXPECT_EQ(passo(check).code, 0);
  const Outcome on_grbl = passo(check + " --board grbl");
  EXPECT_EQ(on_grbl.code, 1);
  EXPECT_THAT(on_grbl.err, HasSubstr("check.steps-lost"));
}

TEST_F(CheckGrbl, refuses_what_grbl_cannot_do_and_other_boards) {
  const std::string program = write("p.ngc", "G21 S1000 M3\nG33 Z-5 K1\nM2\n");
  const Outcome thread = passo("check " + program + " -m " + machines_ + "router.toml --board grbl");
  EXPECT_EQ(thread.code, 2);
  EXPECT_THAT(thread.err, HasSubstr("grbl.cannot"));
  const Outcome other = passo("check " + program + " -m " + machines_ + "router.toml --board /dev/ttyUSB7");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err,
              HasSubstr("--board of check takes grbl, grbl:DEVICE[@BAUD], grbl:tcp:HOST:PORT or grbl:ws://HOST"));
}

// A row of the table in motion-mm/README.md: the time of Grbl 1.1h.
struct Row {
  std::string file;
  double time = 0;
};

std::vector<Row> rows() {
  const std::filesystem::path folder = std::filesystem::path(PASSO_SOURCE_DIR) / "../shared/peers/motion-mm";
  std::ifstream readme(folder / "README.md");
  std::vector<Row> all;
  for (std::string row; std::getline(readme, row);) {
    std::smatch found;
    if (!std::regex_match(row, found, std::regex(R"(\| (p\d\d) [^|]*\|[^|]*\|[^|]*\|[^|]*\| ([0-9.]+) \|.*)")))
      continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().filename().string().starts_with(found[1].str() + "_")) {
        all.push_back({.file = entry.path().string(), .time = std::stod(found[2])});
      }
    }
  }
  return all;
}

TEST_F(CheckGrbl, is_within_a_percent_of_grbl_itself) {
  const std::vector<Row> all = rows();
  if (all.empty()) GTEST_SKIP() << "no ../shared/peers/motion-mm beside this checkout";
  EXPECT_EQ(all.size(), 11U);
  for (std::size_t i = 0; i < all.size(); i += passo::test::in_full() == 0 ? 3 : 1) {
    const double time = json_of(all[i].file, "bench.toml")["board"]["time_s"];
    EXPECT_NEAR(time / all[i].time, 1, 0.01) << all[i].file;
    std::printf("%.4f of Grbl's time: %s\n", time / all[i].time, std::filesystem::path(all[i].file).filename().c_str());
  }
}

}  // namespace
