#include "passo/sender/grbl_words.hpp"

#include <algorithm>
#include <array>
#include <span>

#include <fmt/format.h>

namespace passo {
namespace {

struct Meaning {
  int number;
  std::string_view words;
};

constexpr std::array grbl_errors = {
    Meaning{1, "a word has no letter"},
    Meaning{2, "a number is invalid"},
    Meaning{3, "the '$' command is unknown"},
    Meaning{4, "a value is negative"},
    Meaning{5, "homing is not enabled: $22=1 enables it, on a machine with limit switches"},
    Meaning{6, "the step pulse is too short"},
    Meaning{7, "its settings were unreadable and were reset"},
    Meaning{8, "it is not idle"},
    Meaning{9, "it is locked by an alarm"},
    Meaning{10, "soft limits need homing"},
    Meaning{11, "the line is too long"},
    Meaning{12, "the step rate would be too high"},
    Meaning{13, "its safety door is open"},
    Meaning{14, "the line is too long to be stored"},
    Meaning{15, "the jog would leave the travel"},
    Meaning{16, "the jog command is invalid"},
    Meaning{17, "laser mode needs a PWM output"},
    Meaning{20, "it does not support a code of the line"},
    Meaning{21, "two codes of one group"},
    Meaning{22, "no feed rate is set"},
    Meaning{23, "a code needs a whole number"},
    Meaning{24, "two codes need the axis words"},
    Meaning{25, "a word is repeated"},
    Meaning{26, "axis words are missing"},
    Meaning{27, "the line number is out of range"},
    Meaning{28, "a value is missing"},
    Meaning{29, "there is no such work offset"},
    Meaning{30, "G53 needs G0 or G1"},
    Meaning{31, "axis words that no code uses"},
    Meaning{32, "an arc has no axis word of its plane"},
    Meaning{33, "the target of the motion is invalid"},
    Meaning{34, "the radius of an arc is invalid"},
    Meaning{35, "an arc has no centre"},
    Meaning{36, "words that no code uses"},
    Meaning{37, "G43.1 is for the Z axis"},
    Meaning{38, "the tool number is too large"},
};

constexpr std::array grblhal_errors = {
    Meaning{18, "it was reset"},
    Meaning{19, "a value must be above 0"},
    Meaning{39, "a value is out of range"},
    Meaning{40, "it waits for a tool change"},
    Meaning{41, "the spindle does not turn"},
    Meaning{42, "this code is not possible in the active plane"},
    Meaning{43, "the feed rate is too high"},
    Meaning{44, "the spindle speed is out of range"},
    Meaning{45, "a limit switch is closed: move the axis off it"},
    Meaning{46, "it must be homed first"},
    Meaning{47, "the tool is not known"},
    Meaning{48, "two values of the line exclude each other"},
    Meaning{49, "its self-test has failed"},
    Meaning{50, "its emergency stop is pressed"},
    Meaning{51, "a motor driver reports a fault"},
    Meaning{52, "the value of a setting is out of range"},
    Meaning{53, "the setting is not available"},
    Meaning{54, "the retract position is wrong"},
    Meaning{55, "its homing set-up is invalid"},
    Meaning{56, "the work offset is locked"},
    Meaning{77, "it requires a password"},
    Meaning{78, "it denies access"},
    Meaning{79, "an alarm must be cleared by a reset first"},
};

constexpr std::array fluidnc_errors = {
    Meaning{18, "its configuration has no homing cycle"},
    Meaning{19, "it does not home single axes"},
    Meaning{38, "a value is too large"},
    Meaning{40, "a control pin is active: an emergency stop or a door"},
    Meaning{110, "it requires a password"},
    Meaning{120, "another interface controls it"},
    Meaning{152, "its configuration is invalid; see its boot messages"},
};

constexpr std::array grbl_alarms = {
    Meaning{1, "a limit switch closed; the position is lost"},
    Meaning{2, "the motion would have left the travel (soft limit); the position is kept"},
    Meaning{3, "it was reset while moving; the position is lost"},
    Meaning{4, "the probe was not in its initial state"},
    Meaning{5, "the probe did not touch anything"},
    Meaning{6, "homing was reset"},
    Meaning{7, "the door was opened while it homed"},
    Meaning{8,
            "homing could not move off a switch. Check that the switch opens again, and that the pull-off ($27) is "
            "long enough"},
    Meaning{9,
            "homing found no switch within the travel. Check that the machine has switches, their wiring, and $5, $23 "
            "and $130 to $132"},
    Meaning{10, "homing found no second switch of an axis with two motors"},
};

constexpr std::array grblhal_alarms = {
    Meaning{10, "its emergency stop is pressed"},
    Meaning{11, "it must be homed first"},
    Meaning{12, "a limit switch is closed: move the axis off it"},
    Meaning{13, "the probe was triggered outside a probe move"},
    Meaning{14, "the spindle did not reach its speed"},
    Meaning{15, "homing found no second switch of an axis with two motors"},
    Meaning{16, "its self-test has failed"},
    Meaning{17, "a motor driver reports a fault"},
    Meaning{18, "homing has failed"},
};

constexpr std::array fluidnc_alarms = {
    Meaning{10, "the spindle did not reach its speed"},
    Meaning{11, "a control pin was active when it started: an emergency stop or a door"},
    Meaning{12, "a limit switch shared by two ends is closed: move the axis off it"},
    Meaning{13, "it was stopped instantly; the position is lost"},
    Meaning{14, "it must be homed first"},
    Meaning{15, "it has not been unlocked since its start"},
    Meaning{16, "one of its expansion boards was reset"},
    Meaning{17, "it rejected a line"},
    Meaning{18, "a limit switch closed during a probe move"},
};

std::string_view meaning_of(std::span<const Meaning> own, std::span<const Meaning> of_grbl, int number) {
  for (const auto& meanings : {own, of_grbl}) {
    const auto found = std::ranges::find(meanings, number, &Meaning::number);
    if (found != meanings.end()) return found->words;
  }
  return {};
}

}  // namespace

std::string_view words_of_grbl_error(std::string_view firmware, int number) {
  std::span<const Meaning> own;
  if (firmware == "grblHAL") own = grblhal_errors;
  if (firmware == "FluidNC") own = fluidnc_errors;
  const std::string_view words = meaning_of(own, grbl_errors, number);
  return words.empty() ? "an error that Grbl 1.1 does not have" : words;
}

std::string_view words_of_grbl_alarm(std::string_view firmware, int number) {
  std::span<const Meaning> own;
  if (firmware == "grblHAL") own = grblhal_alarms;
  if (firmware == "FluidNC") own = fluidnc_alarms;
  const std::string_view words = meaning_of(own, grbl_alarms, number);
  return words.empty() ? "an alarm that Grbl 1.1 does not have" : words;
}

std::optional<GrblFault> trouble_of_grbl_state(const GrblReport& report) {
  const std::string& state = report.state;
  if (state == "Idle" || state == "Alarm") return {};
  if (state == "Sleep") {
    return GrblFault{.code = "grbl.asleep",
                     .message =
                         "the machine is asleep: its motors are off, and it does not accept lines. Reset it with its "
                         "button or with Ctrl-X from another sender, then home it"};
  }
  if (state == "Check") {
    return GrblFault{.code = "grbl.check-mode",
                     .message =
                         "the machine is in check mode: it would accept all lines without moving. End check mode with "
                         "$C from another sender, or reset the machine"};
  }
  if (const std::string_view wait = words_of_grbl_wait(report); !wait.empty()) {
    return GrblFault{.code = "grbl.busy", .message = fmt::format("{}, or reset it", wait)};
  }
  if (state == "Run" || state == "Jog" || state == "Home") {
    return GrblFault{
        .code = "grbl.busy",
        .message = fmt::format(
            "the machine is already moving (state {}): wait until it stops, or stop it with the sender that moves it",
            state)};
  }
  return GrblFault{
      .code = "grbl.busy",
      .message = fmt::format(
          "the machine is in state {}, in which it may not accept lines: wait until it ends, or reset the machine",
          state)};
}

std::string_view words_of_grbl_wait(const GrblReport& report) {
  if (report.state == "Hold") {
    return "the machine is in a feed hold (state Hold): resume it with its cycle start button, or with the sender that "
           "holds it";
  }
  if (report.state == "Door") {
    return "the machine's safety door is open, or was opened (state Door): close it, and resume the machine with its "
           "cycle start button";
  }
  if (report.state == "Tool") {
    return "the machine waits for a tool change (state Tool): change the tool, and resume the machine with its cycle "
           "start button";
  }
  return {};
}

}  // namespace passo
