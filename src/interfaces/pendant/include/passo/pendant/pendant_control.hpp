// PendantControl: acts for a pendant, by the requests of the API that browsers use too.
//
//   PendantDevice -> PendantDecoder -> PendantControl -> PendantJog -> WebApi -> session
//                                         keys ---------------------> WebApi
//
// Position in the pipeline: outside it, beside the web server, in the same loop; it has no thread and no clock.
//
// Invariants: the machine moves for a pendant only after a request that the API has accepted, so never while a job
// runs. What moves for the wheel or the ring ends when the pendant is gone or has lost its link. A pendant has control
// of the machine only while it is used; then the one who had it before has it again (docs/decisions/0206).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/api/machine_control.hpp"
#include "passo/api/pendant_status.hpp"
#include "passo/api/web_api.hpp"
#include "passo/pendant/pendant_decoder.hpp"
#include "passo/pendant/pendant_display.hpp"
#include "passo/pendant/pendant_jog.hpp"
#include "passo/pendant/pendant_table.hpp"
#include "passo/session/machine_session.hpp"
#include "passo/web/web_server.hpp"

namespace passo {

// The machine that a pendant moves.
struct PendantMachine {
  const MachineDescription& machine;
  MachineSession& session;
  MachineControl& owner;
  WebApi& api;
};

class PendantControl final : private PendantJogPort {
 public:
  static constexpr Seconds gives_back_after{0.5};
  static constexpr Seconds between_views{0.1};

  // All must outlive this object.
  PendantControl(const PendantTable& table, const PendantMachine& machine, PendantStatus& status);

  void connect(Seconds now);
  // Processes a report.
  void receive(std::span<const std::uint8_t> report, Seconds now);
  // The pendant was unplugged.
  void disconnect(Seconds now);
  // Must be called often. `now`: any clock that goes on while the machine rests.
  void poll(Seconds now);
  // Returns the reports for the display, if it has to show something new.
  std::vector<std::vector<std::uint8_t>> take_display(Seconds now);

 private:
  struct Answer {
    unsigned status = 0;
    std::string body;
    bool is_good() const { return status >= 200 && status < 300; }
  };

  bool begin(const PendantMove& move) override;
  void renew(double share) override;
  void stop() override;
  bool jogs() const override;

  void handle(const PendantEvent& event, Seconds now);
  void turn_wheel(int detents, Seconds now);
  void press(const PendantKey& key);
  void act(const PendantAction& action);
  void start();
  void resume_sender();
  bool has_sender_program() const { return to_.owner.is_sender() && to_.session.busy(); }
  void reset();
  void zero(std::optional<Axis> axis);
  void stop_spindle();
  void change_override(double feed, double spindle);
  void choose_mode(bool is_continuous);
  void choose_step(int index);
  void lose_link();

  Answer ask(std::string_view path, const std::string& body = "");
  // Asks with control of the machine.
  bool ask_in_control(std::string_view path, const std::string& body = "");
  bool take_control();
  void give_back_control(Seconds now);
  void record_refusal(const Answer& answer);
  PendantView view() const;

  const PendantTable& table_;
  const PendantMachine to_;
  PendantStatus& status_;
  PendantDecoder decoder_;
  PendantJog jog_;
  int step_ = -1;  // index of the selected step; negative: none
  bool modifies_ = false;
  bool jogs_ = false;
  std::string key_;                       // for requests; empty: not in control
  std::optional<MachineControl> before_;  // who had control before
  Seconds now_{0};
  Seconds used_at_{0};
  Seconds heard_at_{0};
  PendantView shown_;
  Seconds shown_at_{0};
  bool has_shown_ = false;
};

}  // namespace passo
