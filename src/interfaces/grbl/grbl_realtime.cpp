// GrblController: what real-time commands do.
#include <algorithm>
#include <cmath>

#include "passo/grbl/grbl_controller.hpp"

namespace passo {
namespace {

// How many reports lie between two that show the work offset, or the overrides: at rest, and while the machine moves.
constexpr int offset_each_at_rest = 10;
constexpr int offset_each = 30;
constexpr int overrides_each_at_rest = 10;
constexpr int overrides_each = 20;

// A jog of a sender that asks for the status is cancelled when nothing was heard of the sender for its pace of asking
// and this time more. A sender that asks more slowly than that does not ask.
constexpr Seconds jog_lease{0.25};
constexpr Seconds slowest_pace{1};

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
    case '?': note_question(); return report_status();
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

void GrblController::note_question() {
  const Seconds now = session_.now();
  const bool asks_often = now - asked_at_ <= slowest_pace;
  pace_ = asks_often ? std::optional(now - asked_at_) : std::nullopt;
  asked_at_ = now;
}

// A sender that asks for the status again and again, and no longer does, hangs or is out of reach. So its key-up may
// never come.
void GrblController::mind_jog_lease() {
  if (pace_ && jogs() && session_.now() - heard_at_ > *pace_ + jog_lease) cancel_jog();
}

// True: a line of the program moves the machine, or is held.
bool GrblController::is_executing() const {
  return session_.busy() && session_.state() != MachineState::await_line && !program_.jogs();
}

void GrblController::report_status() {
  const MachineStatus status = session_.status();
  const bool rests = is_idle() || alarm_;
  GrblStatus report;
  report.state = state_name();
  report.machine_place = status.now_at;
  report.work_offset = program_.modes().frame.machine_from_work(Point());
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
  // What has changed is shown at once, the offset first. Else the two take turns, as in grbl.
  const bool has_moved = report.work_offset != told_offset_;
  const bool is_news = status.outputs != told_outputs_ || status.overrides != told_overrides_;
  report.shows_offset = has_moved || (offset_in_ <= 0 && !is_news);
  report.shows_overrides = !report.shows_offset && (is_news || overrides_in_ <= 0);
  if (report.shows_overrides) {
    told_outputs_ = status.outputs;
    told_overrides_ = status.overrides;
  }
  offset_in_ = report.shows_offset ? (rests ? offset_each_at_rest : offset_each) - 1 : offset_in_ - 1;
  overrides_in_ = report.shows_overrides ? (rests ? overrides_each_at_rest : overrides_each) - 1 : overrides_in_ - 1;
  if (report.shows_offset) told_offset_ = report.work_offset;
  say(status_text(report, units(), memory_.choices.status_mask));
}

// At rest too: then the next motion waits for a resume.
void GrblController::hold() {
  if (alarm_ || checks_ || resets_) return;
  if (session_.state() == MachineState::idle) request_stream();
  ask(request::Hold{});
}

// As a hold, also amid a jog. At rest the spindle and the coolant are off, until the resume.
void GrblController::open_door() {
  if (alarm_ || checks_ || resets_ || waits_ == Waits::homing) return;
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
  static_cast<void>(program_.take(words, session_.now()));
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
  after_stop_ = nullptr;
  homing_.reset();
  resets_ = true;
  stop_for(Waits::none);
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
