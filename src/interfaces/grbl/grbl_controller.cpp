// GrblController: lines, and what has happened.
#include "passo/grbl/grbl_controller.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "passo/activity/machine_plant.hpp"
#include "passo/interpreter/grbl_errors.hpp"
#include "passo/session/board_machine_session.hpp"
#include "passo/session/confirmed_place.hpp"

namespace passo {
namespace {

// Words by which a program changes what is kept: offsets, and the homes of G28 and G30.
bool changes_offsets(const std::string& line) {
  return line.find("G10") != std::string::npos || line.find("G28.1") != std::string::npos ||
         line.find("G30.1") != std::string::npos;
}

bool is_off(const OutputState& outputs) {
  return outputs.spindle == SpindleDirection::off && !outputs.mist && !outputs.flood;
}

// A board that fails has raised its own alarm before: then no switch was met.
GrblAlarm alarm_of_homing(const MachineChange& change) {
  if (change.outcome == Outcome::stopped) return GrblAlarm::homing_stopped;
  if (!change.fault || is_of_board(change.fault->fault)) return GrblAlarm::homing_no_switch;
  const GrblAlarm alarm = row_of(change.fault->fault).alarm;
  return alarm == GrblAlarm::none ? GrblAlarm::homing_no_switch : alarm;
}

// Lines that change nothing.
bool is_question(const std::string& line) {
  return line == "$" || line == "$G" || line == "$$" || line == "$#" || line == "$I" || line == "$I+" || line == "$N" ||
         line.starts_with("$E");
}

}  // namespace

GrblController::GrblController(const MachineDescription& machine, MachineSession& session, StreamedProgram& program)
    : machine_(machine), session_(session), program_(program), store_(machine) {
  alarm_ = has_lost_place();
}

void GrblController::connect() {
  is_here_ = true;
  input_.clear();
  report_rotation_.begin();
  lease_.end();
  say(std::string(grbl_banner));
  if (!drives_) say("[MSG:Another client is in control]\r\n");
  if (alarm_) say("[MSG:'$H'|'$X' to unlock]\r\n");
}

void GrblController::start_up() {
  if (drives_ && !resets_ && !std::exchange(has_started_, true)) run_startup();
}

// Not while the controller is locked: they may move the machine.
void GrblController::run_startup() {
  for (const std::string& line : store_.memory().startup) {
    if (alarm_) return;
    if (line.empty()) continue;
    const auto wrong = program_.add_line(line, session_.now());
    const bool is_beyond = wrong && wrong->code == travel_exceeded;
    if (is_beyond) stop_at_soft_limit();
    const int error = wrong && !is_beyond ? number_of(*wrong) : 0;
    say(fmt::format(">{}:{}", line, error == 0 ? "ok\r\n" : fmt::format("error:{}\r\n", error)));
  }
}

// As grbl: what was sent before is held, and the rest is not executed.
void GrblController::stop_at_soft_limit() {
  hold();
  raise(GrblAlarm::soft_limit);
  say("[MSG:Reset to continue]\r\n");
}

// grbl checks the travel only while it moves.
int GrblController::number_of(const Diagnostic& wrong) {
  if (wrong.code == travel_exceeded) return static_cast<int>(GrblError::invalid_target);
  return grbl_error_number(wrong.code).value_or(static_cast<int>(GrblError::unsupported));
}

void GrblController::apply_offsets(const SavedParameters& parameters) {
  program_.apply_offsets(parameters, session_.status().position.place);
}

// The disk may take its time while nothing moves.
void GrblController::share_changed_offsets() {
  const bool rests = !session_.busy() || session_.state() == MachineState::await_line;
  if (!offsets_changed_ || !rests) return;
  offsets_changed_ = false;
  if (share_offsets_) share_offsets_(program_.parameters());
}

// A program that is held goes on with the next one who may drive.
void GrblController::let_drive(bool drives) {
  if (drives == drives_) return;
  drives_ = drives;
  if (due_.call_off()) answer(GrblError::locked);
  checks_ = resets_ = false;
  alarm_ = has_lost_place();
  if (!session_.busy()) program_.go_on_at(session_.status().position.place);
  say(drives ? "[MSG:This sender is in control]\r\n" : "[MSG:Another client is in control]\r\n");
}

void GrblController::disconnect() {
  is_here_ = false;
  input_.clear();
  if (!drives_) return;
  if (jogs()) {
    cancel_jog();
  } else if (!is_idle() && !due_.is_due()) {
    hold();
  }
}

void GrblController::receive(std::string_view bytes) {
  lease_.on_byte(session_.now());
  input_.receive(bytes, [this](std::uint8_t byte) { act(byte); });
  start_up();
}

std::vector<std::string> GrblController::take_replies() {
  return std::exchange(replies_, {});
}

void GrblController::poll(const std::vector<MachineChange>& changes) {
  for (const MachineChange& change : changes) on_change(change);
  if (due_.waits_for_probe() && !program_.asks()) end_probe();
  if (NumberedSettings* const board = session_.numbered_settings()) {
    if (const auto trouble = board->poll_write()) end_write(*trouble);
  }
  if (!session_.busy()) {
    if (const auto next = due_.take_rest()) next();
  }
  if (resets_ && !session_.busy() && session_.state() != MachineState::offline) end_reset();
  share_changed_offsets();
  if (jogs() && lease_.is_over(session_.now())) cancel_jog();
  begin_stream();
  handle_lines();
  end_stream();
}

void GrblController::on_change(const MachineChange& change) {
  switch (change.kind) {
    case MachineChange::Kind::state:
      if (change.state == MachineState::alarm) raise_alarm_of_board();
      if (change.state == MachineState::fault) raise(GrblAlarm::lost_place);
      if (change.state == MachineState::run) wait_told_ = false;
      if (change.state == MachineState::await_line) stream_.record_rest(change.time);
      return;
    case MachineChange::Kind::came_to_rest: return report_wait();
    case MachineChange::Kind::position_lost: return raise(GrblAlarm::lost_place);
    case MachineChange::Kind::probed: probe_ = change.probe; return;
    case MachineChange::Kind::answered: break;
    default: return;
  }
  stream_.on_answer(change.ticket);
  if (!due_.take_homing(change.ticket)) return;
  program_.go_on_at(session_.status().position.place);
  if (change.outcome == Outcome::done) {
    alarm_ = session_.lost_place().has_value();  // the axes without a switch
    run_startup();
    return answer(GrblError::none);
  }
  raise(alarm_of_homing(change));
  answer(GrblError::locked);
}

// What the program says where it waits for a person, once.
void GrblController::report_wait() {
  const auto wait = session_.status().waits_for;
  if (!wait || std::exchange(wait_told_, true)) return;
  if (wait->kind == Action::Kind::tool_change) say(fmt::format("[MSG:Tool {}]\r\n", wait->tool));
  std::istringstream lines(wait->words);
  for (std::string words; std::getline(lines, words);) say(fmt::format("[MSG:{}]\r\n", words));
}

// The probe move is done, and its line can be answered.
void GrblController::end_probe() {
  due_.call_off();
  const bool failed = program_.answer_fault().has_value();
  if (failed)
    raise(row_of(probe_ && probe_->refused ? MachineFault::probe_before : MachineFault::probe_untouched).alarm);
  if (!probe_ || !probe_->refused) say(probe_text(probe_, units()));
  report_end();
  answer(GrblError::none);
}

// Grbl's numbers do not tell what it was, so a message does.
void GrblController::raise_alarm_of_board() {
  const BoardMachineSession* const own = session_.as_board_session();
  const bool is_drive = own != nullptr && (own->board().stopped_by() & pin_setup(machine_).alarms) != 0;
  raise(is_drive ? GrblAlarm::motor_fault : GrblAlarm::hard_limit);
  say("[MSG:" + session_.trouble_words() + "]\r\n");
}

// Then a sender has to home the machine or, by $X, to state that it stands where it is shown.
bool GrblController::has_lost_place() const {
  return session_.lost_place().has_value() ||
         (!machine_.homing.empty() && session_.status().position.trust == Trust::unknown);
}

void GrblController::raise(GrblAlarm alarm) {
  alarm_ = true;
  say(fmt::format("ALARM:{}\r\n", static_cast<int>(alarm)));
}

// Ends what goes on, at rest on the path.
void GrblController::stop_machine() {
  if (session_.busy()) ask(request::Stop{});
}

// The program's place is the machine's whenever a stream begins.
void GrblController::begin_stream() {
  if (session_.state() != MachineState::idle || resets_ || due_.waits_for_homing() || !drives_) return;
  if (program_.is_to_begin(session_.now())) request_stream();
}

void GrblController::request_stream() {
  const auto ticket = session_.request(request::Stream{.program = &program_});
  stream_.begin(ticket ? std::optional(*ticket) : std::nullopt);
}

// The lines are done, and have left nothing on: the machine is idle, for others too. A sender that answers within a
// second goes on with the same stream.
void GrblController::end_stream() {
  if (session_.state() != MachineState::await_line || !stream_.may_end(session_.now(), is_here_)) return;
  if (program_.queued() > 0 || program_.asks() || !is_off(session_.status().outputs)) return;
  if (ask(request::Stop{})) stream_.note_asked_to_end();
}

bool GrblController::may_take_line() const {
  if (due_.is_due() || resets_) return false;
  const MachineState state = session_.state();
  return state != MachineState::offline && program_.room();
}

void GrblController::handle_lines() {
  while (may_take_line()) {
    const auto line = input_.pop_line();
    if (!line) return;
    handle(*line);
  }
}

void GrblController::handle(const GrblInput::Line& line) {
  if (line.too_long) return answer(GrblError::line_overflow);
  const bool may_act = drives_ && !alarm_ && !jogs() && session_.state() != MachineState::sleep;
  const std::string message = line.message.empty() ? "" : "(MSG," + line.message + ")";
  if (line.text.empty()) {
    if (may_act && !checks_ && !message.empty()) static_cast<void>(program_.add_line(message, session_.now()));
    return answer(GrblError::none);
  }
  if (!drives_ && !is_question(line.text)) return answer(GrblError::locked);
  if (line.cancelled && line.text.starts_with(jog_begins)) return answer(GrblError::none);
  if (line.text[0] == '$') return handle_command(line.text);
  if (!may_act) return answer(GrblError::locked);
  handle_code(line.text + message);
}

void GrblController::handle_code(const std::string& text) {
  probe_ = program_.asks() ? std::nullopt : probe_;
  if (machine_.tool_change != nullptr) program_.allow_tool_changes(checks_ || is_place_confirmed(session_));
  const auto wrong = checks_ ? program_.check(text) : program_.add_line(text, session_.now());
  if (wrong) {
    if (checks_ || wrong->code != travel_exceeded) return answer(number_of(*wrong));
    stop_at_soft_limit();
    return answer(GrblError::none);
  }
  offsets_changed_ = offsets_changed_ || (!checks_ && changes_offsets(text));
  if (program_.asks()) {
    due_.wait_for_probe();
    return begin_stream();
  }
  report_end();
  begin_stream();
  answer(GrblError::none);
}

void GrblController::report_end() {
  if (program_.take_ended()) say("[MSG:Pgm End]\r\n");
}

void GrblController::answer(int error) {
  say(error == 0 ? std::string("ok\r\n") : fmt::format("error:{}\r\n", error));
}

bool GrblController::jogs() const {
  if (!program_.jogs()) return false;
  return program_.queued() > 0 || session_.state() == MachineState::run;
}

bool GrblController::is_idle() const {
  const MachineState state = session_.state();
  return (state == MachineState::idle || state == MachineState::await_line) && program_.queued() == 0 &&
         !program_.asks() && !alarm_ && !checks_ && !due_.is_due();
}

std::string_view GrblController::state_name() const {
  const MachineState state = session_.state();
  const MachineStatus status = session_.status();
  switch (state) {
    case MachineState::home: return "Home";
    case MachineState::sleep: return "Sleep";
    case MachineState::alarm:
    case MachineState::fault: return "Alarm";
    default: break;
  }
  if (alarm_) return "Alarm";
  switch (state) {
    case MachineState::hold:
    case MachineState::tool_change: return status.rests ? "Hold:0" : "Hold:1";
    case MachineState::door: return !status.rests ? "Door:2" : (status.inputs & input_door) != 0 ? "Door:1" : "Door:0";
    case MachineState::run:
    case MachineState::probe: break;
    case MachineState::jog: return "Jog";
    default:
      if (checks_) return "Check";
      if (program_.queued() == 0 && !program_.asks()) return "Idle";
  }
  return program_.jogs() ? "Jog" : "Run";
}

// Limits and the probe. Never the start button: a sender begins a job of its own when it sees that.
std::string GrblController::pins() const {
  const unsigned inputs = session_.status().inputs;
  std::string letters;
  if ((inputs & input_probe) != 0) letters += 'P';
  for (const AxisDescription& axis : machine_.axes) {
    if (axis.home && (inputs & axis.home_switches()) != 0) letters += letter_of(axis.axis);
  }
  if ((inputs & input_door) != 0) letters += 'D';
  if ((inputs & input_hold) != 0) letters += 'H';
  return letters;
}

GrblUnits GrblController::units() const {
  return {.axes = grbl_axes_of(machine_), .inches = store_.memory().choices.inches};
}

}  // namespace passo
