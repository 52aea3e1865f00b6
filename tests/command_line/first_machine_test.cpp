// docs/manual/first-machine.md: its commands, in their order, and what it says of them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

namespace fs = std::filesystem;
using passo::test::checkout;
using passo::test::lacks_an_emulator;
using passo::test::Outcome;
using passo::test::read;
using testing::HasSubstr;

const std::string prompt = "passo ";
constexpr double step_mm = 0.02;

std::string as_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

// A command of the document, and what stands below it in the same block.
struct Shown {
  std::string command;
  std::string output;
};
std::vector<Shown> commands_of(const std::string& document, const std::string& section) {
  std::vector<Shown> commands;
  std::istringstream text(document);
  bool is_block = false;
  bool is_section = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("## ")) is_section = line == "## " + section;
    if (line.starts_with("```")) is_block = !is_block;
    if (!is_section || !is_block || line.starts_with("```")) continue;
    if (line.starts_with(prompt) && !line.starts_with("passo: ")) {
      commands.push_back({.command = line.substr(prompt.size()), .output = {}});
    } else if (!commands.empty()) {
      commands.back().output += line + "\n";
    }
  }
  return commands;
}

class FirstMachine : public passo::test::CommandLine {
 protected:
  FirstMachine() { fs::create_directory_symlink(checkout + "/examples", path("examples")); }

  // A run is cut short where the document cuts it after a minute.
  Outcome run(std::string command) const {
    const std::string minute = "--hold-at 60";
    if (const std::size_t at = command.find(minute); at != std::string::npos) {
      command.replace(at, minute.size(), "--hold-at 12");
    }
    return passo(command, "cd " + path(".") + " &&");
  }
  // The commands of a section. False: gpsim is not installed.
  bool run_section(const std::string& section, std::vector<Outcome>& outcomes) const {
    for (const Shown& shown : commands_of(document, section)) {
      outcomes.push_back(run(shown.command));
      if (lacks_an_emulator(outcomes.back())) return false;
      EXPECT_EQ(outcomes.back().code, 0) << shown.command << "\n" << outcomes.back().err;
    }
    return true;
  }
  // Commanded, sampled and true steps agree.
  void expect_true(const std::string& report, std::int64_t least_steps) const {
    const auto json = nlohmann::json::parse(read(path(report)));
    std::int64_t steps = 0;
    for (const auto& motor : json["port"]["motors"]) {
      const std::string axis = motor["axis"];
      EXPECT_EQ(motor["commanded_steps"], json["steps"][axis]["total"]) << axis;
      EXPECT_EQ(motor["commanded_steps"], motor["sampled_steps"]) << axis;
      EXPECT_EQ(motor["commanded_net"], json["steps"][axis]["net"]) << axis;
      EXPECT_EQ(motor["commanded_net"], motor["sampled_net"]) << axis;
      EXPECT_NEAR(motor["true_position_mm"], json["position_mm"][axis], step_mm) << axis;
      EXPECT_NEAR(motor["true_net"], motor["commanded_net"], 0.5) << axis;
      steps += motor["commanded_steps"].get<std::int64_t>();
    }
    EXPECT_EQ(json["port"]["motors"].size(), 3U);
    EXPECT_EQ(json["port"]["lost_pulses"], 0);
    EXPECT_GE(steps, least_steps);
  }

  const std::string document = read(checkout + "/docs/manual/first-machine.md");
};

// Where a program drills, in its units times `scale`.
std::set<std::pair<long, long>> holes_of(const std::string& program, double scale) {
  std::set<std::pair<long, long>> holes;
  const std::regex hole(R"(^(?:G9[89] )?(?:G81 )?X(-?[0-9.]+) Y(-?[0-9.]+))");
  std::istringstream text(program);
  for (std::string line; std::getline(text, line);) {
    std::smatch words;
    if (!std::regex_search(line, words, hole)) continue;
    const auto hundredths = [&](std::size_t word) { return std::lround(std::stod(words[word]) * scale * 100); };
    holes.emplace(hundredths(1), hundredths(2));
  }
  return holes;
}

// Where the rotors' way is deeper than `depth`: the first point of each hole.
std::vector<std::pair<double, double>> deep_points(const std::string& way, double depth) {
  std::vector<std::pair<double, double>> points;
  const std::regex move(R"(^G1 X(-?[0-9.]+) Y(-?[0-9.]+) Z(-?[0-9.]+))");
  std::istringstream text(way);
  bool is_deep = false;
  for (std::string line; std::getline(text, line);) {
    std::smatch words;
    if (!std::regex_search(line, words, move)) continue;
    const bool was_deep = std::exchange(is_deep, std::stod(words[3]) <= depth);
    if (is_deep && !was_deep) points.emplace_back(std::stod(words[1]), std::stod(words[2]));
  }
  return points;
}

