// The G and M codes: their modal groups, the words they use, and their meaning.
//
// Each code is one row of the table. For a code that only sets a mode, the row defines its whole behaviour for the
// interpreter, canon, `explain`, the Grbl dialect, the rules and the #<_names>. A new mode needs an enumerator here, in
// its position in `modes_in_order`, a row for its group, and a row for each of its codes. The effect of the mode on
// other codes is implemented where they are executed. A code that does more than set a mode also needs a case in the
// function that executes its group (block_executor.cpp). A test compares docs/gcode.md with the rows.
//
// The table is sufficient to check a block before it is executed: for two codes of one group, for words that no code
// uses, and for two codes that both use the axis words.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "passo/diagnostics/finding_words.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

// A code's number in tenths, so that G59.1 is a whole number: code(59, 1) == 591.
using CodeNumber = std::int16_t;
constexpr CodeNumber code(int whole, int tenth = 0) {
  return static_cast<CodeNumber>(whole * 10 + tenth);
}

// RS274/NGC's modal groups (table 4 of the standard, with LinuxCNC's additions). A block may have at most one code of
// each group.
enum class ModalGroup : std::uint8_t {
  non_modal,            // G group 0
  motion,               // G group 1
  plane,                // G group 2
  distance,             // G group 3
  arc_distance,         // G group 4
  feed_mode,            // G group 5
  length_units,         // G group 6
  cutter_compensation,  // G group 7
  tool_length,          // G group 8
  retract,              // G group 10
  work_system,          // G group 12
  path_mode,            // G group 13
  spindle_mode,         // G group 14
  lathe_diameter,       // G group 15
  macro,                // Fanuc macro calls
  stopping,             // M group 4
  input_output,         // M group 5
  tool_change,          // M group 6
  spindle,              // M group 7
  coolant,              // M group 8
  overrides,            // M group 9
  user,                 // M group 10
};
constexpr std::size_t index_of(ModalGroup group) {
  return static_cast<std::size_t>(group);
}
inline constexpr std::size_t modal_group_count = index_of(ModalGroup::user) + 1;

// The modes that a block sets after F, S and T, and that M72 restores, in LinuxCNC's order.
inline constexpr ModalGroup modes_in_order[] = {
    ModalGroup::plane,        ModalGroup::length_units, ModalGroup::lathe_diameter, ModalGroup::cutter_compensation,
    ModalGroup::tool_length,  ModalGroup::work_system,  ModalGroup::path_mode,      ModalGroup::distance,
    ModalGroup::arc_distance, ModalGroup::retract};

// When a mode is included in the canonical calls.
enum class Told : std::uint8_t { always, when_changed };

struct GroupRow {
  ModalGroup group = ModalGroup::non_modal;
  std::string_view name;             // name of its codes, for messages
  CodeNumber at_start = 0;           // the code that is active when a program starts; 0: the group is not a mode
  std::string_view sets = {};        // what its codes set, for `explain`
  Told told = Told::always;          // when the canonical calls include the mode, if it has no other effects
  bool ahead_of_held_moves = false;  // emitted before the moves held back by cutter compensation
};
// Returns the groups, modes first, in the order in which `explain` shows them.
std::span<const GroupRow> group_rows();
const GroupRow& row_of(ModalGroup group);

// A set of word letters. The polar words '@' and '^', and '$', follow 'Z'.
inline constexpr std::size_t letter_count = 29;
constexpr std::size_t letter_index(char letter) {
  if (letter >= 'A' && letter <= 'Z') return static_cast<std::size_t>(letter - 'A');
  return letter == '@' ? 26 : letter == '^' ? 27 : 28;
}
class LetterSet {
 public:
  constexpr LetterSet() = default;
  constexpr LetterSet(const char* letters) {  // NOLINT: implicit on purpose, for the rows of the table
    for (; *letters != 0; ++letters) add(*letters);
  }
  constexpr bool has(char letter) const { return (bits_ >> letter_index(letter) & 1U) != 0; }
  constexpr bool any() const { return bits_ != 0; }
  constexpr void add(char letter) { bits_ |= std::uint32_t{1} << letter_index(letter); }
  constexpr std::uint32_t bits() const { return bits_; }
  friend constexpr LetterSet operator|(LetterSet a, LetterSet b) { return of_bits(a.bits_ | b.bits_); }
  friend constexpr LetterSet operator&(LetterSet a, LetterSet b) { return of_bits(a.bits_ & b.bits_); }
  friend constexpr LetterSet operator-(LetterSet a, LetterSet b) { return of_bits(a.bits_ & ~b.bits_); }

 private:
  static constexpr LetterSet of_bits(std::uint32_t bits) {
    LetterSet set;
    set.bits_ = bits;
    return set;
  }
  std::uint32_t bits_ = 0;
};
inline constexpr LetterSet axis_letters = "XYZABCUVW";
inline constexpr LetterSet polar_letters = "@^";

enum class AxisUse : std::uint8_t { none, may, must };

enum class GrblUse : std::uint8_t { refused, executed, without_effect };

// The meaning of a word of a code. A word without a description is shown as "a value of" its code.
enum class LetterQuantity : std::uint8_t { number, turns, times, length, degrees, seconds, speed };
struct LetterMeaning {
  char letter = 0;
  LetterQuantity quantity = LetterQuantity::number;
  const char* text = "";  // {} stands for the value
};

struct CodeEntry {
  char letter = 'G';
  CodeNumber number = 0;
  ModalGroup group = ModalGroup::non_modal;
  AxisUse axes = AxisUse::none;  // whether the code uses axis words
  LetterSet letters = {};        // the other words that the code uses
  std::string_view what;         // short description for messages and `explain`
  GrblUse grbl = GrblUse::refused;
  std::string_view note = {};         // the comment by which LinuxCNC reports the mode; empty: none
  OperationKind (*call)() = nullptr;  // the canonical call that sets the mode; null: none
  std::string_view parameter = {};    // the #<_name> that is 1 while the mode is active; empty: none
  std::string_view chapter = {};      // manual chapter about the use of the code; empty: no error is possible
  std::array<LetterMeaning, 4> meanings = {};
};

// Returns all codes except M100 to M199.
std::span<const CodeEntry> code_entries();
// Null if there is no such code.
const CodeEntry* find_code(char letter, CodeNumber number);
// Returns the code as written, e.g. "G59.1".
std::string spelling(char letter, CodeNumber number);
inline std::string spelling(const CodeEntry& entry) {
  return spelling(entry.letter, entry.number);
}
// Returns a suggestion in place of a code that is not in the table.
FindingWords cure_for_unknown_code(char letter, CodeNumber number);
// Returns the codes that use this word, e.g. "G2, G3 or G10". Empty if there are none.
std::string codes_using(char letter);

}  // namespace passo
