#include "frame_codes.hpp"

#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

// G54 … G59, G59.1 … G59.3.
constexpr int system_of(CodeNumber number) {
  return number <= code(59) ? number / 10 - 53 : 6 + number % 10;
}
constexpr CodeNumber code_of_system(int system) {
  return system <= 6 ? code(53 + system) : code(59, system - 6);
}

}  // namespace

// Changes the frame. The machine position stays, and the work position changes.
template <class... Operations>
void FrameCodes::change_frame(const Operations&... operations) {
  const Point machine = state_.machine_position();
  const auto change = [this](const Operation& operation) {
    operations_.push(operation);
    state_.frame.follow(operation);
  };
  (change(operation_of(operations)), ...);
  state_.position = state_.frame.work_from_machine(machine);
}

// Starts with the work coordinate system and the offsets of the parameters, as the last run left them.
void FrameCodes::start() {
  const int system = static_cast<int>(parameters_.get(work_system_parameter));
  state_.modal.set(work_system, code_of_system(system));
  change_frame(
      operation::SetWorkOffset{static_cast<std::uint8_t>(system), parameters_.point(work_offset_parameter(system))},
      operation::SetG92Offset{active_g92()}, operation::SetRotation{parameters_.get(rotation_parameter(system))});
}

void FrameCodes::use_tool_offset(const Point& offset) {
  change_frame(operation::SetToolOffset{offset});
}

void FrameCodes::shift_work_z(double way) {
  for (int system = 1; system <= work_systems; ++system) {
    Point offset = parameters_.point(work_offset_parameter(system));
    offset[Axis::z] += way;
    parameters_.set_point(work_offset_parameter(system), offset);
  }
  activate_system(system_of(state_.modal[work_system]), true);
}

void FrameCodes::restore_tool_offset(const ModalSnapshot& saved) {
  if (state_.modal[tool_length] == saved.modal[tool_length] && state_.frame.tool_offset() == saved.tool_offset) return;
  state_.modal.set(tool_length, saved.modal[tool_length]);
  change_frame(operation::SetToolOffset{saved.tool_offset});
}

bool FrameCodes::select_work_system(CodeNumber number) {
  if (state_.modal[work_system] == number) {
    emit_comment("interpreter: continuing to use same coordinate system");
    return true;
  }
  activate_system(system_of(number), true);
  return true;
}

void FrameCodes::activate_system(int system, bool with_g92) {
  state_.modal.set(work_system, code_of_system(system));
  parameters_.set(work_system_parameter, system);
  const operation::SetWorkOffset offset{static_cast<std::uint8_t>(system),
                                        parameters_.point(work_offset_parameter(system))};
  const operation::SetRotation rotation{parameters_.get(rotation_parameter(system))};
  if (with_g92) {
    change_frame(offset, operation::SetG92Offset{state_.frame.g92_offset()}, rotation);
  } else {
    change_frame(offset, rotation);
  }
}

// G28 and G30: goes to the given point first. Then the given axes (or all of them) go to the stored point.
bool FrameCodes::go_home(int parameter) {
  Point end;
  if (!end_point(end)) return false;
  emit(operation::StraightTraverse{end});
  const Point home = state_.frame.work_from_machine(parameters_.point(parameter));
  for (const Axis axis : all_axes) {
    if (!words_.any_axis() || words_.has(letter_of(axis))) end[axis] = home[axis];
  }
  emit(operation::StraightTraverse{end});
  state_.position = end;
  return true;
}

bool FrameCodes::store_home(int parameter) {
  parameters_.set_point(parameter, state_.machine_position());
  return true;
}

bool FrameCodes::check_work_offset_words(int& system) {
  std::int32_t number = 0;
  if (words_.has('P')) {
    if (!whole_word('P', 0, work_systems, number)) return false;
  } else if (!speaks_grbl()) {  // grbl takes P0
    return fail("gcode.missing-word", words_.span(non_modal), "G10 without P",
                "P, the work offset: 1 to 9, or 0 for the active one");
  }
  if (words_['L'] == 20 && words_.has('R') && !words_.is_of_another('R', non_modal)) {
    return fail("gcode.unused-word", words_.span('R'), "R with G10 L20", "G10 L2 R… rotates a work offset");
  }
  for (const char letter : {'I', 'J', 'Q'}) {
    if (!words_.has(letter) || words_.is_of_another(letter, non_modal)) continue;
    return fail("gcode.unused-word", words_.span(letter), fmt::format("{} with G10 L{}", letter, words_['L']),
                fmt::format("G10 L1 {}… sets a tool", letter));
  }
  system = number == 0 ? system_of(state_.modal[work_system]) : number;
  return true;
}

