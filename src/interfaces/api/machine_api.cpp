#include "passo/api/machine_api.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/api/deleted_lines.hpp"

namespace passo {
namespace {

constexpr std::size_t small_body = std::size_t{1} << 16;
constexpr std::size_t longest_map = std::size_t{1} << 22;
constexpr std::string_view programs_path = "/api/v1/programs";
constexpr std::string_view owner_path = "/api/v1/owner";
constexpr std::string_view queue_path = "/api/v1/queue";
constexpr std::string_view history_path = "/api/v1/history";
constexpr std::string_view machine_file_path = "/api/v1/machine/file";
constexpr std::string_view make_path = "/api/v1/make";
constexpr std::string_view study_path = "/api/v1/study";
constexpr std::string_view pulses_path = "/api/v1/pulses";
constexpr std::string_view make_files_path = "/api/v1/make/files";
constexpr std::string_view interrupted_path = "/api/v1/interrupted";
constexpr std::string_view alarms_path = "/api/v1/alarms";
constexpr std::int64_t shown_of_history = 100;
constexpr double farthest_zero = 1e6;  // mm or degrees from the tool

unsigned status_of(RefusalCode code) {
  return code == RefusalCode::bad_value ? 400 : 409;
}

}  // namespace

std::optional<Dialect> dialect_from(std::string_view query) {
  const std::string_view dialect = query_value(query, "dialect");
  if (dialect == "grbl") return Dialect::grbl;
  if (dialect.empty() || dialect == "linuxcnc") return Dialect::linuxcnc;
  return {};
}

std::string_view name_of(JobState state) {
  switch (state) {
    case JobState::none: return "none";
    case JobState::checking: return "checking";
    case JobState::running: return "running";
    case JobState::done: return "done";
    case JobState::stopped: return "stopped";
    case JobState::failed: return "failed";
    case JobState::interrupted: return "interrupted";
  }
  return "";
}

MachineApi::MachineApi(const MachineDescription& machine, MachineSession& session, MotionOwner& owner,
                       ApiOptions options)
    : machine_(machine),
      session_(session),
      owner_(owner),
      options_(std::move(options)),
      repeats_(machine),
      mdi_(machine, session, programs_) {
  programs_.set_offsets(options_.parameters, options_.tools);
  mdi_.begin_anew();
  session_.board().sent_segments().keep(machine_.board.clock);
  if (options_.keeper == nullptr || options_.history == nullptr) return;
  kept_ = std::make_unique<KeptJob>(machine, session, *options_.keeper, *options_.history, programs_,
                                    KeptJob::Names{.made_by = options_.version, .machine = options_.machine_file});
  session.listen_before_hello(
      [this](const BoardStatus& status, const Greeting& greeting) { kept_->hear(status, greeting); });
  if (options_.broken_off) kept_->find(*options_.broken_off);
}

WebAnswer MachineApi::refusal(unsigned status) {
  switch (status) {
    case 400: return error_answer(status, "http.bad-request", "this is no request that HTTP knows");
    case 401: return error_answer(status, "http.token", "a token is needed: the header Authorization: Bearer …");
    case 403: return error_answer(status, "http.foreign-page", "the name in Host or Origin is not this server's");
    case 404: return error_answer(status, "http.not-found", "there is nothing at this path");
    case 405: return error_answer(status, "http.method", "this path has other methods");
    case 413: return error_answer(status, "http.too-large", "the body is too long");
    case 431: return error_answer(status, "http.too-large", "the header is too long");
    case 503: return error_answer(status, "http.busy", "other clients or large uploads take all the room: try again");
    default: return error_answer(status, "http.error", "the request failed");
  }
}

std::size_t MachineApi::longest_body(const WebRequest& request) {
  const bool uploads = request.path == programs_path || (request.path == queue_path && options_.history != nullptr);
  if (request.method != "POST") return small_body;
  if (request.path.ends_with("/height-map")) return longest_map;
  if (request.path == make_files_path && options_.maker != nullptr) return Maker::longest_file;
  return uploads || request.path.starts_with(uploads_path) ? ProgramStore::longest_program : small_body;
}

WebAnswer MachineApi::answer(const WebRequest& request) {
  if (owner_.is_client(request.key)) owner_heard_ = session_.now();
  const FoundRoute found = find_route(request.method, request.path);
  if (found.route == nullptr) {
    if (found.knows_path) return refusal(405);
    const bool looks = request.method == "GET" && options_.page;
    if (const auto page = looks ? options_.page(request) : std::nullopt) return *page;
    return refusal(404);
  }
  if (found.route->moves && !owner_.is_client(request.key)) {
    return error_answer(
        403, "owner.not-you",
        "only the owner of motion may do this: take ownership by POST /api/v1/owner, and send its key in "
        "X-Passo-Key");
  }
  if (auto wrong = wrong_body(found.route->body, request)) return std::move(*wrong);
  return request.method == "GET" ? look(found, request) : change(found, request);
}

WebAnswer MachineApi::look(const FoundRoute& found, const WebRequest& request) {
  const std::string_view path = found.route->path;
  if (path == queue_path || path == history_path || path == alarms_path) return look_at_history(found, request);
  if (path == interrupted_path) {
    if (options_.history == nullptr) return no_history();
    const InterruptedJob* const job = kept_ ? kept_->interrupted() : nullptr;
    return json_answer(200, {{"interrupted", job != nullptr ? as_json(machine_, *job, kept_->reentry()) : Json()}});
  }
  if (path.ends_with("/status")) return {.body = status_text()};
  if (path == make_path) return make_answer();
  if (path.starts_with(make_path)) return path.ends_with("/page") ? made_page() : made_picture(request.query);
  if (path == pulses_path) return pulses_answer(request.query);
  if (path == study_path) return study_answer();
  if (path.starts_with(study_path)) return study_file(path.ends_with("/picture"));
  if (path == machine_file_path) return machine_file_answer(options_.machine_access, options_.machine_file);
  if (path.ends_with("/machine")) return json_answer(200, machine_json(machine_, options_.version));
  if (path.ends_with("/openapi.json")) return {.body = options_.openapi};
  if (path.ends_with("/metrics")) return {.type = "text/plain; version=0.0.4", .body = metrics()};
  if (path.ends_with("/stream")) return refusal(400);
  if (path.ends_with("/log")) return words_answer();
  if (path.ends_with("/homing")) return json_answer(200, as_json(homed_, repeats_));
  if (path.ends_with("/health")) {
    const MachineState state = session_.state();
    const bool well = state != MachineState::fault && state != MachineState::offline;
    return json_answer(well ? 200 : 503, {{"healthy", well}, {"state", name_of(state)}});
  }
  if (path == programs_path) {
    Json list = Json::array();
    for (const auto& [id, program] : programs_.all()) list.push_back(as_json(program, false));
    return json_answer(200, {{"programs", std::move(list)}});
  }
  if (path.starts_with(uploads_path)) return look_at_uploads(found);
  const StoredProgram* const program = programs_.find(found.id);
  if (program == nullptr) return refusal(404);
  if (path.ends_with("/path")) return path_answer(*program, machine_, programs_.tools(), request.query);
  if (path.ends_with("/text")) return text_answer(*program, request.query);
  if (path.ends_with("/height-map")) return height_map_answer(*program, request.query);
  if (path.ends_with("/way")) {
    const auto from = place_from(request.query);
    return from ? json_answer(200, as_json(machine_, way_to(*program, *from))) : no_place();
  }
  return json_answer(200, as_json(*program, true));
}

WebAnswer MachineApi::change(const FoundRoute& found, const WebRequest& request) {
  const std::string_view path = found.route->path;
  if (path.starts_with(programs_path)) return change_programs(found, request);
  if (path.starts_with(uploads_path)) return change_uploads(found, request);
  if (path.starts_with(queue_path)) return change_queue(found, request);
  if (path.starts_with(make_path)) return change_making(found, request);
  if (path == study_path) return begin_study(request.body);
  if (path.starts_with(interrupted_path)) return change_interrupted(found);
  if (path.starts_with(machine_file_path)) return change_machine_file(found, request);
  if (path.starts_with(owner_path)) return change_owner(found, request);
  const Json body = request.body.empty() ? Json::object() : Json::parse(request.body, nullptr, false);
  if (path == "/api/v1/work") return set_work_zero(request.body);
  if (path == "/api/v1/mdi") return take_mdi(request.body);
  if (path == "/api/v1/probe") return begin_probing(request.body);
  std::string reason;
  auto wanted = read_request(path, body, machine_, reason);
  if (!wanted) return bad_body(reason);
  // Who holds or stops wants no motion, also of a job that is about to begin.
  const bool calls_off = path == "/api/v1/hold" || path == "/api/v1/stop";
  if (calls_off && job_.state == JobState::checking && !session_.busy()) {
    end_job(JobState::stopped, "it was called off before it began");
    return ticket_answer(0);
  }
  if (path == "/api/v1/stop") {
    stopped_by_ = owner_.is_client(request.key) ? owner_.name() : "somebody who does not own the motion";
    if (parked_ && !session_.busy()) return stop_parked_job();
  }
  if (path == "/api/v1/operator-done" && parked_ && !session_.status().waits_for) return go_on_behind_stop();
  if (path == "/api/v1/jog" || path == "/api/v1/home") step_aside();
  return ask(std::move(*wanted));
}

// Reading a machine file may take some milliseconds: nothing waits for them while nothing moves.
WebAnswer MachineApi::change_machine_file(const FoundRoute& found, const WebRequest& request) {
  if (session_.busy() || job_.state == JobState::checking) {
    return error_answer(409, "machine.busy", "the machine moves: the machine file can wait");
  }
  if (found.route->moves) return write_machine_file(options_.machine_access, options_.machine_file, request.body);
  return try_machine_file(options_.machine_access, request.body);
}

WebAnswer MachineApi::change_making(const FoundRoute& found, const WebRequest& request) {
  if (found.route->path == make_path) return begin_making(request.body);
  if (request.method == "DELETE") return clear_make_files();
  const auto name = name_from(request.query, "");
  return name ? keep_make_file(*name, request.body) : name.error();
}

// The tool stands at this place of the work.
WebAnswer MachineApi::set_work_zero(std::string_view body) {
  step_aside();
  const MachineStatus status = session_.status();
  if (status.state != MachineState::idle || job_.state == JobState::checking) {
    return error_answer(409, "machine.busy", fmt::format("the machine is not idle: {}", name_of(status.state)));
  }
  if (kept_ && kept_->interrupted() != nullptr) {
    return error_answer(409, "jobs.interrupted",
                        "a job was broken off, and needs its zero: resume it or drop it first");
  }
  const Frame frame = programs_.work_frame();
  const Point& at = status.position.place;
  std::string reason;
  const auto place = read_place(Json::parse(body, nullptr, false), machine_, frame.work_from_machine(at), reason);
  if (!place) return bad_body(reason);
  const auto is_far = [](double value) { return std::abs(value) > farthest_zero; };
  if (std::ranges::any_of(place->values, is_far)) return bad_body("the place is too far away");
  const SavedParameters before = programs_.parameters();
  programs_.set_work_zero(at - (frame.machine_from_work(*place) - frame.work_offset()));
  keep_offsets();
  if (!offsets_trouble_.empty()) {
    WebAnswer refused = unwritten("the zero of the work", offsets_trouble_);
    programs_.set_offsets(before, programs_.tools());
    keep_offsets();
    return refused;
  }
  mdi_.take_offsets();
  return json_answer(200, {{"work_offset", as_json(machine_, programs_.work_zero())}});
}

void MachineApi::take_offsets(const SavedParameters& parameters) {
  SavedParameters all = programs_.parameters();
  set_lasting_offsets(all, parameters);
  if (all == programs_.parameters()) return;
  programs_.set_offsets(all, programs_.tools());
  mdi_.begin_anew();
}

WebAnswer MachineApi::ask(Request wanted) {
  const auto ticket = session_.request(std::move(wanted));
  if (!ticket)
    return error_answer(status_of(ticket.error().code), code_of(ticket.error().code), ticket.error().message);
  return ticket_answer(*ticket);
}

// A client tells by the change which statuses are older than its request.
WebAnswer MachineApi::ticket_answer(Ticket ticket) const {
  return json_answer(200, {{"ticket", ticket}, {"change", session_.status().version}});
}

WebAnswer MachineApi::change_programs(const FoundRoute& found, const WebRequest& request) {
  if (found.route->path == programs_path) {
    const auto dialect = dialect_from(request.query);
    if (!dialect) return bad_body("the dialect is linuxcnc or grbl");
    auto name = name_from(request.query, "program");
    if (!name) return name.error();
    const StoredProgram* const program = programs_.add(std::move(*name), *dialect, request.body);
    return program != nullptr ? json_answer(201, as_json(*program, false)) : no_room();
  }
  const StoredProgram* const program = programs_.find(found.id);
  if (program == nullptr) return refusal(404);
  if (found.route->path.ends_with("/height-map")) return take_height_map(*program, request);
  if (found.route->path.ends_with("/level")) return level_program(*program, request.query);
  const bool is_checked_for_job = job_.state == JobState::checking;
  if (request.method == "DELETE") {
    const bool is_parked = parked_ && parked_->job.program == found.id;
    if (is_parked || (is_checked_for_job && job_.program == found.id)) {
      return error_answer(409, "programs.in-use", "the program is about to run");
    }
    programs_.remove(found.id);
    return json_answer(200, Json::object());
  }
  if (is_checked_for_job) return error_answer(409, "machine.busy", "a job is about to begin");
  if (found.route->path.ends_with("/block-delete")) return choose_lines(*program, request.body);
  if (found.route->path.ends_with("/run")) return parked_ ? parked_refusal() : run_program(*program, request.query);
  programs_.check(found.id, machine_, session_.status().position.place);
  return json_answer(202, as_json(*program, false));
}

// Only of a program that does not run: what runs was read with the choice of before.
WebAnswer MachineApi::choose_lines(const StoredProgram& program, std::string_view text) {
  std::string reason;
  const Json body = Json::parse(text, nullptr, false);
  const auto leaves_out = read_flag(body, "on", reason);
  if (!leaves_out) return bad_body(reason);
  if (*leaves_out && program.dialect == Dialect::grbl)
    return bad_body("grbl knows no block delete: it runs such lines");
  if (runs(program)) return error_answer(409, "programs.in-use", "the program runs");
  programs_.set_block_delete(program.id, *leaves_out);
  return json_answer(200, as_json(program, false));
}

WebAnswer MachineApi::look_at_history(const FoundRoute& found, const WebRequest& request) {
  if (options_.history == nullptr) return no_history();
  std::int64_t most = shown_of_history;
  const std::string_view digits = query_value(request.query, "most");
  std::from_chars(digits.data(), digits.data() + digits.size(), most);
  most = std::clamp<std::int64_t>(most, 1, JobHistory::most_ended);
  const std::string_view path = found.route->path;
  Json list = Json::array();
  if (path == alarms_path) {
    for (const HistoryAlarm& one : options_.history->alarms(most))
      list.push_back({{"at", one.at}, {"words", one.words}});
    return json_answer(200, {{"alarms", std::move(list)}});
  }
  for (const HistoryJob& one : path == queue_path ? options_.history->queue() : options_.history->ended(most)) {
    list.push_back(as_json(one));
  }
  return json_answer(200, {{"jobs", std::move(list)}});
}

// A job in the queue waits until somebody runs it.
WebAnswer MachineApi::change_queue(const FoundRoute& found, const WebRequest& request) {
  JobHistory* const history = options_.history;
  if (history == nullptr) return no_history();
  if (found.route->path == queue_path) {
    const auto dialect = dialect_from(request.query);
    if (!dialect) return bad_body("the dialect is linuxcnc or grbl");
    const bool leaves_out = *dialect != Dialect::grbl && query_value(request.query, "block_delete") == "true";
    const auto name = name_from(request.query, "program");
    if (!name) return name.error();
    const auto id = history->add(*name, *dialect == Dialect::grbl ? "grbl" : "linuxcnc",
                                 leaves_out ? with_deleted_lines_as_comments(request.body) : request.body, wall_time());
    return id ? json_answer(201, as_json(*history->find(*id))) : no_room_in_history();
  }
  const auto id = static_cast<std::int64_t>(std::min<std::uint64_t>(found.id, INT64_MAX));
  const auto job = history->find(id);
  if (!job || job->state != HistoryState::queued) return refusal(404);
  if (job_.state == JobState::checking) return error_answer(409, "machine.busy", "a job is about to begin");
  if (request.method == "DELETE") {
    return history->remove(id) ? json_answer(200, Json::object()) : no_room_in_history();
  }
  if (parked_) return parked_refusal();
  const StoredProgram* const program = programs_.add(
      job->name, job->dialect == "grbl" ? Dialect::grbl : Dialect::linuxcnc, history->program_of(id).value_or(""));
  if (program == nullptr) return no_room();
  const std::uint64_t stored = program->id;
  WebAnswer answer = begin_job(*program, id);
  if (answer.status != 202) programs_.remove(stored);
  return answer;
}

void MachineApi::note_alarm() {
  ++alarms_;
  if (options_.history != nullptr) options_.history->note_alarm(session_.status().trouble_words, wall_time());
}

void MachineApi::turn() {
  mind_owner();
  programs_.turn();
  heed_maker();
  mind_times();
  mind_mdi();
  if (kept_) kept_->look();
  if (job_.state == JobState::checking && !programs_.checks()) begin_checked_job();
  if (!session_.busy()) keep_all();
}

// The disk may take its time while nothing moves. What it refuses is tried again each second.
void MachineApi::keep_all() {
  constexpr Seconds between_attempts{1};
  if (session_.now() < keeps_again_) return;
  const bool is_kept = options_.history == nullptr || options_.history->keep();
  if (!offsets_trouble_.empty()) keep_offsets();
  if (!is_kept || !offsets_trouble_.empty()) keeps_again_ = session_.now() + between_attempts;
}

void MachineApi::keep_offsets() {
  if (options_.keep_offsets) offsets_trouble_ = options_.keep_offsets(programs_.parameters(), programs_.tools());
}

// What has happened and is not on the disk. Empty: all is.
std::string MachineApi::unkept() const {
  std::string words;
  const auto add = [&words](std::string_view what, std::string_view why) {
    if (!words.empty()) words += "; ";
    words += fmt::format("{} cannot be written: {}", what, why);
  };
  if (options_.history != nullptr && options_.history->is_behind()) add("the history", options_.history->trouble());
  if (!offsets_trouble_.empty()) add("the offsets", offsets_trouble_);
  if (named_ && !kept_->is_written()) add("the journal of the job", options_.keeper->trouble());
  return words;
}

std::string MachineApi::status_text() const {
  MachineStatus status = session_.status();
  const bool is_free = parked_ ? !status.waits_for : is_free_to_move(status);
  if (parked_ && is_free && !goes_on_) status.waits_for = parked_->wait;
  Json json = as_json(machine_, status);
  if (status.waits_for) json["waits"]["free"] = is_free;
  const std::optional<Seconds> left = time_left(status);
  json["left"] = left ? Json(rounded(left->value())) : Json();
  const Frame frame = programs_.work_frame();
  json["work_offset"] = as_json(machine_, frame.work_offset());
  json["work_rotation"] = frame.rotation_degrees();
  json["owner"] = as_json(owner_);
  json["job"] = as_json(job_);
  json["unkept"] = unkept();
  json["mdi"] = as_json(machine_, mdi_, status.now_at);
  return json.dump() + "\n";
}

std::string MachineApi::metrics() const {
  const MachineStatus status = session_.status();
  std::string text;
  const auto add = [&](const char* name, const char* type, const char* help, auto value) {
    text += fmt::format("# HELP passo_{} {}\n# TYPE passo_{} {}\npasso_{} {}\n", name, help, name, type, name, value);
  };
  text += "# HELP passo_state 1 for the state that the machine is in.\n# TYPE passo_state gauge\n";
  for (const StateRow& row : state_rows) {
    text += fmt::format("passo_state{{state=\"{}\"}} {}\n", row.name, row.state == status.state ? 1 : 0);
  }
  add("board_seconds_total", "counter", "Time on the board's side.", status.time.value());
  add("homed", "gauge", "1: the place is known by switches.", status.position.trust == Trust::homed ? 1 : 0);
  add("job_progress", "gauge", "Of the job that runs, 0 to 1.", status.progress.value_or(0));
  add("jobs_ended_total", "counter", "Jobs that have ended, in whatever way.", jobs_ended_);
  add("alarms_total", "counter", "Times the machine stopped at once or the board was lost.", alarms_);
  add("late_refills_total", "counter", "Rests because motion reached the board too late.", late_);
  if (server_ == nullptr) return text;
  add("http_connections", "gauge", "Open connections.", server_->connections());
  add("http_watchers", "gauge", "Clients of the stream.", server_->watchers());
  add("http_requests_total", "counter", "Requests that were answered.", server_->requests());
  add("http_refused_total", "counter", "Requests and connections that were refused.", server_->refused());
  add("stream_skipped_total", "counter", "Messages that slow clients of the stream skipped.", server_->skipped());
  return text;
}

}  // namespace passo
