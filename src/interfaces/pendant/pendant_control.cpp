#include "passo/pendant/pendant_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/api/api_routes.hpp"

namespace passo {
namespace {

using Json = nlohmann::ordered_json;

constexpr double override_step = 0.1;
constexpr double least_override = 0.1;
constexpr double most_override = 2;
constexpr Seconds shows_again_after{1};

char key_of(Axis axis) {
  return static_cast<char>(letter_of(axis) - 'A' + 'a');
}

double changed(double factor, double by) {
  return std::clamp(std::round((factor + by) * 100) / 100, least_override, most_override);
}

// What an error of the API says.
Sentence sentence_in(const std::string& body) {
  const Json answer = Json::parse(body, nullptr, false);
  const Json error = answer.is_object() ? answer.value("error", Json()) : Json();
  if (!error.is_object()) return {.code = "pendant.refused", .text = "the request was refused"};
  Sentence sentence{.code = {}, .text = error.value("message", "")};
  const Json said = error.value("sentence", Json());
  if (!said.is_object()) return sentence;
  sentence.code = said.value("code", "");
  const Json arguments = said.value("arguments", Json::object());
  for (const auto& [name, value] : arguments.items()) {
    if (value.is_string()) sentence.arguments.emplace_back(name, value.get<std::string>());
  }
  return sentence;
}

}  // namespace

PendantControl::PendantControl(const PendantTable& table, const PendantMachine& machine, PendantStatus& status)
    : table_(table),
      to_(machine),
      status_(status),
      decoder_(table),
      jog_(machine.machine, *this, table.wheel ? table.wheel->pause : PendantTable::Wheel().pause) {
  if (!table.step_byte && !table.steps.empty()) choose_step(0);
}

void PendantControl::connect(Seconds now) {
  heard_at_ = now;
  status_.name = table_.name;
  status_.is_connected = status_.has_link = true;
  status_.refusal = {};
  has_shown_ = false;
}

void PendantControl::disconnect(Seconds now) {
  now_ = now;
  lose_link();
  status_.is_connected = false;
}

// What a held key or a turned ring has begun ends, and begins again only after another press.
void PendantControl::lose_link() {
  jog_.end();
  decoder_.forget();
  modifies_ = false;
  status_.has_link = false;
}

void PendantControl::receive(std::span<const std::uint8_t> report, Seconds now) {
  now_ = heard_at_ = now;
  if (report.size() == table_.length) status_.has_link = true;
  for (const PendantEvent& event : decoder_.decode(report)) handle(event, now);
}

void PendantControl::handle(const PendantEvent& event, Seconds now) {
  using Kind = PendantEvent::Kind;
  const auto position = static_cast<std::size_t>(std::abs(event.number));
  switch (event.kind) {
    case Kind::wheel: return turn_wheel(event.number, now);
    case Kind::ring:
      return jog_.hold_ring(event.number > 0 ? 1 : (event.number < 0 ? -1 : 0),
                            position > 0 ? table_.ring->shares[position - 1] : 1);
    case Kind::axis:
      jog_.select(event.axis);
      status_.axis = event.axis;
      return;
    case Kind::step: return choose_step(event.number);
    case Kind::press: return press(*event.key);
    case Kind::release:
      if (event.key->action.kind == PendantAction::Kind::modifier) modifies_ = false;
      return;
    case Kind::link_lost: return lose_link();
    case Kind::link_is_back: return;
  }
}

void PendantControl::turn_wheel(int detents, Seconds now) {
  if (step_ < 0) return;
  const PendantStep& step = table_.steps[static_cast<std::size_t>(step_)];
  if (status_.is_continuous) {
    jog_.turn(detents, step.share, now);
  } else {
    jog_.step(detents, step.step, table_.step_share, now);
  }
}

void PendantControl::choose_step(int index) {
  if (index != step_) jog_.end();
  step_ = index;
  const PendantStep step = index < 0 ? PendantStep() : table_.steps[static_cast<std::size_t>(index)];
  status_.step = step.step;
  status_.share = step.share;
}

void PendantControl::choose_mode(bool is_continuous) {
  if (is_continuous != status_.is_continuous) jog_.end();
  status_.is_continuous = is_continuous;
}

void PendantControl::press(const PendantKey& key) {
  using Kind = PendantAction::Kind;
  if (key.action.kind == Kind::modifier) {
    modifies_ = true;
    return;
  }
  status_.refusal = {};
  act(modifies_ ? key.with_modifier : key.action);
}

void PendantControl::act(const PendantAction& action) {
  using Kind = PendantAction::Kind;
  const int last = static_cast<int>(table_.steps.size()) - 1;
  switch (action.kind) {
    case Kind::none:
    case Kind::modifier: return;
    case Kind::start: return start();
    case Kind::hold: jog_.end(); return record_refusal(ask("/hold"));
    case Kind::stop: jog_.end(); return record_refusal(ask("/stop"));
    case Kind::reset: return reset();
    case Kind::home: return static_cast<void>(ask_in_control("/home", "{}"));
    case Kind::go: return static_cast<void>(ask_in_control("/go", Json({{"to", action.word}}).dump()));
    case Kind::macro: return static_cast<void>(ask_in_control("/macros", Json({{"name", action.word}}).dump()));
    case Kind::zero: return zero(action.axis);
    case Kind::select_axis:
      jog_.select(action.axis);
      status_.axis = action.axis;
      return;
    case Kind::step_mode: return choose_mode(false);
    case Kind::continuous_mode: return choose_mode(true);
    case Kind::other_mode: return choose_mode(!status_.is_continuous);
    case Kind::coarser: return choose_step(std::min(step_ + 1, last));
    case Kind::finer: return choose_step(std::min(std::max(step_ - 1, 0), last));
    case Kind::feed_up: return change_override(override_step, 0);
    case Kind::feed_down: return change_override(-override_step, 0);
    case Kind::spindle_up: return change_override(0, override_step);
    case Kind::spindle_down: return change_override(0, -override_step);
    case Kind::spindle_stop: return stop_spindle();
  }
}

// One key starts what waits for the operator, resumes what is held, and holds what runs.
void PendantControl::start() {
  const MachineStatus status = to_.session.status();
  switch (status.state) {
    case MachineState::run:
    case MachineState::home:
    case MachineState::probe:
    case MachineState::jog: jog_.end(); return record_refusal(ask("/hold"));
    case MachineState::hold:
    case MachineState::door:
      if (has_sender_program()) return resume_sender();
      return static_cast<void>(ask_in_control(status.waits_for ? "/operator-done" : "/resume"));
    default: return static_cast<void>(ask_in_control("/operator-done"));
  }
}

// As a cycle start button of the board does.
void PendantControl::resume_sender() {
  const auto ticket = to_.session.request(request::Resume{});
  if (!ticket) status_.refusal = ticket.error().sentence();
}

void PendantControl::reset() {
  jog_.end();
  if (to_.session.busy()) return record_refusal(ask("/stop"));
  ask_in_control("/reset");
}

void PendantControl::zero(std::optional<Axis> axis) {
  const std::optional<Axis> which = axis ? axis : jog_.axis();
  if (!which) return;
  ask_in_control("/work", fmt::format(R"({{"place": {{"{}": 0}}}})", key_of(*which)));
}

void PendantControl::stop_spindle() {
  const bool turns = to_.session.status().outputs.spindle != SpindleDirection::off;
  ask_in_control("/outputs", Json({{"spindle_stands", turns}}).dump());
}

// The operator at the machine changes the overrides of any job, as everybody may hold it.
void PendantControl::change_override(double feed, double spindle) {
  const Overrides overrides = to_.session.status().overrides;
  request::Override wanted;
  if (feed != 0) wanted.feed = changed(overrides.feed, feed);
  if (spindle != 0) wanted.spindle = changed(overrides.spindle, spindle);
  const auto ticket = to_.session.request(wanted);
  if (!ticket) status_.refusal = ticket.error().sentence();
}

PendantControl::Answer PendantControl::ask(std::string_view path, const std::string& body) {
  const WebAnswer answer = to_.api.answer({.method = "POST",
                                           .path = std::string(api_root) + std::string(path),
                                           .key = key_,
                                           .type = body.empty() ? "" : "application/json",
                                           .body = body});
  return {.status = answer.status, .body = answer.body};
}

bool PendantControl::ask_in_control(std::string_view path, const std::string& body) {
  used_at_ = now_;
  if (!take_control()) return false;
  const Answer answer = ask(path, body);
  record_refusal(answer);
  return answer.is_good();
}

// It stays while the pendant can still say it: an idle machine has nothing to hold.
void PendantControl::record_refusal(const Answer& answer) {
  if (!answer.is_good()) status_.refusal = sentence_in(answer.body);
}

bool PendantControl::take_control() {
  if (to_.owner.is_client(key_)) return true;
  // Another client that takes control would end the sender's program.
  if (has_sender_program()) {
    status_.refusal = {.code = "machine.busy", .text = "the machine is busy"};
    return false;
  }
  MachineControl before = to_.owner;
  const Answer answer = ask("/owner", Json({{"name", table_.name}}).dump());
  record_refusal(answer);
  if (!answer.is_good()) return false;
  key_ = Json::parse(answer.body, nullptr, false).value("key", "");
  before_ = std::move(before);
  return true;
}

// A job that is about to start is of the one who has asked for it. While a job runs, nobody must not have control: a
// sender would take it.
void PendantControl::give_back_control(Seconds now) {
  if (!before_) return;
  if (!to_.owner.is_client(key_)) {  // another client has taken it
    key_.clear();
    before_.reset();
    return;
  }
  if (jogs() || now - used_at_ < gives_back_after || to_.api.job().state == JobState::checking) return;
  if (to_.session.busy() && before_->kind() != MachineControl::Kind::client) return;
  to_.owner.give_back_to(*before_);
  key_.clear();
  before_.reset();
}

bool PendantControl::begin(const PendantMove& move) {
  status_.refusal = {};
  const std::string direction = fmt::format(R"({{"{}": {}}})", key_of(move.axis), move.sign);
  jogs_ =
      ask_in_control("/jog", fmt::format(R"({{"direction": {}, "speed": {}, "share": {}, "distance": {}}})", direction,
                                         move.speed.value() * seconds_per_minute, move.share, move.distance));
  return jogs_;
}

void PendantControl::renew(double share) {
  used_at_ = now_;
  ask("/jog/renew", fmt::format(R"({{"share": {}}})", share));
}

// Only the jog: a job that waits for the operator goes on waiting.
void PendantControl::stop() {
  if (jogs()) ask("/stop");
}

bool PendantControl::jogs() const {
  return jogs_ && to_.session.state() == MachineState::jog && to_.owner.is_client(key_);
}

void PendantControl::poll(Seconds now) {
  now_ = now;
  if (table_.silence && status_.has_link && now - heard_at_ > *table_.silence) lose_link();
  jog_.poll(now);
  if (!jogs()) jogs_ = false;
  give_back_control(now);
}

PendantView PendantControl::view() const {
  const MachineStatus status = to_.session.status();
  const Json told = Json::parse(to_.api.status_text(), nullptr, false);
  PendantView view{
      .place = status.now_at,
      .axis = status_.axis,
      .is_continuous = status_.is_continuous,
      .feed = status.speed_now.value() * seconds_per_minute,
      .spindle = status.outputs.spindle == SpindleDirection::off ? 0 : status.outputs.revolutions_per_minute};
  // A display has no room for a rotation.
  const Json in_program = told.value("program_zero", Json());
  const Json offset = in_program.is_object() ? in_program : told.value("work_offset", Json());
  view.is_machine_place = !offset.is_object() || told.value("work_rotation", 0.0) != 0;
  if (view.is_machine_place) return view;
  for (const AxisDescription& axis : to_.machine.axes) {
    view.place[axis.axis] -= offset.value(std::string(1, key_of(axis.axis)), 0.0);
  }
  return view;
}

std::vector<std::vector<std::uint8_t>> PendantControl::take_display(Seconds now) {
  if (!table_.display || !status_.is_connected || (has_shown_ && now - shown_at_ < between_views)) return {};
  const PendantView current = view();
  if (has_shown_ && current == shown_ && now - shown_at_ < shows_again_after) return {};
  has_shown_ = true;
  shown_ = current;
  shown_at_ = now;
  return display_reports(table_, current);
}

}  // namespace passo
