#include "passo/api/web_api.hpp"

#include <utility>
#include <variant>

#include "api_json.hpp"
#include "board_files_api.hpp"
#include "cam_api.hpp"
#include "camera_api.hpp"
#include "jobs_api.hpp"
#include "machine_api.hpp"
#include "machine_file_api.hpp"
#include "owner_api.hpp"
#include "ports_api.hpp"
#include "programs_api.hpp"
#include "settings_api.hpp"
#include "small_jobs_api.hpp"
#include "studies_api.hpp"
#include "tools_api.hpp"
#include <fmt/format.h>

#include "passo/api/api_routes.hpp"
#include "passo/api/tool_lives.hpp"
#include "passo/session/board_machine_session.hpp"

namespace passo {
namespace {

constexpr std::size_t small_body = std::size_t{1} << 16;
constexpr std::size_t longest_map = std::size_t{1} << 22;

WebAnswer not_the_owner() {
  return error_answer(
      403, "owner.not-you",
      "only the client in control may do this: take control with POST /api/v1/owner, and send its key in X-Passo-Key");
}

// Why this server has nothing at such a path. Empty: it has all that is needed.
std::optional<WebAnswer> what_lacks(Needs needs, const ApiShared& shared) {
  const ApiOptions& options = shared.options;
  if (needs == Needs::camera && !shared.camera) return no_camera();
  if (needs == Needs::history && options.history == nullptr) return no_history();
  if (needs == Needs::maker && options.maker == nullptr) return no_maker();
  if (needs == Needs::ports && options.contact == nullptr) return no_ports();
  if (needs == Needs::settings && options.settings == nullptr) return no_settings();
  if (needs == Needs::studies && options.studies == nullptr) return no_studies();
  return {};
}

// What is written for another version of the API: its path has another number, or none.
bool is_of_another_version(std::string_view path) {
  constexpr std::string_view any_version = "/api/";
  if (!path.starts_with(any_version) || !path.starts_with(api_root)) return path.starts_with(any_version);
  return path.size() > api_root.size() && path[api_root.size()] != '/';
}

std::size_t longest_of(BodyKind kind) {
  switch (kind) {
    case BodyKind::none:
    case BodyKind::json: return small_body;
    case BodyKind::program: return ProgramStore::longest_program;
    case BodyKind::table: return longest_map;
    case BodyKind::bytes: return CamService::longest_file;
  }
  return 0;
}

}  // namespace

// What answers, in the order in which one needs the other.
class WebApi::Parts {
 public:
  Parts(const MachineDescription& machine, MachineSession& session, MachineControl& owner, ApiOptions all_options)
      : options(std::move(all_options)), mdi(machine, session, programs), offsets(programs, options), shared{machine,
                                                                                                             session,
                                                                                                             owner,
                                                                                                             options,
                                                                                                             programs,
                                                                                                             offsets} {
    programs.judge_paths(options.path_judge);
    if (options.workshop.library != nullptr) {
      programs.set_lives([this] {
        const ToolRecords* const records = options.workshop.records;
        return lives_left(*options.workshop.library, records != nullptr ? records->all() : std::vector<ToolRecord>());
      });
    }
    if (!options.macro_folder.empty()) programs.set_sub_folders({options.macro_folder});
    mdi.begin_anew();
    if (BoardMachineSession* const own = session.as_board_session()) {
      own->board().sent_segments().keep(machine.board.clock);
    }
  }

  WebAnswer answer(const WebRequest& request, const FoundRoute& found, std::optional<Json> said = {}) {
    owner_api.hear(request.key);
    if (found.route == nullptr) return answer_elsewhere(request, found);
    const ApiRoute& route = *found.route;
    if (route.moves && !shared.owner.is_client(request.key)) return not_the_owner();
    auto body = read_body(route.body, request, std::move(said));
    if (!body) return body.error();
    if (auto lacks = what_lacks(route.needs, shared)) return std::move(*lacks);
    const ApiCall call{.request = request, .id = found.id, .rest = found.rest, .body = std::move(*body)};
    return std::visit([&](auto handler) { return ask(handler, call); }, route.handler);
  }
  // The disk may take its time while nothing moves. What it refuses is tried again each second.
  void keep_all() {
    constexpr Seconds between_attempts{1};
    if (shared.session.now() < keeps_again_) return;
    const bool is_kept = options.history == nullptr || options.history->keep();
    const bool are_offsets_kept = offsets.write_again();
    const bool are_tools_kept = options.workshop.records == nullptr || options.workshop.records->keep();
    if (!is_kept || !are_offsets_kept || !are_tools_kept) keeps_again_ = shared.session.now() + between_attempts;
  }

