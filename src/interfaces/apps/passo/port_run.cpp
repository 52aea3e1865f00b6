#include "port_run.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "board_opening.hpp"
#include "program_input.hpp"
#include <fmt/format.h>

#include "passo/activity/stage_options.hpp"

namespace passo {
namespace {

constexpr double nanoseconds_a_second = 1e9;
constexpr std::string_view address = "sim:first_board";

}  // namespace

bool is_on_port(const std::string& board) {
  return board == address;
}

bool suits_the_port(const MachineDescription& machine, const std::string& file, bool anyway) {
  if (machine.motor_count() > port_axes) {
    fail(exit_bad_machine, fmt::format("{}: it has {} motors, but the first board has windings for {} [port.motors]",
                                       file, machine.motor_count(), port_axes));
    return false;
  }
  const double level_us = static_cast<double>(first_board_level) * 1e-3;
  // A machine file gives a pause the length of a pulse.
  if (anyway || machine.board.step_pulse.value() * 1e6 >= level_us) return true;
  const double highest = std::floor(1e6 / (2 * level_us) / 100) * 100;
  fail(exit_bad_machine,
       fmt::format("{}: step_pulse_us = {:g} is shorter than a turn of the first board's loop, so the PIC would not "
                   "sample every pulse: set step_pulse_us to {:g} or more, and max_event_rate_hz to {:.0f} or less. "
                   "With --anyway the run shows which pulses are lost [port.clock-too-fast]",
                   file, machine.board.step_pulse.value() * 1e6, level_us, highest));
  return false;
}

PortRun::PortRun(const MachineDescription& machine, MachineConnection& opened, std::unique_ptr<TemporaryFolder> folder,
                 std::unique_ptr<FollowerOnPort> board)
    : description_(machine),
      opened_(opened),
      kinematics_(kinematics_of(machine)),
      folder_(std::move(folder)),
      board_(std::move(board)),
      lines_(opened.session().now()) {}

void PortRun::record_path(OutputFile& file) {
  path_ = &file;
  file.write("(the way of the rotors, by passo run: machine coordinates)\nG21 G90 G94 F1000\n");
  board_->set_watch([this](Seconds time) { write_place(time); });
}

// A place for each step of any motor, just before the next step.
void PortRun::write_place(Seconds time) {
  constexpr double far_enough = 0.5;  // steps
  const MotorPositions places = opened_.plant().truth_at(time).positions;
  double farthest = 0;
  for (std::size_t m = 0; m < port_axes; ++m) farthest = std::max(farthest, std::abs(places[m] - written_[m]));
  if (farthest < far_enough) return;
  written_ = places;
  const Point place = kinematics_.axes(MotorPosition{places});
  std::string words = "G1";
  for (const AxisDescription& axis : description_.axes) {
    words += fmt::format(" {}{:.3f}", letter_of(axis.axis), place[axis.axis]);
  }
  path_->write(words + "\n");
}

std::unique_ptr<PortRun> PortRun::start(const MachineDescription& machine, MachineConnection& opened, int& code) {
  const std::filesystem::path image = built_follower("first_board");
  if (!std::filesystem::exists(image)) {
    code = fail(exit_failed, message_of_missing(image));
    return nullptr;
  }
  auto folder = std::make_unique<TemporaryFolder>();
  if (!folder->make()) {
    code = fail(exit_failed, "cannot create a temporary folder");
    return nullptr;
  }
  const auto pulse = std::llround(machine.board.step_pulse.value() * nanoseconds_a_second);
  auto board = FollowerOnPort::start(image, folder->name(), pulse, opened.plant());
  if (!board) {
    code = fail(exit_failed, fmt::format("{}: {}", address, board.error()));
    return nullptr;
  }
  std::unique_ptr<PortRun> run(new PortRun(machine, opened, std::move(folder), std::move(*board)));
  opened.machine().add_observer(*run);
  return run;
}

Nanoseconds PortRun::time_of(Ticks time) const {
  const auto clock = std::llround(description_.board.clock.value());
  const auto rest = static_cast<double>(time.count % clock) / static_cast<double>(clock);
  return time.count / clock * 1'000'000'000 + std::llround(rest * nanoseconds_a_second);
}

// A failure shows in poll().
void PortRun::on_steps(Ticks time, std::uint8_t stepped, std::uint8_t directions) {
  const Nanoseconds at = time_of(time);
  if (board_->pass_to(at)) board_->step(at, stepped, directions);
}

void PortRun::on_outputs(Ticks time, const BoardOutputs& outputs) {
  const bool is_on = (outputs.switches & OutputSwitch::spindle_on) != 0;
  if (is_on != std::exchange(tool_is_on_, is_on)) board_->switch_tool(time_of(time), is_on);
}

bool PortRun::poll() {
  const bool goes_on = board_->pass_to(time_of(opened_.machine().now()));
  find_lines();
  return goes_on;
}

void PortRun::find_lines() {
  const auto& lost = board_->lost_pulses();
  while (lines_of_lost_.size() < lost.size()) {
    const auto at = static_cast<double>(lost[lines_of_lost_.size()].at) / nanoseconds_a_second;
    lines_of_lost_.push_back(lines_.line_at(Seconds(at)));
  }
  lines_.forget_before(played() - Seconds(0.01));
}

void PortRun::finish() {
  static_cast<void>(board_->finish(time_of(opened_.machine().now())));
  find_lines();
}

Seconds PortRun::played() const {
  return Seconds(static_cast<double>(board_->played()) / nanoseconds_a_second);
}

PortSummary PortRun::summary() {
  PortSummary summary;
  summary.register_writes = board_->register_writes();
  summary.relay_closings = board_->relay_closings();
  summary.relay_is_closed = board_->relay_is_closed();
  if (path_ != nullptr) {
    write_place(played());
    path_->write("M2\n");
  }
  const Truth truth = opened_.plant().truth_at(played());
  const Point place = kinematics_.axes(MotorPosition{truth.positions});
  for (std::size_t m = 0; m < description_.axes.size(); ++m) {
    const AxisDescription& axis = description_.axes[m];
    const FollowerOnPort::Counts& counts = board_->counts(m);
    const int way = axis.inverted ? -1 : 1;
    summary.motors.push_back({.axis = axis.axis,
                              .commanded = counts.commanded,
                              .sampled = counts.sampled,
                              .commanded_net = way * counts.commanded_net,
                              .sampled_net = way * counts.sampled_net,
                              .true_net = way * truth.positions[m],
                              .true_end = place[axis.axis]});
  }
  const auto& lost = board_->lost_pulses();
  for (std::size_t i = 0; i < lost.size(); ++i) {
    summary.lost.push_back({.time = Seconds(static_cast<double>(lost[i].at) / nanoseconds_a_second),
                            .axis = description_.axes[lost[i].motor].axis,
                            .line = lines_of_lost_[i]});
  }
  return summary;
}

}  // namespace passo
