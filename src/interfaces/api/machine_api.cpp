#include "machine_api.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api_json.hpp"
#include "json_members.hpp"
#include <fmt/format.h>

#include "passo/interpreter/saved_offsets.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {
namespace {

constexpr double farthest_zero = 1e6;  // mm or degrees from the tool

// The only member of the body.
std::optional<std::string> line_from(const Json& body) {
  const auto line = body.is_object() && body.size() == 1 ? body.find("line") : body.end();
  if (line == body.end() || !line->is_string()) return {};
  return line->get<std::string>();
}

}  // namespace

MachineApi::MachineApi(const ApiShared& shared, JobRunner& jobs, const ProgramTimes& times, MdiLines& mdi)
    : shared_(shared), jobs_(jobs), times_(times), mdi_(mdi), homing_(shared.machine, shared.session) {}

WebAnswer MachineApi::status(const ApiCall&) {
  return {.body = status_text()};
}

WebAnswer MachineApi::health(const ApiCall&) {
  const MachineState state = shared_.session.state();
  const bool well = state != MachineState::fault && state != MachineState::offline;
  return json_answer(well ? 200 : 503, {{"healthy", well}, {"state", name_of(state)}});
}

WebAnswer MachineApi::description(const ApiCall&) {
  const CameraDescription* const camera = shared_.camera ? &shared_.camera->description : nullptr;
  return json_answer(200, machine_json(shared_.machine, shared_.session.abilities(), shared_.options.version, camera));
}

WebAnswer MachineApi::homing(const ApiCall&) {
  return json_answer(200, as_json(homing_.homed(), homing_.repeats()));
}

WebAnswer MachineApi::pulses(const ApiCall& call) {
  if (BoardMachineSession* const own = shared_.session.as_board_session()) {
    return pulses_answer(*own, shared_.machine, call.request.query);
  }
  const MachineAbilities abilities = shared_.session.abilities();
  const Sentence* const why = abilities.why_not(Ability::pulses);
  return error_answer(409, "machine.cannot", why != nullptr ? *why : Sentence{.code = "machine.cannot"});
}

WebAnswer MachineApi::metrics(const ApiCall&) {
  return {.type = "text/plain; version=0.0.4", .body = metrics_text()};
}

WebAnswer MachineApi::openapi(const ApiCall&) {
  return {.body = shared_.options.openapi};
}

WebAnswer MachineApi::stream(const ApiCall&) {
  return refusal_answer(400);
}

WebAnswer MachineApi::ask(Request wanted) {
  const auto ticket = shared_.session.request(std::move(wanted));
  return ticket ? ticket_answer(shared_.session, *ticket) : refused_answer(ticket.error());
}

// Who holds or stops wants no motion, also of a job that is about to begin.
WebAnswer MachineApi::hold(const ApiCall& call) {
  JsonMembers members(call.members());
  const request::Hold hold{.for_door = members.flag("door").value_or(false)};
  if (!members.end()) return bad_body(members.reason());
  return jobs_.call_off() ? ticket_answer(shared_.session, 0) : ask(hold);
}

WebAnswer MachineApi::stop(const ApiCall& call) {
  if (jobs_.call_off()) return ticket_answer(shared_.session, 0);
  const bool is_owner = shared_.owner.is_client(call.request.key);
  jobs_.set_stopped_by(is_owner ? shared_.owner.name() : std::string());
  return jobs_.parked() && !shared_.session.busy() ? jobs_.stop_parked() : ask(request::Stop{});
}

WebAnswer MachineApi::home(const ApiCall& call) {
  JsonMembers members(call.members());
  const request::Home home{.axis = members.axis("axis", shared_.machine)};
  if (!members.end()) return bad_body(members.reason());
  jobs_.step_aside();
  return ask(home);
}

WebAnswer MachineApi::jog(const ApiCall& call) {
  JsonMembers members(call.members());
  request::Jog jog;
  jog.way.direction = members.place("direction", shared_.machine, Point());
  jog.way.speed = MmPerSecond(members.number("speed").value_or(0) / seconds_per_minute);
  jog.way.distance = Mm(members.number("distance").value_or(0));
  jog.lease = Seconds(members.number("lease").value_or(jog.lease.value()));
  jog.share = members.number("share").value_or(jog.share);
  if (!members.end()) return bad_body(members.reason());
  jobs_.step_aside();
  return ask(jog);
}

WebAnswer MachineApi::renew_jog(const ApiCall& call) {
  JsonMembers members(call.members());
  const request::RenewKeepAlive renew{.share = members.number("share")};
  return members.end() ? ask(renew) : bad_body(members.reason());
}

