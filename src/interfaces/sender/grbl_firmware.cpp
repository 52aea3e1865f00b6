#include "passo/sender/grbl_firmware.hpp"

#include <algorithm>
#include <array>

namespace passo {
namespace {

constexpr std::array grblhal_errors = {
    GrblMeaning{18, "it was reset"},
    GrblMeaning{19, "a value must be above 0"},
    GrblMeaning{39, "a value is out of range"},
    GrblMeaning{40, "it waits for a tool change"},
    GrblMeaning{41, "the spindle does not turn"},
    GrblMeaning{42, "this code is not possible in the active plane"},
    GrblMeaning{43, "the feed rate is too high"},
    GrblMeaning{44, "the spindle speed is out of range"},
    GrblMeaning{45, "a limit switch is closed: move the axis off it"},
    GrblMeaning{46, "it must be homed first"},
    GrblMeaning{47, "the tool is not known"},
    GrblMeaning{48, "two values of the line exclude each other"},
    GrblMeaning{49, "its self-test has failed"},
    GrblMeaning{50, "its emergency stop is pressed"},
    GrblMeaning{51, "a motor driver reports a fault"},
    GrblMeaning{52, "the value of a setting is out of range"},
    GrblMeaning{53, "the setting is not available"},
    GrblMeaning{54, "the retract position is wrong"},
    GrblMeaning{55, "its homing set-up is invalid"},
    GrblMeaning{56, "the work offset is locked"},
    GrblMeaning{57, "a program mark is not expected here"},
    GrblMeaning{58, "the port is not available"},
    GrblMeaning{77, "it requires a password"},
    GrblMeaning{78, "it denies access"},
    GrblMeaning{79, "an alarm must be cleared by a reset first"},
    GrblMeaning{84, "it cannot open the file"},
    GrblMeaning{86, "the port cannot be used"},
    GrblMeaning{87, "there is a tool in the spindle"},
    GrblMeaning{88, "there is no tool in the spindle"},
};

constexpr std::array fluidnc_errors = {
    GrblMeaning{18, "its configuration has no homing cycle"},
    GrblMeaning{19, "it does not home single axes"},
    GrblMeaning{38, "a value is too large"},
    GrblMeaning{40, "a control pin is active: an emergency stop or a door"},
    GrblMeaning{110, "it requires a password"},
    GrblMeaning{120, "another interface controls it"},
    GrblMeaning{152, "its configuration is invalid; see its boot messages"},
    GrblMeaning{162, "the value is in its YAML file, and cannot be written by number"},
};

constexpr std::array grblhal_alarms = {
    GrblMeaning{10, "its emergency stop is pressed"},
    GrblMeaning{11, "it must be homed first"},
    GrblMeaning{12, "a limit switch is closed: move the axis off it"},
    GrblMeaning{13, "the probe was triggered outside a probe move"},
    GrblMeaning{14, "the spindle did not reach its speed"},
    GrblMeaning{15, "homing found no second switch of an axis with two motors"},
    GrblMeaning{16, "its self-test has failed"},
    GrblMeaning{17, "a motor driver reports a fault"},
    GrblMeaning{18, "its homing set-up is invalid"},
    GrblMeaning{19, "a Modbus device does not answer, or answers wrongly"},
    GrblMeaning{20, "an expansion board does not answer"},
    GrblMeaning{21, "its settings memory has failed"},
    GrblMeaning{22, "a buffer overflowed"},
};

constexpr std::array fluidnc_alarms = {
    GrblMeaning{10, "the spindle did not reach its speed"},
    GrblMeaning{11, "a control pin was active when it started: an emergency stop or a door"},
    GrblMeaning{12, "a limit switch shared by two ends is closed: move the axis off it"},
    GrblMeaning{13, "it was stopped instantly; the position is lost"},
    GrblMeaning{14, "it must be homed first"},
    GrblMeaning{15, "it has not been unlocked since its start"},
    GrblMeaning{16, "one of its expansion boards was reset"},
    GrblMeaning{17, "it rejected a line"},
    GrblMeaning{18, "a limit switch closed during a probe move"},
};

constexpr std::array ucnc_errors = {
    GrblMeaning{39, "a comment is not closed"},
    GrblMeaning{40, "there is no such tool"},
    GrblMeaning{41, "no feed rate is set"},
    GrblMeaning{42, "its settings memory cannot be written"},
    GrblMeaning{43, "its settings are write-protected"},
    GrblMeaning{50, "the spindle does not turn"},
    GrblMeaning{55, "the tool has failed"},
    GrblMeaning{56, "this code is not possible in the active plane"},
    GrblMeaning{57, "hard limits are disabled"},
    GrblMeaning{59, "the jog was cancelled"},
    GrblMeaning{255, "it had to stop; reset it"},
};

using FeedWay = GrblFirmware::FeedWay;
using Settings = GrblFirmware::Settings;

constexpr std::array<std::string_view, 2> grblhal_questions = {"$I+", "$EA"};
constexpr std::array<std::string_view, 1> ucnc_questions = {"$I+"};

constexpr std::array firmwares = {
    GrblFirmware{.name = "Grbl",
                 .mark = "",
                 .axes = "XYZABC",
                 .unusable_bytes = 0,
                 .sizes_are_last = false,
                 .tells_mist = true,
                 .tells_core_xy = true,
                 .measures_motors = true,
                 .homes_single_axes = false,
                 .converts_angles = true,
                 .unasked_modes = 0,
                 .feed_way = FeedWay::all_axes,
                 .settings = Settings::numbers,
                 .questions = {},
                 .save = "",
                 .errors = {},
                 .alarms = {}},
    // As Grbl, with more blocks.
    GrblFirmware{.name = "grbl-Mega",
                 .mark = "",
                 .axes = "XYZABC",
                 .unusable_bytes = 0,
                 .sizes_are_last = false,
                 .tells_mist = true,
                 .tells_core_xy = true,
                 .measures_motors = true,
                 .homes_single_axes = false,
                 .converts_angles = true,
                 .unasked_modes = 0,
                 .feed_way = FeedWay::all_axes,
                 .settings = Settings::numbers,
                 .questions = {},
                 .save = "",
                 .errors = {},
                 .alarms = {}},
    // As Grbl; tells the letters of its axes.
    GrblFirmware{.name = "grbl-Mega-5X",
                 .mark = "",
                 .axes = "XYZABC",
                 .unusable_bytes = 0,
                 .sizes_are_last = false,
                 .tells_mist = true,
                 .tells_core_xy = true,
                 .measures_motors = true,
                 .homes_single_axes = false,
                 .converts_angles = true,
                 .unasked_modes = 0,
                 .feed_way = FeedWay::all_axes,
                 .settings = Settings::numbers,
                 .questions = {},
                 .save = "",
                 .errors = {},
                 .alarms = {}},
    GrblFirmware{.name = "grblHAL",
                 .mark = "grblhal",
                 .axes = "XYZABCUVW",
                 .unusable_bytes = 1,  // its ring holds a byte less than it reports
                 .sizes_are_last = false,
                 .tells_mist = true,
                 .tells_core_xy = true,
                 .measures_motors = false,
                 .homes_single_axes = false,
                 .converts_angles = false,
                 .unasked_modes = 512,                   // its $10: parser state
                 .feed_way = FeedWay::depends_on_build,  // ROTARY_FIX
                 .settings = Settings::described,
                 .questions = grblhal_questions,
                 .save = "",
                 .errors = grblhal_errors,
                 .alarms = grblhal_alarms},
    GrblFirmware{.name = "FluidNC",
                 .mark = "fluidnc",
                 .axes = "XYZABCUVW",
                 .unusable_bytes = 0,
                 .sizes_are_last = false,
                 .tells_mist = true,
                 .tells_core_xy = false,
                 .measures_motors = false,
                 .homes_single_axes = true,
                 .converts_angles = false,
                 .unasked_modes = GrblFirmware::at_any_time,  // $Report/Interval
                 .feed_way = FeedWay::all_axes,
                 .settings = Settings::yaml,
                 .questions = {},
                 .save = "",
                 .errors = fluidnc_errors,
                 .alarms = fluidnc_alarms},
    GrblFirmware{.name = "uCNC",
                 .mark = "ucnc",
                 .axes = "XYZABC",
                 .unusable_bytes = 0,
                 .sizes_are_last = true,
                 .tells_mist = false,
                 .tells_core_xy = false,
                 .measures_motors = false,
                 .homes_single_axes = false,
                 .converts_angles = true,
                 .unasked_modes = 0,
                 .feed_way = FeedWay::all_axes,
                 .settings = Settings::numbers,
                 .questions = ucnc_questions,
                 .save = "$SS",
                 .errors = ucnc_errors,
                 .alarms = {}},
};

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

std::string_view meaning_in(std::span<const GrblMeaning> own, std::span<const GrblMeaning> of_grbl, int number) {
  for (const auto& meanings : {own, of_grbl}) {
    const auto found = std::ranges::find(meanings, number, &GrblMeaning::number);
    if (found != meanings.end()) return found->words;
  }
  return {};
}

}  // namespace

std::span<const GrblFirmware> grbl_firmwares() {
  return firmwares;
}

const GrblFirmware& grbl_firmware(std::string_view name) {
  const auto found = std::ranges::find(firmwares, name, &GrblFirmware::name);
  return found == firmwares.end() ? firmwares.front() : *found;
}

const GrblFirmware* marked_grbl_firmware(std::string_view text) {
  const auto has_mark = [text](const GrblFirmware& firmware) {
    const auto same = [](char heard, char marked) { return lower(heard) == marked; };
    return !firmware.mark.empty() &&
           std::search(text.begin(), text.end(), firmware.mark.begin(), firmware.mark.end(), same) != text.end();
  };
  const auto found = std::ranges::find_if(firmwares, has_mark);
  return found == firmwares.end() ? nullptr : &*found;
}

std::string_view meaning_of_grbl_error(std::string_view firmware, int number) {
  return meaning_in(grbl_firmware(firmware).errors, grbl_errors(), number);
}

std::string_view meaning_of_grbl_alarm(std::string_view firmware, int number) {
  return meaning_in(grbl_firmware(firmware).alarms, grbl_alarms(), number);
}

}  // namespace passo
