#include "passo/machine/virtual_machine.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

namespace passo {

namespace {

BoardIdentity identity_of(std::uint8_t motors, Hertz clock, Hertz highest_event_rate, std::size_t places) {
  const auto ticks = static_cast<std::uint32_t>(std::llround(clock.value()));
  const auto rate = static_cast<std::uint32_t>(std::ceil(highest_event_rate.value()));
  return {.motors = motors,
          .clock = ticks,
          .shortest_interval = shortest_interval(ticks, rate),
          .about = {.highest_event_rate = rate, .name = "virtual machine"},
          .places = static_cast<std::uint8_t>(places)};
}

}  // namespace

VirtualMachine::VirtualMachine(std::uint8_t motors, Hertz clock, Hertz highest_event_rate, std::size_t places)
    : identity_(identity_of(motors, clock, highest_event_rate, places)),
      board_(hardware_, identity_),
      clock_(clock),
      motor_count_(motors),
      tenth_(std::max<std::int64_t>(std::llround(clock.value() / 10), 1)),
      next_tenth_(tenth_) {
  hardware_.seconds_a_tick = 1 / clock.value();
  hardware_.plant = &own_plant_;
}

void VirtualMachine::connect(Plant& plant) {
  hardware_.plant = &plant;
  update_inputs();
}

void VirtualMachine::stand_at(const MotorSteps& positions) {
  hardware_.pulse_plant();
  for (std::size_t m = 0; m < positions.size(); ++m) hardware_.motors[m].position = positions[m];
  hardware_.pulsed = positions;
}

void VirtualMachine::wire(const PinSetup& wiring) {
  hardware_.wiring = wiring;
  update_inputs();
}

void VirtualMachine::receive(std::span<const std::uint8_t> bytes) {
  if (board_.idle()) waits_ = false;  // the board may have stopped before its event
  for (const std::uint8_t byte : bytes) {
    board_.receive(byte);
    if (std::exchange(hardware_.is_new_setup, false)) update_inputs();
  }
  if (board_.owes_report()) board_.report();
}

bool VirtualMachine::run(Seconds most) {
  const double ticks = clock_ * most;
  return run_to(Ticks{ticks < 9e18 ? hardware_.now + std::llround(ticks) : INT64_MAX});
}

bool VirtualMachine::run_to(Ticks time) {
  const std::int64_t end = time.count;
  check_inputs();
  while (hardware_.to_host.empty() && !board_.idle()) {
    if (!waits_) {
      const std::int64_t interval = board_.ticks_to_next_event();
      shortest_event_interval_ = std::min(shortest_event_interval_, interval);
      next_event_ = hardware_.now + interval;
    }
    waits_ = next_event_ > end;
    if (waits_) break;
    hardware_.now = next_event_;
    ++events_;
    board_.on_event();
    if (hardware_.now >= next_tenth_) count_silence();
    if (--look_in_ <= 0) update_inputs();
    if (board_.owes_report()) board_.report();
  }
  hardware_.pulse_plant();
  if (!hardware_.to_host.empty()) return true;
  if (end == INT64_MAX || end <= hardware_.now) return false;
  for (; next_tenth_ <= end && board_.idle(); count_silence()) hardware_.now = std::max(hardware_.now, next_tenth_);
  hardware_.now = end;
  count_silence();
  return false;
}

void VirtualMachine::count_silence() {
  for (; next_tenth_ <= hardware_.now; next_tenth_ += tenth_) board_.count_silence();
}

void VirtualMachine::set_switch(std::uint16_t which, bool closed) {
  hardware_.plant->set_switch(which, closed);
  update_inputs();
}

void VirtualMachine::update_inputs() {
  hardware_.pulse_plant();
  look_in_ = hardware_.plant->events_to_next_change();
  check_inputs();
}

void VirtualMachine::check_inputs() {
  const unsigned misread = hardware_.wiring.inputs ^ unsigned { hardware_.setup.inputs };
  const unsigned inputs = hardware_.plant->inputs_at(hardware_.time()) ^ misread;
  if (inputs != told_) on_inputs(inputs);
}

// Does what the firmware's main loop does: captures a watched input, tells the host what a person presses, and stops at
// an input that stops, with the outputs off.
void VirtualMachine::on_inputs(unsigned now) {
  const unsigned changed = now ^ std::exchange(told_, static_cast<std::uint16_t>(now));
  const unsigned by_people = pressed_by_people(hardware_.alarms());
  const unsigned on = changed & now;
  board_.set_inputs(told_, static_cast<std::uint16_t>((changed & board_.watched()) | (on & by_people)));
  const unsigned stops = on & board_.stopping();
  if ((stops & stopping_at_rest(hardware_.alarms())) == 0 && (stops == 0 || board_.idle())) return;
  hardware_.switch_off();
  if ((stops & input_emergency_stop) != 0) hardware_.drivers_on = false;
  board_.stop_at_once(told_);
}

void VirtualMachine::reset_board() {
  hardware_.pulse_plant();
  std::destroy_at(&board_);
  std::construct_at(&board_, hardware_, identity_);
  waits_ = false;
  hardware_.to_host.clear();
  hardware_.switch_off();
  hardware_.setup = {};
  told_ = 0;
  update_inputs();
}

void VirtualMachine::stand_still(Ticks time) {
  assert(waits_);
  next_event_ += time.count;
  board_.player().slip();
}

void VirtualMachine::wait(Ticks time) {
  assert(board_.idle() && time.count >= 0);
  hardware_.now += time.count;
  count_silence();
}

std::span<const std::uint8_t> VirtualMachine::replies() {
  taken_.clear();
  taken_.swap(hardware_.to_host);
  return taken_;
}

void VirtualMachine::Hardware::step(std::uint8_t stepped, std::uint8_t directions) {
  const unsigned turned = (directions ^ last_directions) & stepped;
  for (unsigned left = stepped; left != 0; left &= left - 1) {
    const auto m = static_cast<unsigned>(std::countr_zero(left));
    Motor& motor = motors[m];
    motor.position += (directions >> m & 1U) != 0 ? -1 : 1;
    // The first step has no step before it.
    if (motor.total++ != 0) motor.shortest_interval = std::min(motor.shortest_interval, now - motor.last_step);
    motor.last_step = now;
  }
  if (turned != 0) {
    for (unsigned left = turned; left != 0; left &= left - 1) {
      Motor& motor = motors[static_cast<unsigned>(std::countr_zero(left))];
      if (motor.total > 1) ++motor.reversals;
    }
    last_directions = static_cast<std::uint8_t>(last_directions ^ turned);
  }
  for (MachineObserver* observer : observers) observer->on_steps(Ticks{now}, stepped, directions);
}

void VirtualMachine::Hardware::outputs(const BoardOutputs& wanted) {
  outputs_now = wanted;
  const bool reverse = (wanted.switches & OutputSwitch::spindle_reverse) != 0;
  const bool on = (wanted.switches & OutputSwitch::spindle_on) != 0;
  const double rpm = on ? wanted.spindle_rpm : 0;
  pulse_plant();
  plant->command_spindle(time(), reverse ? -rpm : rpm);
  ++output_changes;
  for (MachineObserver* observer : observers) observer->on_outputs(Ticks{now}, wanted);
}

void VirtualMachine::Hardware::switch_off() {
  if (outputs_now.switches != 0) outputs({});
}

bool VirtualMachine::Hardware::switch_off(std::uint8_t switches) {
  BoardOutputs left = outputs_now;
  left.switches = static_cast<std::uint8_t>(left.switches & ~switches);
  if (left.switches == outputs_now.switches) return false;
  if ((switches & OutputSwitch::spindle_on) != 0) left.spindle_rpm = 0;
  outputs(left);
  return true;
}

SpindleCount VirtualMachine::Hardware::spindle() const {
  SpindleCount count = plant->spindle().count_at(time());
  count.tick = static_cast<std::uint32_t>(now);
  return count;
}

void VirtualMachine::Hardware::pulse_plant() {
  MotorSteps steps{};
  bool any = false;
  for (std::size_t m = 0; m < motors.size(); ++m) {
    steps[m] = motors[m].position - pulsed[m];
    any = any || steps[m] != 0;
  }
  if (!any) return;
  for (std::size_t m = 0; m < motors.size(); ++m) pulsed[m] = motors[m].position;
  if (drivers_on != drivers_obey()) return;  // motors without current do not follow
  plant->pulse(time(), steps);
}

MachineCounts VirtualMachine::counts() const {
  const auto shortest = [](std::int64_t interval) { return Ticks{interval == INT64_MAX ? 0 : interval}; };
  MachineCounts counts;
  counts.motor_count = motor_count_;
  for (std::size_t m = 0; m < motor_count_; ++m) {
    const Hardware::Motor& motor = hardware_.motors[m];
    counts.motors[m] = {.position = motor.position,
                        .total = motor.total,
                        .reversals = motor.reversals,
                        .last_step = Ticks{motor.last_step},
                        .shortest_interval = shortest(motor.shortest_interval)};
  }
  counts.time = now();
  counts.events = events_;
  counts.shortest_event_interval = shortest(shortest_event_interval_);
  counts.outputs = hardware_.outputs_now;
  counts.output_changes = hardware_.output_changes;
  return counts;
}

}  // namespace passo
