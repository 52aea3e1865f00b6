#include "passo/grbl_meanings/grbl_meanings.hpp"

#include <array>

namespace passo {
namespace {

constexpr std::array errors = {
    GrblMeaning{1, "a word has no letter"},
    GrblMeaning{2, "a number is invalid"},
    GrblMeaning{3, "the '$' command is unknown"},
    GrblMeaning{4, "a value is negative"},
    GrblMeaning{5, "homing is not enabled: $22=1 enables it, on a machine with limit switches"},
    GrblMeaning{6, "the step pulse is too short"},
    GrblMeaning{7, "its settings were unreadable and were reset"},
    GrblMeaning{8, "it is not idle"},
    GrblMeaning{9, "it is locked by an alarm"},
    GrblMeaning{10, "soft limits need homing"},
    GrblMeaning{11, "the line is too long"},
    GrblMeaning{12, "the step rate would be too high"},
    GrblMeaning{13, "its safety door is open"},
    GrblMeaning{14, "the line is too long to be stored"},
    GrblMeaning{15, "the jog would leave the travel"},
    GrblMeaning{16, "the jog command is invalid"},
    GrblMeaning{17, "laser mode needs a PWM output"},
    GrblMeaning{20, "it does not support a code of the line"},
    GrblMeaning{21, "two codes of one group"},
    GrblMeaning{22, "no feed rate is set"},
    GrblMeaning{23, "a code needs a whole number"},
    GrblMeaning{24, "two codes need the axis words"},
    GrblMeaning{25, "a word is repeated"},
    GrblMeaning{26, "axis words are missing"},
    GrblMeaning{27, "the line number is out of range"},
    GrblMeaning{28, "a value is missing"},
    GrblMeaning{29, "there is no such work offset"},
    GrblMeaning{30, "G53 needs G0 or G1"},
    GrblMeaning{31, "axis words that no code uses"},
    GrblMeaning{32, "an arc has no axis word of its plane"},
    GrblMeaning{33, "the target of the motion is invalid"},
    GrblMeaning{34, "the radius of an arc is invalid"},
    GrblMeaning{35, "an arc has no centre"},
    GrblMeaning{36, "words that no code uses"},
    GrblMeaning{37, "G43.1 is for the Z axis"},
    GrblMeaning{38, "the tool number is too large"},
};

constexpr std::array alarms = {
    GrblMeaning{1, "a limit switch closed; the position is lost"},
    GrblMeaning{2, "the motion would have left the travel (soft limit); the position is kept"},
    GrblMeaning{3, "it was reset while moving; the position is lost"},
    GrblMeaning{4, "the probe was not in its initial state"},
    GrblMeaning{5, "the probe did not touch anything"},
    GrblMeaning{6, "homing was reset"},
    GrblMeaning{7, "the door was opened while it homed"},
    GrblMeaning{8,
                "homing could not move off a switch. Check that the switch opens again, and that the pull-off ($27) is "
                "long enough"},
    GrblMeaning{
        9,
        "homing found no switch within the travel. Check that the machine has switches, their wiring, and $5, $23 "
        "and $130 to $132"},
    GrblMeaning{10, "homing found no second switch of an axis with two motors"},
};

}  // namespace

std::span<const GrblMeaning> grbl_errors() {
  return errors;
}

std::span<const GrblMeaning> grbl_alarms() {
  return alarms;
}

}  // namespace passo
