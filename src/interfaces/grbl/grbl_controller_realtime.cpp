// GrblController: what real-time commands do.
#include <algorithm>
#include <cmath>

#include "passo/grbl/grbl_controller.hpp"

namespace passo {
namespace {

int percent(double factor) {
  return static_cast<int>(std::lround(factor * 100));
}

constexpr int least_override = 10;
constexpr int most_override = 200;

// A factor changed by so many percent. 0: back to 100 %.
double changed(double factor, int by) {
  return by == 0 ? 1 : std::clamp(percent(factor) + by, least_override, most_override) / 100.0;
}

}  // namespace

void GrblController::act(std::uint8_t byte) {
  if (!drives_) return act_as_watcher(byte);
  switch (byte) {
    case '?': lease_.on_question(session_.now()); return report_status();
    case '!': return jogs() ? cancel_jog() : hold();
    case '~': return resume();
    case 0x18: return reset();
    case 0x84: return open_door();
    case 0x85: return cancel_jog();
    case 0x90: return change_feed(0);
    case 0x91: return change_feed(10);
    case 0x92: return change_feed(-10);
    case 0x93: return change_feed(1);
    case 0x94: return change_feed(-1);
    case 0x95: return change_rapids(100);
    case 0x96: return change_rapids(50);
    case 0x97: return change_rapids(25);
    case 0x99: return change_spindle(0);
    case 0x9A: return change_spindle(10);
    case 0x9B: return change_spindle(-10);
    case 0x9C: return change_spindle(1);
    case 0x9D: return change_spindle(-1);
    case 0x9E: return stop_spindle();
    case 0xA0: return switch_coolant(true);
    case 0xA1: return switch_coolant(false);
    default: return;
  }
}

// Everybody may hold. A reset greets, and stops nothing.
void GrblController::act_as_watcher(std::uint8_t byte) {
  switch (byte) {
    case '?': return report_status();
    case '!': ask(request::Hold{}); return;
    case 0x84: ask(request::Hold{.for_door = true}); return;
    case 0x18: return connect();
    default: return;
  }
}

// True: a line of the program moves the machine, or is held.
bool GrblController::is_executing() const {
  return session_.busy() && session_.state() != MachineState::await_line && !program_.jogs();
}

void GrblController::report_status() {
  const MachineStatus status = session_.status();
  GrblStatus report;
  report.state = state_name();
  report.machine_place = status.now_at;
  report.work_offset = program_.modes().frame.work_zero();
  report.planner_free = grbl_planner_blocks - std::min(program_.queued(), grbl_planner_blocks);
  report.bytes_free = input_.free();
  report.feed = status.speed_now.value() * seconds_per_minute;
  report.speed = status.outputs.spindle == SpindleDirection::off ? 0 : status.outputs.revolutions_per_minute;
  report.pins = pins();
  if (is_executing()) report.line_number = status.executes.line_number;
  report.outputs = status.outputs;
  report.feed_override = percent(status.overrides.feed);
  report.rapid_override = percent(status.overrides.rapids);
  report.spindle_override = percent(status.overrides.spindle);
  report_rotation_.choose(report, status.overrides, is_idle() || alarm_);
  say(status_text(report, units(), store_.memory().choices.status_mask));
}

// At rest too: then the next motion waits for a resume.
void GrblController::hold() {
  if (alarm_ || checks_ || resets_) return;
  if (session_.state() == MachineState::idle) request_stream();
  ask(request::Hold{});
}

// As a hold, also amid a jog. At rest the spindle and the coolant are off, until the resume.
void GrblController::open_door() {
  if (alarm_ || checks_ || resets_ || due_.waits_for_homing()) return;
  cancel_jog();
  if (session_.state() == MachineState::idle) request_stream();
  ask(request::Hold{.for_door = true});
}

// Only in a hold, at rest. The resume lets the spindle turn again.
void GrblController::stop_spindle() {
  const OutputState outputs = session_.status().outputs;
  ask(request::SwitchOutputs{.spindle_stands = outputs.spindle != SpindleDirection::off});
}

// While nothing is going on, the program switches the coolant itself, as by M7, M8 and M9. Amid the program the coolant
// stays as switched until the program orders something else.
void GrblController::switch_coolant(bool flood) {
  const MachineState state = session_.state();
  if (alarm_ || checks_ || resets_ || jogs() || state == MachineState::home) return;
  const OutputState outputs = session_.status().outputs;
  const bool on = !(flood ? outputs.flood : outputs.mist);
  if (session_.busy()) {
    ask(flood ? request::SwitchOutputs{.flood = on} : request::SwitchOutputs{.mist = on});
    return;
  }
  if (!is_idle()) return;
  const bool other = flood ? outputs.mist : outputs.flood;
  const std::string words = !on ? other ? flood ? "M9 M7" : "M9 M8" : "M9" : flood ? "M8" : "M7";
  static_cast<void>(program_.add_line(words, session_.now()));
}

void GrblController::resume() {
  if (session_.status().waits_for) ask(request::OperatorDone{});
  ask(request::Resume{});
}

// The jog may have come with the cancel, and wait as a line or in the queue.
void GrblController::cancel_jog() {
  input_.cancel_jogs();
  if (jogs() && !ask(request::DropLines{})) program_.drop(session_.status().position.place);
}

// Brakes on the path. The answer, the banner, comes when the machine rests.
void GrblController::reset() {
  input_.clear();
  due_.call_off();
  resets_ = true;
  stop_machine();
  if (session_.state() == MachineState::sleep) ask(request::Wake{});
  const MachineState state = session_.state();
  if (state == MachineState::alarm || state == MachineState::fault) ask(request::ResetMachine{});
}

void GrblController::end_reset() {
  resets_ = checks_ = false;
  ask(request::Override{.feed = 1, .adaptive_feed = {}, .spindle = 1, .rapids = 1});
  program_.restart(session_.status().position.place);
  alarm_ = alarm_ || session_.lost_place().has_value();
  has_started_ = false;
  connect();
  start_up();
}

void GrblController::change_feed(int by) {
  ask(request::Override{.feed = changed(session_.status().overrides.feed, by)});
}

void GrblController::change_rapids(int to) {
  ask(request::Override{.rapids = to / 100.0});
}

void GrblController::change_spindle(int by) {
  ask(request::Override{.spindle = changed(session_.status().overrides.spindle, by)});
}

}  // namespace passo
