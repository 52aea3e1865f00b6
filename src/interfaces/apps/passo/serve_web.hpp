// ServedWeb: the web server of `passo serve`, with its API.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "page_folder.hpp"
#include "serve_addresses.hpp"
#include "served_camera.hpp"
#include "served_contact.hpp"
#include "served_journal.hpp"
#include "served_maker.hpp"
#include "served_offsets.hpp"
#include "served_settings.hpp"
#include "served_studies.hpp"
#include "served_timer.hpp"
#include "served_tools.hpp"

#include "passo/api/web_api.hpp"
#include "passo/grbl/grbl_controller.hpp"
#include "passo/sender/grbl_machine_session.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

// the contents of docs/api/openapi.json
extern const char* const openapi_text;

// The persistent data of a running job.
struct ServedJobs {
  ServedJournal* journal = nullptr;  // null: none
  FileStamp machine_file;
  MachineFileAccess machine_access;
  std::function<PathJudge()> path_judge = {};  // see ApiOptions
};

// What is stored in the folder of --data.
struct ServedData {
  std::unique_ptr<JobHistory> history = {};     // may be null
  std::unique_ptr<ServedOffsets> offsets = {};  // may be null
  std::unique_ptr<ServedTools> tools = {};
};

class ServedWeb {
 public:
  // Null, with a message and `code`, if the address or the token is invalid.
  static std::unique_ptr<ServedWeb> open(const ServeArguments& arguments, const MachineDescription& machine,
                                         MachineSession& session, MachineControl& owner, const ServedJobs& jobs,
                                         int& code);

  std::string name() const;
  // The file descriptors that wake up the loop, and its maximum sleep time.
  void add_to(std::vector<pollfd>& all) const { server_->add_to(all); }
  Seconds most_wait(Seconds most) const;
  void hear_changes(const std::vector<MachineChange>& changes) { api_.on_change(changes); }
  // Returns the last known motor position of the interrupted job, if it is reliable.
  std::optional<Point> broken_off_at() { return api_.broken_off_at(); }
  // A job that is stopped from now on can be resumed when the program runs again.
  void leave() { api_.leave(); }
  const WebApi& api() const { return api_; }
  WebApi& api() { return api_; }
  // Shows the pictures of the machine's camera.
  void show(const CameraDescription& camera);
  // Makes senders and programs share the same offsets. `grbl` must outlive this object.
  void share_offsets(GrblController& grbl);
  // The board keeps the work offsets: takes over its own, and writes changed ones to it. It plans the motion, too:
  // times are predicted for it, and for a connection of that rate (0: without limit). `board` must outlive this object.
  void follow_board(GrblMachineSession& board, double bytes_per_second);
  // Processes requests of the clients, and sends changes to those that are subscribed.
  void poll();

 private:
  ServedWeb(const ServeArguments& arguments, const MachineDescription& machine, MachineSession& session,
            MachineControl& owner, ServedData data, const ServedJobs& jobs);
  void publish();
  std::string keep(const SavedParameters& parameters, const ToolTable& tools);

  MachineSession& session_;
  MachineControl& owner_;
  PageFolder page_;
  bool has_page_ = false;
  ServedData data_;
  GrblController* grbl_ = nullptr;       // the controller for senders
  GrblMachineSession* board_ = nullptr;  // a board that keeps the offsets
  std::string host_;
  ServedBoards boards_;
  ServedMaker maker_;
  ServedStudies studies_;
  ServedTimer timer_;
  std::unique_ptr<ServedCamera> camera_;  // null: the machine has none
  WebApi api_;
  std::unique_ptr<WebServer> server_;
  std::chrono::steady_clock::time_point published_;
  std::uint64_t told_version_ = 0;
  std::uint64_t told_owner_ = 0;
  ApiJob told_job_;
  std::uint64_t told_mdi_ = 0;
};

}  // namespace passo
