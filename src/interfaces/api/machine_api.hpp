// MachineApi: the machine itself: its status, and manual operation: hold, stop, jog, home, overrides, outputs, MDI
// lines, and the work zero. Private to api/.
#pragma once

#include <cstdint>
#include <string>

#include "api_call.hpp"
#include "api_shared.hpp"
#include "homing_record.hpp"
#include "job_runner.hpp"
#include "program_times.hpp"

#include "passo/api/mdi_lines.hpp"
#include "passo/api/pendant_status.hpp"

namespace passo {

class MachineApi {
 public:
  // All references must outlive this object.
  MachineApi(const ApiShared& shared, JobRunner& jobs, const ProgramTimes& times, MdiLines& mdi);

  WebAnswer status(const ApiCall& call);
  WebAnswer health(const ApiCall& call);
  WebAnswer description(const ApiCall& call);
  WebAnswer homing(const ApiCall& call);
  WebAnswer pulses(const ApiCall& call);
  WebAnswer metrics(const ApiCall& call);
  WebAnswer openapi(const ApiCall& call);
  // Returns an error: the stream requires WebSocket.
  WebAnswer stream(const ApiCall& call);

  WebAnswer hold(const ApiCall& call);
  WebAnswer stop(const ApiCall& call);
  WebAnswer home(const ApiCall& call);
  WebAnswer jog(const ApiCall& call);
  WebAnswer renew_jog(const ApiCall& call);
  WebAnswer set_overrides(const ApiCall& call);
  WebAnswer choose_stops(const ApiCall& call);
  WebAnswer switch_outputs(const ApiCall& call);
  WebAnswer operator_done(const ApiCall& call);
  WebAnswer set_position(const ApiCall& call);
  WebAnswer set_work_zero(const ApiCall& call);
  WebAnswer run_line(const ApiCall& call);
  // Passes on a session request without parameters.
  template <class Wanted>
  WebAnswer order(const ApiCall&) {
    return ask(Wanted{});
  }

  std::string status_text() const;
  void on_change(const MachineChange& change);
  void poll();
  // Sets the server whose counters are included in the metrics.
  void watch(const WebServer& server) { server_ = &server; }
  // Sets the pendant that the status shows.
  void watch(const PendantStatus& pendant) { pendant_ = &pendant; }

 private:
  WebAnswer ask(Request wanted);
  std::vector<Sentence> unkept() const;
  std::string metrics_text() const;

  const ApiShared& shared_;
  JobRunner& jobs_;
  const ProgramTimes& times_;
  MdiLines& mdi_;
  HomingRecord homing_;
  std::uint64_t mdi_owner_ = 0;  // value of MachineControl::changes() for the MDI lines
  const WebServer* server_ = nullptr;
  const PendantStatus* pendant_ = nullptr;
  std::uint64_t alarms_ = 0;
  std::uint64_t late_ = 0;  // number of stops because a queue update was late
};

}  // namespace passo
