// ApiOptions: what a program gives to the API besides the machine.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "passo/api/maker.hpp"
#include "passo/api/motion_times.hpp"
#include "passo/api/studies.hpp"
#include "passo/job/job_history.hpp"
#include "passo/job/kept_job.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

// The machine file on the disk.
struct MachineFileAccess {
  std::string name;  // for people
  std::function<std::optional<std::string>()> read = {};
  // Writes `after`, if the file is still as `before`. Returns why it could not; empty: it is written. Null: the machine
  // is no file.
  std::function<std::string(const std::string& before, const std::string& after)> write = {};
};

struct ApiOptions {
  std::string version;                    // of the program
  std::string openapi;                    // the text of docs/api/openapi.json
  std::function<std::string()> make_key;  // a text that nobody guesses, for an owner of motion
  // What serves other paths: a folder with a page. Empty: nothing does.
  std::function<std::optional<WebAnswer>(const WebRequest& request)> page = {};
  // Keeps the queue of jobs and what became of them; outlives the API. Null: there is no queue, and nothing is kept.
  JobHistory* history = nullptr;
  std::function<double()> wall_time = {};  // seconds since 1970, for the history
  // Keeps the journal of a job, with a history; outlives the API. Null: a job that is broken off cannot go on.
  JobKeeper* keeper = nullptr;
  FileStamp machine_file = {};            // as it was read
  MachineFileAccess machine_access = {};  // for an editor
  // The offsets and tools of the programs at the beginning, and what keeps them when they have changed: it returns why
  // it could not, or an empty text.
  SavedParameters parameters = {};
  ToolTable tools = {};
  std::function<std::string(const SavedParameters&, const ToolTable&)> keep_offsets = {};
  std::optional<BrokenOff> broken_off = {};  // the job of an earlier program
  // Makes programs of drawings; outlives the API. Null: nobody does.
  Maker* maker = nullptr;
  // Works out what takes longer; outlives the API. Null: nobody does.
  Studies* studies = nullptr;
  // Times the motion of programs; outlives the API. Null: nobody does, and the time left is not known.
  MotionTimer* timer = nullptr;
};

}  // namespace passo
