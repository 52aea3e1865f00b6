// WebApi: the HTTP and WebSocket API of a machine, for programs and browsers. It converts JSON to requests to the
// machine's session, and the session's status to JSON.
//
//   WebServer -> WebApi -> a row of api_routes() -> MachineApi, JobsApi, ProgramsApi … -> requests to MachineSession
//             <- JSON                                                                  <- status and changes
//
// Position in the pipeline: outside it, above the session, like GrblController for senders. It uses no sockets and no
// clock. docs/api/openapi.json describes each request; lengths are mm, speeds mm/min, times seconds.
//
// Invariants: only the client in control moves the machine; everyone may hold and stop. A program runs only after a
// successful check from the current position. Memory is bounded.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/api/api_job.hpp"
#include "passo/api/api_options.hpp"
#include "passo/api/camera.hpp"
#include "passo/api/machine_control.hpp"
#include "passo/api/pendant_status.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

class WebApi final : public WebHandler {
 public:
  // All references must outlive this object.
  WebApi(const MachineDescription& machine, MachineSession& session, MachineControl& owner, ApiOptions options);
  ~WebApi() override;

  WebService find(const WebRequest& head) override;
  WebAnswer refusal(unsigned status) override;
  // The files of the web interface are public; its API requests need the token.
  bool is_public(const WebRequest& request) override;
  // {"do": "/api/v1/jog/renew", "key": "…", "body": {…}} acts as a POST; the response has "do", "status" and "body".
  std::string hear(std::string_view message, std::uint64_t client) override;
  void gone(std::uint64_t client) override;

  // Answers a request whose body has been received.
  WebAnswer answer(const WebRequest& request) { return find(request).answer(request); }

  // Processes the session's changes since the last call. Must be called after each turn of the session.
  void on_change(const std::vector<MachineChange>& changes);
  // Does a limited piece of pending work: about a millisecond of a check, or disk access while the machine is idle.
  // Must be called once per iteration of the main loop.
  void poll();
  // Returns true if poll() has more work to do immediately.
  bool is_checking() const;
  // Returns the status, as in GET /api/v1/status.
  std::string status_text() const;
  // The offsets and tools of the programs. apply_offsets() adopts changes made by a sender.
  const SavedParameters& parameters() const;
  const ToolTable& tools() const;
  void apply_offsets(const SavedParameters& parameters);
  // Sets the reason why a sender's offsets could not be saved. Empty: they are saved.
  void set_offsets_trouble(std::string why);
  // Returns the last known motor position of the interrupted job, if it is reliable. Empty: there is none.
  std::optional<Point> broken_off_at();
  // Sets the server whose counters are included in the metrics.
  void watch(const WebServer& server);
  // Sets the pendant that the status shows; must outlive the API.
  void watch(const PendantStatus& pendant);
  // Sets the camera of the machine. Its pictures must outlive the API.
  void use(const MachineCamera& camera);
  const ApiJob& job() const;
  // Returns the remaining time of the running job, if it is known.
  std::optional<Seconds> time_left() const;
  // Increases when the modal state of the MDI lines has changed.
  std::uint64_t mdi_version() const;
  // Announces the end of the program: a job that is stopped from now on counts as interrupted.
  void leave();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace passo
