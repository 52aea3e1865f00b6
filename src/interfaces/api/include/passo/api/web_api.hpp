// WebApi: a machine for programs and browsers, by HTTP and WebSocket. It turns JSON into requests of the machine's
// session, and the session's status into JSON.
//
//   WebServer -> WebApi -> a row of api_routes() -> MachineApi, JobsApi, ProgramsApi … -> requests to MachineSession
//             <- JSON                                                                  <- status and changes
//
// Position in the pipeline: outside it, above the session, as GrblController is for senders. It knows no sockets and no
// clock. docs/api/openapi.json describes each request; lengths are mm, speeds mm/min, times seconds.
//
// Invariants: only the owner of motion moves the machine; everybody may hold and stop. A program runs only after a
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
#include "passo/api/motion_owner.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/session/machine_session.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

class WebApi final : public WebHandler {
 public:
  // All of them outlive this.
  WebApi(const MachineDescription& machine, MachineSession& session, MotionOwner& owner, ApiOptions options);
  ~WebApi() override;

  WebService find(const WebRequest& head) override;
  WebAnswer refusal(unsigned status) override;
  // The page itself is no secret: what it asks of the API needs the token.
  bool is_public(const WebRequest& request) override;
  // {"do": "/api/v1/jog/renew", "key": "…", "body": {…}} is a POST; the answer has "do", "status" and "body".
  std::string hear(std::string_view message, std::uint64_t client) override;
  void gone(std::uint64_t client) override;

  // To a request whose body is at hand.
  WebAnswer answer(const WebRequest& request) { return find(request).answer(request); }

  // Heeds what has happened. `changes`: the session's, since the last call. Call after each turn of the session.
  void on_change(const std::vector<MachineChange>& changes);
  // Does a bounded piece of what was asked: about a millisecond of a check, or the disk's time while the machine rests.
  // Call once in each round of the loop.
  void poll();
  // True: poll() has more to do at once.
  bool is_checking() const;
  // The status, as GET /api/v1/status gives it.
  std::string status_text() const;
  // The offsets and tools of the programs. apply_offsets() takes those that a sender has changed.
  const SavedParameters& parameters() const;
  const ToolTable& tools() const;
  void apply_offsets(const SavedParameters& parameters);
  // A sender's offsets could not be kept, for this reason. Empty: they are.
  void set_offsets_trouble(std::string why);
  // Where the motors of the job that was broken off were last, as far as that is sure. Empty: there is none.
  std::optional<Point> broken_off_at();
  // What web servers count, for the metrics.
  void watch(const WebServer& server);
  const ApiJob& job() const;
  // Of the job that runs, as far as it is known.
  std::optional<Seconds> time_left() const;
  // Grows when the modes of the lines that a person types have changed.
  std::uint64_t mdi_version() const;
  // From now on a job that is stopped was broken off: the program is about to end.
  void leave();

 private:
  class Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace passo
