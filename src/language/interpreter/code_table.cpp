#include "code_table.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;
using enum AxisUse;

constexpr CodeEntry table[] = {
    {'G', code(0), motion, may, "@^", "rapid move"},
    {'G', code(1), motion, may, "@^", "feed move"},
    {'G', code(2), motion, may, "@^IJKRP", "arc, clockwise"},
    {'G', code(3), motion, may, "@^IJKRP", "arc, counterclockwise"},
    {'G', code(4), non_modal, none, "P", "dwell"},
    {'G', code(5), motion, may, "IJPQ", "cubic spline"},
    {'G', code(5, 1), motion, may, "IJ", "quadratic spline"},
    {'G', code(5, 2), motion, may, "PL", "control point of a NURBS"},
    {'G', code(5, 3), motion, none, "", "move along the NURBS"},
    {'G', code(7), lathe_diameter, none, "", "X words are diameters"},
    {'G', code(8), lathe_diameter, none, "", "X words are radii"},
    {'G', code(10), non_modal, may, "LPRIJQ", "set a work offset or a tool"},
    {'G', code(17), plane, none, "", "plane XY"},
    {'G', code(17, 1), plane, none, "", "plane UV"},
    {'G', code(18), plane, none, "", "plane ZX"},
    {'G', code(18, 1), plane, none, "", "plane WU"},
    {'G', code(19), plane, none, "", "plane YZ"},
    {'G', code(19, 1), plane, none, "", "plane VW"},
    {'G', code(20), length_units, none, "", "inches"},
    {'G', code(21), length_units, none, "", "millimetres"},
    {'G', code(28), non_modal, may, "", "go to the first home position"},
    {'G', code(28, 1), non_modal, none, "", "store the first home position"},
    {'G', code(30), non_modal, may, "", "go to the second home position"},
    {'G', code(30, 1), non_modal, none, "", "store the second home position"},
    {'G', code(33), motion, must, "@^K$", "spindle-synchronised move"},
    {'G', code(33, 1), motion, must, "@^K$", "rigid tapping"},
    {'G', code(38, 2), motion, must, "@^", "probing towards"},
    {'G', code(38, 3), motion, must, "@^", "probing towards"},
    {'G', code(38, 4), motion, must, "@^", "probing away"},
    {'G', code(38, 5), motion, must, "@^", "probing away"},
    {'G', code(40), cutter_compensation, none, "", "cutter compensation off"},
    {'G', code(41), cutter_compensation, none, "D", "cutter compensation, tool left of the contour"},
    {'G', code(41, 1), cutter_compensation, none, "DL", "cutter compensation, tool left of the contour"},
    {'G', code(42), cutter_compensation, none, "D", "cutter compensation, tool right of the contour"},
    {'G', code(42, 1), cutter_compensation, none, "DL", "cutter compensation, tool right of the contour"},
    {'G', code(43), tool_length, none, "H", "tool offset from the tool table"},
    {'G', code(43, 1), tool_length, may, "", "tool offset from the axis words"},
    {'G', code(43, 2), tool_length, may, "H", "further tool offset"},
    {'G', code(49), tool_length, none, "", "no tool offset"},
    {'G', code(50), non_modal, none, "", "no scaling"},
    {'G', code(51), non_modal, may, "PIJK", "scale X Y Z"},
    {'G', code(52), non_modal, must, "", "offset of all work systems"},
    {'G', code(53), non_modal, none, "", "move in machine coordinates"},
    {'G', code(54), work_system, none, "", "work system 1"},
    {'G', code(55), work_system, none, "", "work system 2"},
    {'G', code(56), work_system, none, "", "work system 3"},
    {'G', code(57), work_system, none, "", "work system 4"},
    {'G', code(58), work_system, none, "", "work system 5"},
    {'G', code(59), work_system, none, "", "work system 6"},
    {'G', code(59, 1), work_system, none, "", "work system 7"},
    {'G', code(59, 2), work_system, none, "", "work system 8"},
    {'G', code(59, 3), work_system, none, "", "work system 9"},
    {'G', code(61), path_mode, none, "", "exact path"},
    {'G', code(61, 1), path_mode, none, "", "exact stop"},
    {'G', code(64), path_mode, none, "PQR", "blended path"},
    {'G', code(65), macro, none, "PL", "macro call"},
    {'G', code(66), macro, none, "PL", "macro call behind each block that moves"},
    {'G', code(67), macro, none, "", "no more macro calls of G66"},
    {'G', code(70), motion, may, "QDEP", "lathe finishing cycle"},
    {'G', code(71), motion, may, "QDIR", "lathe roughing cycle"},
    {'G', code(71, 1), motion, may, "QDIR", "lathe roughing cycle"},
    {'G', code(71, 2), motion, may, "QDIR", "lathe roughing cycle"},
    {'G', code(72), motion, may, "QDIR", "lathe facing cycle"},
    {'G', code(72, 1), motion, may, "QDIR", "lathe facing cycle"},
    {'G', code(72, 2), motion, may, "QDIR", "lathe facing cycle"},
    {'G', code(73), motion, must, "@^RLQD", "chip-breaking drilling cycle"},
    {'G', code(74), motion, must, "@^RLP", "left-hand tapping cycle"},
    {'G', code(76), motion, must, "@^PIJKRQHEL", "threading cycle"},
    {'G', code(80), motion, none, "", "no motion"},
    {'G', code(81), motion, must, "@^RL", "drilling cycle"},
    {'G', code(82), motion, must, "@^RLP", "drilling cycle with dwell"},
    {'G', code(83), motion, must, "@^RLQD", "peck drilling cycle"},
    {'G', code(84), motion, must, "@^RLP", "right-hand tapping cycle"},
    {'G', code(85), motion, must, "@^RL", "boring cycle, feed out"},
    {'G', code(86), motion, must, "@^RLP", "boring cycle, spindle stop, rapid out"},
    {'G', code(87), motion, must, "@^RLIJK", "back boring cycle"},
    {'G', code(88), motion, must, "@^RLP", "boring cycle, retract by hand"},
    {'G', code(89), motion, must, "@^RLP", "boring cycle with dwell, feed out"},
    {'G', code(90), distance, none, "", "absolute distances"},
    {'G', code(90, 1), arc_distance, none, "", "absolute arc centres"},
    {'G', code(91), distance, none, "", "incremental distances"},
    {'G', code(91, 1), arc_distance, none, "", "incremental arc centres"},
    {'G', code(92), non_modal, must, "", "offset so that this is the given position"},
    {'G', code(92, 1), non_modal, none, "", "clear the G92 offset"},
    {'G', code(92, 2), non_modal, none, "", "suspend the G92 offset"},
    {'G', code(92, 3), non_modal, none, "", "restore the G92 offset"},
    {'G', code(93), feed_mode, none, "", "inverse time feed"},
    {'G', code(94), feed_mode, none, "", "feed in units a minute"},
    {'G', code(95), feed_mode, none, "", "feed in units a revolution"},
    {'G', code(96), spindle_mode, none, "D$", "constant surface speed"},
    {'G', code(97), spindle_mode, none, "$", "constant spindle speed"},
    {'G', code(98), retract, none, "", "cycles retract to where they began"},
    {'G', code(99), retract, none, "", "cycles retract to R"},

    {'M', code(0), stopping, none, "", "stop"},
    {'M', code(1), stopping, none, "", "optional stop"},
    {'M', code(2), stopping, none, "", "end of the program"},
    {'M', code(3), spindle, none, "$", "spindle clockwise"},
    {'M', code(4), spindle, none, "$", "spindle counterclockwise"},
    {'M', code(5), spindle, none, "$", "spindle off"},
    {'M', code(6), tool_change, none, "", "tool change"},
    {'M', code(7), coolant, none, "", "mist on"},
    {'M', code(8), coolant, none, "", "flood on"},
    {'M', code(9), coolant, none, "", "coolant off"},
    {'M', code(19), spindle, none, "RQP$", "orient the spindle"},
    {'M', code(30), stopping, none, "", "end of the program"},
    {'M', code(48), overrides, none, "", "overrides on"},
    {'M', code(49), overrides, none, "", "overrides off"},
    {'M', code(50), overrides, none, "P", "feed override"},
    {'M', code(51), overrides, none, "P$", "spindle override"},
    {'M', code(52), overrides, none, "P", "adaptive feed"},
    {'M', code(53), overrides, none, "P", "feed hold switch"},
    {'M', code(60), stopping, none, "", "pallet change and stop"},
    {'M', code(61), tool_change, none, "Q", "name the tool in the spindle"},
    {'M', code(62), input_output, none, "P", "digital output"},
    {'M', code(63), input_output, none, "P", "digital output"},
    {'M', code(64), input_output, none, "P", "digital output"},
    {'M', code(65), input_output, none, "P", "digital output"},
    {'M', code(66), input_output, none, "PELQ", "wait for an input"},
    {'M', code(67), input_output, none, "EQ", "analog output"},
    {'M', code(68), input_output, none, "EQ", "analog output"},
    {'M', code(70), spindle, none, "", "save the modal state"},
    {'M', code(71), spindle, none, "", "drop the saved modal state"},
    {'M', code(72), spindle, none, "", "restore the modal state"},
    {'M', code(73), spindle, none, "", "save the modal state for the caller"},
    {'M', code(98), stopping, none, "PL", "call of a subprogram"},
    {'M', code(99), stopping, none, "", "end of a subprogram"},
};

