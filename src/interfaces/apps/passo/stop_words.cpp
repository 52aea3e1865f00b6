#include "stop_words.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "board_words.hpp"
#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"
#include "passo/session/stop_cause.hpp"

namespace passo {
namespace {

// Where the motors were by the board's counts when it said `status`.
Point counted_place(MachineConnection& opened, const MachineDescription& machine,
                    const std::optional<BoardStatus>& status) {
  const BoardMachineSession& session = opened.session();
  MotorPosition motors = motors_of(opened.machine().counts());
  if (session.zero_counts() && status) motors = steps_since(*session.zero_counts(), status->positions);
  return kinematics_of(machine).axes(motors);
}

// An axis whose drive has given its alarm. Only of motors with physics; empty: none has.
std::optional<StopCause> following_error(MachineConnection& opened, const MachineDescription& machine) {
  const RotorPlant* const rotors = opened.rotors();
  if (rotors == nullptr || !rotors->following_fault()) return std::nullopt;
  const FollowingFault& fault = *rotors->following_fault();
  std::size_t index = fault.motor;
  for (std::size_t m = 0; m < machine.axes.size(); ++m) {
    if (machine.axes[m].second && machine.second_motor_of(m) == fault.motor) index = m;
  }
  const AxisDescription& axis = machine.axes[index];
  return StopCause{
      .what = fmt::format("axis {} was {:.3g} {} from its commanded position ({:g} are allowed)", letter_of(axis.axis),
                          std::abs(fault.error) / kinematics_of(machine).steps_per_unit(axis.axis),
                          is_rotary(axis.axis) ? "degrees" : "mm", axis.encoder->most_error),
      .remedy = "find out what blocks the axis"};
}

std::string line_words(std::uint32_t line, const std::string& program) {
  return line == 0 ? "" : fmt::format(" in line {} of {}", line, program);
}

std::string remedy_for_place(const MachineDescription& machine, const std::string& program) {
  const bool homes = !machine.homing.empty();
  return fmt::format("{}{}",
                     homes ? "home the machine (passo home)" : "jog the machine to machine zero and use --from-here",
                     program.empty() ? "" : ", and restart the program from its beginning");
}

}  // namespace

std::string stop_words(MachineConnection& opened, const MachineDescription& machine, const std::string& program,
                       const LatestMotion& motion, std::uint32_t known_line) {
  const std::uint16_t stopped_by = opened.session().board().stopped_by();
  const std::string closed = closed_switches(opened.session().board());
  const auto& status = opened.session().board().status();
  if (!status) return std::string(message_of(LinkError::stopped)) + " [board.stopped]";
  const Point place = counted_place(opened, machine, status);
  const std::uint32_t line = known_line != 0 ? known_line : motion.line_at(place);
  const std::optional<StopCause> following = following_error(opened, machine);
  StopCause cause = following.value_or(stop_cause(stopped_by != 0 ? stopped_by : status->inputs, machine));
  if (cause.remedy.empty()) {
    cause = {.what = "a limit switch or the emergency stop closed, and is open again", .remedy = "check its wiring"};
  }
  return fmt::format("{}{}: the motors stopped instantly near {}, and steps may be lost. To continue, {}, {} [{}]{}",
                     cause.what, line_words(line, program), place_words(machine, place), cause.remedy,
                     remedy_for_place(machine, program), following ? "run.following-error" : "board.stopped", closed);
}

std::string slip_words(MachineConnection& opened, const MachineDescription& machine, const std::string& program,
                       std::uint32_t line) {
  return fmt::format(
      "it stalled during motion{}, because it could not make its events in time; steps may be lost. The machine was "
      "near {}. To continue, lower max_event_rate_hz in the machine file, {} [board.slipped]",
      line_words(line, program),
      place_words(machine, counted_place(opened, machine, opened.session().board().standstill())),
      remedy_for_place(machine, program));
}

std::uint32_t line_of_standstill(MachineConnection& opened, const MachineDescription& machine,
                                 const LatestMotion& motion) {
  return motion.line_at(counted_place(opened, machine, opened.session().board().standstill()));
}

}  // namespace passo
