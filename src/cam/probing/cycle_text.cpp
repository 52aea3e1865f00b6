#include "cycle_text.hpp"

#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "passo/interpreter/saved_offsets.hpp"

namespace passo {
namespace {

class CycleText {
 public:
  explicit CycleText(const ProbingCycle& cycle) : cycle_(cycle), system_(static_cast<int>(cycle.system)) {}

  std::string write();

 private:
  template <class... T>
  void line(fmt::format_string<T...> words, T&&... values) {
    fmt::format_to(std::back_inserter(text_), words, std::forward<T>(values)...);
    text_ += '\n';
  }
  void head(std::string_view start, std::string_view end);
  void write_subs();
  void touch(int x, int y, int z) { line("o<touch> call [{}] [{}] [{}]", x, y, z); }
  void go(char axis, double way) { line("G91 G0 {}{:.4f}\nG90", axis, way); }
  // The zero of an axis, found by the touch that the machine rests at: `ahead` beyond the contact.
  void set_zero(char axis, int sign, double height);
  std::string offset_of(char axis) const { return fmt::format("#{}", work_offset_parameter(system_) + (axis - 'X')); }

  void surface();
  void edge();
  void corner();
  void bore();
  void go_to_middle();
  void boss();
  void boss_side(char axis, int sign, double half, const char* name);
  void tool();
  void angle();
  void bores();
  void map();

