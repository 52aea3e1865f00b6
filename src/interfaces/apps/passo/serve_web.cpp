#include "serve_web.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <random>
#include <utility>

#include "program_input.hpp"
#include <fmt/format.h>
#include <sys/resource.h>

#include "passo/macro/macro.hpp"

namespace passo {
namespace {

constexpr auto between_messages = std::chrono::microseconds(1'000'000 / 60);
constexpr auto between_signs_of_life = std::chrono::seconds(1);

constexpr const char* no_page =
    "The web interface is missing: build it with scripts/page.sh, or give its folder with --page DIR.\n"
    "The API is at /api/v1/status.\n";

// 128 bits that nobody guesses.
std::string new_key() {
  std::random_device random;
  std::string key;
  for (int i = 0; i < 4; ++i) key += fmt::format("{:08x}", random());
  return key;
}

double seconds_since_1970() {
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

// What the server offers beside the machine.
struct ServedServices {
  FirstContact& contact;
  BoardSettings& settings;
  CamService& maker;
  Studies& studies;
  MotionTimer& timer;
};

ApiOptions api_options(const PageFolder* page, const ServedData& data, const ServedJobs& jobs,
                       const ServedServices& services, const std::string& macro_folder,
                       std::function<std::string(const SavedParameters&, const ToolTable&)> keep) {
  ApiOptions options{.version = PASSO_VERSION, .openapi = openapi_text, .make_key = new_key};
  options.history = data.history.get();
  options.macro_folder = macro_folder;
  options.keep_offsets = std::move(keep);
  options.wall_time = seconds_since_1970;
  options.page = [page](const WebRequest& request) -> std::optional<WebAnswer> {
    if (page != nullptr) return page->answer(request);
    if (request.path != "/") return {};
    return WebAnswer{.status = 404, .type = "text/plain; charset=utf-8", .body = no_page};
  };
  if (data.offsets) {
    options.parameters = data.offsets->parameters();
    options.tools = data.offsets->tools();
  }
  options.workshop.records = data.tools->records();
  options.workshop.library = data.tools->library();
  options.keeper = jobs.journal;
  options.machine_access = jobs.machine_access;
  options.machine_access.stamp = jobs.machine_file;
  options.path_judge = jobs.path_judge;
  options.contact = &services.contact;
  options.settings = &services.settings;
  options.maker = &services.maker;
  options.studies = &services.studies;
  options.timer = &services.timer;
  if (jobs.journal != nullptr) options.broken_off = jobs.journal->found();
  return options;
}

// Shows what is wrong with single macros; these are left out.
bool macros_are_good(const std::string& folder, int& code) {
  if (folder.empty()) return true;
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored)) {
    code = fail(exit_bad_program, fmt::format("--macros {}: there is no such folder [serve.macros]", folder));
    return false;
  }
  show(read_macro_folder(folder).findings, folder);
  return true;
}

// As many connections as files may be open, and some files left: for the board, for what is kept, and for a newcomer. A
// server that accepts none because all files are open would let nobody hold the machine.
WebLimits web_limits() {
  constexpr rlim_t other_files = 48;
  constexpr rlim_t least_connections = 8;
  WebLimits limits;
  rlimit files{};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return limits;
  files.rlim_cur = std::max(files.rlim_cur, std::min<rlim_t>(files.rlim_max, limits.connections + other_files));
  static_cast<void>(setrlimit(RLIMIT_NOFILE, &files));
  const rlim_t left = files.rlim_cur > other_files ? files.rlim_cur - other_files : 0;
  limits.connections = std::min<std::size_t>(limits.connections, std::max(left, least_connections));
  limits.watchers = std::min(limits.watchers, limits.connections * 6 / 7);
  return limits;
}

}  // namespace

ServedWeb::ServedWeb(const ServeArguments& arguments, const MachineDescription& machine, MachineSession& session,
                     MachineControl& owner, ServedData data, const ServedJobs& jobs)
    : session_(session),
      owner_(owner),
      page_(arguments.page),
      has_page_(!arguments.page.empty()),
      data_(std::move(data)),
      boards_(arguments),
      timer_(machine),
      api_(machine, session, owner,
           api_options(
               arguments.page.empty() ? nullptr : &page_, data_, jobs,
               {boards_.contact, boards_.settings, maker_, studies_, timer_}, arguments.macros,
               [this](const SavedParameters& parameters, const ToolTable& tools) { return keep(parameters, tools); })) {
}

