// The sentences of what is found where a program becomes a path. A row is a stable code, by which clients translate
// it, and the English text. The page has the same codes (page/src/lang/LANGUAGE/findings.ts). A test compares the two.
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::path_says {

inline constexpr SentenceRow above_travel{
    "travel.exceeded.high", "{axis} would reach {reached} (work {work}), {far} beyond its travel's end at {end}"};
inline constexpr SentenceRow below_travel{
    "travel.exceeded.low", "{axis} would reach {reached} (work {work}), {far} below its travel's end at {end}"};
inline constexpr SentenceRow within_travel{"expected.within-travel",
                                           "{axis} within {low} to {high}, machine coordinates"};
inline constexpr SentenceRow within_travel_in_inches{"expected.within-travel.inches",
                                                     "{axis} within {low} to {high}, machine coordinates in inches"};
inline constexpr SentenceRow no_such_axis{"travel.no-such-axis",
                                          "this moves the axis {axis}, which the machine does not have"};
inline constexpr SentenceRow these_axes{"expected.these-axes", "moves of {axes} only"};
inline constexpr SentenceRow no_feed{"path.no-feed", "a feed move without a feed rate"};
inline constexpr SentenceRow feed_above_zero{"expected.feed-above-zero", "F above 0 in this block or an earlier one"};
inline constexpr SentenceRow spindle_too_fast{
    "path.spindle-too-fast", "the program commands {asked} rpm, but the spindle's maximum of {most} rpm is used"};
inline constexpr SentenceRow tap_on_bus{
    "path.tap-on-bus",
    "a spindle by Modbus reverses too slowly to tap: it would turn in the thread while the tool waits"};
inline constexpr SentenceRow not_on_bus{"expected.not-on-bus",
                                        "a thread mill, or a machine file without [spindle.modbus]"};
inline constexpr SentenceRow speed_up_to{"expected.speed-up-to", "S up to {most}"};

}  // namespace passo::path_says