constexpr std::size_t table_size = std::size(table);
constexpr CodeNumber number_limit = code(100);
constexpr std::uint8_t nothing = 0xff;
static_assert(table_size < nothing);

// Finds the line of the table from letter and number in one step, because every block looks up several codes.
using Index = std::array<std::array<std::uint8_t, static_cast<std::size_t>(number_limit)>, 2>;
constexpr Index make_index() {
  Index index{};
  for (auto& letter : index) letter.fill(nothing);
  for (std::size_t i = 0; i < table_size; ++i) {
    index[table[i].letter == 'G' ? 0 : 1][static_cast<std::size_t>(table[i].number)] = static_cast<std::uint8_t>(i);
  }
  return index;
}
constexpr Index index_of_table = make_index();

// M100 to M199.
constexpr std::size_t user_codes = 100;
constexpr std::array<CodeEntry, user_codes> make_user_table() {
  std::array<CodeEntry, user_codes> entries{};
  for (std::size_t i = 0; i < user_codes; ++i) {
    entries[i] = {'M', code(100 + static_cast<int>(i)), user, none, "PQ", "user code"};
  }
  return entries;
}
constexpr std::array<CodeEntry, user_codes> user_table = make_user_table();

const CodeEntry* find_user_code(CodeNumber number) {
  const auto at = static_cast<std::size_t>(number / 10 - 100);
  return number % 10 == 0 && at < user_codes ? &user_table[at] : nullptr;
}