std::unique_ptr<ServedWeb> ServedWeb::open(const ServeArguments& arguments, const MachineDescription& machine,
                                           MachineSession& session, MachineControl& owner, const ServedJobs& jobs,
                                           int& code) {
  const auto place = web_place(arguments, code);
  if (!place) return nullptr;
  if (!macros_are_good(arguments.macros, code)) return nullptr;
  ServedData data;
  if (!arguments.data.empty()) {
    std::error_code error;
    std::filesystem::create_directories(arguments.data, error);
    auto opened = JobHistory::open((std::filesystem::path(arguments.data) / "jobs.sqlite").string());
    if (!opened) {
      code = fail(exit_failed, fmt::format("--data {} [serve.data]", opened.error()));
      return nullptr;
    }
    data.history = std::move(*opened);
    data.offsets = std::make_unique<ServedOffsets>(arguments.data);
    if (!data.offsets->read()) {
      code = exit_failed;
      return nullptr;
    }
  }
  data.tools = ServedTools::open(arguments, code);
  if (!data.tools) return nullptr;
  std::unique_ptr<ServedWeb> web(new ServedWeb(arguments, machine, session, owner, std::move(data), jobs));
  auto server = WebServer::listen(place->address.host, place->address.port, place->access, web->api_, web_limits());
  if (!server) {
    code = fail(exit_failed, server.error());
    return nullptr;
  }
  const bool has_colon = place->address.host.find(':') != std::string::npos;
  web->host_ = has_colon ? "[" + place->address.host + "]" : place->address.host;
  web->server_ = std::move(*server);
  web->api_.watch(*web->server_);
  return web;
}

std::string ServedWeb::name() const {
  return fmt::format("http://{}:{}/{}", host_, server_->port(), has_page_ ? "" : "api/v1/");
}

Seconds ServedWeb::most_wait(Seconds most) const {
  return api_.is_checking() ? Seconds(0) : most;
}

void ServedWeb::poll() {
  server_->poll();
  api_.poll();
  boards_.settings.poll();
  if (camera_) camera_->poll(*server_);
  if (server_->watchers() > 0) publish();
}

void ServedWeb::publish() {
  const auto now = std::chrono::steady_clock::now();
  if (now - published_ < between_messages) return;
  const std::uint64_t version = session_.status().version;
  const bool is_news = session_.busy() || version != told_version_ || owner_.changes() != told_owner_ ||
                       api_.job() != told_job_ || api_.mdi_version() != told_mdi_ ||
                       now - published_ >= between_signs_of_life;
  if (!is_news) return;
  published_ = now;
  told_version_ = version;
  told_owner_ = owner_.changes();
  told_job_ = api_.job();
  told_mdi_ = api_.mdi_version();
  server_->publish(api_.status_text());
}

void ServedWeb::show(const CameraDescription& camera) {
  camera_ = std::make_unique<ServedCamera>(camera);
  api_.use(camera_->machine_camera());
}

void ServedWeb::share_offsets(GrblController& grbl) {
  grbl_ = &grbl;
  grbl.apply_offsets(api_.parameters());
  grbl.share_offsets([this](const SavedParameters& parameters) {
    api_.apply_offsets(parameters);
    if (board_ != nullptr) board_->store_offsets(parameters);
    if (data_.offsets) api_.set_offsets_trouble(data_.offsets->keep(api_.parameters(), api_.tools()));
  });
}

void ServedWeb::follow_board(GrblMachineSession& board, double bytes_per_second) {
  timer_.follow(board, bytes_per_second);
  api_.apply_offsets(board.offsets(api_.parameters()));
  board_ = &board;
  boards_.settings.use(board);
  board.watch_offsets([this] {
    api_.apply_offsets(board_->offsets(api_.parameters()));
    if (grbl_ != nullptr) grbl_->apply_offsets(api_.parameters());
    if (data_.offsets) api_.set_offsets_trouble(data_.offsets->keep(api_.parameters(), api_.tools()));
  });
}

std::string ServedWeb::keep(const SavedParameters& parameters, const ToolTable& tools) {
  if (board_ != nullptr) board_->store_offsets(parameters);
  if (grbl_ != nullptr) grbl_->apply_offsets(parameters);
  return data_.offsets ? data_.offsets->keep(parameters, tools) : std::string();
}

}  // namespace passo
