#include "code_table.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;
using enum AxisUse;
using enum LetterQuantity;
using enum GrblUse;

constexpr GroupRow groups[] = {
    {motion, "motion", code(80), "motion"},
    {length_units, "length units", code(21), "units", Told::always, true},
    {distance, "distance modes", code(90), "distances", Told::when_changed},
    {arc_distance, "arc centre modes", code(91, 1), "arc centres", Told::when_changed},
    {plane, "planes", code(17), "plane", Told::always, true},
    {feed_mode, "feed modes", code(94), "feed mode"},
    {work_system, "work coordinate systems", code(54), "work coordinate system"},
    {tool_length, "tool length offsets", code(49), "tool length"},
    {cutter_compensation, "cutter compensation", code(40), "cutter compensation"},
    {path_mode, "path modes", code(64), "path"},
    {retract, "retract modes", code(99), "retract"},
    {spindle_mode, "spindle modes", code(97), "spindle mode"},
    {lathe_diameter, "lathe modes", code(8), "X words", Told::when_changed, true},
    {non_modal, "non-modal codes"},
    {macro, "macro calls"},
    {stopping, "program stops"},
    {input_output, "inputs and outputs"},
    {tool_change, "tool changes"},
    {spindle, "spindle codes"},
    {coolant, "coolant codes"},
    {overrides, "override codes"},
    {user, "user codes"},
};
static_assert(std::size(groups) == modal_group_count);

// Where each group is in `groups`.
constexpr auto row_of_group = [] {
  std::array<std::uint8_t, modal_group_count> rows{};
  for (std::size_t i = 0; i < std::size(groups); ++i) rows[index_of(groups[i].group)] = static_cast<std::uint8_t>(i);
  return rows;
}();

// What may stand in a row beside number, group and text.
constexpr auto axes(AxisUse use) {
  return [=](CodeEntry& entry) { entry.axes = use; };
}
constexpr auto uses(LetterSet letters) {
  return [=](CodeEntry& entry) { entry.letters = letters; };
}
constexpr auto means(char letter, LetterQuantity quantity, const char* text) {
  return [=](CodeEntry& entry) {
    for (LetterMeaning& free : entry.meanings) {
      if (free.letter == 0) return void(free = {letter, quantity, text});
    }
  };
}
constexpr auto tells(std::string_view note) {
  return [=](CodeEntry& entry) { entry.note = note; };
}
template <auto operation>
constexpr auto calls = [](CodeEntry& entry) { entry.call = [] { return OperationKind(operation); }; };
constexpr auto parameter(std::string_view name) {
  return [=](CodeEntry& entry) { entry.parameter = name; };
}
constexpr auto grbl(GrblUse use) {
  return [=](CodeEntry& entry) { entry.grbl = use; };
}
constexpr auto chapter(std::string_view title) {
  return [=](CodeEntry& entry) { entry.chapter = title; };
}

template <class... Facts>
constexpr CodeEntry code_of(char letter, double number, ModalGroup group, std::string_view what, Facts... facts) {
  const auto tenths = static_cast<CodeNumber>(static_cast<int>(number * 100 + 5) / 10);  // std::lround is no constexpr
  CodeEntry entry{.letter = letter, .number = tenths, .group = group, .what = what};
  (facts(entry), ...);
  return entry;
}
constexpr CodeEntry g(double number, ModalGroup group, std::string_view what, auto... facts) {
  return code_of('G', number, group, what, facts...);
}
constexpr CodeEntry m(double number, ModalGroup group, std::string_view what, auto... facts) {
  return code_of('M', number, group, what, facts...);
}