WebAnswer MachineApi::set_overrides(const ApiCall& call) {
  JsonMembers members(call.members());
  const request::Override wanted{.feed = members.number("feed"),
                                 .adaptive_feed = members.number("adaptive_feed"),
                                 .spindle = members.number("spindle"),
                                 .rapids = members.number("rapids")};
  return members.end() ? ask(wanted) : bad_body(members.reason());
}

WebAnswer MachineApi::choose_stops(const ApiCall& call) {
  JsonMembers members(call.members());
  const request::ChooseStops wanted{.single_block = members.flag("single_block"),
                                    .optional_stop = members.flag("optional_stop")};
  return members.end() ? ask(wanted) : bad_body(members.reason());
}

WebAnswer MachineApi::switch_outputs(const ApiCall& call) {
  JsonMembers members(call.members());
  const request::SwitchOutputs wanted{
      .mist = members.flag("mist"), .flood = members.flag("flood"), .spindle_stands = members.flag("spindle_stands")};
  return members.end() ? ask(wanted) : bad_body(members.reason());
}

WebAnswer MachineApi::operator_done(const ApiCall&) {
  const bool is_parked = jobs_.parked() && !shared_.session.status().waits_for;
  return is_parked ? jobs_.go_on() : ask(request::OperatorDone{});
}

WebAnswer MachineApi::set_position(const ApiCall& call) {
  JsonMembers members(call.members());
  const request::SetPosition wanted{
      {.place = members.place("place", shared_.machine, Point()), .trust = Trust::commanded}};
  return members.end() ? ask(wanted) : bad_body(members.reason());
}

// The tool, or the point under the camera's cross-hair, stands at this place of the work.
WebAnswer MachineApi::set_work_zero(const ApiCall& call) {
  jobs_.step_aside();
  const MachineStatus status = shared_.session.status();
  if (status.state != MachineState::idle || jobs_.is_checking()) return not_idle(status.state);
  if (jobs_.interrupted() != nullptr) {
    return error_answer(409, "jobs.interrupted",
                        Sentence{.code = "jobs.interrupted.zero",
                                 .text = "a job was interrupted, and needs its zero: resume it or discard it first"});
  }
  const Frame frame = shared_.programs.work_frame();
  Point at = status.position.place;
  JsonMembers members(call.body);
  if (members.flag("cross_hair").value_or(false)) {
    if (!shared_.camera) return no_camera();
    at = under_cross_hair(shared_.camera->description, at);
  }
  const Point place = members.place("place", shared_.machine, frame.work_from_machine(at));
  if (!members.end()) return bad_body(members.reason());
  const auto is_far = [](double value) { return std::abs(value) > farthest_zero; };
  if (std::ranges::any_of(place.values, is_far)) return bad_body("the position is too far away");
  if (!shared_.offsets.set_work_zero(at - (frame.machine_from_work(place) - frame.work_offset()))) {
    return unwritten("the zero of the work", "zero", shared_.offsets.trouble());
  }
  mdi_.apply_offsets();
  return json_answer(200, {{"work_offset", as_json(shared_.machine, shared_.programs.work_zero())}});
}

WebAnswer MachineApi::run_line(const ApiCall& call) {
  const auto line = line_from(call.body);
  if (!line) return bad_body("expected {\"line\": \"G0 X1\"}");
  const bool moves = !line->starts_with("$");
  if (moves) jobs_.step_aside();
  if (jobs_.is_checking()) return job_begins();
  if (moves && jobs_.interrupted() != nullptr) {
    return error_answer(409, "jobs.interrupted", "a job was interrupted: resume it or discard it first");
  }
  MdiLines::Answer answer = mdi_.execute(*line);
  if (!answer.code.empty()) {
    const Json error = {{"code", answer.code},
                        {"message", answer.message},
                        {"sentence", as_json(answer.message.sentence())},
                        {"expected", answer.expected},
                        {"expected_sentence", as_json(answer.expected.sentence())}};
    return json_answer(409, {{"error", error}});
  }
  return json_answer(200, {{"words", std::move(answer.words)}, {"change", shared_.session.status().version}});
}

void MachineApi::on_change(const MachineChange& change) {
  if (change.kind == MachineChange::Kind::rested_by_tail) ++late_;
  if (change.kind != MachineChange::Kind::state) return;
  if (change.state == MachineState::alarm || change.state == MachineState::fault) {
    ++alarms_;
    JobHistory* const history = shared_.options.history;
    const Sentence trouble = shared_.session.status().trouble_sentence;
    if (history != nullptr) history->record_alarm(trouble.text, shared_.wall_time(), kept_form(trouble));
  }
  homing_.on_change(change.state);
}

