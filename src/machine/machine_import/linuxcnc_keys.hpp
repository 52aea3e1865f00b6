// LinuxCncKey: the sections and keys of LinuxCNC's ini that have no place in a machine file, and why.
#pragma once

#include <array>
#include <string_view>

namespace passo {

struct LinuxCncSection {
  std::string_view name;
  const char* reason;
};
inline constexpr LinuxCncSection linuxcnc_sections[] = {
    {"DISPLAY", "no equivalent: the screen"},
    {"FILTER", "no equivalent: programs that convert files"},
    {"TASK", "no equivalent: LinuxCNC's own programs"},
    {"RS274NGC", "no equivalent: the interpreter"},
    {"EMCMOT", "no equivalent: LinuxCNC's own programs"},
    {"HAL", "no equivalent: the wiring is in other files"},
    {"HALUI", "no equivalent: commands of buttons"},
    {"EMCIO", "no equivalent: the tool changer"},
    {"APPLICATIONS", "no equivalent: LinuxCNC's own programs"},
    {"PYTHON", "no equivalent: remapped codes"},
    {"HOSTMOT2", "no equivalent: the interface card"},
    {"EMC", "no equivalent: LinuxCNC's own programs"},
    {"MACROS", "no equivalent: commands of buttons"},
    {"MDI_COMMAND_LIST", "no equivalent: commands of buttons"},
    {"PROBE", "no equivalent: commands of buttons"},
    {"TOOLSENSOR", "no equivalent: commands of buttons"},
    {"VERSA_TOOLSETTER", "no equivalent: commands of buttons"},
};
inline constexpr const char* linuxcnc_servo_reason = "the loop of a servo: see [axis.X.encoder]";
inline constexpr std::array linuxcnc_servo_keys = {"P",
                                                   "I",
                                                   "D",
                                                   "FF0",
                                                   "FF1",
                                                   "FF2",
                                                   "BIAS",
                                                   "DEADBAND",
                                                   "MAX_OUTPUT",
                                                   "MAX_ERROR",
                                                   "OUTPUT_SCALE",
                                                   "OUTPUT_OFFSET",
                                                   "OUTPUT_MIN_LIMIT",
                                                   "OUTPUT_MAX_LIMIT",
                                                   "PID_MAX_VEL",
                                                   "PID_MAX_ERROR",
                                                   "ENCODER_SCALE",
                                                   "INPUT_OFFSET",
                                                   "MAX_VELOCITY_FF",
                                                   "PGAIN",
                                                   "IGAIN",
                                                   "DGAIN"};

struct LinuxCncKey {
  std::string_view key;
  const char* reason;
};
inline constexpr LinuxCncKey linuxcnc_joint_keys[] = {
    {"STEPGEN_MAXVEL", "headroom of LinuxCNC's step generator: Passo needs none"},
    {"STEPGEN_MAXACCEL", "headroom of LinuxCNC's step generator: Passo needs none"},
    {"STEPGEN_MAX_VEL", "headroom of LinuxCNC's step generator: Passo needs none"},
    {"STEPGEN_MAX_ACC", "headroom of LinuxCNC's step generator: Passo needs none"},
    {"FERROR", "the following error of a servo: see [axis.X.encoder]"},
    {"MIN_FERROR", "the following error of a servo: see [axis.X.encoder]"},
    {"STEPSPACE", "Passo makes the pause as long as the pulse"},
    {"COMP_FILE", "errors of the screw in another file: see error_mm in [axis.X.screw]"},
    {"COMP_FILE_TYPE", "errors of the screw in another file: see error_mm in [axis.X.screw]"},
    {"HOME_FINAL_VEL", "no equivalent: the speed after homing"},
    {"HOME_USE_INDEX", "no equivalent: homing to the index pulse of an encoder"},
    {"HOME_IS_SHARED", "axes with one switch have the same input in [axis.X.home]"},
    {"HOME_ABSOLUTE_ENCODER", "no equivalent: an absolute encoder"},
    {"HOME_IGNORE_LIMITS", "no equivalent"},
    {"VOLATILE_HOME", "no equivalent"},
    {"LOCKING_INDEXER", "no equivalent"},
    {"OFFSET_AV_RATIO", "no equivalent"},
    {"WRAPPED_ROTARY", "no equivalent"},
    {"UNITS", "the unit is that of [TRAJ]"},
    {"AXIS", "the number is that of the section"},
    {"JOINTS", "the coordinates tell the number of joints"},
};

// The steps per unit of a stepper motor. Before 2.3 they were the scale of its input.
inline constexpr std::array linuxcnc_scale_keys = {"SCALE", "STEP_SCALE", "STEPGEN_SCALE", "INPUT_SCALE"};

}  // namespace passo