// G10 L2 sets a work coordinate system's offset. G10 L20 sets the offset with which the tool's work position is the
// given one.
bool FrameCodes::set_work_offset() {
  int system = 0;
  if (!check_work_offset_words(system)) return false;
  const int first = work_offset_parameter(system);
  Point offset = parameters_.point(first);
  const bool is_active = code_of_system(system) == state_.modal[work_system];
  if (words_['L'] == 2) {
    for (const Axis axis : all_axes) {
      if (words_.has(letter_of(axis))) offset[axis] = axis_word(axis);
    }
    if (words_.has('R')) parameters_.set(rotation_parameter(system), words_['R']);
  } else {
    Frame frame = state_.frame;
    frame.follow({operation::SetWorkOffset{static_cast<std::uint8_t>(system), offset}, block_.source});
    frame.follow({operation::SetRotation{parameters_.get(rotation_parameter(system))}, block_.source});
    frame.follow({operation::SetG92Offset{active_g92()}, block_.source});
    const Point here = state_.machine_position();
    Point wanted = frame.work_from_machine(here);
    bool any_of_plane = false;
    for (const Axis axis : all_axes) {
      if (!words_.has(letter_of(axis))) continue;
      wanted[axis] = axis_word(axis);
      any_of_plane |= axis == Axis::x || axis == Axis::y;
    }
    const Point moved = offset + (here - frame.machine_from_work(wanted));
    for (const Axis axis : all_axes) {
      const bool in_plane = axis == Axis::x || axis == Axis::y;
      if (words_.has(letter_of(axis)) || (in_plane && any_of_plane && frame.rotation_degrees() != 0)) {
        offset[axis] = moved[axis];
      }
    }
  }
  parameters_.set_point(first, offset);
  if (is_active) {
    activate_system(system, false);
  } else {
    emit_comment("interpreter: setting coordinate system origin");
  }
  return true;
}

Point FrameCodes::active_g92() const {
  return parameters_.get(g92_active_parameter) != 0 ? parameters_.point(g92_parameter) : Point{};
}

bool FrameCodes::set_g92(CodeNumber number) {
  Point offset;
  switch (number) {
    case code(92):
      offset = state_.frame.g92_offset();
      for (const Axis axis : all_axes) {
        if (words_.has(letter_of(axis))) offset[axis] += state_.position[axis] - axis_word(axis);
      }
      break;
    case code(52):
      offset = state_.frame.g92_offset();
      for (const Axis axis : all_axes) {
        if (words_.has(letter_of(axis))) offset[axis] = axis_word(axis);
      }
      break;
    case code(92, 3): offset = parameters_.point(g92_parameter); break;
    default: break;  // G92.1 and G92.2: no offset
  }
  const bool active = number == code(92) || number == code(52) || number == code(92, 3);
  parameters_.set(g92_active_parameter, active ? 1 : 0);
  if (number != code(92, 2)) parameters_.set_point(g92_parameter, offset);
  change_frame(operation::SetG92Offset{offset});
  return true;
}

// G51, as in grblHAL. X Y Z is the centre; a coordinate that is not given is the tool's. P is the factor of all three
// axes. I J K are the factors of X Y Z. A factor that is not given stays as it was.
bool FrameCodes::set_scaling() {
  constexpr char letters[] = {'I', 'J', 'K'};
  if (!words_.has('P') && !(words_.present() & LetterSet("IJK")).any()) {
    return fail("gcode.missing-word", words_.span(non_modal), "G51 without a factor",
                "P, one factor for X Y Z, or I J K, one factor each");
  }
  Scaling scaling = state_.scaling;
  if (!scaling.on) scaling.factors = {1, 1, 1};
  for (std::size_t i = 0; i < scaling.factors.size(); ++i) {
    const char letter = words_.has('P') ? 'P' : letters[i];
    if (words_.has('P') && words_.has(letters[i])) {
      return fail("gcode.unused-word", words_.span(letters[i]), fmt::format("{} together with P in G51", letters[i]),
                  "P, or I J K");
    }
    if (!words_.has(letter)) continue;
    if (words_[letter] == 0) {
      return fail("gcode.zero-scale", words_.span(letter), "a scaling factor of 0", "a factor other than 0");
    }
    scaling.factors[i] = words_[letter];
  }
  for (const Axis axis : all_axes) {
    if (words_.has(letter_of(axis)) && index_of(axis) >= scaling.factors.size()) {
      return fail("gcode.scale-axis", words_.span(letter_of(axis)),
                  fmt::format("{} in G51, which scales X Y Z", letter_of(axis)), "X, Y and Z, the centre");
    }
    scaling.center[axis] = words_.has(letter_of(axis)) ? axis_word(axis) : state_.position[axis];
  }
  scaling.on = true;
  state_.scaling = scaling;
  return true;
}

}  // namespace passo