  const ApiOptions options;
  ProgramStore programs;
  MdiLines mdi;
  KeptOffsets offsets;
  ApiShared shared;
  JobRunner jobs{shared, mdi};
  ProgramTimes times{shared, jobs};
  BoardFilesApi board_files_api{shared, jobs};
  CamApi cam_api{shared, jobs};
  CameraApi camera_api{shared};
  JobsApi jobs_api{shared, jobs};
  MachineApi machine_api{shared, jobs, times, mdi};
  MachineFileApi machine_file_api{shared, jobs};
  OwnerApi owner_api{shared, jobs};
  PortsApi ports_api{shared, jobs};
  ProgramsApi programs_api{shared, jobs};
  SettingsApi settings_api{shared, jobs};
  SmallJobsApi small_jobs_api{shared, jobs};
  StudiesApi studies_api{shared};
  ToolsApi tools_api{shared};

 private:
  // Another method, or a path of the page's.
  WebAnswer answer_elsewhere(const WebRequest& request, const FoundRoute& found) const {
    if (!found.allowed.empty()) {
      WebAnswer refused = refusal_answer(405);
      refused.allow = found.allowed;
      return refused;
    }
    if (is_of_another_version(request.path)) {
      return error_answer(404, "http.other-version",
                          fmt::format("the API of this server is {0}, described in {0}/openapi.json", api_root));
    }
    const bool looks = request.method == "GET" && options.page;
    auto page = looks ? options.page(request) : std::nullopt;
    return page ? std::move(*page) : refusal_answer(404);
  }
  WebAnswer ask(AnswerOf<BoardFilesApi> handler, const ApiCall& call) { return (board_files_api.*handler)(call); }
  WebAnswer ask(AnswerOf<CamApi> handler, const ApiCall& call) { return (cam_api.*handler)(call); }
  WebAnswer ask(AnswerOf<CameraApi> handler, const ApiCall& call) { return (camera_api.*handler)(call); }
  WebAnswer ask(AnswerOf<JobsApi> handler, const ApiCall& call) { return (jobs_api.*handler)(call); }
  WebAnswer ask(AnswerOf<MachineApi> handler, const ApiCall& call) { return (machine_api.*handler)(call); }
  WebAnswer ask(AnswerOf<MachineFileApi> handler, const ApiCall& call) { return (machine_file_api.*handler)(call); }
  WebAnswer ask(AnswerOf<OwnerApi> handler, const ApiCall& call) { return (owner_api.*handler)(call); }
  WebAnswer ask(AnswerOf<PortsApi> handler, const ApiCall& call) { return (ports_api.*handler)(call); }
  WebAnswer ask(AnswerOf<ProgramsApi> handler, const ApiCall& call) { return (programs_api.*handler)(call); }
  WebAnswer ask(AnswerOf<SettingsApi> handler, const ApiCall& call) { return (settings_api.*handler)(call); }
  WebAnswer ask(AnswerOf<SmallJobsApi> handler, const ApiCall& call) { return (small_jobs_api.*handler)(call); }
  WebAnswer ask(AnswerOf<ToolsApi> handler, const ApiCall& call) { return (tools_api.*handler)(call); }
  WebAnswer ask(AnswerOf<StudiesApi> handler, const ApiCall& call) { return (studies_api.*handler)(call); }

