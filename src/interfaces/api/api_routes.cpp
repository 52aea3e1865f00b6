#include "passo/api/api_routes.hpp"

#include <charconv>
#include <utility>

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

namespace passo {
namespace {

using enum BodyKind;

// Who may ask.
constexpr bool anybody = false;
constexpr bool owner = true;

constexpr ApiRoute routes[] = {
    {"GET", "/alarms", "listAlarms", anybody, none, &JobsApi::list_alarms, Needs::history},
    {"GET", "/health", "getHealth", anybody, none, &MachineApi::health},
    {"POST", "/go", "goToPlace", owner, json, &SmallJobsApi::go_to},
    {"POST", "/hold", "hold", anybody, json, &MachineApi::hold},
    {"POST", "/home", "home", owner, json, &MachineApi::home},
    {"GET", "/history", "listHistory", anybody, none, &JobsApi::list_history, Needs::history},
    {"GET", "/homing", "getHoming", anybody, none, &MachineApi::homing},
    {"GET", "/log", "getLog", anybody, none, &JobsApi::log},
    {"GET", "/metrics", "getMetrics", anybody, none, &MachineApi::metrics},
    {"GET", "/openapi.json", "getDescription", anybody, none, &MachineApi::openapi},
    {"GET", "/pulses", "getPulses", anybody, none, &MachineApi::pulses},
    {"GET", "/status", "getStatus", anybody, none, &MachineApi::status},
    {"GET", "/stream", "openStream", anybody, none, &MachineApi::stream},

    {"GET", "/board/files", "getBoardFiles", anybody, none, &BoardFilesApi::get},
    {"POST", "/board/files", "listBoardFiles", owner, none, &BoardFilesApi::list},
    {"PUT", "/board/files/{path}", "sendBoardFile", owner, program, &BoardFilesApi::send},
    {"DELETE", "/board/files/{path}", "deleteBoardFile", owner, none, &BoardFilesApi::remove},
    {"POST", "/board/run", "runBoardFile", owner, json, &BoardFilesApi::run},

    {"GET", "/board/settings", "getBoardSettings", anybody, none, &SettingsApi::get, Needs::settings},
    {"POST", "/board/settings", "useBoardSettings", owner, json, &SettingsApi::begin},
    {"GET", "/board/settings/file", "getBoardSettingsFile", anybody, none, &SettingsApi::file, Needs::settings},

    {"GET", "/cam", "getCam", anybody, none, &CamApi::get, Needs::maker},
    {"POST", "/cam", "beginCam", anybody, json, &CamApi::begin},
    {"POST", "/cam/files", "sendCamFile", anybody, bytes, &CamApi::keep_file, Needs::maker},
    {"DELETE", "/cam/files", "clearCamFiles", anybody, none, &CamApi::clear_files, Needs::maker},
    {"GET", "/cam/job", "getCamJobFile", anybody, none, &CamApi::job_file, Needs::maker},
    {"POST", "/cam/job", "editCamJobFile", anybody, json, &CamApi::edit_job_file},
    {"GET", "/cam/operations", "getCamOperations", anybody, none, &CamApi::operations},
    {"GET", "/cam/page", "getCamPage", anybody, none, &CamApi::page, Needs::maker},
    {"GET", "/cam/picture", "getCamPicture", anybody, none, &CamApi::picture, Needs::maker},
    {"GET", "/cam/shapes", "getCamShapes", anybody, none, &CamApi::shapes, Needs::maker},

    {"GET", "/camera/still", "getCameraStill", anybody, none, &CameraApi::still, Needs::camera},
    {"GET", "/camera/stream", "openCameraStream", anybody, none, &CameraApi::stream, Needs::camera},

    {"GET", "/history/stills/{id}", "getJobStill", anybody, none, &CameraApi::job_still, Needs::history},

    {"GET", "/interrupted", "getInterrupted", anybody, none, &JobsApi::get_interrupted, Needs::history},
    {"DELETE", "/interrupted", "dropInterrupted", owner, none, &JobsApi::drop_interrupted, Needs::history},
    {"POST", "/interrupted/reenter", "reenterInterrupted", owner, none, &JobsApi::reenter_interrupted, Needs::history},
    {"POST", "/interrupted/resume", "resumeInterrupted", owner, none, &JobsApi::resume_interrupted, Needs::history},

    {"POST", "/jog", "jog", owner, json, &MachineApi::jog},
    {"POST", "/jog/renew", "renewJog", owner, json, &MachineApi::renew_jog},

    {"GET", "/machine", "getMachine", anybody, none, &MachineApi::description},
    {"GET", "/machine/file", "getMachineFile", anybody, none, &MachineFileApi::get},
    {"POST", "/machine/file", "writeMachineFile", owner, json, &MachineFileApi::write},
    {"POST", "/machine/file/draft", "draftMachineFile", anybody, json, &MachineFileApi::draft},
    {"POST", "/machine/files", "keepMachineFile", owner, json, &PortsApi::keep_machine},

    {"GET", "/macros", "listMacros", anybody, none, &SmallJobsApi::list_macros},
    {"POST", "/macros", "runMacro", owner, json, &SmallJobsApi::run_macro},

    {"POST", "/mdi", "runLine", owner, json, &MachineApi::run_line},
    {"POST", "/operator-done", "confirmOperatorDone", owner, none, &MachineApi::operator_done},
    {"POST", "/outputs", "switchOutputs", owner, json, &MachineApi::switch_outputs},
    {"POST", "/override", "setOverride", owner, json, &MachineApi::set_overrides},

    {"POST", "/owner", "takeOwnership", anybody, json, &OwnerApi::claim},
    {"DELETE", "/owner", "giveBackOwnership", anybody, none, &OwnerApi::release},
    {"POST", "/owner/renew", "renewOwnership", owner, none, &OwnerApi::renew},

    {"GET", "/ports", "listPorts", anybody, none, &PortsApi::list, Needs::ports},
    {"GET", "/ports/open", "getOpenedPort", anybody, none, &PortsApi::opened, Needs::ports},
    {"POST", "/ports/open", "openPort", owner, json, &PortsApi::open},

    {"POST", "/position", "setPosition", owner, json, &MachineApi::set_position},
    {"POST", "/probe", "probe", owner, json, &JobsApi::probe},

    {"GET", "/programs", "listPrograms", anybody, none, &ProgramsApi::list},
    {"POST", "/programs", "sendProgram", anybody, program, &ProgramsApi::send},
    {"GET", "/programs/{id}", "getProgram", anybody, none, &ProgramsApi::get},
    {"DELETE", "/programs/{id}", "deleteProgram", owner, none, &ProgramsApi::remove},
    {"POST", "/programs/{id}/block-delete", "setBlockDelete", anybody, json, &ProgramsApi::set_block_delete},
    {"POST", "/programs/{id}/check", "checkProgram", anybody, none, &ProgramsApi::check},
    {"POST", "/programs/{id}/frame", "frameProgram", owner, json, &SmallJobsApi::frame},
    {"GET", "/programs/{id}/height-map", "getHeightMap", anybody, none, &ProgramsApi::height_map},
    {"POST", "/programs/{id}/height-map", "setHeightMap", anybody, table, &ProgramsApi::set_height_map},
    {"POST", "/programs/{id}/level", "levelProgram", anybody, none, &ProgramsApi::level},
    {"GET", "/programs/{id}/path", "getProgramPath", anybody, none, &ProgramsApi::path},
    {"POST", "/programs/{id}/run", "runProgram", owner, none, &JobsApi::run},
    {"GET", "/programs/{id}/text", "getProgramText", anybody, none, &ProgramsApi::text},
    {"GET", "/programs/{id}/way", "getProgramWay", anybody, none, &JobsApi::way},

    {"GET", "/queue", "listQueue", anybody, none, &JobsApi::list_queue, Needs::history},
    {"POST", "/queue", "queueJob", anybody, program, &JobsApi::queue, Needs::history},
    {"GET", "/queue/attempts/{path}", "getQueuedAttempt", anybody, none, &JobsApi::get_attempt, Needs::history},
    {"PUT", "/queue/attempts/{path}", "queueAttempt", anybody, program, &JobsApi::queue_attempt, Needs::history},
    {"DELETE", "/queue/{id}", "deleteQueuedJob", owner, none, &JobsApi::delete_queued, Needs::history},
    {"POST", "/queue/{id}/run", "runQueuedJob", owner, none, &JobsApi::run_queued, Needs::history},

    {"POST", "/reset", "reset", owner, none, &MachineApi::order<request::ResetMachine>},
    {"POST", "/resume", "resume", owner, none, &MachineApi::order<request::Resume>},
    {"POST", "/sleep", "sleep", owner, none, &MachineApi::order<request::Sleep>},
    {"POST", "/stop", "stop", anybody, none, &MachineApi::stop},
    {"POST", "/stops", "chooseStops", owner, json, &MachineApi::choose_stops},

    {"GET", "/study", "getStudy", anybody, none, &StudiesApi::get, Needs::studies},
    {"POST", "/study", "beginStudy", anybody, json, &StudiesApi::begin},
    {"GET", "/study/loads", "getStudyLoads", anybody, none, &StudiesApi::loads, Needs::studies},
    {"GET", "/study/options", "getStudyOptions", anybody, none, &StudiesApi::options},
    {"GET", "/study/picture", "getStudyPicture", anybody, none, &StudiesApi::picture, Needs::studies},

    {"GET", "/tools", "listTools", anybody, none, &ToolsApi::list},
    {"POST", "/tools", "readToolLibrary", anybody, bytes, &CamApi::tools},
    {"POST", "/tools/{id}/replaced", "replaceTool", owner, none, &ToolsApi::replace},

    {"GET", "/uploads", "listUploads", anybody, none, &ProgramsApi::list_uploads},
    {"POST", "/uploads", "beginUpload", anybody, none, &ProgramsApi::begin_upload},
    {"GET", "/uploads/{id}", "getUpload", anybody, none, &ProgramsApi::get_upload},
    {"DELETE", "/uploads/{id}", "dropUpload", anybody, none, &ProgramsApi::drop_upload},
    {"POST", "/uploads/{id}", "sendUploadPiece", anybody, program, &ProgramsApi::receive_piece},

    {"POST", "/wake", "wake", owner, none, &MachineApi::order<request::Wake>},
    {"POST", "/work", "setWorkZero", owner, json, &MachineApi::set_work_zero},
};
constexpr std::string_view id_place = "{id}";
constexpr std::string_view rest_place = "{path}";

bool matches(std::string_view pattern, std::string_view path, std::uint64_t& id, std::string& rest) {
  if (pattern.ends_with(rest_place)) {
    const std::string_view head = pattern.substr(0, pattern.size() - rest_place.size());
    if (!path.starts_with(head) || path.size() == head.size()) return false;
    rest = path.substr(head.size());
    return true;
  }
  const std::size_t at = pattern.find(id_place);
  if (at == std::string_view::npos) return pattern == path;
  if (!path.starts_with(pattern.substr(0, at))) return false;
  path.remove_prefix(at);
  const auto [end, error] = std::from_chars(path.data(), path.data() + path.size(), id);
  if (error != std::errc()) return false;
  path.remove_prefix(static_cast<std::size_t>(end - path.data()));
  return path == pattern.substr(at + id_place.size());
}

}  // namespace

std::span<const ApiRoute> api_routes() {
  return routes;
}

FoundRoute find_route(std::string_view method, std::string_view path) {
  FoundRoute found;
  if (!path.starts_with(api_root)) return found;
  path.remove_prefix(api_root.size());
  for (const ApiRoute& one : routes) {
    if (!matches(one.path, path, found.id, found.rest)) continue;
    if (one.method == method) return {.route = &one, .id = found.id, .rest = std::move(found.rest)};
    found.allowed += found.allowed.empty() ? "" : ", ";
    found.allowed += one.method;
  }
  return found;
}

}  // namespace passo