  const ProbingCycle& cycle_;
  int system_;
  std::string text_;
};

void CycleText::head(std::string_view start, std::string_view end) {
  line("({}: {})", name_of(cycle_.kind), purpose_of(cycle_.kind));
  line("(Start: {})", start);
  line("(Ends:  {})", end);
}

// #1 #2 #3: the way of the touch. What the probe touched is kept in #5061 and the following.
void CycleText::write_subs() {
  line("#<_reach> = {:.4f} (largest length of a probe move)", cycle_.touch.reach);
  line("#<_back> = {:.4f} (retract between the two touches)", cycle_.touch.back);
  line("#<_fast> = {:.4f} (speed of the first touch)", cycle_.touch.fast);
  line("#<_slow> = {:.4f} (speed of the second touch)", cycle_.touch.slow);
  line("o<touch> sub (#1 #2 #3: the direction)");
  line("  G91");
  line("  G38.2 X[#1*#<_reach>] Y[#2*#<_reach>] Z[#3*#<_reach>] F#<_fast>");
  line("  G0 X[-#1*#<_back>] Y[-#2*#<_back>] Z[-#3*#<_back>]");
  line("  G38.2 X[#1*2*#<_back>] Y[#2*2*#<_back>] Z[#3*2*#<_back>] F#<_slow>");
  line("  G90");
  line("o<touch> endsub");
  line("o<lower> sub (moves down to the work Z #1; the path must be clear)");
  line("  G38.3 Z#1 F#<_fast>");
  line("  o<hit> if [#5070 EQ 1]");
  line("    G38.2 Z[#1-0.01] (the probe is already triggered: something is in the way, so the program ends here)");
  line("  o<hit> endif");
  line("o<lower> endsub");
  line("G17 G21 G40 G80 G90 G94 {}", cycle_.kind == ProbingKind::tool ? "G49" : name_of_system(system_));
}

// The machine rests a little behind the contact. G10 L20 says which work coordinate that place has.
void CycleText::set_zero(char axis, int sign, double height) {
  const int number = axis - 'X';
  const double edge = axis == 'Z' ? height : -sign * cycle_.ball / 2 + 0.0;  // no -0
  line("G10 L20 P{} {}[#{}-#{}{:+.6f}]", system_, axis, 5420 + number, 5061 + number, edge);
}

void CycleText::surface() {
  head("above the work, within the reach", "above the touched point, by the clearance");
  write_subs();
  touch(0, 0, -1);
  set_zero('Z', -1, cycle_.height);
  go('Z', cycle_.clearance);
  line("(PRINT,found: Z0 of {} is Z{} in the machine)", name_of_system(system_), offset_of('Z'));
}

void CycleText::edge() {
  const TouchWay way = *way_of(cycle_.side);
  head("next to the edge, below the top of the work, within the reach", "away from the edge, by the clearance");
  write_subs();
  touch(way.axis == 'X' ? way.sign : 0, way.axis == 'Y' ? way.sign : 0, 0);
  set_zero(way.axis, way.sign, 0);
  go(way.axis, -way.sign * cycle_.clearance);
  line("(PRINT,found: {}0 of {} is {}{} in the machine)", way.axis, name_of_system(system_), way.axis,
       offset_of(way.axis));
}

void CycleText::corner() {
  const CornerWays ways = *corner_of(cycle_.side);
  head("above the work, and nearer to both sides of the corner than the reach", "above the corner, by the clearance");
  write_subs();
  touch(0, 0, -1);
  set_zero('Z', -1, 0);
  line("G0 Z{:.4f}", cycle_.clearance);
  go('X', -ways.x * cycle_.touch.reach);
  line("o<lower> call [{:.4f}]", -cycle_.depth);
  touch(ways.x, 0, 0);
  set_zero('X', ways.x, 0);
  line("G0 X{:.4f}", -ways.x * (cycle_.clearance + cycle_.ball / 2));
  line("G0 Z{:.4f}", cycle_.clearance);
  line("G0 X{:.4f}", ways.x * cycle_.inside);
  go('Y', -ways.y * cycle_.touch.reach);
  line("o<lower> call [{:.4f}]", -cycle_.depth);
  touch(0, ways.y, 0);
  set_zero('Y', ways.y, 0);
  line("G0 Y{:.4f}", -ways.y * (cycle_.clearance + cycle_.ball / 2));
  line("G0 Z{:.4f}", cycle_.clearance);
  line("G0 X0 Y0");
  line("(PRINT,found: X0 Y0 Z0 of {} is X{} Y{} Z{} in the machine)", name_of_system(system_), offset_of('X'),
       offset_of('Y'), offset_of('Z'));
}

// The middle of a chord along X is above the middle of the bore; the chord along Y through it is the diameter.
void CycleText::go_to_middle() {
  touch(-1, 0, 0);
  line("#<left> = #5061");
  go('X', cycle_.touch.back);
  touch(1, 0, 0);
  line("#<middle_x> = [[#<left>+#5061]/2]");
  line("G0 X#<middle_x>");
  touch(0, -1, 0);
  line("#<front> = #5062");
  go('Y', cycle_.touch.back);
  touch(0, 1, 0);
  line("#<middle_y> = [[#<front>+#5062]/2]");
  line("#<diameter> = [#5062-#<front>+{:.4f}]", cycle_.ball);
  line("G0 Y#<middle_y>");
}

void CycleText::bore() {
  head("in the bore, near its centre", "in the centre of the bore");
  write_subs();
  go_to_middle();
  line("G10 L20 P{} X0 Y0", system_);
  line("(PRINT,found: X0 Y0 of {} is X{} Y{} in the machine; the bore is #<diameter> wide)", name_of_system(system_),
       offset_of('X'), offset_of('Y'));
}

// Until both bores are known the system is not turned. What the bores are too near or too far is shared by both: the
// midpoint between them lies where the program has it.
void CycleText::bores() {
  head("in the first bore, near its centre; the second bore is within the reach of its nominal position",
       "above the second bore, by the clearance");
  write_subs();
  line("G10 L2 P{} R0", system_);
  line("#<down> = #5422");
  go_to_middle();
  line("G10 L20 P{} X{:.4f} Y{:.4f} (the first bore is where it should be)", system_, cycle_.x, cycle_.y);
  go('Z', cycle_.clearance);
  line("G0 X{:.4f} Y{:.4f}", cycle_.second_x, cycle_.second_y);
  line("o<lower> call [#<down>]");
  go_to_middle();
  line("#<way_x> = [#<middle_x>-{:.4f}]\n#<way_y> = [#<middle_y>-{:.4f}]", cycle_.x, cycle_.y);
  go('Z', cycle_.clearance);
  const double way_x = cycle_.second_x - cycle_.x;
  const double way_y = cycle_.second_y - cycle_.y;
  line("#<apart> = SQRT[#<way_x>*#<way_x>+#<way_y>*#<way_y>]");
  line("o<fit> if [ABS[#<apart>-{:.6f}] GT {:.4f}]", std::hypot(way_x, way_y), cycle_.fit);
  line("  (ABORT, the bores are #<apart> mm apart; they should be {:.4f} mm apart)", std::hypot(way_x, way_y));
  line("o<fit> endif");
  line("#<angle> = [ATAN[#<way_y>]/[#<way_x>]-{:.9f}]", std::atan2(way_y, way_x) / std::numbers::pi * 180);
  line("o<half> if [#<angle> GT 180]\n  #<angle> = [#<angle>-360]\no<half> endif");
  line("o<half2> if [#<angle> LT -180]\n  #<angle> = [#<angle>+360]\no<half2> endif");
  const double half_x = (cycle_.x + cycle_.second_x) / 2;
  const double half_y = (cycle_.y + cycle_.second_y) / 2;
  line("#<zero_x> = [{}+{:.6f}+#<way_x>/2-COS[#<angle>]*{:.6f}+SIN[#<angle>]*{:.6f}]", offset_of('X'), cycle_.x, half_x,
       half_y);
  line("#<zero_y> = [{}+{:.6f}+#<way_y>/2-SIN[#<angle>]*{:.6f}-COS[#<angle>]*{:.6f}]", offset_of('Y'), cycle_.y, half_x,
       half_y);
  line("G10 L2 P{} X#<zero_x> Y#<zero_y> R#<angle>", system_);
  line(
      "(PRINT,found: X0 Y0 of {} is X{} Y{} in the machine, rotated by #<angle> degrees; the bores are #<apart> apart)",
      name_of_system(system_), offset_of('X'), offset_of('Y'));
}

void CycleText::boss_side(char axis, int sign, double half, const char* name) {
  line("G0 Z[#<top>+{:.4f}]", cycle_.clearance);
  line("G0 X#<middle_x> Y#<middle_y>");
  go(axis, -sign * (half + cycle_.clearance + cycle_.ball / 2));
  line("o<lower> call [#<top>-{:.4f}]", cycle_.depth);
  touch(axis == 'X' ? sign : 0, axis == 'Y' ? sign : 0, 0);
  line("#<{}> = #{}", name, axis == 'X' ? 5061 : 5062);
  go(axis, -sign * cycle_.clearance);
}

void CycleText::boss() {
  head("above the boss, near its centre, within the reach", "above the centre of the boss, by the clearance");
  write_subs();
  line("#<middle_x> = #5420");
  line("#<middle_y> = #5421");
  touch(0, 0, -1);
  line("#<top> = #5063");
  boss_side('X', 1, cycle_.size_x / 2, "left");
  boss_side('X', -1, cycle_.size_x / 2, "right");
  line("#<middle_x> = [[#<left>+#<right>]/2]");
  boss_side('Y', 1, cycle_.size_y / 2, "front");
  boss_side('Y', -1, cycle_.size_y / 2, "back_side");
  line("#<middle_y> = [[#<front>+#<back_side>]/2]");
  line("#<width> = [#<back_side>-#<front>-{:.4f}]", cycle_.ball);
  line("G0 Z[#<top>+{:.4f}]", cycle_.clearance);
  line("G0 X#<middle_x> Y#<middle_y>");
  line("G10 L20 P{} X0 Y0", system_);
  line("(PRINT,found: X0 Y0 of {} is X{} Y{} in the machine; the boss is #<width> wide along Y)",
       name_of_system(system_), offset_of('X'), offset_of('Y'));
}

void CycleText::tool() {
  const int tool = static_cast<int>(cycle_.tool.number);
  head("anywhere; the tool is in the spindle", "above the fixed probe");
  write_subs();
  line("G53 G0 Z{:.4f}", cycle_.tool.travel_z);
  line("G53 G0 X{:.4f} Y{:.4f}", cycle_.x, cycle_.y);
  touch(0, 0, -1);
  line("#<length> = [#<_abs_z>-#5422+#5063-{:.6f}]", cycle_.tool.zero_z);
  line("G10 L1 P{} Z#<length>", tool);
  line("G53 G0 Z{:.4f}", cycle_.tool.travel_z);
  line("(PRINT,found: tool {} is #<length> long)", tool);
}

// The work coordinate system is turned about its zero. Until both places are known it is not turned.
void CycleText::angle() {
  const TouchWay way = *way_of(cycle_.side);
  const bool along_x = way.axis == 'Y';
  head("next to the edge, below the top of the work; the second point lies ahead along the other axis",
       "away from the second point, by the clearance");
  write_subs();
  line("G10 L2 P{} R0", system_);
  const int x = along_x ? 0 : way.sign;
  const int y = along_x ? way.sign : 0;
  touch(x, y, 0);
  line("#<first_x> = #5061\n#<first_y> = #5062");
  go(way.axis, -way.sign * cycle_.clearance);
  go(along_x ? 'X' : 'Y', cycle_.along);
  touch(x, y, 0);
  if (along_x) {
    line("#<angle> = ATAN[#5062-#<first_y>]/[#5061-#<first_x>]");
  } else {
    line("#<angle> = ATAN[#<first_x>-#5061]/[#5062-#<first_y>]");
  }
  go(way.axis, -way.sign * cycle_.clearance);
  line("G10 L2 P{} R#<angle>", system_);
  line("(PRINT,found: {} is rotated by #<angle> degrees)", name_of_system(system_));
}

// Each height is logged with the place that was meant, as a line of a height map.
void CycleText::map() {
  head("Z0 is on the surface, and nothing is in the way at the clearance height",
       "above the last point, by the clearance");
  line("G17 G21 G40 G80 G90 G94 {}", name_of_system(system_));
  line("G0 Z{:.4f}", cycle_.clearance);
  const auto columns = static_cast<int>(cycle_.columns);
  const auto rows = static_cast<int>(cycle_.rows);
  for (int row = 0; row < rows; ++row) {
    const double y = cycle_.y + cycle_.size_y * row / (rows - 1);
    for (int i = 0; i < columns; ++i) {
      const double x = cycle_.x + cycle_.size_x * (row % 2 == 0 ? i : columns - 1 - i) / (columns - 1);
      line("G0 X{:.4f} Y{:.4f}", x, y);
      line("G38.2 Z{:.4f} F{:.4f}", -cycle_.depth, cycle_.touch.fast);
      line("(LOG,{:.4f},{:.4f},#5063)", x, y);
      line("G0 Z{:.4f}", cycle_.clearance);
    }
  }
}

// The cycle begins and ends with '%': the tool stays where it is, while M2 may move it to the park position.
std::string CycleText::write() {
  line("%");
  switch (cycle_.kind) {
    case ProbingKind::surface: surface(); break;
    case ProbingKind::edge: edge(); break;
    case ProbingKind::corner: corner(); break;
    case ProbingKind::bore: bore(); break;
    case ProbingKind::boss: boss(); break;
    case ProbingKind::tool: tool(); break;
    case ProbingKind::angle: angle(); break;
    case ProbingKind::bores: bores(); break;
    case ProbingKind::map: map(); break;
  }
  line("%");
  return std::move(text_);
}

}  // namespace

std::optional<TouchWay> way_of(std::string_view side) {
  if (side.size() != 2 || (side[1] != '+' && side[1] != '-')) return {};
  if (side[0] != 'x' && side[0] != 'y') return {};
  return TouchWay{.axis = side[0] == 'x' ? 'X' : 'Y', .sign = side[1] == '+' ? 1 : -1};
}

std::optional<CornerWays> corner_of(std::string_view side) {
  if (side == "front-left") return CornerWays{.x = 1, .y = 1};
  if (side == "front-right") return CornerWays{.x = -1, .y = 1};
  if (side == "back-left") return CornerWays{.x = 1, .y = -1};
  if (side == "back-right") return CornerWays{.x = -1, .y = -1};
  return {};
}

std::string cycle_text(const ProbingCycle& cycle) {
  return CycleText(cycle).write();
}

}  // namespace passo
