// ServedWeb: the web server of `passo serve`, with the API behind it.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "commands.hpp"
#include "page_folder.hpp"
#include "serve_addresses.hpp"
#include "served_journal.hpp"
#include "served_maker.hpp"
#include "served_offsets.hpp"
#include "served_studies.hpp"
#include "served_timer.hpp"

#include "passo/api/web_api.hpp"
#include "passo/grbl/grbl_controller.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

// docs/api/openapi.json
extern const char* const openapi_text;

// What is kept of a job that runs.
struct ServedJobs {
  ServedJournal* journal = nullptr;  // null: none
  FileStamp machine_file;
  MachineFileAccess machine_access;
};

class ServedWeb {
 public:
  // Null, with a message and `code`: the address or the token is not good.
  static std::unique_ptr<ServedWeb> open(const ServeArguments& arguments, const MachineDescription& machine,
                                         MachineSession& session, MotionOwner& owner, const ServedJobs& jobs,
                                         int& code);

  std::string name() const;
  // What the loop wakes up for, and how long it may sleep.
  void add_to(std::vector<pollfd>& all) const { server_->add_to(all); }
  Seconds most_wait(Seconds most) const;
  void hear_changes(const std::vector<MachineChange>& changes) { api_.on_change(changes); }
  // Where the motors of the job that was broken off were last, as far as that is sure.
  std::optional<Point> broken_off_at() { return api_.broken_off_at(); }
  // A job that is stopped from now on can go on when the program runs again.
  void leave() { api_.leave(); }
  const WebApi& api() const { return api_; }
  // From now on senders and programs have the same offsets. `grbl` outlives this.
  void share_offsets(GrblController& grbl);
  // Hears the clients, and tells those who watch what is new.
  void poll();

 private:
  ServedWeb(const ServeArguments& arguments, const MachineDescription& machine, MachineSession& session,
            MotionOwner& owner, std::unique_ptr<JobHistory> history, std::unique_ptr<ServedOffsets> offsets,
            const ServedJobs& jobs);
  void publish();
  std::string keep(const SavedParameters& parameters, const ToolTable& tools);

  MachineSession& session_;
  MotionOwner& owner_;
  PageFolder page_;
  bool has_page_ = false;
  std::unique_ptr<JobHistory> history_;     // may be null
  std::unique_ptr<ServedOffsets> offsets_;  // may be null
  GrblController* grbl_ = nullptr;          // what senders speak to
  std::string host_;
  ServedMaker maker_;
  ServedStudies studies_;
  ServedTimer timer_;
  WebApi api_;
  std::unique_ptr<WebServer> server_;
  std::chrono::steady_clock::time_point published_;
  std::uint64_t told_version_ = 0;
  std::uint64_t told_owner_ = 0;
  ApiJob told_job_;
  std::uint64_t told_mdi_ = 0;
};

}  // namespace passo