TEST_F(FirstMachine, drills_the_board_of_the_drawing_through_port_and_pic) {
  std::vector<Outcome> outcomes;
  if (!run_section("Drill a circuit board", outcomes)) GTEST_SKIP() << outcomes.back().err;
  ASSERT_EQ(outcomes.size(), 4U);
  // The same twelve holes in cm, in mm and in inches.
  const auto holes = holes_of(read(path("holes.ngc")), 1);
  EXPECT_EQ(holes.size(), 12U);
  EXPECT_EQ(holes, holes_of(read(path("fori.gc")), 10));
  const std::string drill = commands_of(document, "Drill a circuit board")[0].command;
  const Outcome inches =
      run(std::regex_replace(drill, std::regex("--units cm --drill 0.075 --clearance 0.2 --depth -0.3 -o fori.gc"),
                             "--input cm --units inch --drill 0.075cm --clearance 0.2cm --depth -0.3cm -o inch.ngc"));
  EXPECT_EQ(inches.code, 0) << inches.err;
  EXPECT_EQ(holes.size(), holes_of(read(path("inch.ngc")), 25.4).size());
  for (const auto& hole : holes_of(read(path("inch.ngc")), 25.4)) EXPECT_TRUE(holes.contains(hole));
  // The board, the PIC and the rotors.
  expect_true("holes.json", 9'000);
  EXPECT_EQ(nlohmann::json::parse(read(path("holes.json")))["port"]["relay_closings"], 1);
  const std::string table = document.substr(document.find("Parallel port and PIC, in steps"));
  EXPECT_THAT(as_one_line(outcomes[2].out), HasSubstr(as_one_line(table.substr(0, table.find("```")))));
  // The rotors have been 3 mm deep in each hole and nowhere else, and the stock shows it.
  const auto drilled = deep_points(read(path("drilled.ngc")), -2.9);
  EXPECT_EQ(drilled.size(), 12U);
  for (const auto& [x, y] : drilled) {
    EXPECT_TRUE(std::ranges::any_of(holes,
                                    [&, x = x, y = y](const auto& hole) {
                                      return std::hypot(x - static_cast<double>(hole.first) / 100,
                                                        y - static_cast<double>(hole.second) / 100) < 1.5 * step_mm;
                                    }))
        << x << " " << y;
  }
  const Outcome cut = run("simulate drilled.ngc --tool flat:0.75 --stock X0:29,Y0:20,Z-3.2:0 --cell 0.02 --json");
  const double volume = 12 * 3.0 * 3.14159 * 0.375 * 0.375;
  EXPECT_NEAR(nlohmann::json::parse(cut.out)["removed_mm3"], volume, 0.06 * volume);
  EXPECT_GT(fs::file_size(path("first-machine-holes.png")), 10'000U);
}

TEST_F(FirstMachine, engraves_letters_and_carves_a_relief_for_their_first_seconds) {
  std::vector<Outcome> letters;
  if (!run_section("Engrave letters", letters)) GTEST_SKIP() << letters.back().err;
  expect_true("letters.json", 1'000);
  EXPECT_THAT(letters[1].out, HasSubstr("0:03:51 in motion, 0:00:02 of dwells"));
  std::vector<Outcome> relief;
  ASSERT_TRUE(run_section("Carve a relief", relief));
  expect_true("relief.json", 1'000);
  EXPECT_THAT(relief[1].out, HasSubstr("5:39:"));
}

// Refused with the document's words; or run, with the pulses that the loop did not see.
TEST_F(FirstMachine, refuses_pulses_that_are_too_short_for_the_loop) {
  const std::string school = read(checkout + "/examples/machines/first-machine.toml");
  write("fast.toml",
        std::regex_replace(std::regex_replace(school, std::regex("step_pulse_us = 50\n"), "step_pulse_us = 20\n"),
                           std::regex("max_event_rate_hz = 10_000\n"), "max_event_rate_hz = 20000\n"));
  write("holes.ngc", "G21 G90 F300\nG1 X4 Y2 Z1\nG1 X0 Y0 Z0\nM2\n");
  const auto shown = commands_of(document, "Too fast for the loop");
  ASSERT_EQ(shown.size(), 1U);
  const Outcome refused = run(shown[0].command);
  EXPECT_EQ(refused.code, 3);
  EXPECT_EQ(as_one_line(refused.err), as_one_line(shown[0].output));
  const Outcome anyway = run(shown[0].command + " --anyway --report lost.json");
  if (lacks_an_emulator(anyway)) GTEST_SKIP() << anyway.err;
  EXPECT_EQ(anyway.code, 1);
  EXPECT_THAT(anyway.err, HasSubstr("[run.pulses-lost]"));
  const auto port = nlohmann::json::parse(read(path("lost.json")))["port"];
  std::map<std::string, std::int64_t> lost;
  for (const auto& motor : port["motors"]) {
    lost[motor["axis"]] = motor["commanded_steps"].get<std::int64_t>() - motor["sampled_steps"].get<std::int64_t>();
    // The rotors turn as the PIC steps, not as the port commands.
    EXPECT_NEAR(motor["true_net"], motor["sampled_net"], 0.5);
  }
  std::map<std::string, std::int64_t> named;
  for (const auto& pulse : port["lost"]) {
    ++named[pulse["axis"]];
    EXPECT_TRUE(pulse["line"] == 2 || pulse["line"] == 3);
  }
  std::erase_if(lost, [](const auto& one) { return one.second == 0; });
  EXPECT_EQ(lost, named);
  EXPECT_GE(port["lost_pulses"], 3);
}

TEST_F(FirstMachine, has_no_inputs) {
  const std::string machine = " -m examples/machines/first-machine.toml --board sim:first_board";
  write("probe.ngc", "G21 F100\nG38.2 Z-1\nM2\n");
  EXPECT_THAT(run("run probe.ngc" + machine).err, HasSubstr("[port.no-inputs]"));
  EXPECT_THAT(run("run probe.ngc --touch Z:-1" + machine).err, HasSubstr("has none"));
  EXPECT_THAT(run("jog X1" + machine).err, HasSubstr("[board.one-way]"));
  EXPECT_THAT(run("run probe.ngc --anyway -m examples/machines/first-machine.toml").err, HasSubstr("sim:first_board"));
}

}  // namespace
