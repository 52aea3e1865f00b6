// The sentences of the usual mistakes in programs: correct G-code that hardly does what was meant. A row is a stable
// code, by which clients translate it, and the English text. The page has the same codes
// (page/src/lang/LANGUAGE/findings.ts). A test compares the two.
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::mistakes_say {

inline constexpr SentenceRow no_units{"path.no-units",
                                      "the program moves before it sets its units; millimetres are assumed"};
inline constexpr SentenceRow units_first{"expected.units-first",
                                         "G21 (millimetres) or G20 (inches) before the first move, or --inches"};
inline constexpr SentenceRow feed_without_spindle{"path.spindle-off-in-feed",
                                                  "a feed move while the spindle is stopped"};
inline constexpr SentenceRow spindle_first{
    "expected.spindle-first", "S and M3 before the move; a machine file without tool.max_rpm has no spindle"};
inline constexpr SentenceRow spindle_at_zero{"path.spindle-at-zero",
                                             "the spindle is switched on at S0, so it does not turn"};
inline constexpr SentenceRow speed_first{"expected.speed-first", "S above 0 before the next feed move"};
inline constexpr SentenceRow idle_speed{"path.idle-speed",
                                        "S has no effect here: the machine only switches its spindle on and off"};
inline constexpr SentenceRow speed_in_machine_file{
    "expected.speed-in-machine-file", "tool.max_rpm in the machine file, if the machine sets the spindle's speed"};
inline constexpr SentenceRow idle_tool{"path.idle-tool", "T{tool} has no effect: the program has no tool change (M6)"};
inline constexpr SentenceRow tool_change{"expected.tool-change", "M6 after the T word"};
inline constexpr SentenceRow life_ends{
    "tool.life-ends", "the life of T{tool} ends here: the program cuts {cuts} with it, and {left} are left"};
inline constexpr SentenceRow new_tool{"expected.new-tool", "a new T{tool}, recorded as replaced"};
inline constexpr SentenceRow long_dwell{"path.long-dwell",
                                        "this dwell takes {time} seconds; were {time} milliseconds meant?"};
inline constexpr SentenceRow dwell_in_seconds{"expected.dwell-in-seconds",
                                              "P in seconds: P{short} for {time} milliseconds"};
inline constexpr SentenceRow spindle_left_on{"path.spindle-left-on",
                                             "the spindle is still on where '%' ends the program"};
inline constexpr SentenceRow spindle_off_before{"expected.spindle-off-before", "M5, and M2 or M30, before '%'"};
inline constexpr SentenceRow nearly_circle{"path.nearly-circle",
                                           "this arc is nearly a full circle: it ends {gap} mm before its start"};
inline constexpr SentenceRow whole_circle{
    "expected.whole-circle",
    "for a full circle, an end equal to the start; for a short move, G1 or the other direction (G2, G3)"};
inline constexpr SentenceRow low_rapid{
    "path.low-rapid", "a rapid moves sideways at Z{z}, where there may be material: the program has cut at Z{cut}"};
inline constexpr SentenceRow above_work{"expected.above-work",
                                        "Z above the work before the rapid, or a feed move (G1)"};
inline constexpr SentenceRow rapid_plunge{
    "path.rapid-plunge", "a rapid goes down to Z{z}, deeper than every earlier feed move (Z{deepest})"};
inline constexpr SentenceRow feed_in_material{"expected.feed-in-material",
                                              "a feed move (G1) where there may be material"};
inline constexpr SentenceRow blind_plunge{"path.blind-plunge",
                                          "a rapid goes down to Z{z} before the program has given X or Y"};
inline constexpr SentenceRow place_first{"expected.place-first", "X and Y first, with Z above the work"};
inline constexpr SentenceRow no_depth{"path.no-depth", "no feed move goes below Z0: the lowest is at Z{z}"};
inline constexpr SentenceRow minus_sign{"expected.minus-sign", "a minus sign, if the work zero is on the top face"};

}  // namespace passo::mistakes_say
