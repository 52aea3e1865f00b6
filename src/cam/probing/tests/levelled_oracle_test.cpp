// The path of a levelled program, less the map, is the path of the program: random programs with all words that move
// the frame, on machines whose offsets, tools and start the leveller knows or does not know.
#include <cstdlib>
#include <random>
#include <string>

#include "kit/in_full.hpp"
#include "levelled_path.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/probing/levelled_program.hpp"

namespace passo::test {
namespace {

HeightMap random_map(std::mt19937_64& random) {
  std::uniform_real_distribution<double> height(-0.6, 0.6);
  std::vector<double> heights(6 * 5);
  for (double& each : heights) each = height(random);
  return HeightMap({-10, 10, 25, 40, 60, 80}, {-10, 15, 30, 50, 80}, heights);
}

// Writes a program line by line, and knows how it stands as far as that takes.
class RandomProgram {
 public:
  RandomProgram(std::mt19937_64& random, bool with_all) : random_(random), with_all_(with_all) {}

  std::string text() {
    if (one_in(3)) add("G21 G90 G54");
    if (one_in(3)) add("G17 G40 G49 G80");
    if (one_in(4)) add(one_in(2) ? "G92.1" : "G92.2");
    add("M3 S1000 F400");
    is_fresh_ = one_in(4);
    if (!is_fresh_) start();
    const int lines = 4 + static_cast<int>(number(0, 14));
    for (int i = 0; i < lines; ++i) {
      block();
      is_fresh_ = false;
    }
    if (one_in(2)) add(mode(false) + "G53 G0 Z-4");
    if (one_in(3)) add("G91 G28 Z0");
    add("M5");
    add("M2");
    return text_;
  }

 private:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  bool one_in(int count) { return std::uniform_int_distribution<int>(1, count)(random_) == 1; }
  void add(const std::string& line) { text_ += line + "\n"; }
  std::string mode(bool incremental) {
    if (incremental == incremental_ && !one_in(5)) return {};
    incremental_ = incremental;
    return incremental ? "G91 " : "G90 ";
  }
  std::string word(char letter, double mm) {
    const double value = mm / unit_;
    return one_in(6) ? fmt::format("{}[{:.4f}/2]", letter, value * 2) : fmt::format("{}{:.4f}", letter, value);
  }
  std::string place() { return word('X', number(0, 70)) + " " + word('Y', number(0, 70)); }
  void start() {
    if (one_in(2)) add(mode(false) + "G0 " + place());
    add(mode(false) + "G0 " + word('Z', number(2, 8)));
    if (one_in(2)) add(mode(false) + "G0 " + place());
  }

  void straight() {
    const std::string code = one_in(3) ? "G0 " : "G1 ";
    std::string line = mode(one_in(3)) + code;
    const auto way = [&](char letter) {
      return incremental_ ? word(letter, number(-12, 12)) : word(letter, number(0, 70));
    };
    if (!one_in(4)) line += way('X');
    if (!one_in(4)) line += " " + way('Y');
    if (one_in(2)) line += " " + word('Z', incremental_ ? number(-2, 2) : number(-2, 4));
    if (one_in(8)) line += " " + word('A', number(0, 30) * unit_);
    add(line + (one_in(5) ? " F" + fmt::format("{:.2f}", 300 / unit_) : ""));
  }

  void arc() {
    const double radius = number(2, 12);
    const std::string code = one_in(2) ? "G2 " : "G3 ";
    switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
      case 0: return add(code + word('I', radius));  // a full circle
      case 1:
        return add(code + word('J', -radius) + (one_in(2) ? " P2 " : " ") +
                   (incremental_ ? word('Z', number(-1, 1)) : ""));
      case 2: return add(mode(true) + code + word('X', 2 * radius) + " " + word('I', radius));
      case 3: return add("G18 " + mode(true) + code + word('X', 2 * radius) + " " + word('I', radius) + "\nG17");
      default: {
        const double x = number(15, 50);
        const double y = number(15, 50);
        add(mode(false) + "G1 " + word('X', x - radius) + " " + word('Y', y));
        return add(mode(false) + code +
                   fmt::format("X{:.5f} Y{:.5f} I{:.5f}", x / unit_, (y + radius) / unit_, radius / unit_));
      }
    }
  }

