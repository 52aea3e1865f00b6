// LinuxCNC's ini file, as linuxcnc.org/docs describes it (INI Configuration, Homing Configuration), also with the
// [AXIS_0] of versions before 2.8.
#include <algorithm>
#include <array>
#include <vector>

#include "format_imports.hpp"
#include "source_text.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

struct SectionReason {
  std::string_view name;
  const char* reason;
};
constexpr SectionReason section_reasons[] = {
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
const char* const servo_reason = "the loop of a servo: see [axis.X.encoder]";
constexpr std::array servo_keys = {"P", "I", "D", "FF0", "FF1", "FF2", "BIAS", "DEADBAND", "MAX_OUTPUT", "MAX_ERROR", "OUTPUT_SCALE", "OUTPUT_OFFSET", "OUTPUT_MIN_LIMIT", "OUTPUT_MAX_LIMIT", "PID_MAX_VEL", "PID_MAX_ERROR", "ENCODER_SCALE", "INPUT_OFFSET", "MAX_VELOCITY_FF", "PGAIN", "IGAIN", "DGAIN"};

struct KeyReason {
  std::string_view key;
  const char* reason;
};
constexpr KeyReason joint_reasons[] = {
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
constexpr std::array scale_keys = {"SCALE", "STEP_SCALE", "STEPGEN_SCALE", "INPUT_SCALE"};

// "ALWAYS", "1", "YES": the first word of a value, without a comment behind it.
std::string_view first_word(std::string_view text) {
  text = without_blanks(text);
  return text.substr(0, std::min(text.find_first_of(" \t#;"), text.size()));
}

class LinuxCncImport {
 public:
  LinuxCncImport(const SourceNode& tree, ImportContext& context, ImportedModel& model)
      : tree_(tree), context_(context), model_(model) {}

  void import();

 private:
  struct Joint {
    const SourceNode* joint = nullptr;  // [JOINT_0]
    const SourceNode* axis = nullptr;   // [AXIS_X]
    Axis letter = Axis::x;
  };

  static std::string key_of(const SourceNode& section, std::string_view key) {
    return fmt::format("[{}]{}", section.name, key);
  }
  const SourceNode* value(std::string_view section, std::string_view key);
  std::optional<SourcedNumber> number_in(const SourceNode* section, std::string_view key, UnitFactor unit,
                                         bool is_needed = true);
  void check_kinematics();
  std::vector<Axis> letters();
  std::vector<Axis> letters_of(const SourceNode& node, std::string_view text);
  void read_units();
  void find_joints();
  void read_axis(const Joint& joint);
  void read_second_motor(ImportedAxis& axis, const Joint& joint);
  std::optional<SourcedNumber> lower_of(const Joint& joint, std::string_view key, UnitFactor unit,
                                        std::string_view trajectory_key);
  std::optional<SourcedNumber> first_of(const Joint& joint, std::string_view key, UnitFactor unit);
  void read_home(ImportedAxis& axis, const Joint& joint, UnitFactor unit);
  void read_times(const Joint& joint);
  void read_spindle();
  void list_sections();
  void list_joint_keys(const SourceNode& section);
  UnitFactor unit_of(Axis axis) const { return is_rotary(axis) ? UnitFactor{} : length_; }

  const SourceNode& tree_;
  ImportContext& context_;
  ImportedModel& model_;
  UnitFactor length_;
  bool is_old_ = false;  // [AXIS_0], before 2.8
  bool has_servos_ = false;
  std::vector<Joint> joints_;
};

const SourceNode* LinuxCncImport::value(std::string_view section, std::string_view key) {
  const SourceNode* found = tree_.child(section);
  return found == nullptr ? nullptr : found->child(key);
}

std::optional<SourcedNumber> LinuxCncImport::number_in(const SourceNode* section, std::string_view key, UnitFactor unit,
                                                       bool is_needed) {
  const SourceNode* node = section == nullptr ? nullptr : section->child(key);
  if (node == nullptr) return std::nullopt;
  const std::string name = key_of(*section, key);
  return is_needed ? context_.number(node, name, unit) : context_.optional_number(node, name, unit);
}

void LinuxCncImport::check_kinematics() {
  const SourceNode* kinematics = value("KINS", "KINEMATICS");
  if (kinematics == nullptr) return;
  context_.mark(*kinematics);
  const std::string_view name = first_word(kinematics->text);
  const ValueOrigin origin = context_.origin(*kinematics, "[KINS]KINEMATICS");
  if (name == "trivkins") {
    context_.understood(origin, "a motor, or two, for each axis");
    return;
  }
  context_.error("import.kinematics", origin,
                 fmt::format("the machine has the kinematics {}", ImportContext::printable(name)),
                 "trivkins: a machine file describes machines with a motor, or two, for each axis");
}

// "XYZ", "X Y Y Z": the letter of each joint.
std::vector<Axis> LinuxCncImport::letters_of(const SourceNode& node, std::string_view text) {
  std::vector<Axis> letters;
  for (const char letter : text) {
    const auto axis = axis_of(letter);
    if (axis) letters.push_back(*axis);
    if (axis || letter == ' ' || letter == '\t' || letter == '"' || letter == ',') continue;
    context_.error("import.axes", context_.origin(node, node.name),
                   fmt::format("there is no axis {}", ImportContext::printable({&letter, 1})),
                   "the letters of the axes, e.g. XYZ or XYYZ");
    break;
  }
  return letters;
}

std::vector<Axis> LinuxCncImport::letters() {
  const SourceNode* kinematics = value("KINS", "KINEMATICS");
  const std::size_t at = kinematics == nullptr ? std::string::npos : kinematics->text.find("coordinates=");
  const SourceNode* coordinates = value("TRAJ", "COORDINATES");
  if (coordinates != nullptr) {
    context_.mark(*coordinates);
    context_.understood(context_.origin(*coordinates, "[TRAJ]COORDINATES"), "a table [axis.X] for each letter");
  }
  if (at != std::string::npos) return letters_of(*kinematics, first_word(std::string_view(kinematics->text).substr(at + 12)));
  if (coordinates != nullptr) {
    return letters_of(*coordinates, coordinates->text.substr(0, std::min(coordinates->text.find('#'), coordinates->text.size())));
  }
  context_.error("import.axes", ValueOrigin{}, "the file does not name the axes",
                 "COORDINATES in [TRAJ], or coordinates= in [KINS]KINEMATICS");
  return {};
}

void LinuxCncImport::read_units() {
  const SourceNode* units = value("TRAJ", "LINEAR_UNITS");
  if (units == nullptr) {
    context_.error("import.units", ValueOrigin{}, "the file does not say the unit of length",
                   "LINEAR_UNITS = mm, or inch, in [TRAJ]");
    return;
  }
  context_.mark(*units);
  const ValueOrigin origin = context_.origin(*units, "[TRAJ]LINEAR_UNITS");
  const std::string_view name = first_word(units->text);
  const auto number = DecimalNumber::parse(name);  // older versions: units per millimetre
  const bool is_inch = name == "in" || name == "inch" || name == "imperial" ||
                       (number && number->value() > 0.0393 && number->value() < 0.0394);
  const bool is_mm = name == "mm" || name == "metric" || (number && number->value() == 1);
  if (!is_inch && !is_mm) {
    context_.error("import.units", origin, fmt::format("the unit of length is {}", origin.value), "mm or inch");
    return;
  }
  context_.understood(origin, is_inch ? "all lengths are converted from inches" : "all lengths are in millimetres");
  if (is_inch) {
    length_ = {254, 10};
    context_.warn("the source is in inches: all lengths are converted to millimetres");
  }
  const SourceNode* angles = value("TRAJ", "ANGULAR_UNITS");
  if (angles == nullptr) return;
  context_.mark(*angles);
  const ValueOrigin angle = context_.origin(*angles, "[TRAJ]ANGULAR_UNITS");
  const std::string_view word = first_word(angles->text);
  if (word == "deg" || word == "degree" || word == "degrees" || word == "360" || word == "1" || word == "1.0") {
    context_.understood(angle, "degrees");
  } else {
    context_.error("import.units", angle, fmt::format("the unit of angles is {}", angle.value), "degree");
  }
}

void LinuxCncImport::find_joints() {
  is_old_ = tree_.child("JOINT_0") == nullptr && tree_.child("AXIS_0") != nullptr;
  const std::vector<Axis> all = letters();
  // Without coordinates= the number of a joint is that of its letter: joint 2 is Z, also of a lathe without Y.
  const SourceNode* kinematics = value("KINS", "KINEMATICS");
  const bool are_given = kinematics != nullptr && kinematics->text.find("coordinates=") != std::string::npos;
  const bool are_once = std::ranges::all_of(all, [&](Axis axis) { return std::ranges::count(all, axis) == 1; });
  const bool by_letter = is_old_ || (!are_given && are_once);
  for (std::size_t i = 0; i < all.size(); ++i) {
    Joint joint{.letter = all[i]};
    const std::size_t number = by_letter ? index_of(all[i]) : i;
    joint.joint = tree_.child(fmt::format("{}_{}", is_old_ ? "AXIS" : "JOINT", number));
    joint.axis = is_old_ ? nullptr : tree_.child(fmt::format("AXIS_{}", letter_of(all[i])));
    if (joint.joint == nullptr) {
      context_.error("import.missing-key", ValueOrigin{},
                     fmt::format("there is no section for joint {}, axis {}", number, letter_of(all[i])),
                     fmt::format("[{}_{}]", is_old_ ? "AXIS" : "JOINT", number));
      return;
    }
    joints_.push_back(joint);
  }
}

std::optional<SourcedNumber> LinuxCncImport::first_of(const Joint& joint, std::string_view key, UnitFactor unit) {
  const SourceNode* section = joint.axis != nullptr && joint.axis->child(key) != nullptr ? joint.axis : joint.joint;
  auto number = number_in(section, key, unit);
  if (section == joint.axis && number) {
    if (const auto other = number_in(joint.joint, key, unit); other && other->value.value() != number->value.value()) {
      context_.unmapped(other->origin, fmt::format("the limit of [{}] is used", joint.axis->name));
    } else if (other) {
      context_.understood(other->origin, fmt::format("the same as {}", number->origin.key));
    }
  }
  return number;
}

// A move obeys the limits of the axis and of its joint.
std::optional<SourcedNumber> LinuxCncImport::lower_of(const Joint& joint, std::string_view key, UnitFactor unit,
                                                      std::string_view trajectory_key) {
  auto number = number_in(joint.joint, key, unit);
  if (const auto other = number_in(joint.axis, key, unit)) {
    if (!number || other->value < number->value) {
      if (number) context_.unmapped(number->origin, fmt::format("the lower one of {} is used", other->origin.key));
      return other;
    }
    if (number->value < other->value) {
      context_.unmapped(other->origin, fmt::format("the lower one of {} is used", number->origin.key));
    } else {
      context_.understood(other->origin, fmt::format("the same as {}", number->origin.key));
    }
  }
  return number ? number : number_in(tree_.child("TRAJ"), trajectory_key, unit);
}

void LinuxCncImport::read_axis(const Joint& joint) {
  const auto known = std::ranges::find(model_.axes, joint.letter, &ImportedAxis::axis);
  if (known != model_.axes.end()) {
    read_second_motor(*known, joint);
    return;
  }
  const UnitFactor unit = unit_of(joint.letter);
  const UnitFactor per_unit{unit.divisor, unit.factor};
  ImportedAxis axis{.axis = joint.letter};
  for (const char* key : scale_keys) {
    auto scale = number_in(joint.joint, key, per_unit, !axis.scale);
    if (!scale) continue;
    if (axis.scale) {
      context_.unmapped(scale->origin, fmt::format("{} is used", axis.scale->origin.key));
    } else {
      axis.scale = scale;
    }
  }
  axis.velocity = lower_of(joint, "MAX_VELOCITY", unit, is_rotary(joint.letter) ? "MAX_ANGULAR_VELOCITY" : "MAX_LINEAR_VELOCITY");
  axis.acceleration = lower_of(joint, "MAX_ACCELERATION", unit, is_rotary(joint.letter) ? "MAX_ANGULAR_ACCELERATION" : "MAX_LINEAR_ACCELERATION");
  axis.low = first_of(joint, "MIN_LIMIT", unit);
  axis.high = first_of(joint, "MAX_LIMIT", unit);
  axis.backlash = number_in(joint.joint, "BACKLASH", unit, false);
  if (const SourceNode* type = joint.joint->child("TYPE")) {
    context_.mark(*type);
    const bool is_angular = first_word(type->text) == "ANGULAR";
    context_.understood(context_.origin(*type, key_of(*joint.joint, "TYPE")), is_rotary(joint.letter) ? "degrees" : "millimetres");
    if (is_angular != is_rotary(joint.letter)) {
      context_.warn(fmt::format("[{}]TYPE is {}, but axis {} is in {} in a machine file", joint.joint->name,
                                is_angular ? "ANGULAR" : "LINEAR", letter_of(joint.letter),
                                is_rotary(joint.letter) ? "degrees" : "millimetres"));
    }
  }
  read_home(axis, joint, unit);
  read_times(joint);
  model_.axes.push_back(std::move(axis));
}

void LinuxCncImport::read_second_motor(ImportedAxis& axis, const Joint& joint) {
  const ValueOrigin origin = {.key = fmt::format("[{}]", joint.joint->name), .value = std::string(1, letter_of(joint.letter)), .line = joint.joint->line, .column = joint.joint->column};
  if (axis.second) {
    context_.error("import.too-many-motors", origin, fmt::format("axis {} has more than two joints", letter_of(axis.axis)),
                   "one or two motors for each axis");
    return;
  }
  axis.second = ImportedSecondMotor{.origin = origin};
  const UnitFactor unit = unit_of(joint.letter);
  const SourceNode* section = joint.joint;
  for (const char* key : scale_keys) {
    const auto scale = number_in(section, key, {unit.divisor, unit.factor});
    if (!scale || !axis.scale) continue;
    if (scale->value.magnitude().value() != axis.scale->value.magnitude().value()) {
      context_.error("import.scale", scale->origin,
                     fmt::format("the two motors of axis {} have different scales, {} and {}", letter_of(axis.axis),
                                 axis.scale->value.text(), scale->value.text()),
                     "the same scale for both; its sign may differ");
    }
    if (!axis.second->inverted) axis.second->inverted = SourcedFlag{scale->value.value() < 0, scale->origin};
  }
  context_.list_rest(*section, fmt::format("[{}]", section->name), "", "the values of the first motor of the axis are used");
  context_.warn(fmt::format("axis {} has two motors: Passo squares them with a limit switch each, see square_mm in "
                            "[axis.{}.second_motor]",
                            letter_of(axis.axis), letter_of(axis.axis)));
}

void LinuxCncImport::read_home(ImportedAxis& axis, const Joint& joint, UnitFactor unit) {
  const SourceNode* section = joint.joint;
  const auto seek = number_in(section, "HOME_SEARCH_VEL", unit, false);
  const auto latch = number_in(section, "HOME_LATCH_VEL", unit, false);
  const auto offset = number_in(section, "HOME_OFFSET", unit, false);
  const auto rest = number_in(section, "HOME", unit, false);
  const auto turn = number_in(section, "HOME_SEQUENCE", {}, false);
  if (!seek || seek->value.value() == 0 || !latch || latch->value.value() == 0) {
    const char* const reason = "the axis is not homed with a switch (HOME_SEARCH_VEL, HOME_LATCH_VEL)";
    for (const auto* number : {&seek, &latch, &offset, &rest, &turn}) {
      if (*number) context_.unmapped((*number)->origin, reason);
    }
    return;
  }
  const bool high = seek->value.value() > 0;
  const SourcedNumber zero{DecimalNumber(0), {.key = {}, .value = {}, .reason = "LinuxCNC's default for HOME_OFFSET"}};
  ImportedHome home{.is_high = {high, seek->origin},
                    .switch_at = offset ? *offset : zero,
                    .seek = {seek->value.magnitude(), seek->origin},
                    .latch = {latch->value.magnitude(), latch->origin},
                    .pull_off = {},
                    .turn = -1};
  if (rest) {
    const DecimalNumber off = high ? home.switch_at.value - rest->value : rest->value - home.switch_at.value;
    if (off.value() > 0) home.pull_off = SourcedNumber{off, rest->origin};
    if (off.value() <= 0) context_.unmapped(rest->origin, "the axis rests on its switch, or beyond it");
  }
  if (turn) {
    // A negative number: axes that start their last move together.
    home.turn = static_cast<int>(std::min(turn->value.magnitude().value(), 100.0));
    home.turn_origin = turn->origin;
  }
  axis.home = std::move(home);
}

// The longest time of all joints, in nanoseconds.
void LinuxCncImport::read_times(const Joint& joint) {
  const auto read = [&](std::string_view key, std::optional<SourcedNumber>& longest) {
    const auto time = number_in(joint.joint, key, {1, 1000}, false);
    if (!time) return;
    if (longest && !(longest->value < time->value)) {
      context_.understood(time->origin, fmt::format("not longer than {}", longest->origin.key));
      return;
    }
    if (longest) context_.understood(longest->origin, fmt::format("not longer than {}", time->origin.key));
    longest = time;
  };
  read("STEPLEN", model_.step_pulse_us);
  read("DIRSETUP", model_.direction_setup_us);
  read("DIRHOLD", model_.direction_hold_us);
}

void LinuxCncImport::read_spindle() {
  model_.max_rpm = number_in(tree_.child("SPINDLE_0"), "MAX_FORWARD_VELOCITY", {}, false);
  if (model_.max_rpm) return;
  for (const char* section : {"SPINDLE", "SPINDLE_9"}) {
    if (!model_.max_rpm) model_.max_rpm = number_in(tree_.child(section), "MAX_RPM", {}, false);
  }
}

void LinuxCncImport::list_sections() {
  for (const SourceNode& section : tree_.children) {
    if (section.name == "#INCLUDE") {
      context_.unmapped(&section, "#INCLUDE", "another file, which is not read");
      context_.warn(fmt::format("the file includes {}, which is not read", ImportContext::printable(section.text)));
      continue;
    }
    const auto row = std::ranges::find(section_reasons, section.name, &SectionReason::name);
    if (row != std::end(section_reasons)) {
      context_.mark_all(section);
      ValueOrigin origin = context_.origin(section, fmt::format("[{}]", section.name));
      origin.value = fmt::format("{} keys", section.children.size());
      context_.unmapped(origin, row->reason);
      continue;
    }
    list_joint_keys(section);
    const bool is_used = std::ranges::any_of(
        joints_, [&](const Joint& joint) { return joint.joint == &section || joint.axis == &section; });
    const bool is_of_motion = section.name.starts_with("JOINT_") || section.name.starts_with("AXIS_");
    if (!is_of_motion && section.name != "TRAJ" && section.name != "KINS" && !section.name.starts_with("SPINDLE")) {
      context_.mark_all(section);
      ValueOrigin origin = context_.origin(section, fmt::format("[{}]", section.name));
      origin.value = fmt::format("{} keys", section.children.size());
      context_.unmapped(origin, "");
    }
    context_.list_rest(section, fmt::format("[{}]", section.name), "",
                       section.name == "TRAJ"    ? "no equivalent: the machine file has the limits of each axis"
                       : is_of_motion && !is_used ? "the coordinates name no axis for this section"
                                                  : "");
  }
}

void LinuxCncImport::list_joint_keys(const SourceNode& section) {
  const bool is_joint = section.name.starts_with("JOINT_") || section.name.starts_with("AXIS_");
  if (!is_joint && section.name != "KINS") return;
  for (const SourceNode& key : section.children) {
    const auto reason = std::ranges::find(joint_reasons, key.name, &KeyReason::key);
    if (reason != std::end(joint_reasons)) context_.unmapped(&key, key_of(section, key.name), reason->reason);
    if (std::ranges::find(servo_keys, key.name) != servo_keys.end()) {
      context_.unmapped(&key, key_of(section, key.name), servo_reason);
      has_servos_ |= key.name == "P" || key.name == "PGAIN";
    }
  }
}

void LinuxCncImport::import() {
  context_.result().controller = "LinuxCNC";
  context_.end_numbers_at_blanks();
  const SourceNode* name = value("EMC", "MACHINE");
  if (name != nullptr && !name->text.empty()) {
    context_.mark(*name);
    model_.name = {ImportContext::printable(name->text), context_.origin(*name, "[EMC]MACHINE")};
  } else {
    model_.name = {"LinuxCNC machine", {.key = {}, .value = {}, .reason = "the file has no name"}};
  }
  check_kinematics();
  read_units();
  if (context_.has_failed()) return;
  find_joints();
  if (context_.has_failed()) return;
  for (const Joint& joint : joints_) read_axis(joint);
  read_spindle();
  list_sections();
  if (has_servos_) {
    context_.warn("the axes have servo loops: check whether the scale is that of the motor's steps, or of an encoder");
  }
  context_.warn("the levels of pins are in LinuxCNC's HAL files: check the directions, the switches and the outputs");
}

}  // namespace

void import_linuxcnc(const SourceNode& tree, ImportContext& context, ImportedModel& model) {
  LinuxCncImport(tree, context, model).import();
}

}  // namespace passo
