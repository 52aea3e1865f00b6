// Executor: what moves the frame. G10, G28, G30, G43, G49, G54 … G59.3, G92.
#include <cmath>

#include "executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t systems = work_offset_count;

double rotation_of(const ModalState& state, std::size_t system) {
  return state.rotations[system];
}

}  // namespace

void Executor::emit_work_offset() {
  emit(operation::SetWorkOffset{.system = static_cast<std::uint8_t>(state_.work_system + 1),
                                .offset = state_.work_offsets[state_.work_system]});
  emit(operation::SetRotation{rotation_of(state_, state_.work_system)});
}

void Executor::work_offset(const BlockWords& words) {
  const CodeWord& code = words.code(ModalGroup::work_offset);
  if (!code) return;
  const std::int32_t number = code.code->number;
  change_frame([&] {
    state_.work_system = static_cast<std::size_t>(number <= 590 ? (number - 540) / 10 : 5 + number - 590);
    emit(operation::SetWorkOffset{.system = static_cast<std::uint8_t>(state_.work_system + 1),
                                  .offset = state_.work_offsets[state_.work_system]});
    emit(operation::SetG92Offset{state_.g92_active ? state_.g92_offset : Point()});
    emit(operation::SetRotation{rotation_of(state_, state_.work_system)});
  });
}

bool Executor::tool_length(BlockWords& words) {
  const CodeWord& code = words.code(ModalGroup::tool_length);
  if (!code) return true;
  Point offset;
  if (code.is(430)) {
    words.take('H');
    reporter_.warning("gcode.no-tool-table", code.span,
                      "there is no tool table yet: the tool's length is taken as zero",
                      "G43.1 with the length, or a work offset for each tool");
  }
  if (code.is(431)) {
    offset = state_.tool_offset;
    for (const Axis axis : all_axes) {
      if (words.has(letter_of(axis))) {
        offset[axis] = words.take(letter_of(axis)) * (is_rotary(axis) ? 1 : state_.scale());
      }
    }
  }
  change_frame([&] {
    state_.tool_offset = offset;
    emit(operation::SetToolOffset{offset});
  });
  return true;
}

bool Executor::non_modal(BlockWords& words) {
  const CodeWord& code = words.code(ModalGroup::non_modal);
  if (!code || code.is(40) || code.is(530)) return true;
  const Point machine = state_.frame.machine_from_work(state_.work);
  switch (code.code->number) {
    case 100: return set_work_offset(words);
    case 280: return go_home(words, 0);
    case 300: return go_home(words, 1);
    case 281: state_.homes[0] = machine; return true;
    case 301: state_.homes[1] = machine; return true;
    case 920:
      if (!words.has_axis_word()) {
        return reporter_.error("gcode.missing-value", code.span, "G92 says no axis", "at least one axis word");
      }
      set_g92(words);
      return true;
    default: break;
  }
  // G92.1 forgets the shift, G92.2 keeps it for G92.3.
  change_frame([&] {
    state_.g92_active = code.is(923);
    if (code.is(921)) state_.g92_offset = Point();
    emit(operation::SetG92Offset{state_.g92_active ? state_.g92_offset : Point()});
  });
  return true;
}

void Executor::set_g92(BlockWords& words) {
  Point offset = state_.g92_active ? state_.g92_offset : Point();
  Point work = state_.work;
  for (const Axis axis : all_axes) {
    if (!words.has(letter_of(axis))) continue;
    const double value = words.take(letter_of(axis)) * (is_rotary(axis) ? 1 : state_.scale());
    offset[axis] += work[axis] - value;
    work[axis] = value;
  }
  state_.g92_offset = offset;
  state_.g92_active = true;
  emit(operation::SetG92Offset{offset});
  state_.work = work;
}

bool Executor::system_of(BlockWords& words, std::size_t& system) {
  const double p = words.take_if('P').value_or(0);
  if (p < 0 || p > static_cast<double>(systems) || std::fabs(p - std::round(p)) > whole_number_tolerance) {
    return reporter_.error("gcode.value-out-of-range", words.span('P'), "P is no number of a work offset",
                           fmt::format("a whole number from 0 (the active one) to {} (G59.3)", systems));
  }
  const auto number = static_cast<std::size_t>(std::lround(p));
  system = number == 0 ? state_.work_system : number - 1;
  return true;
}

// G10 L2 says the offset itself, G10 L20 the work position that the tool is to have.
bool Executor::set_work_offset(BlockWords& words) {
  const double l = words.take_if('L').value_or(-1);
  if (l != 2 && l != 20) {
    return reporter_.error("gcode.unsupported-code", words.code(ModalGroup::non_modal).span,
                           words.has('L') ? fmt::format("G10 L{} is not supported by this release", l)
                                          : std::string("G10 does not say what to set"),
                           "L2 or L20");
  }
  std::size_t system = 0;
  if (!system_of(words, system)) return false;

  Point offset = state_.work_offsets[system];
  double rotation = state_.rotations[system];
  if (const auto r = words.take_if('R'); r && l == 2) rotation = *r;

  // What the tool's work position in that system is, and becomes.
  Frame frame = state_.frame;
  frame.follow({.what = operation::SetWorkOffset{.offset = offset}, .source = {}});
  frame.follow({.what = operation::SetRotation{rotation}, .source = {}});
  const Point machine = state_.frame.machine_from_work(state_.work);
  Point work = frame.work_from_machine(machine);
  for (const Axis axis : all_axes) {
    if (!words.has(letter_of(axis))) continue;
    const double value = words.take(letter_of(axis)) * (is_rotary(axis) ? 1 : state_.scale());
    (l == 2 ? offset : work)[axis] = value;
  }
  if (l == 20) offset = offset + machine - frame.machine_from_work(work);

  state_.rotations[system] = rotation;
  state_.work_offsets[system] = offset;
  if (system == state_.work_system) {
    change_frame([this] { emit_work_offset(); });
  } else {
    emit(operation::Comment{"interpreter: setting coordinate system origin"});
  }
  return true;
}

// By way of the point that the axis words say, to the home of those axes; without any, of all axes.
bool Executor::go_home(BlockWords& words, std::size_t which) {
  const bool some = words.has_axis_word();
  Point home = state_.frame.machine_from_work(state_.work);
  AxisSet axes;
  for (const Axis axis : all_axes) {
    if (!some || words.has(letter_of(axis))) axes.add(axis);
  }
  Point by_way;
  if (!end_point(words, by_way)) return false;
  home = state_.frame.machine_from_work(by_way);
  for (const Axis axis : all_axes) {
    if (axes.has(axis)) home[axis] = state_.homes[which][axis];
  }
  emit(operation::StraightTraverse{by_way});
  state_.work = state_.frame.work_from_machine(home);
  emit(operation::StraightTraverse{state_.work});
  return true;
}

}  // namespace passo
