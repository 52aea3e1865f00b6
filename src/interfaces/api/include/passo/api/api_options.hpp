// ApiOptions: the data and services that a program provides to the API in addition to the machine.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "passo/api/board_settings.hpp"
#include "passo/api/cam_service.hpp"
#include "passo/api/first_contact.hpp"
#include "passo/api/motion_times.hpp"
#include "passo/api/program_store.hpp"
#include "passo/api/studies.hpp"
#include "passo/job/job_history.hpp"
#include "passo/job/kept_job.hpp"
#include "passo/job/tool_records.hpp"
#include "passo/tooling/tool_library.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

// Access to the machine file on disk.
struct MachineFileAccess {
  std::string name;  // name of the file for display
  std::function<std::optional<std::string>()> read = {};
  // Writes `after`, if the file still contains `before`. Returns the reason for a failure; empty on success. Null: the
  // machine is not from a file.
  std::function<std::string(const std::string& before, const std::string& after)> write = {};
  FileStamp stamp = {};  // fingerprint of the file when it was read
};

// The tools of the workshop. Both must outlive the API.
struct WorkshopTools {
  ToolRecords* records = nullptr;        // stores what each tool has cut; null: it is not counted
  const ToolLibrary* library = nullptr;  // has their names and the limits of their lives; null: unknown
};

struct ApiOptions {
  std::string version;                    // program version
  std::string openapi;                    // contents of docs/api/openapi.json
  std::function<std::string()> make_key;  // returns an unguessable key for the client in control
  // Serves all other paths: a folder with the web interface. Empty: not served.
  std::function<std::optional<WebAnswer>(const WebRequest& request)> page = {};
  // Stores the job queue and the history; must outlive the API. Null: there is no queue and no history.
  JobHistory* history = nullptr;
  WorkshopTools workshop = {};
  std::function<double()> wall_time = {};  // seconds since 1970, for the history
  // Writes the journal of a job, in addition to the history; must outlive the API. Null: an interrupted job cannot be
  // resumed.
  JobKeeper* keeper = nullptr;
  MachineFileAccess machine_access = {};  // for the editor
  // The folder with macros, and with the subroutines that programs may call. Empty: there is none.
  std::string macro_folder = {};
  // The initial offsets and tools of the programs, and a function that saves them after a change; it returns the reason
  // for a failure, or an empty text.
  SavedParameters parameters = {};
  ToolTable tools = {};
  std::function<std::string(const SavedParameters&, const ToolTable&)> keep_offsets = {};
  std::optional<BrokenOff> broken_off = {};  // the job of an earlier program run
  // Generates programs from drawings; must outlive the API. Null: not available.
  CamService* maker = nullptr;
  // Lists and opens serial ports; must outlive the API. Null: not available.
  FirstContact* contact = nullptr;
  // Reads and writes the settings of a Grbl board; must outlive the API. Null: not available.
  BoardSettings* settings = nullptr;
  // Runs longer analyses; must outlive the API. Null: not available.
  Studies* studies = nullptr;
  // Returns a judge for the path of each program that is checked. Null: the board can execute every path.
  std::function<PathJudge()> path_judge = {};
  // Computes the duration of programs; must outlive the API. Null: not available, so the remaining time is unknown.
  MotionTimer* timer = nullptr;
};

}  // namespace passo
