// Random programs, interpreted here and by LinuxCNC's rs274 where it is installed (Debian: linuxcnc-uspace). Both must
// make the same calls with the same numbers, or both must refuse the program. PASSO_SEED chooses the programs.
//
// What the generator leaves out, because rs274 (2.9, as Debian 12 has it) is known to do it wrong or in another way:
//   LE and GE                     they are exact there; in LinuxCNC 2.9.0 and here they hold within 1e-6
//   G93 with slow feeds           no feed there is below 0.1 a minute
//   G10 L2 R, G28.1 when turned   the tool's place is lost
//   units that change under G43.1 the tool's place is lost
//   M6, M61                       rs274 alone takes the numbers of the last move for the position
//   M49                           M2 leaves the speed override off
//   M70 to M73                    some overrides are mixed up
//   G74, G84 outside G17          they go sideways
//   cutter compensation           gouging is looked for at some corners only
//   O-words that repeat a label   loops are refused there
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <random>
#include <sstream>

#include "interpreted.hpp"
#include "kit/seed.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace passo {
namespace {

namespace fs = std::filesystem;

// What rs274 prints for a program. Its errors, which go to standard error, are left out.
struct Peer {
  bool refused = false;
  std::string canon;
};

class Rs274 {
 public:
  Rs274() : path_(fs::temp_directory_path() / fmt::format("passo-differential-{}.ngc", getpid())) {}
  ~Rs274() { fs::remove(path_); }
  Rs274(const Rs274&) = delete;
  Rs274& operator=(const Rs274&) = delete;

  static bool is_installed() { return std::system("command -v rs274 >/dev/null 2>&1") == 0; }

  Peer run(const std::string& program) const {
    std::ofstream(path_) << program;
    Peer peer;
    std::FILE* const pipe = popen(fmt::format("rs274 -g {} 2>/dev/null", path_.string()).c_str(), "r");
    if (pipe == nullptr) return peer;
    std::array<char, 65536> buffer;
    for (std::size_t size = 0; (size = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
      peer.canon.append(buffer.data(), size);
    }
    peer.refused = pclose(pipe) != 0;
    return peer;
  }

  // "2.9", as the program itself sees it.
  std::string version() const {
    std::istringstream lines(run("(debug,%.1f#<_vmajor>.%d#<_vminor>)\nM2\n").canon);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("MESSAGE") != std::string::npos) return line.substr(line.find('"'));
    }
    return "unknown";
  }

 private:
  fs::path path_;
};