  void machine_move() {
    const std::string code = one_in(3) ? "G53 G1 " : "G53 G0 ";
    switch (std::uniform_int_distribution<int>(0, 3)(random_)) {
      case 0: return add(mode(false) + code + word('Z', number(-6, -1)));
      case 1: return add(mode(false) + code + place());
      case 2: return add(mode(false) + code + word('X', number(-5, 5)) + " " + word('Z', number(-6, -1)));
      default: return add(mode(false) + code + word('Y', number(-5, 5)));
    }
  }

  void home() {
    const std::string code = one_in(3) ? "G30 " : "G28 ";
    switch (std::uniform_int_distribution<int>(0, 4)(random_)) {
      case 0: return add(code);
      case 1: return add(mode(true) + code + "Z0");
      case 2: return add(mode(true) + code + "X0 Y0");
      case 3: return add(mode(false) + code + word('Z', number(2, 5)));
      default: return add(mode(true) + code + word('Z', number(0.5, 2)));
    }
  }

  // A cycle begins above the work: at a height of the machine, or of the work.
  void cycle() {
    if (one_in(2)) {
      add(mode(false) + "G53 G0 " + word('Z', number(-3, -1)));
    } else if (one_in(2) || !is_fresh_) {
      add(mode(false) + "G0 " + word('Z', number(3, 6)));
    }
    constexpr const char* codes[] = {"G81", "G82", "G83", "G85", "G73", "G89"};
    const char* const code = codes[std::uniform_int_distribution<std::size_t>(0, 5)(random_)];
    std::string line = mode(one_in(6) && with_all_) + (one_in(2) ? "G98 " : "G99 ") + code + " ";
    line += incremental_ ? word('X', 5) + " " + word('Y', 3) : place();
    line += incremental_ ? " " + word('Z', -3) + " " + word('R', -0.5)
                         : " " + word('Z', number(-3, -2)) + " " + word('R', number(0.1, 3));
    if (code == codes[2] || code == codes[4]) line += " " + word('Q', 1.1);
    if (code == codes[1] || code == codes[5]) line += " P0.1";
    add(line);
    if (one_in(2)) add(incremental_ ? word('X', 4) : word('X', number(0, 70)));
    add("G80");
  }

  void frame_word() {
    switch (std::uniform_int_distribution<int>(0, 9)(random_)) {
      case 0: return add(fmt::format("G{}", 54 + static_cast<int>(number(0, 5.99))));
      case 1: return add(fmt::format("G59.{}", 1 + static_cast<int>(number(0, 2.99))));
      case 2: return add("G43 H1");
      case 3: return add("T2 M6\nG43 H2 " + mode(false) + "G0 " + word('Z', number(3, 6)));
      case 4: return add("G49");
      case 5: return add(one_in(2) ? "G43.1 " + word('Z', number(0, 5)) : std::string("G43.2 H1"));
      case 6: return add(one_in(2) ? "G28.1" : "G30.1");
      case 7: return add(one_in(2) ? "G54" : "G92.1");
      case 8: return add("G10 L1 P2 " + word('Z', number(0, 9)));
      default:
        unit_ = one_in(2) ? 25.4 : 1;
        return add((unit_ == 1 ? "G21" : "G20") + fmt::format(" F{:.2f}", 400 / unit_));
    }
  }

  void block() {
    switch (std::uniform_int_distribution<int>(0, 15)(random_)) {
      case 0:
      case 1: return arc();
      case 2: return machine_move();
      case 3: return home();
      case 4:
      case 5: return frame_word();
      case 6: return cycle();
      case 7:
        return add(mode(false) + "G0 @" + fmt::format("{:.3f}", number(5, 40) / unit_) +
                   fmt::format(" ^{:.3f}", number(10, 80)));
      case 8: {
        const std::string name = fmt::format("o{}", ++labels_);
        add(name + " repeat [2]");
        straight();
        return add(name + " endrepeat");
      }
      case 9: return add(mode(false) + "G0 " + word('Z', number(3, 6)));
      default: return straight();
    }
  }

