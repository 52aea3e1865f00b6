// The G and M codes: their modal groups, the words they use, and whether this release executes them.
//
// One line a code: supporting a new one is a line here, and a case in the one small function of its group
// (block_executor.hpp). Everything that can be said of a block before it is executed follows from this table: two
// codes of one group, words that no code uses, two codes that both claim the axis words.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace passo {

// Tenths, so that G59.1 is a whole number: code(59, 1) == 591.
using CodeNumber = std::int16_t;
constexpr CodeNumber code(int whole, int tenth = 0) {
  return static_cast<CodeNumber>(whole * 10 + tenth);
}

// RS274/NGC's modal groups (table 4 of the standard, with LinuxCNC's additions); a block has at most one code of each.
enum class ModalGroup : std::uint8_t {
  non_modal,            // G group 0
  motion,               // 1
  plane,                // 2
  distance,             // 3
  arc_distance,         // 4
  feed_mode,            // 5
  length_units,         // 6
  cutter_compensation,  // 7
  tool_length,          // 8
  retract,              // 10
  work_system,          // 12
  path_mode,            // 13
  spindle_mode,         // 14
  lathe_diameter,       // 15
  macro,                // Fanuc's macro calls
  stopping,             // M group 4
  input_output,         // 5
  tool_change,          // 6
  spindle,              // 7
  coolant,              // 8
  overrides,            // 9
  user,                 // 10
};
inline constexpr std::size_t modal_group_count = 22;
constexpr std::size_t index_of(ModalGroup group) {
  return static_cast<std::size_t>(group);
}
std::string_view name_of(ModalGroup group);

// A set of word letters; polar words '@' and '^', and '$', stand behind 'Z'.
inline constexpr std::size_t letter_count = 29;
constexpr std::size_t letter_index(char letter) {
  if (letter >= 'A' && letter <= 'Z') return static_cast<std::size_t>(letter - 'A');
  return letter == '@' ? 26 : letter == '^' ? 27 : 28;
}
class LetterSet {
 public:
  constexpr LetterSet() = default;
  constexpr LetterSet(const char* letters) {  // NOLINT: implicit on purpose, the table below is made of them
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

struct CodeEntry {
  char letter = 'G';
  CodeNumber number = 0;
  ModalGroup group = ModalGroup::non_modal;
  AxisUse axes = AxisUse::none;  // what it does with axis words
  LetterSet letters;             // the other words it uses
  std::string_view what;         // a few words for messages
};

// Null where the language has no such code.
const CodeEntry* find_code(char letter, CodeNumber number);
// "G59.1"
std::string spelling(char letter, CodeNumber number);
inline std::string spelling(const CodeEntry& entry) {
  return spelling(entry.letter, entry.number);
}
// The code that executes and is spelled most alike; empty when none is near.
std::string nearest_code(std::string_view spelled);
// "G2, G3 or G10": the codes that execute and use this word; empty when there is none.
std::string codes_using(char letter);

}  // namespace passo