// One set of offsets and tools for lines and programs. Whoever owns the motion no longer leaves nothing on.
void MachineApi::poll() {
  if (mdi_.poll()) {
    SavedParameters parameters = mdi_.parameters();
    begin_with_g54(parameters);
    shared_.offsets.adopt(parameters, mdi_.tools());
  }
  const MachineControl& owner = shared_.owner;
  if (std::exchange(mdi_owner_, owner.changes()) == owner.changes() || owner.kind() == MachineControl::Kind::client) {
    return;
  }
  if (mdi_.streams()) static_cast<void>(shared_.session.request(request::Stop{}).has_value());
  if (owner.is_sender()) mdi_.begin_anew();
}

// What has happened and is not on the disk. Empty: all is.
std::vector<Sentence> MachineApi::unkept() const {
  std::vector<Sentence> all;
  const auto add = [&all](std::string_view what, std::string_view finer, const std::string& why) {
    all.push_back(sentence_of_unwritten(what, finer, why));
  };
  const ApiOptions& options = shared_.options;
  if (options.history != nullptr && options.history->is_behind())
    add("the history", "history", options.history->trouble());
  if (!shared_.offsets.trouble().empty()) add("the offsets", "offsets", shared_.offsets.trouble());
  if (!jobs_.is_journal_written()) add("the journal of the job", "journal", options.keeper->trouble());
  return all;
}

std::string MachineApi::status_text() const {
  const MachineDescription& machine = shared_.machine;
  MachineStatus status = shared_.session.status();
  const std::optional<ParkedJob>& parked = jobs_.parked();
  const bool is_free = parked ? !status.waits_for : jobs_.is_free_to_move(status);
  if (parked && is_free && !jobs_.goes_on()) status.waits_for = parked->wait;
  Json json = as_json(machine, status);
  if (status.waits_for) json["waits"]["free"] = is_free;
  const std::optional<Seconds> left = times_.left(status);
  json["left"] = left ? Json(rounded(left->value())) : Json();
  const Frame frame = shared_.programs.work_frame();
  json["work_offset"] = as_json(machine, frame.work_offset());
  json["work_rotation"] = frame.rotation_degrees();
  json["owner"] = as_json(shared_.owner);
  json["pendant"] = pendant_ != nullptr ? as_json(*pendant_) : Json();
  const HostSpindle* const spindle = shared_.session.spindle();
  json["spindle_drive"] = spindle != nullptr ? as_json(spindle->status()) : Json();
  json["camera"] = shared_.camera ? as_json(shared_.camera->pictures->status()) : Json();
  json["job"] = as_json(jobs_.job());
  std::string unkept_words;
  Json sentences = Json::array();
  for (const Sentence& one : unkept()) {
    unkept_words += (unkept_words.empty() ? "" : "; ") + one.text;
    sentences.push_back(as_json(one));
  }
  json["unkept"] = std::move(unkept_words);
  json["unkept_sentences"] = std::move(sentences);
  json["mdi"] = as_json(machine, mdi_, status.now_at);
  return json.dump() + "\n";
}

std::string MachineApi::metrics_text() const {
  const MachineStatus status = shared_.session.status();
  std::string text;
  const auto add = [&](const char* name, const char* type, const char* help, auto value) {
    text += fmt::format("# HELP passo_{} {}\n# TYPE passo_{} {}\npasso_{} {}\n", name, help, name, type, name, value);
  };
  text += "# HELP passo_state 1 for the state that the machine is in.\n# TYPE passo_state gauge\n";
  for (const StateRow& row : state_rows) {
    text += fmt::format("passo_state{{state=\"{}\"}} {}\n", row.name, row.state == status.state ? 1 : 0);
  }
  add("board_seconds_total", "counter", "Time on the board's clock.", status.time.value());
  add("homed", "gauge", "1: the position is homed.", status.position.trust == Trust::homed ? 1 : 0);
  add("job_progress", "gauge", "Progress of the running job, 0 to 1.", status.progress.value_or(0));
  add("jobs_ended_total", "counter", "Jobs that have ended, successfully or not.", jobs_.jobs_ended());
  add("alarms_total", "counter", "Times the motors were stopped instantly or the board was lost.", alarms_);
  add("late_refills_total", "counter", "Stops because motion reached the board too late.", late_);
  if (server_ == nullptr) return text;
  add("http_connections", "gauge", "Open connections.", server_->connections());
  add("http_watchers", "gauge", "Clients of the stream.", server_->watchers());
  add("http_requests_total", "counter", "Requests that were answered.", server_->requests());
  add("http_refused_total", "counter", "Requests and connections that were refused.", server_->refused());
  add("stream_skipped_total", "counter", "Messages that slow clients of the stream skipped.", server_->skipped());
  return text;
}

}  // namespace passo
