// RandomProgram: random programs that Passo and LinuxCNC's rs274 both accept.
//
// It omits the following, because rs274 (2.9, as in Debian 12) is known to have errors or to differ there:
//   EQ, NE, LE and GE             EQ and NE hold within 1e-4 there, LE and GE are exact; in LinuxCNC 2.9.0 and here all
//                                 four hold within 1e-6
//   G93 with slow feeds           the minimum feed there is 0.1 per minute
//   G10 L2 R, G28.1 when rotated  the tool's position is lost
//   units changed under G43.1     the tool's position is lost
//   M6, M61                       rs274 alone takes the numbers of the last move for the position
//   M49                           M2 leaves the speed override off
//   M70 to M73                    some overrides are mixed up
//   G74, G84 outside G17          they move sideways
//   cutter compensation           gouging is detected at some corners only; arcs lead in on the wrong side, too;
//                                 in inches, arcs that become 0.001 radian longer are refused
//   O-words that repeat a label   loops are refused there
//   break out of while, then do   the `break` of an earlier `while` ends the next `do` loop after its first pass
//   continue in do                the condition of the loop is not evaluated
//   G17 with polar words          the previous plane is used there
//   quarter turns                 COS[90] is not 0 there
//   pecks that end at the bottom  rounding may add one of zero length
//   lines over 255 characters     it does not read them
//   contours of G70 to G72        U, W, A and C were added in 2.10. With D, 2.10 leads out of the stock before the
//                                 contour is offset, and merges arcs of opposite directions. G71.2 continues where
//                                 G71.1 ended. Where arcs cross at two points, rs274 may take the farther one.
//                                 Collinear lines, or lines along the cuts, end at different points of the same path
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <numbers>
#include <random>
#include <string>

#include <fmt/format.h>

namespace passo::test {

class RandomProgram {
 public:
  explicit RandomProgram(std::uint64_t seed) : random_(seed) {}

  std::string program() {
    do {
      write();
    } while (has_long_line());
    return text_;
  }

  // Returns a program in which a contour is turned, faced and finished.
  std::string lathe_program() {
    text_ = fmt::format("G21 G18 {} F200\n", one_of({"G7", "G8"}));
    facing_ = below(3) == 0;
    profile();
    text_ += "G0 X60 Z5\n";
    for (int i = 1 + below(3); i > 0; --i) {
      if (below(4) == 0) {
        text_ += fmt::format("G70 Q200 X55 Z4 D{} E{} P{}\n", size(2), size(1), 1 + below(3));
        continue;
      }
      text_ += fmt::format("{}{} Q200 X55 Z4", facing_ ? "G72" : "G71", one_of({"", "", ".1"}));
      if (below(2) == 0) text_ += " D" + size(1);
      if (below(3) > 0) text_ += fmt::format(" I{:.1f}", 0.5 + below(40) / 10.0);
      if (below(2) == 0) text_ += " R" + size(1);
      text_ += "\n";
    }
    return text_ + "G0 X70\nM2\n";
  }

 private:
  void write() {
    labels_ = 100;
    subs_ = 0;
    has_do_ = below(2) == 0;
    is_metric_ = below(2) == 0;
    text_ = is_metric_ ? "G21 F100\n" : "G20 F100\n";
    for (int i = below(3); i > 0; --i) sub(i);
    if (subs_ > 0) early_sub();
    for (int i = 5 + below(25); i > 0; --i) statement(0);
    text_ += "M2\n";
  }
  bool has_long_line() const {
    for (std::size_t at = 0, end = 0; at < text_.size(); at = end + 1) {
      end = text_.find('\n', at);
      if (end - at > 255) return true;
    }
    return false;
  }

  int below(int limit) { return std::uniform_int_distribution<int>(0, limit - 1)(random_); }
  std::string one_of(std::initializer_list<const char*> list) {
    return *(list.begin() + below(static_cast<int>(list.size())));
  }
  std::string number(int limit = 50) { return fmt::format("{:.{}f}", below(2000 * limit) / 1000.0 - limit, below(4)); }