  Seconds keeps_again_{0};  // what could not be written is tried again then
};

WebApi::WebApi(const MachineDescription& machine, MachineSession& session, MachineControl& owner, ApiOptions options)
    : parts_(std::make_unique<Parts>(machine, session, owner, std::move(options))) {}

WebApi::~WebApi() = default;

WebService WebApi::find(const WebRequest& head) {
  FoundRoute found = find_route(head.method, head.path);
  const ApiRoute* const route = found.route;
  const bool is_served = route != nullptr && !what_lacks(route->needs, parts_->shared);
  return {
      .longest_body = is_served ? longest_of(route->body) : small_body,
      .is_stream = route != nullptr && route->handler == ApiHandler(&MachineApi::stream),
      .is_pictures = is_served && route->handler == ApiHandler(&CameraApi::stream),
      .answer = [this, found = std::move(found)](const WebRequest& request) { return parts_->answer(request, found); }};
}

WebAnswer WebApi::refusal(unsigned status) {
  return refusal_answer(status);
}

bool WebApi::is_public(const WebRequest& request) {
  return parts_->options.page && request.method == "GET" && !request.path.starts_with("/api/");
}

std::string WebApi::hear(std::string_view message, std::uint64_t client) {
  const Json said = Json::parse(message, nullptr, false);
  const auto member = [&](const char* key) { return said.is_object() ? said.value(key, Json()) : Json(); };
  const auto text = [&](const char* key) {
    const Json value = member(key);
    return value.is_string() ? value.get<std::string>() : std::string();
  };
  const std::string path = text("do");
  const std::string key = text("key");
  const bool has_body = said.is_object() && said.contains("body");
  const WebRequest request{.method = "POST", .path = path, .key = key, .type = "application/json"};
  const WebAnswer answer = parts_->answer(request, find_route(request.method, request.path),
                                          has_body ? std::optional(member("body")) : std::nullopt);
  parts_->owner_api.hear(key, client);
  return Json({{"do", path}, {"status", answer.status}, {"body", Json::parse(answer.body, nullptr, false)}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

void WebApi::gone(std::uint64_t client) {
  parts_->owner_api.gone(client);
}

void WebApi::on_change(const std::vector<MachineChange>& changes) {
  for (const MachineChange& change : changes) {
    parts_->mdi.on_change(change);
    parts_->machine_api.on_change(change);
    parts_->jobs.on_change(change);
  }
}

void WebApi::poll() {
  parts_->owner_api.poll();
  parts_->programs.poll();
  parts_->board_files_api.poll();
  parts_->cam_api.poll();
  parts_->times.poll();
  parts_->machine_api.poll();
  parts_->jobs.poll();
  parts_->small_jobs_api.poll();
  parts_->camera_api.poll(parts_->jobs.job());
  if (!parts_->shared.session.busy()) parts_->keep_all();
}

bool WebApi::is_checking() const {
  return parts_->programs.checks();
}

std::string WebApi::status_text() const {
  return parts_->machine_api.status_text();
}

const SavedParameters& WebApi::parameters() const {
  return parts_->programs.parameters();
}

const ToolTable& WebApi::tools() const {
  return parts_->programs.tools();
}

void WebApi::apply_offsets(const SavedParameters& parameters) {
  if (parts_->offsets.adopt(parameters)) parts_->mdi.begin_anew();
}

void WebApi::set_offsets_trouble(std::string why) {
  parts_->offsets.set_trouble(std::move(why));
}

std::optional<Point> WebApi::broken_off_at() {
  const InterruptedJob* const job = parts_->jobs.interrupted();
  return job != nullptr && job->back_at ? std::optional(job->back_at->point) : std::nullopt;
}

void WebApi::watch(const WebServer& server) {
  parts_->machine_api.watch(server);
}

void WebApi::watch(const PendantStatus& pendant) {
  parts_->machine_api.watch(pendant);
}

void WebApi::use(const MachineCamera& camera) {
  parts_->shared.camera = camera;
}

const ApiJob& WebApi::job() const {
  return parts_->jobs.job();
}

std::optional<Seconds> WebApi::time_left() const {
  return parts_->times.left(parts_->shared.session.status());
}

std::uint64_t WebApi::mdi_version() const {
  return parts_->mdi.version();
}

void WebApi::leave() {
  parts_->jobs.leave();
}

}  // namespace passo