// A random program that both accept.
class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed) {}

  std::string program() {
    labels_ = 100;
    subs_ = 0;
    text_ = one_of({"G21", "G20"}) + " F100\n";
    for (int i = below(3); i > 0; --i) sub(i);
    for (int i = 5 + below(25); i > 0; --i) statement(0);
    return text_ + "M2\n";
  }

 private:
  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  std::string one_of(std::initializer_list<const char*> list) {
    return *(list.begin() + below(static_cast<int>(list.size())));
  }
  std::string number(int limit = 50) { return fmt::format("{:.{}f}", below(2000 * limit) / 1000.0 - limit, below(4)); }

  // A value: a number, or an expression.
  std::string value(int depth = 0) {
    switch (below(depth < 3 ? 8 : 2)) {
      case 2: return fmt::format("#{}", 1 + below(6));
      case 3: return fmt::format("[{} {} {}]", value(depth + 1), one_of({"+", "-", "*"}), value(depth + 1));
      case 4:
        return fmt::format("[{} {} {}]", value(depth + 1), one_of({"EQ", "NE", "GT", "LT", "AND", "OR", "XOR"}),
                           value(depth + 1));
      case 5: return fmt::format("{}[{}]", one_of({"ABS", "SIN", "COS", "FIX", "FUP", "ROUND"}), value(depth + 1));
      case 6: return fmt::format("[{} MOD {}]", value(depth + 1), 2 + below(9));
      case 7: return fmt::format("ATAN[{}]/[{}]", value(depth + 1), 1 + below(9));
      default: return number();
    }
  }
  // A place that no expression brings out of the numbers that are printed alike.
  std::string place() { return below(3) == 0 ? fmt::format("[{} MOD 100]", value()) : number(); }

  std::string axes() {
    std::string words;
    for (const char axis : {'X', 'Y', 'Z', 'A', 'B', 'C'}) {
      if (below(axis < 'A' + 3 ? 8 : 2) == 0) words += fmt::format(" {}{}", axis, place());
    }
    return words.empty() ? " X" + place() : words;
  }

  void arc() {
    const std::array<const char*, 3> planes[] = {{"G17", "XY", "IJ"}, {"G18", "XZ", "IK"}, {"G19", "YZ", "JK"}};
    const auto& [code, ends, centers] = planes[below(3)];
    const double angle = below(628) / 100.0;
    const double radius = 1 + below(20);
    // In increments: from a point of a circle to another one.
    const double next = angle + 0.1 + below(600) / 100.0;
    text_ +=
        fmt::format("{} G91 {} {}{:.6f} {}{:.6f} {}{:.6f} {}{:.6f}\nG90\n", code, one_of({"G2", "G3"}), ends[0],
                    radius * (std::cos(next) - std::cos(angle)), ends[1], radius * (std::sin(next) - std::sin(angle)),
                    centers[0], -radius * std::cos(angle), centers[1], -radius * std::sin(angle));
  }

  std::string size(int limit) { return fmt::format("{:.2f}", 0.1 + below(100 * limit) / 100.0); }

  // Cycles in every plane and distance mode, arcs with R, splines, threads, and codes that ask the machine.
  void machining() {
    switch (below(5)) {
      case 0: return drilling();
      case 1:
        text_ += fmt::format("G17 G91 {} X{}3 Y{}2 R{}{}\nG90\n", one_of({"G2", "G3"}), one_of({"", "-"}),
                             one_of({"", "-"}), one_of({"", "-"}), 2 + below(9));
        return;
      case 2: return spline();
      case 3: return thread();
      default:
        text_ += one_of({"M62 P1", "M63 P2", "M64 P3", "M65 P0", "M66 P1 L0", "M66 P2 L3 Q1", "M66 E1 L0",
                         "M67 E1 Q2.5", "M68 E2 Q-1", "M19 R90 Q2", "M66 P0\n(debug,#5399)"}) +
                 "\n";
    }
  }
  void drilling() {
    const std::array<const char*, 3> planes[] = {{"G17", "XY", "Z"}, {"G18", "XZ", "Y"}, {"G19", "YZ", "X"}};
    const auto& [code, across, down] = planes[below(3)];
    text_ +=
        fmt::format("G90 G0 {}{}\n{} {} {}\n", down, number(20), code, one_of({"G90", "G91"}), one_of({"G98", "G99"}));
    text_ += fmt::format("{} {}{} {}{} {}-{} R{}{}\n",
                         one_of({"G81", "G82 P0.5", "G83 Q1.7", "G73 Q0.9", "G85", "G89 P0.3"}), across[0], number(20),
                         across[1], number(20), down, size(8), size(5), one_of({"", " L1", " L3"}));
    for (int i = below(3); i > 0; --i) {
      text_ += fmt::format("{}{}{}\n", across[below(2)], number(20), one_of({"", " R2.5", " R0.4"}));
    }
    text_ += "G80 G90 G17\n";
  }
  void spline() {
    text_ += "G17\n";
    switch (below(3)) {
      case 0:
        text_ += fmt::format("G5 I{} J{} P{} Q{} X{} Y{}\nG5 P1 Q2 X{} Y{}\n", number(9), number(9), number(9),
                             number(9), number(), number(), number(), number());
        return;
      case 1: text_ += fmt::format("G5.1 I{} J{} X{} Y{}\n", number(9), number(9), number(), number()); return;
      default:
        text_ += "G5.2" + one_of({"", " L3"});
        for (int i = 3 + below(4); i > 0; --i) text_ += fmt::format(" X{} Y{} P{}\n", number(), number(), size(3));
        text_ += "G5.3\n";
    }
  }
  void thread() {
    text_ += fmt::format("M3 S200\nG18 {}\nG0 X{:.2f} Z{:.2f}\n", one_of({"G7", "G8"}), 15 + below(100) / 10.0,
                         below(50) / 10.0);
    if (below(2) == 0) {
      text_ += fmt::format("G33 Z-{} K{}\nG17 G33.1 Z{} K{}\n", size(20), size(2), number(20), size(2));
    } else {
      text_ += fmt::format("G76 P{} Z-{} I-{} J{:.2f} K{:.2f} R{} Q{} H{} E{} L{}\n", size(2), 10 + below(20), size(2),
                           0.05 + below(35) / 100.0, 0.5 + below(150) / 100.0, one_of({"1", "1.5", "2"}),
                           one_of({"0", "29.5", "30"}), below(3), one_of({"0", "0.5", "1"}), below(4));
    }
    text_ += "G8 G17\n";
  }

  void statement(int depth) {
    if (below(5) == 0) return machining();
    switch (below(depth < 2 ? 16 : 11)) {
      case 0:
      case 1:
      case 2: text_ += one_of({"G0", "G1", "G1 F77", "N20 G1", "G0 G53"}) + axes() + "\n"; return;
      case 3: arc(); return;
      case 4: text_ += fmt::format("#{}={}\n", 1 + below(6), value()); return;
      case 5:
        text_ += one_of({"G54", "G55", "G59.3", "G61", "G64 P0.1",   "G64",         "G91.1", "M3 S500", "M4",     "M5",
                         "M7",  "M8",  "M9",    "M48", "(a remark)", "(msg,hello)", "G17",   "G18",     "G19",    "M0",
                         "M1",  "T2",  "G98",   "G99", "G49",        "G40",         "G80",   "G28",     "G4 P0.5"}) +
                 "\n";
        return;
      case 6:
        text_ += fmt::format("{}{}\n", one_of({"G10 L2 P1", "G10 L2 P2", "G10 L2 P0", "G10 L20 P0", "G92", "G52"}),
                             " X" + place() + " Z" + place());
        return;
      case 7: text_ += one_of({"G92.1", "G92.2", "G92.3", "G43.1 Z1", "G43.1 X2", "G49"}) + "\n"; return;
      case 8:
        text_ += fmt::format("G17 G90\n{} X{} Y{} Z-3 R2{}\nX{}\nG80\n",
                             one_of({"G81", "G82 P1", "G83 Q1", "G73 Q1", "G85", "G89 P1"}), place(), place(),
                             one_of({"", " L2"}), place());
        return;
      case 9: text_ += fmt::format("(debug,#{})\n", 1 + below(6)); return;
      case 10: text_ += fmt::format("G91 {} X{} Y{}\nG90\n", one_of({"G0", "G1"}), number(), number()); return;
      case 11: block("if [" + value() + "]", one_of({"else", ""}), "endif", depth); return;
      case 12: block(fmt::format("repeat [{}]", below(4)), "", "endrepeat", depth); return;
      case 13: counted(depth); return;
      default:
        if (subs_ > 0) text_ += fmt::format("o{} call [{}] [{}]\n", 1 + below(subs_), value(), place());
    }
  }

  void block(const std::string& opening, const std::string& middle, const char* closing, int depth) {
    const int label = ++labels_;
    text_ += fmt::format("o{} {}\n", label, opening);
    statement(depth + 1);
    if (!middle.empty()) text_ += fmt::format("o{} {}\n", label, middle);
    if (!middle.empty()) statement(depth + 1);
    text_ += fmt::format("o{} {}\n", label, closing);
  }
  // A loop that counts in a parameter of its own.
  void counted(int depth) {
    const int label = ++labels_;
    text_ += fmt::format("#{0}=0\no{0} while [#{0} LT {1}]\n#{0}=[#{0}+1]\n", label, 1 + below(4));
    statement(depth + 1);
    text_ += fmt::format("o{} endwhile\n", label);
  }
  void sub(int number) {
    subs_ = std::max(subs_, number);
    text_ += fmt::format("o{} sub\nG1 X#1\n#3=[#1+#2]\nG0 Y[#3 MOD 50]\no{} endsub [#3]\n", number, number);
  }

  std::mt19937_64 random_;
  std::string text_;
  int labels_ = 100;  // labels are the numbers of parameters too
  int subs_ = 0;
};