  // Returns a value: a number, or an expression.
  std::string value(int depth = 0) {
    switch (below(depth < 3 ? 9 : 2)) {
      case 2: return fmt::format("#{}", 1 + below(6));
      case 3: return fmt::format("[{} {} {}]", value(depth + 1), one_of({"+", "-", "*"}), value(depth + 1));
      case 4:
        if (below(3) == 0) {
          return fmt::format("[FIX[{}] {} FUP[{}]]", value(depth + 1), one_of({"EQ", "NE"}), value(depth + 1));
        }
        return fmt::format("[{} {} {}]", value(depth + 1), one_of({"GT", "LT", "AND", "OR", "XOR"}), value(depth + 1));
      case 5: return fmt::format("{}[{}]", one_of({"ABS", "FIX", "FUP", "ROUND"}), value(depth + 1));
      case 8: return fmt::format("{}[{} + 0.3719]", one_of({"SIN", "COS"}), value(depth + 1));
      case 6: return fmt::format("[{} MOD {}]", value(depth + 1), 2 + below(9));
      case 7: return fmt::format("ATAN[{}]/[{}]", value(depth + 1), 1 + below(9));
      default: return number();
    }
  }
  // Returns a coordinate that no expression computes from numbers with the same printed value.
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
    // Incremental: from one point of a circle to another one.
    const double next = angle + 0.1 + below(600) / 100.0;
    text_ +=
        fmt::format("{} G91 {} {}{:.6f} {}{:.6f} {}{:.6f} {}{:.6f}\nG90\n", code, one_of({"G2", "G3"}), ends[0],
                    radius * (std::cos(next) - std::cos(angle)), ends[1], radius * (std::sin(next) - std::sin(angle)),
                    centers[0], -radius * std::cos(angle), centers[1], -radius * std::sin(angle));
  }

  std::string size(int limit) { return fmt::format("{:.2f}", 0.1 + below(100 * limit) / 100.0); }

