// The sentences of what the interpreter finds in a program. A row is a stable code, by which clients translate
// it, and the English text. The page has the same codes (page/src/lang/LANGUAGE/findings.ts). A test compares the two.
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::interpreter_says {

inline constexpr SentenceRow no_feed{"gcode.missing-feed", "no feed rate is set"};
inline constexpr SentenceRow feed_first{"expected.feed-first", "F before the first feed move, or in its block"};
inline constexpr SentenceRow feed_is{"gcode.negative-word.feed", "the feed rate is {value}"};
inline constexpr SentenceRow feed_from_zero{"expected.feed-from-zero", "F of 0 or more"};
inline constexpr SentenceRow speed_is{"gcode.negative-word.speed", "the spindle speed is {value}"};
inline constexpr SentenceRow no_end{"gcode.no-end", "the program ends without M2, M30 or '%'"};
inline constexpr SentenceRow end_in_last_line{"expected.end-in-last-line", "M2 in its last line"};
inline constexpr SentenceRow move_after_end{"gcode.move-after-end",
                                            "this move comes after the end of the program and is never executed"};
inline constexpr SentenceRow end_after_moves{"expected.end-after-moves", "M2 or M30 in the last line"};
inline constexpr SentenceRow read_as{"gcode.blank-in-number", "{written} is read as {read}"};
inline constexpr SentenceRow no_blank{"expected.no-blank", "{read} without a space, or a letter before each number"};
inline constexpr SentenceRow never_set{"gcode.unset-parameter", "#{number} was never set, and is 0"};
inline constexpr SentenceRow set_before{"expected.parameter-set", "#{number} = ... before this line"};
inline constexpr SentenceRow no_value{"gcode.unknown-parameter", "{what} has no value"};
inline constexpr SentenceRow divides_by_zero{"gcode.division-by-zero", "{what} divides by zero"};
inline constexpr SentenceRow no_code{"gcode.unknown-code", "there is no {code}"};
inline constexpr SentenceRow unused_word{"gcode.unused-word", "no code of this block uses the word {letter}"};
inline constexpr SentenceRow second_letter{"gcode.repeated-word", "a second {letter} in one block"};
inline constexpr SentenceRow letter_once{"expected.letter-once", "each letter except G and M at most once"};
inline constexpr SentenceRow same_group{
    "gcode.modal-conflict", "{first} and {second} are in the same group ({group}) and cannot be in one block"};
inline constexpr SentenceRow one_or_two_blocks{"expected.one-or-two-blocks",
                                               "only one of them, or two separate blocks"};
inline constexpr SentenceRow two_blocks{"expected.two-blocks", "two separate blocks"};
inline constexpr SentenceRow both_use_axes{"gcode.axis-conflict",
                                           "{first} and {second} both use the axis words of the block"};
inline constexpr SentenceRow without_axes{"gcode.missing-axis", "{code} without axis words"};
inline constexpr SentenceRow an_axis{"expected.axis-word", "at least one of X Y Z A B C U V W"};
inline constexpr SentenceRow nothing_moves{"gcode.missing-motion", "axis words, but no motion code is active"};
inline constexpr SentenceRow motion_code{"expected.motion-code",
                                         "G0, G1, G2, G3 or another motion code in this block or an earlier one"};
inline constexpr SentenceRow home_beside_g0{
    "gcode.g0-with-home", "{code} uses the axis words of the block; G0 only becomes the active motion code"};
inline constexpr SentenceRow home_alone{"expected.home-without-g0", "{code} in a block without G0"};
inline constexpr SentenceRow dwell_without_p{"gcode.missing-word.dwell", "G4 without P"};
inline constexpr SentenceRow seconds_to_wait{"expected.seconds-to-wait", "P with the dwell time in seconds"};
inline constexpr SentenceRow no_tool_selected{"gcode.missing-tool", "M6, but no tool is selected"};
inline constexpr SentenceRow tool_before{"expected.tool-before", "T in this block or an earlier one"};
inline constexpr SentenceRow tool_not_in_table{"gcode.unknown-tool", "tool {tool} is not in the tool table"};
inline constexpr SentenceRow offset_taken_as_zero{
    "gcode.no-tool-table", "the offset of tool {tool} is taken as zero: no tool table was given"};
inline constexpr SentenceRow aborts{"gcode.abort", "the program aborts:{words}"};
inline constexpr SentenceRow no_sub{"gcode.unknown-sub", "there is no subroutine {name}"};
inline constexpr SentenceRow no_program{"gcode.unknown-sub.program", "there is no program {name}"};
inline constexpr SentenceRow loop_without_motion{"gcode.endless-loop.no-motion",
                                                 "the loop ran {times} times without any motion"};
inline constexpr SentenceRow loop_ran_once{"gcode.endless-loop.no-motion.once",
                                           "the loop ran 1 time without any motion"};
inline constexpr SentenceRow still_open{"gcode.probe-untouched.open", "{name} finished, but the probe is still open"};
inline constexpr SentenceRow still_triggered{"gcode.probe-untouched.triggered",
                                             "{name} finished, but the probe is still triggered"};
inline constexpr SentenceRow triggered_before{"gcode.probe-before.triggered",
                                              "{name} begins with the probe already triggered"};
inline constexpr SentenceRow open_before{"gcode.probe-before.open", "{name} begins with the probe already open"};
inline constexpr SentenceRow no_centre{"gcode.missing-center", "an arc without a centre or a radius"};
inline constexpr SentenceRow centre_words{"expected.arc-centre",
                                          "the centre in the plane {plane} ({letters}, or one of them), or R"};
inline constexpr SentenceRow radius_and_centre{"gcode.mixed-arc", "an arc with a radius and a centre"};
inline constexpr SentenceRow radius_or_centre{"expected.radius-or-centre", "R, or I J K"};
inline constexpr SentenceRow not_in_plane{"gcode.wrong-center", "{letter} is not in the plane {plane}"};
inline constexpr SentenceRow words_in_plane{"expected.centre-in-plane",
                                            "{first} and {second}, or another plane (G17, G18, G19) before the arc"};
inline constexpr SentenceRow words_in_plane_or_grbl{
    "expected.centre-in-plane.grbl",
    "{first} and {second}, or another plane (G17, G18, G19) before the arc; Grbl ignores the word (--dialect grbl)"};
inline constexpr SentenceRow radii_differ{"gcode.arc-radii-differ",
                                          "the arc starts at a radius of {start} and ends at a radius of {end}"};
inline constexpr SentenceRow equal_radii{"expected.equal-radii",
                                         "a centre at the same distance from the start and the end"};
inline constexpr SentenceRow not_absolute{
    "gcode.arc-radii-differ.absolute",
    "the arc's start and end are not equally far from its centre (G90.1: the centre is an absolute position)"};
inline constexpr SentenceRow not_incremental{
    "gcode.arc-radii-differ.incremental",
    "the arc's start and end are not equally far from its centre (G91.1: the centre is relative to the start)"};
inline constexpr SentenceRow incremental_before{
    "expected.incremental-centre", "G91.1 before the arc: with a centre relative to the start, the arc is valid"};
inline constexpr SentenceRow absolute_before{"expected.absolute-centre",
                                             "G90.1 before the arc: with an absolute centre, the arc is valid"};
inline constexpr SentenceRow zero_arc{"gcode.zero-arc", "the arc's centre coincides with its start or its end"};
inline constexpr SentenceRow some_radius{"expected.some-radius", "a radius above zero"};
inline constexpr SentenceRow small_radius{"gcode.impossible-arc",
                                          "no arc with a radius of {radius} reaches from the start to the end"};
inline constexpr SentenceRow half_the_distance{"expected.half-the-distance",
                                               "a radius of at least half the distance from start to end"};
inline constexpr SentenceRow ends_at_start{"gcode.impossible-arc.ends-at-start",
                                           "an arc with R that ends where it starts"};
inline constexpr SentenceRow full_circle{"expected.full-circle", "the centre (I J K) instead of R, for a full circle"};
inline constexpr SentenceRow instead_of_g12{"expected.instead-of-g12", "G2 or G3 with I and J, for a full circle"};
inline constexpr SentenceRow instead_of_g15{"expected.instead-of-g15", "X and Y, or @ and ^ for polar coordinates"};
inline constexpr SentenceRow instead_of_g16{"expected.instead-of-g16", "@ and ^ for polar coordinates"};
inline constexpr SentenceRow instead_of_g31{"expected.instead-of-g31", "G38.2 to G38.5, which probe"};
inline constexpr SentenceRow instead_of_g37{"expected.instead-of-g37", "G38.2 and G10 L10, which measure a tool"};
inline constexpr SentenceRow instead_of_g44{"expected.instead-of-g44", "G43 with the opposite sign of the offset"};
inline constexpr SentenceRow instead_of_g68{"expected.instead-of-g68",
                                            "G10 L2 with R, which rotates a work coordinate system"};
inline constexpr SentenceRow instead_of_g69{"expected.instead-of-g69",
                                            "G10 L2 with R0, which ends the rotation of a work coordinate system"};
inline constexpr SentenceRow instead_of_m13{"expected.instead-of-m13",
                                            "M3 and M8: on other controls, this code does both at once"};
inline constexpr SentenceRow instead_of_m14{"expected.instead-of-m14",
                                            "M4 and M8: on other controls, this code does both at once"};
inline constexpr SentenceRow instead_of_m29{"expected.instead-of-m29",
                                            "G33.1: on other controls, this code announces rigid tapping"};
inline constexpr SentenceRow instead_of_m42{"expected.instead-of-m42", "M62 to M65, which switch a digital output"};
inline constexpr SentenceRow instead_of_m97{"expected.instead-of-m97", "o… call or M98, which call a subroutine"};
inline constexpr SentenceRow instead_of_m47{"expected.instead-of-m47", "M99 in the main program, which restarts it"};

}  // namespace passo::interpreter_says