// Whether two words of calls are the same, numbers but for their rounding.
bool same_word(const std::string& mine, const std::string& other) {
  char* my_end = nullptr;
  char* other_end = nullptr;
  const double a = std::strtod(mine.c_str(), &my_end);
  const double b = std::strtod(other.c_str(), &other_end);
  if (my_end == mine.c_str() || other_end == other.c_str()) return mine == other;
  return std::abs(a - b) < 1.5e-4 && std::string(my_end) == other_end;
}

bool same_line(std::string mine, std::string other) {
  for (std::string* const line : {&mine, &other}) {
    for (char& c : *line) c = c == '(' ? ' ' : c;
  }
  std::istringstream my_words(mine);
  std::istringstream other_words(other);
  for (std::string a, b;;) {
    const bool more = static_cast<bool>(my_words >> a);
    if (static_cast<bool>(other_words >> b) != more) return false;
    if (!more) return true;
    if (!same_word(a, b)) return false;
  }
}

void expect_same_calls(const std::string& mine, const std::string& other, const std::string& program) {
  std::istringstream my_lines(mine);
  std::istringstream other_lines(other);
  for (std::string a, b;;) {
    const bool more = static_cast<bool>(std::getline(my_lines, a));
    ASSERT_EQ(more, static_cast<bool>(std::getline(other_lines, b))) << a << "\n" << b << "\n" << program;
    if (!more) return;
    ASSERT_TRUE(same_line(a, b)) << "here:  " << a << "\nrs274: " << b << "\n" << program;
  }
}

TEST(Differential, random_programs_mean_the_same_to_rs274) {
  if (!Rs274::is_installed()) GTEST_SKIP() << "no rs274: the package linuxcnc-uspace is not installed";
  const Rs274 rs274;
  std::cout << "rs274 of LinuxCNC " << rs274.version() << "\n";
  SCOPED_TRACE("PASSO_SEED=" + std::to_string(test::seed()));
  Generator generator(test::seed());
  InterpreterOptions options;
  options.machine_units = LengthUnits::inch;  // rs274 alone is a machine of inches
  options.tools = example_tools();
  int accepted = 0;
  for (int i = 0; i < 60; ++i) {
    const std::string program = generator.program();
    const Interpreted here = interpret_text(program, options);
    const Peer there = rs274.run(program);
    ASSERT_EQ(here.diagnostics.any_error(), there.refused) << here.rendered() << there.canon << program;
    if (there.refused) continue;
    ++accepted;
    expect_same_calls(here.canon, there.canon, program);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(accepted, 30) << "most programs are good ones";
}

}  // namespace
}  // namespace passo
