#include "code_table.hpp"

#include <algorithm>
#include <array>

namespace passo {
namespace {

using enum ModalGroup;

// Ordered by letter and number: find_code searches by halves.
constexpr auto codes = std::to_array<Code>({
    {'G', 0, motion, "rapid"},
    {'G', 10, motion, "straight feed"},
    {'G', 20, motion, "arc, clockwise"},
    {'G', 30, motion, "arc, counterclockwise"},
    {'G', 40, non_modal, "dwell"},
    {'G', 70, diameter, "lathe diameters"},
    {'G', 80, diameter, "lathe radii"},
    {'G', 100, non_modal, "set offsets"},
    {'G', 170, plane, "XY plane"},
    {'G', 180, plane, "ZX plane"},
    {'G', 190, plane, "YZ plane"},
    {'G', 200, units, "inches"},
    {'G', 210, units, "millimetres"},
    {'G', 280, non_modal, "go to home"},
    {'G', 281, non_modal, "set home"},
    {'G', 300, non_modal, "go to second home"},
    {'G', 301, non_modal, "set second home"},
    {'G', 330, motion, "spindle-synchronised feed"},
    {'G', 331, motion, "rigid tapping"},
    {'G', 400, cutter, "no cutter compensation"},
    {'G', 430, tool_length, "tool length offset of a tool"},
    {'G', 431, tool_length, "tool length offset given here"},
    {'G', 490, tool_length, "no tool length offset"},
    {'G', 530, non_modal, "machine coordinates"},
    {'G', 540, work_offset, "work offset 1"},
    {'G', 550, work_offset, "work offset 2"},
    {'G', 560, work_offset, "work offset 3"},
    {'G', 570, work_offset, "work offset 4"},
    {'G', 580, work_offset, "work offset 5"},
    {'G', 590, work_offset, "work offset 6"},
    {'G', 591, work_offset, "work offset 7"},
    {'G', 592, work_offset, "work offset 8"},
    {'G', 593, work_offset, "work offset 9"},
    {'G', 610, path, "exact path"},
    {'G', 611, path, "exact stop"},
    {'G', 640, path, "continuous path"},
    {'G', 800, motion, "no motion mode"},
    {'G', 900, distance, "absolute distances"},
    {'G', 901, arc_distance, "absolute arc centres"},
    {'G', 910, distance, "incremental distances"},
    {'G', 911, arc_distance, "incremental arc centres"},
    {'G', 920, non_modal, "shift the frame"},
    {'G', 921, non_modal, "cancel the shift, forget it"},
    {'G', 922, non_modal, "cancel the shift, keep it"},
    {'G', 923, non_modal, "restore the shift"},
    {'G', 930, feed_mode, "inverse time feed"},
    {'G', 940, feed_mode, "feed a minute"},
    {'G', 950, feed_mode, "feed a revolution"},
    {'G', 970, spindle_mode, "spindle speed in revolutions a minute"},
    {'G', 980, retract, "canned cycles go back to where they began"},
    {'G', 990, retract, "canned cycles go back to R"},
    {'M', 0, stopping, "program stop"},
    {'M', 10, stopping, "optional stop"},
    {'M', 20, stopping, "program end"},
    {'M', 30, spindle, "spindle clockwise"},
    {'M', 40, spindle, "spindle counterclockwise"},
    {'M', 50, spindle, "spindle stop"},
    {'M', 60, tool_change, "tool change"},
    {'M', 70, coolant, "mist on"},
    {'M', 80, coolant, "flood on"},
    {'M', 90, coolant, "coolant off"},
    {'M', 300, stopping, "program end"},
    {'M', 480, override_switch, "overrides on"},
    {'M', 490, override_switch, "overrides off"},
    {'M', 600, stopping, "pallet change stop"},
    {'M', 610, tool_change, "set the tool number"},
});

constexpr bool comes_before(const Code& a, const Code& b) {
  return a.letter != b.letter ? a.letter < b.letter : a.number < b.number;
}
static_assert(std::ranges::is_sorted(codes, comes_before));

}  // namespace

const Code* find_code(char letter, std::int32_t tenths) {
  const Code wanted{.letter = letter, .number = tenths, .group = motion, .meaning = {}};
  const auto* found = std::lower_bound(codes.begin(), codes.end(), wanted, comes_before);
  return found != codes.end() && found->letter == letter && found->number == tenths ? found : nullptr;
}

std::span<const Code> all_codes() {
  return codes;
}

std::string_view group_name(ModalGroup group) {
  constexpr std::array<std::string_view, modal_group_count> names = {"motion",
                                                                     "plane",
                                                                     "distance mode",
                                                                     "arc distance mode",
                                                                     "feed mode",
                                                                     "units",
                                                                     "cutter compensation",
                                                                     "tool length",
                                                                     "retract mode",
                                                                     "work offset",
                                                                     "path mode",
                                                                     "diameter mode",
                                                                     "spindle mode",
                                                                     "non-modal",
                                                                     "stopping",
                                                                     "tool change",
                                                                     "spindle",
                                                                     "coolant",
                                                                     "override"};
  return names[static_cast<std::size_t>(group)];
}

}  // namespace passo