// Codes of other controls, and what does the same here.
struct ForeignCode {
  char letter;
  CodeNumber number;
  std::string_view cure;
};
constexpr ForeignCode foreign_codes[] = {
    {'G', code(12), "G2 or G3 with I and J, a full circle"},
    {'G', code(13), "G2 or G3 with I and J, a full circle"},
    {'G', code(15), "X and Y, or @ and ^ for polar coordinates"},
    {'G', code(16), "@ and ^ for polar coordinates"},
    {'G', code(31), "G38.2 to G38.5, which probe"},
    {'G', code(36), "G38.2 and G10 L10, which measure a tool"},
    {'G', code(37), "G38.2 and G10 L10, which measure a tool"},
    {'G', code(44), "G43 with the offset's other sign"},
    {'G', code(68), "G10 L2 with R, which turns a work system"},
    {'G', code(69), "G10 L2 with R0, which ends the turning of a work system"},
    {'M', code(13), "M3 and M8: on other controls this is both at once"},
    {'M', code(14), "M4 and M8: on other controls this is both at once"},
    {'M', code(29), "G33.1: on other controls this announces rigid tapping"},
    {'M', code(42), "M62 to M65, which switch a digital output"},
    {'M', code(97), "o… call or M98, which call a part of the program"},
    {'M', code(47), "M99 in the main program, which begins it again"},
};

// "G1, G2 or G3".
std::string in_a_row(const std::vector<std::string>& names) {
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

}  // namespace

std::string_view name_of(ModalGroup group) {
  constexpr std::array<std::string_view, modal_group_count> names = {
      "non-modal codes",     "motion",        "planes",        "distance modes",
      "arc centre modes",    "feed modes",    "length units",  "cutter compensation",
      "tool length offsets", "retract modes", "work systems",  "path modes",
      "spindle modes",       "lathe modes",   "macro calls",   "program stops",
      "inputs and outputs",  "tool changes",  "spindle codes", "coolant codes",
      "override codes",      "user codes"};
  return names[index_of(group)];
}

const CodeEntry* find_code(char letter, CodeNumber number) {
  if (number < 0) return nullptr;
  if (number >= number_limit) return letter == 'M' ? find_user_code(number) : nullptr;
  const std::uint8_t at = index_of_table[letter == 'G' ? 0 : 1][static_cast<std::size_t>(number)];
  return at == nothing ? nullptr : &table[at];
}

std::string spelling(char letter, CodeNumber number) {
  const int whole = number / 10;
  const int tenth = number % 10;
  return tenth == 0 ? fmt::format("{}{}", letter, whole) : fmt::format("{}{}.{}", letter, whole, tenth);
}

std::string cure_for_unknown_code(char letter, CodeNumber number) {
  for (const ForeignCode& foreign : foreign_codes) {
    if (foreign.letter == letter && foreign.number == number) return std::string(foreign.cure);
  }
  std::vector<std::string> relatives;  // of the same whole number
  for (const CodeEntry& entry : table) {
    const bool is_other = entry.number % 10 == 0 && number % 10 != 0;
    if (entry.letter == letter && entry.number / 10 == number / 10 && !is_other) relatives.push_back(spelling(entry));
  }
  return relatives.empty() ? "a code of docs/gcode.md" : in_a_row(relatives);
}

std::string codes_using(char letter) {
  const bool axis = (axis_letters | polar_letters).has(letter);
  std::vector<std::string> users;
  for (const CodeEntry& entry : table) {
    if (entry.letters.has(letter) || (axis && entry.axes != none)) users.push_back(spelling(entry));
  }
  return users.empty() ? std::string() : in_a_row(users);
}

}  // namespace passo