constexpr CodeEntry table[] = {
    g(0, motion, "rapid move", axes(may), uses("@^"), grbl(executed), chapter("RS274/NGC 3.5.1, rapid linear motion")),
    g(1, motion, "feed move", axes(may), uses("@^"), grbl(executed),
      chapter("RS274/NGC 3.5.2, linear motion at feed rate")),
    g(2, motion, "arc, clockwise", axes(may), uses("@^IJKRP"), means('R', length, "the arc's radius is {}"),
      means('P', turns, "{}, where the last turn may be partial"), grbl(executed),
      chapter("RS274/NGC 3.5.3, arc at feed rate")),
    g(3, motion, "arc, counterclockwise", axes(may), uses("@^IJKRP"), means('R', length, "the arc's radius is {}"),
      means('P', turns, "{}, where the last turn may be partial"), grbl(executed),
      chapter("RS274/NGC 3.5.3, arc at feed rate")),
    g(4, non_modal, "dwell", uses("P"), means('P', seconds, "wait {}"), grbl(executed),
      chapter("RS274/NGC 3.5.4, dwell")),
    g(5, motion, "cubic spline", axes(may), uses("IJPQ"), chapter("LinuxCNC manual, G-codes: G5 Cubic Spline")),
    g(5.1, motion, "quadratic spline", axes(may), uses("IJ"),
      chapter("LinuxCNC manual, G-codes: G5.1 Quadratic Spline")),
    g(5.2, motion, "control point of a NURBS", axes(may), uses("PL"),
      chapter("LinuxCNC manual, G-codes: G5.2 G5.3 NURBS Block")),
    g(5.3, motion, "move along the NURBS", chapter("LinuxCNC manual, G-codes: G5.2 G5.3 NURBS Block")),
    g(7, lathe_diameter, "X words are diameters", tells("interpreter: Lathe diameter mode changed to diameter"),
      parameter("_lathe_diameter_mode")),
    g(8, lathe_diameter, "X words are radii", tells("interpreter: Lathe diameter mode changed to radius"),
      parameter("_lathe_radius_mode")),
    g(10, non_modal, "set a work offset or a tool", axes(may), uses("LPRIJQ"),
      means('P', number, "number {} of the offset or tool that G10 sets"), grbl(executed),
      chapter("RS274/NGC 3.5.5, set coordinate system data")),
    g(17, plane, "plane XY", calls<operation::SelectPlane{Plane::xy}>, grbl(executed)),
    g(17.1, plane, "plane UV", calls<operation::SelectPlane{Plane::uv}>),
    g(18, plane, "plane ZX", calls<operation::SelectPlane{Plane::zx}>, grbl(executed)),
    g(18.1, plane, "plane WU", calls<operation::SelectPlane{Plane::wu}>),
    g(19, plane, "plane YZ", calls<operation::SelectPlane{Plane::yz}>, grbl(executed)),
    g(19.1, plane, "plane VW", calls<operation::SelectPlane{Plane::vw}>),
    g(20, length_units, "inches", calls<operation::SetLengthUnits{LengthUnits::inch}>, parameter("_imperial"),
      grbl(executed)),
    g(21, length_units, "millimetres", calls<operation::SetLengthUnits{LengthUnits::mm}>, parameter("_metric"),
      grbl(executed)),
    g(28, non_modal, "move to the first home position", axes(may), grbl(executed),
      chapter("RS274/NGC 3.5.8, return to home")),
    g(28.1, non_modal, "store the first home position", grbl(executed),
      chapter("LinuxCNC manual, G-codes: G28, G28.1 Go/Set Predefined Position")),
    g(30, non_modal, "move to the second home position", axes(may), grbl(executed),
      chapter("RS274/NGC 3.5.8, return to home")),
    g(30.1, non_modal, "store the second home position", grbl(executed),
      chapter("LinuxCNC manual, G-codes: G30, G30.1 Go/Set Predefined Position")),
    g(33, motion, "spindle-synchronised move", axes(must), uses("@^K$"),
      means('K', length, "{} per spindle revolution"),
      chapter("LinuxCNC manual, G-codes: G33 Spindle Synchronized Motion")),
    g(33.1, motion, "rigid tapping", axes(must), uses("@^K$"), means('K', length, "{} per spindle revolution"),
      chapter("LinuxCNC manual, G-codes: G33.1 Rigid Tapping")),
    g(38.2, motion, "probing towards", axes(must), uses("@^"), grbl(executed),
      chapter("RS274/NGC 3.5.9, straight probe")),
    g(38.3, motion, "probing towards", axes(must), uses("@^"), grbl(executed),
      chapter("LinuxCNC manual, G-codes: G38.n Straight Probe")),
    g(38.4, motion, "probing away", axes(must), uses("@^"), grbl(executed),
      chapter("LinuxCNC manual, G-codes: G38.n Straight Probe")),
    g(38.5, motion, "probing away", axes(must), uses("@^"), grbl(executed),
      chapter("LinuxCNC manual, G-codes: G38.n Straight Probe")),
    g(40, cutter_compensation, "cutter compensation off", grbl(without_effect)),
    g(41, cutter_compensation, "cutter compensation, tool left of the contour", uses("D"),
      means('D', number, "the radius of tool {}"), chapter("LinuxCNC manual, G-codes: G41, G42 Cutter Compensation")),
    g(41.1, cutter_compensation, "cutter compensation, tool left of the contour", uses("DL"),
      means('D', length, "a tool {} wide"),
      chapter("LinuxCNC manual, G-codes: G41.1, G42.1 Dynamic Cutter Compensation")),
    g(42, cutter_compensation, "cutter compensation, tool right of the contour", uses("D"),
      means('D', number, "the radius of tool {}"), chapter("LinuxCNC manual, G-codes: G41, G42 Cutter Compensation")),
    g(42.1, cutter_compensation, "cutter compensation, tool right of the contour", uses("DL"),
      means('D', length, "a tool {} wide"),
      chapter("LinuxCNC manual, G-codes: G41.1, G42.1 Dynamic Cutter Compensation")),
    g(43, tool_length, "tool offset from the tool table", uses("H"), means('H', number, "of tool {} in the tool table"),
      chapter("LinuxCNC manual, G-codes: G43 Tool Length Offset")),
    g(43.1, tool_length, "tool offset from the axis words", axes(may), grbl(executed),
      chapter("LinuxCNC manual, G-codes: G43.1 Dynamic Tool Length Offset")),
    g(43.2, tool_length, "additional tool offset", axes(may), uses("H"),
      means('H', number, "of tool {} in the tool table"),
      chapter("LinuxCNC manual, G-codes: G43.2 Apply additional Tool Length Offset")),
    g(49, tool_length, "no tool offset", grbl(executed)),
    g(50, non_modal, "no scaling"),
    g(51, non_modal, "scale X Y Z", axes(may), uses("PIJK"), chapter("grblHAL, G50 and G51: scaling")),
    g(52, non_modal, "offset of all work coordinate systems", axes(must),
      chapter("LinuxCNC manual, G-codes: G52 Local Coordinate System Offset")),
    g(53, non_modal, "move in machine coordinates", grbl(executed),
      chapter("RS274/NGC 3.5.12, move in absolute coordinates")),
    g(54, work_system, "work coordinate system 1", grbl(executed)),
    g(55, work_system, "work coordinate system 2", grbl(executed)),
    g(56, work_system, "work coordinate system 3", grbl(executed)),
    g(57, work_system, "work coordinate system 4", grbl(executed)),
    g(58, work_system, "work coordinate system 5", grbl(executed)),
    g(59, work_system, "work coordinate system 6", grbl(executed)),
    g(59.1, work_system, "work coordinate system 7"),
    g(59.2, work_system, "work coordinate system 8"),
    g(59.3, work_system, "work coordinate system 9"),
    g(61, path_mode, "exact path", grbl(without_effect)),
    g(61.1, path_mode, "exact stop"),
    g(64, path_mode, "blended path", uses("PQR"), means('P', length, "path tolerance {}"),
      means('Q', length, "merge moves that are straight within {}")),
    g(65, macro, "macro call", uses("PL")),
    g(66, macro, "macro call after each block that moves", uses("PL")),
    g(67, macro, "end of the macro calls of G66"),
    g(70, motion, "lathe finishing cycle", axes(may), uses("QDEP"),
      chapter("LinuxCNC manual, G-codes: G70 Lathe finishing cycle")),
    g(71, motion, "lathe roughing cycle", axes(may), uses("QDIR"),
      chapter("LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles")),
    g(71.1, motion, "lathe roughing cycle", axes(may), uses("QDIR"),
      chapter("LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles")),
    g(71.2, motion, "lathe roughing cycle", axes(may), uses("QDIR"),
      chapter("LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles")),
    g(72, motion, "lathe facing cycle", axes(may), uses("QDIR"),
      chapter("LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles")),
    g(72.1, motion, "lathe facing cycle", axes(may), uses("QDIR"),
      chapter("LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles")),
    g(72.2, motion, "lathe facing cycle", axes(may), uses("QDIR"),
      chapter("LinuxCNC manual, G-codes: G71 G72 Lathe roughing cycles")),
    g(73, motion, "chip-breaking drilling cycle", axes(must), uses("@^RLQD"),
      means('R', length, "the retract plane is at {}"), means('L', times, "{}"),
      means('Q', length, "{} depth per peck"), means('D', length, "{} retract after each peck"),
      chapter("LinuxCNC manual, G-codes: G73 Drilling Cycle with Chip Breaking")),
    g(74, motion, "left-hand tapping cycle", axes(must), uses("@^RLP"),
      means('R', length, "the retract plane is at {}"), means('L', times, "{}"),
      means('P', seconds, "wait {} at the bottom"),
      chapter("LinuxCNC manual, G-codes: G74 Left-hand Tapping Cycle with Dwell")),
    g(76, motion, "threading cycle", axes(must), uses("@^PIJKRQHEL"),
      chapter("LinuxCNC manual, G-codes: G76 Threading Cycle")),
    g(80, motion, "no motion", grbl(executed)),
    g(81, motion, "drilling cycle", axes(must), uses("@^RL"), means('R', length, "the retract plane is at {}"),
      means('L', times, "{}"), chapter("RS274/NGC 3.5.16.2, G81 cycle")),
    g(82, motion, "drilling cycle with dwell", axes(must), uses("@^RLP"),
      means('R', length, "the retract plane is at {}"), means('L', times, "{}"),
      means('P', seconds, "wait {} at the bottom"), chapter("RS274/NGC 3.5.16.3, G82 cycle")),
    g(83, motion, "peck drilling cycle", axes(must), uses("@^RLQD"), means('R', length, "the retract plane is at {}"),
      means('L', times, "{}"), means('Q', length, "{} depth per peck"),
      means('D', length, "rapid to {} above the depth reached so far"), chapter("RS274/NGC 3.5.16.4, G83 cycle")),
    g(84, motion, "right-hand tapping cycle", axes(must), uses("@^RLP"),
      means('R', length, "the retract plane is at {}"), means('L', times, "{}"),
      means('P', seconds, "wait {} at the bottom"), chapter("RS274/NGC 3.5.16.5, G84 cycle")),
    g(85, motion, "boring cycle, feed out", axes(must), uses("@^RL"), means('R', length, "the retract plane is at {}"),
      means('L', times, "{}"), chapter("RS274/NGC 3.5.16.6, G85 cycle")),
    g(86, motion, "boring cycle, spindle stop, rapid out", axes(must), uses("@^RLP"),
      means('R', length, "the retract plane is at {}"), means('L', times, "{}"),
      means('P', seconds, "wait {} at the bottom"), chapter("RS274/NGC 3.5.16.7, G86 cycle")),
    g(87, motion, "back boring cycle", axes(must), uses("@^RLIJK"), means('R', length, "the retract plane is at {}"),
      means('L', times, "{}")),
    g(88, motion, "boring cycle, retract by hand", axes(must), uses("@^RLP"),
      means('R', length, "the retract plane is at {}"), means('L', times, "{}"),
      means('P', seconds, "wait {} at the bottom")),
    g(89, motion, "boring cycle with dwell, feed out", axes(must), uses("@^RLP"),
      means('R', length, "the retract plane is at {}"), means('L', times, "{}"),
      means('P', seconds, "wait {} at the bottom"), chapter("RS274/NGC 3.5.16.10, G89 cycle")),
    g(90, distance, "absolute distances", tells("interpreter: distance mode changed to absolute"),
      parameter("_absolute"), grbl(executed)),
    g(90.1, arc_distance, "absolute arc centres", tells("interpreter: IJK distance mode changed to absolute"),
      parameter("_ijk_absolute_mode")),
    g(91, distance, "incremental distances", tells("interpreter: distance mode changed to incremental"),
      parameter("_incremental"), grbl(executed)),
    g(91.1, arc_distance, "incremental arc centres", tells("interpreter: IJK distance mode changed to incremental"),
      grbl(without_effect)),
    g(92, non_modal, "offset so that this is the given position", axes(must), grbl(executed),
      chapter("RS274/NGC 3.5.18, coordinate system offsets")),
    g(92.1, non_modal, "clear the G92 offset", grbl(executed)),
    g(92.2, non_modal, "suspend the G92 offset"),
    g(92.3, non_modal, "restore the G92 offset"),
    g(93, feed_mode, "inverse time feed", tells("interpreter: feed mode set to inverse time"),
      calls<operation::SetFeedMode{FeedMode::units_per_minute}>, parameter("_inverse_time"), grbl(executed),
      chapter("RS274/NGC 3.5.19, set feed rate mode")),
    g(94, feed_mode, "feed per minute", tells("interpreter: feed mode set to units per minute"),
      calls<operation::SetFeedMode{FeedMode::units_per_minute}>, parameter("_units_per_minute"), grbl(executed)),
    g(95, feed_mode, "feed per revolution", tells("interpreter: feed mode set to units per revolution"),
      calls<operation::SetFeedMode{FeedMode::units_per_revolution}>, parameter("_units_per_rev"),
      chapter("LinuxCNC manual, G-codes: G93, G94, G95 Feed Rate Mode")),
    g(96, spindle_mode, "constant surface speed", uses("D$"), means('D', speed, "{} at most"),
      parameter("_spindle_css_mode"), chapter("LinuxCNC manual, G-codes: G96, G97 Spindle Control Mode")),
    g(97, spindle_mode, "constant spindle speed", uses("$"), parameter("_spindle_rpm_mode")),
    g(98, retract, "cycles retract to the initial level", tells("interpreter: retract mode set to old_z"),
      parameter("_retract_old_z")),
    g(99, retract, "cycles retract to R", tells("interpreter: retract mode set to r_plane"),
      parameter("_retract_r_plane")),

    m(0, stopping, "stop", grbl(executed)),
    m(1, stopping, "optional stop", grbl(without_effect)),
    m(2, stopping, "end of the program", grbl(executed)),
    m(3, spindle, "spindle clockwise", uses("$"), grbl(executed)),
    m(4, spindle, "spindle counterclockwise", uses("$"), grbl(executed)),
    m(5, spindle, "spindle off", uses("$"), grbl(executed)),
    m(6, tool_change, "tool change", chapter("RS274/NGC 3.6.3, tool change")),
    m(7, coolant, "mist on", grbl(executed)),  // ENABLE_M7
    m(8, coolant, "flood on", grbl(executed)),
    m(9, coolant, "coolant off", grbl(executed)),
    m(19, spindle, "orient the spindle", uses("RQP$"), means('R', degrees, "to {}"), means('Q', seconds, "within {}"),
      chapter("LinuxCNC manual, M-codes: M19 Orient Spindle")),
    m(30, stopping, "end of the program", grbl(executed)),
    m(48, overrides, "overrides on"),
    m(49, overrides, "overrides off"),
    m(50, overrides, "feed override", uses("P")),
    m(51, overrides, "spindle override", uses("P$")),
    m(52, overrides, "adaptive feed", uses("P")),
    m(53, overrides, "feed hold switch", uses("P")),
    m(60, stopping, "pallet change and stop"),
    m(61, tool_change, "name the tool in the spindle", uses("Q"), means('Q', number, "tool {}"),
      chapter("LinuxCNC manual, M-codes: M61 Set Current Tool")),
    m(62, input_output, "digital output", uses("P"), means('P', number, "digital number {}"),
      chapter("LinuxCNC manual, M-codes: M62 - M65 Digital Output Control")),
    m(63, input_output, "digital output", uses("P"), means('P', number, "digital number {}"),
      chapter("LinuxCNC manual, M-codes: M62 - M65 Digital Output Control")),
    m(64, input_output, "digital output", uses("P"), means('P', number, "digital number {}"),
      chapter("LinuxCNC manual, M-codes: M62 - M65 Digital Output Control")),
    m(65, input_output, "digital output", uses("P"), means('P', number, "digital number {}"),
      chapter("LinuxCNC manual, M-codes: M62 - M65 Digital Output Control")),
    m(66, input_output, "wait for an input", uses("PELQ"), means('P', number, "digital number {}"),
      means('E', number, "analog number {}"), means('Q', seconds, "for {} at most"),
      chapter("LinuxCNC manual, M-codes: M66 Wait on Input")),
    m(67, input_output, "analog output", uses("EQ"), means('E', number, "analog number {}"),
      means('Q', number, "to {}"), chapter("LinuxCNC manual, M-codes: M67 Analog Output, Synchronized")),
    m(68, input_output, "analog output", uses("EQ"), means('E', number, "analog number {}"),
      means('Q', number, "to {}"), chapter("LinuxCNC manual, M-codes: M68 Analog Output, Immediate")),
    m(70, spindle, "save the modal state"),
    m(71, spindle, "discard the saved modal state"),
    m(72, spindle, "restore the modal state"),
    m(73, spindle, "save the modal state for the caller"),
    m(98, stopping, "call of a subprogram", uses("PL"), means('P', number, "of subprogram {}"), means('L', times, "{}"),
      chapter("LinuxCNC manual, O Codes: Fanuc-Style Numbered Programs")),
    m(99, stopping, "end of a subprogram", chapter("LinuxCNC manual, O Codes: Fanuc-Style Numbered Programs")),
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
    entries[i] = m(100.0 + static_cast<double>(i), user, "user code", uses("PQ"));
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
  SentenceRow cure;
};
constexpr ForeignCode foreign_codes[] = {
    {'G', code(12), interpreter_says::instead_of_g12}, {'G', code(13), interpreter_says::instead_of_g12},
    {'G', code(15), interpreter_says::instead_of_g15}, {'G', code(16), interpreter_says::instead_of_g16},
    {'G', code(31), interpreter_says::instead_of_g31}, {'G', code(36), interpreter_says::instead_of_g37},
    {'G', code(37), interpreter_says::instead_of_g37}, {'G', code(44), interpreter_says::instead_of_g44},
    {'G', code(68), interpreter_says::instead_of_g68}, {'G', code(69), interpreter_says::instead_of_g69},
    {'M', code(13), interpreter_says::instead_of_m13}, {'M', code(14), interpreter_says::instead_of_m14},
    {'M', code(29), interpreter_says::instead_of_m29}, {'M', code(42), interpreter_says::instead_of_m42},
    {'M', code(97), interpreter_says::instead_of_m97}, {'M', code(47), interpreter_says::instead_of_m47},
};

// "G1, G2 or G3".
std::string in_a_row(const std::vector<std::string>& names) {
  std::string text = names.front();
  for (std::size_t i = 1; i < names.size(); ++i) text += (i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

}  // namespace

std::span<const GroupRow> group_rows() {
  return groups;
}

const GroupRow& row_of(ModalGroup group) {
  return groups[row_of_group[index_of(group)]];
}

std::span<const CodeEntry> code_entries() {
  return table;
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

FindingWords cure_for_unknown_code(char letter, CodeNumber number) {
  for (const ForeignCode& foreign : foreign_codes) {
    if (foreign.letter == letter && foreign.number == number) return foreign.cure;
  }
  std::vector<std::string> relatives;  // of the same whole number
  for (const CodeEntry& entry : table) {
    const bool is_other = entry.number % 10 == 0 && number % 10 != 0;
    if (entry.letter == letter && entry.number / 10 == number / 10 && !is_other) relatives.push_back(spelling(entry));
  }
  return relatives.empty() ? "a code listed in docs/gcode.md" : in_a_row(relatives);
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