  // Appends cycles in every plane and distance mode, arcs with R, splines, threads, contours with compensation, polar
  // words, feed modes, and codes that query the machine.
  void machining() {
    switch (below(9)) {
      case 5: return is_metric_ ? contour() : feed_modes();
      case 6: return polar();
      case 7: return feed_modes();
      case 8: return radial_codes();
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
                         one_of({"G81", "G82 P0.5", "G83 Q1.7219", "G73 Q0.9137", "G85", "G89 P0.3"}), across[0],
                         number(20), across[1], number(20), down, size(8), size(5), one_of({"", " L1", " L3"}));
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

  // Appends lines and arcs with cutter compensation. Each line is much longer than the tool radius, and no corner turns
  // back, so that the tool fits everywhere.
  void contour() {
    const std::array<const char*, 2> planes[] = {{"G17", "XYIJ"}, {"G18", "ZXKI"}};
    const auto& plane = planes[below(2)];
    const char* const code = plane[0];
    const char* const letters = plane[1];
    double first = below(100) / 10.0;
    double second = below(100) / 10.0;
    double heading = below(628) / 100.0;
    const auto go = [&](double way) {
      first += way * std::cos(heading);
      second += way * std::sin(heading);
      return fmt::format(" {}{:.6f} {}{:.6f}", letters[0], first, letters[1], second);
    };
    text_ +=
        fmt::format("{} G40 G80 G90 G94 F100\nG0 {}{:.6f} {}{:.6f}\n", code, letters[0], first, letters[1], second);
    text_ += fmt::format("{} D{}\n", one_of({"G41.1", "G42.1"}), size(3));
    const int moves = 3 + below(6);
    for (int i = 0; i < moves; ++i) {
      if (i == 0 || i + 1 == moves || below(4) > 0) {
        text_ += one_of({"G1", "G1", "G0"}) + go(8 + below(100) / 10.0);
      } else {
        bow(letters, first, second, heading);
      }
      text_ += "\n" + one_of({"", "", "M8\n", "(a remark)\n", "F60\n", "S300\n"});
      heading += (below(2 * 180) - 180) / 100.0;
    }
    text_ += "G40\nG1" + go(10) + "\nG17\n";
  }
  // Appends an arc that begins in the direction of `heading`.
  void bow(const char* letters, double& first, double& second, double& heading) {
    const bool left = below(2) == 0;
    const double radius = 5 + below(50) / 10.0;
    const double sweep = (left ? 1 : -1) * (0.5 + below(250) / 100.0);
    const double toward = heading + (left ? 1 : -1) * std::numbers::pi / 2;
    const double i = radius * std::cos(toward);
    const double j = radius * std::sin(toward);
    heading += sweep;
    const double from_center = toward + std::numbers::pi + sweep;
    first += i + radius * std::cos(from_center);
    second += j + radius * std::sin(from_center);
    text_ += fmt::format("{} {}{:.6f} {}{:.6f} {}{:.6f} {}{:.6f}", left ? "G3" : "G2", letters[0], first, letters[1],
                         second, letters[2], i, letters[3], j);
  }

  void polar() {
    text_ += fmt::format("G17\nG90 G0 @{} ^{}\n", size(20), number(360));
    for (int i = 1 + below(4); i > 0; --i) {
      switch (below(5)) {
        case 0: text_ += fmt::format("G1 @{}\n", size(30)); break;
        case 1: text_ += fmt::format("G1 ^{}\n", number(200)); break;
        case 2: text_ += fmt::format("G91 G1 @{} ^{} Z{}\nG90\n", size(3), number(90), number(5)); break;
        case 3: text_ += fmt::format("G0 @{} ^[{}] A{}\n", size(30), value(), number()); break;
        default: text_ += fmt::format("G81 @{} ^{} Z-2 R1\nG80\n", size(30), number(180));
      }
    }
  }

  // Appends G93 with an F in each block, and G95 with the spindle on.
  void feed_modes() {
    if (below(2) == 0) {
      text_ += "G93\n";
      for (int i = 1 + below(3); i > 0; --i) text_ += fmt::format("G1{} F{}\n", axes(), 40 + below(300) / 10.0);
      if (below(2) == 0) text_ += fmt::format("G17 G91 G3 X2 Y2 I2 J0 F{}\nG90\n", size(20));
    } else {
      text_ += fmt::format("{} S{}\nG95 F{}\n", one_of({"M3", "M4"}), 100 + below(900), size(1));
      for (int i = 1 + below(3); i > 0; --i) text_ += "G1" + axes() + one_of({"", " F0.3"}) + "\n";
    }
    text_ += fmt::format("G94 F{}\n", 10 + below(200));
  }

  // Appends diameters, absolute centres, multiple turns, homes, scaled work offsets, and the subroutine of a contour.
  // Along the cuts the contour is monotonic. Across them it may go back, into pockets.
  void profile() {
    double x = 4 + below(60) / 10.0;
    double z = facing_ ? -20 - below(50) / 10.0 : below(20) / 10.0;
    const bool pockets = below(2) == 0;
    const std::string arc = one_of({"G2", "G3"});
    text_ += fmt::format("o200 sub\nG0 X{:.2f} Z{:.2f}\n", x, z);
    double old_along = 0;
    double old_across = 1;
    bool after_arc = true;
    for (int i = 2 + below(7); i > 0; --i) {
      const double along = 0.5 + below(40) / 10.0;
      const double across = (below(pockets ? 60 : 40) - (pockets ? 20 : 0)) / 10.0 + 0.03;
      if (std::abs(along * old_across - across * old_along) < 0.1) continue;
      old_along = along;
      old_across = across;
      const double old_x = x;
      const double old_z = z;
      x = facing_ ? x + along : std::max(x + across, 1.0);
      z = facing_ ? z + across : z - along;
      const double chord = std::hypot(x - old_x, z - old_z);
      after_arc = !after_arc && below(4) == 0;
      text_ += after_arc ? fmt::format("{} X{:.2f} Z{:.2f} R{:.2f}\n", arc, x, z, chord * 2)
                         : fmt::format("G1 X{:.2f} Z{:.2f}\n", x, z);
    }
    text_ += facing_ ? "G1 Z4\n" : "G1 X55\n";
    text_ += "o200 endsub\n";
  }

  void radial_codes() {
    switch (below(5)) {
      case 0: text_ += fmt::format("G7\nG0 X{} Z{}\nG91 G1 X{}\nG90 G8\n", number(), number(), number()); return;
      case 1:
        text_ +=
            fmt::format("G17 G90.1 G0 X{0} Y0\nG2 X{0} Y0 I0 J0 P{1} Z{2}\nG91.1\n", size(20), 1 + below(3), number(5));
        return;
      case 2: text_ += fmt::format("{}\nG0 X1\n{} Z2\n", one_of({"G28.1", "G30.1"}), one_of({"G28", "G30"})); return;
      case 3: text_ += fmt::format("M3 S300\nG96 D{} S{}\nG1 X3\nG97 S100\n", 500 + below(900), 50 + below(99)); return;
      default: text_ += fmt::format("G53 G0 X{} Y{}\n", number(), number());
    }
  }

  void statement(int depth) {
    if (below(5) == 0) return machining();
    switch (below(depth < 2 ? 19 : 11)) {
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
                             one_of({"G81", "G82 P1", "G83 Q1.0173", "G73 Q0.9871", "G85", "G89 P1"}), place(), place(),
                             one_of({"", " L2"}), place());
        return;
      case 9: text_ += fmt::format("(debug,#{})\n", 1 + below(6)); return;
      case 10: text_ += fmt::format("G91 {} X{} Y{}\nG90\n", one_of({"G0", "G1"}), number(), number()); return;
      case 11: block("if [" + value() + "]", one_of({"else", ""}), "endif", depth); return;
      case 12: block(fmt::format("repeat [{}]", below(4)), "", "endrepeat", depth); return;
      case 13: counted(depth); return;
      case 14: cases(depth); return;
      case 15: until(depth); return;
      case 16: named(); return;
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
  // Appends a loop with its own counter parameter.
  void counted(int depth) {
    const int label = ++labels_;
    text_ += fmt::format("#{0}=0\no{0} while [#{0} LT {1}]\n#{0}=[#{0}+1]\n", label, 1 + below(4));
    statement(depth + 1);
    text_ += fmt::format("o{} endwhile\n", label);
  }
  void cases(int depth) {
    const int label = ++labels_;
    text_ += fmt::format("o{} if [{}]\n", label, value());
    statement(depth + 1);
    for (int i = 1 + below(2); i > 0; --i) {
      text_ += fmt::format("o{} elseif [{}]\n", label, value());
      statement(depth + 1);
    }
    if (below(2) == 0) {
      text_ += fmt::format("o{} else\n", label);
      statement(depth + 1);
    }
    text_ += fmt::format("o{} endif\n", label);
  }
  // Appends a loop with its condition at the end, which may contain break or continue.
  void until(int depth) {
    const int label = ++labels_;
    const int leave = ++labels_;
    const bool at_end = has_do_;
    const std::string condition = fmt::format("while [#{} LT {}]", label, 1 + below(4));
    text_ += fmt::format("#{0}=0\no{0} {1}\n#{0}=[#{0}+1]\n", label, at_end ? "do" : condition);
    statement(depth + 1);
    text_ += fmt::format("o{0} if [#{1} EQ {2}]\no{1} {3}\no{0} endif\n", leave, label, 1 + below(4),
                         at_end ? "break" : one_of({"break", "continue"}));
    statement(depth + 1);
    text_ += fmt::format("o{} {}\n", label, at_end ? condition : "endwhile");
  }
  // Appends named parameters, and a subroutine that returns early and calls another one.
  void named() {
    text_ += fmt::format("#<here>={}\n#<_there>=[#<here> + {}]\nG0 X[#<_there> MOD 50]\n", value(), value());
    if (subs_ > 0)
      text_ += fmt::format("o<early> call [{}] [{}] [{}]\n(debug,#<_value>)\n", below(3), place(), below(2));
  }
  void early_sub() {
    text_ += "o<early> sub\n#<way>=#2\no90 if [#1 EQ 1]\no<early> return [#<way>]\no90 endif\n";
    text_ +=
        "G1 Y[#<way> MOD 50]\no1 call [#3] [#<way>]\no91 repeat [#3]\nG1 Z[#3-#1]\no91 endrepeat\no<early> endsub "
        "[7]\n";
  }
  void sub(int number) {
    subs_ = std::max(subs_, number);
    text_ += fmt::format("o{} sub\nG1 X#1\n#3=[#1+#2]\nG0 Y[#3 MOD 50]\no{} endsub [#3]\n", number, number);
  }

  std::mt19937_64 random_;
  std::string text_;
  int labels_ = 100;  // labels are also used as parameter numbers
  int subs_ = 0;
  bool facing_ = false;
  bool is_metric_ = true;
  bool has_do_ = false;  // true: loops with the condition at the end may contain a break; false: loops with the
                         // condition at the start
};

}  // namespace passo::test