  std::mt19937_64& random_;
  bool with_all_;
  std::string text_;
  bool incremental_ = false;
  bool is_fresh_ = true;  // nothing has moved yet
  double unit_ = 1;
  int labels_ = 100;
};

// A machine as it might be when a program starts.
InterpreterOptions random_machine(std::mt19937_64& random, bool with_g92) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  InterpreterOptions machine;
  machine.on_machine = true;
  for (const Axis axis : {Axis::x, Axis::y, Axis::z}) machine.start[axis] = std::round(number(-20, 20) * 1000) / 1000;
  const auto set = [&](int first, double low, double high) {
    for (int i = 0; i < 3; ++i) machine.parameters[first + i] = std::round(number(low, high) * 1000) / 1000;
  };
  set(5161, -5, 5);
  set(5181, -5, 5);
  for (int system = 0; system < 9; ++system) {
    set(5221 + 20 * system, -50, 50);
    machine.parameters[5223 + 20 * system] = std::round(number(-90, -70));  // the work is below the machine's top
    if (random() % 3 == 0) machine.parameters[5230 + 20 * system] = std::round(number(-180, 180));
  }
  machine.parameters[5220] = 1 + static_cast<double>(random() % 9);
  if (with_g92 && random() % 4 == 0) {
    machine.parameters[5210] = 1;
    set(5211, -3, 3);
  }
  for (int number_of = 1; number_of <= 2; ++number_of) {
    Tool tool{.number = number_of, .pocket = number_of};
    tool.offset[Axis::z] = std::round(number(5, 30) * 1000) / 1000;
    EXPECT_TRUE(machine.tools.add(tool));
  }
  machine.tools.name = "random.tbl";
  return machine;
}

std::uint64_t asked(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

// False: the program itself is wrong: an arc may not be one.
bool is_compared(std::uint64_t seed, bool is_known) {
  std::mt19937_64 random(seed);
  const HeightMap map = random_map(random);
  const InterpreterOptions machine = random_machine(random, !is_known);
  // Who does not know the machine knows neither its offsets nor how long its tools are.
  InterpreterOptions believed = machine;
  if (!is_known) {
    believed = InterpreterOptions();
    believed.on_machine = true;
    for (int number = 1; number <= 2; ++number) EXPECT_TRUE(believed.tools.add({.number = number, .pocket = number}));
  }
  const std::string program = RandomProgram(random, is_known).text();
  const RunPath path = path_of(program, machine);
  if (!path.findings.empty()) return false;
  std::string levelled;
  Diagnostics findings;
  const LevelOptions wish{.holes = true, .beside = 1e5, .knows_offsets = is_known};
  write_levelled_program(ProgramReader::from_text("it", program), believed, map, wish, findings,
                         [&](std::string_view text) { levelled += text; });
  EXPECT_FALSE(findings.any_error()) << "seed " << seed << "\n" << program << render(findings, false);
  const RunPath copy = path_of(levelled, machine);
  EXPECT_EQ(copy.findings, "") << "seed " << seed << "\n" << program << "---\n" << levelled;
  EXPECT_EQ(difference_of(path, copy, map, {.all_known = is_known}), "") << "seed " << seed << "\n"
                                                                         << program << "---\n"
                                                                         << levelled;
  return true;
}

TEST(LevelledProgramOracle, the_path_less_the_map_is_the_path_of_the_program) {
  const std::uint64_t runs = asked("PASSO_RUNS", 600);
  std::uint64_t compared = 0;
  const std::uint64_t first = asked("PASSO_SEED", 1);
  for (std::uint64_t seed = first; seed < first + runs; ++seed) {
    if (is_compared(seed, seed % 2 == 0)) ++compared;
    if (HasFailure()) return;
  }
  EXPECT_GT(compared, runs * 3 / 4);
  RecordProperty("compared", std::to_string(compared));
}

}  // namespace
}  // namespace passo::test
