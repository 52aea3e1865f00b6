// The sentences of what is found in machine files. A row is a stable code, by which clients translate
// it, and the English text. The page has the same codes (page/src/lang/LANGUAGE/findings.ts). A test compares the two.
#pragma once

#include "passo/base/sentence.hpp"

namespace passo::machine_file_says {

inline constexpr SentenceRow empty_file{"machine.empty", "the file is empty"};
inline constexpr SentenceRow goes_from_to{"machine.travel", "{key} goes from {low} to {high}"};
inline constexpr SentenceRow low_end_first{"expected.low-end-first", "the low end first, then the high end"};
inline constexpr SentenceRow has_left_travel{
    "machine.homing.beyond-travel",
    "{key} is {value}; after a pull-off of {off} the axis would be outside its travel of {low} to {high}"};
inline constexpr SentenceRow switch_within_travel{
    "expected.switch-within-travel", "a switch position that leaves the axis within its travel after {key}"};
inline constexpr SentenceRow motor_taken{"machine.motor.taken", "motor {motor} is already assigned to axis {axis}"};
inline constexpr SentenceRow own_motor{"expected.own-motor", "a different motor for each axis"};
inline constexpr SentenceRow no_such_motor{"machine.motor.none", "axis {axis} has motor {motor}, which does not exist"};
inline constexpr SentenceRow motor_missing{"machine.motor.missing", "[axis.{axis}] has no key motor"};
inline constexpr SentenceRow motors_for_all{
    "expected.motors-for-all",
    "a motor for every axis, or for none (then they are assigned in the order X Y Z A B C U V W)"};
inline constexpr SentenceRow too_fast{
    "machine.too-fast", "axis {axis} needs {steps} steps/s for {speed}/s, but the board makes at most {most} events/s"};
inline constexpr SentenceRow starts_too_fast{
    "machine.start-stop",
    "the start-stop velocity of axis {axis}, {speed}/s, is above its maximum velocity of {most}/s"};
inline constexpr SentenceRow too_weak{"machine.too-weak",
                                      "at {speed}/s the motor of axis {axis} has no torque left for acceleration"};
inline constexpr SentenceRow stronger_motor{"expected.stronger-motor", "{key} below {most}, or a stronger motor"};
inline constexpr SentenceRow both_given{"machine.both-given", "{first} and {second} are both given"};
inline constexpr SentenceRow no_axis{"machine.no-axis", "the machine has no axis"};
inline constexpr SentenceRow unknown_axis{"machine.unknown-axis", "there is no axis {name}"};
inline constexpr SentenceRow axis_table{"expected.axis-table", "a table for each axis, as in [axis.X]"};
inline constexpr SentenceRow shared_switch{"machine.homing.shared-switch",
                                           "the two motors of axis {axis} share limit switch {input}"};
inline constexpr SentenceRow park_outside{"machine.park.outside",
                                          "the park position {axis} {place} is outside the travel"};
inline constexpr SentenceRow park_without_plane{"machine.park.no-plane", "a park position needs the axes X and Y"};
inline constexpr SentenceRow park_without_place{"machine.park.no-place", "at_end = \"park\" needs a park position"};
inline constexpr SentenceRow end_without_z{"machine.park.no-z",
                                           "Z moves first at the end of a program, but the machine has no axis Z"};
inline constexpr SentenceRow camera_url{"machine.camera.url", "{key} is not a plain http address"};

}  // namespace passo::machine_file_says
