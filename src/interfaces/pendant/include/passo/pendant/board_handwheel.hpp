// BoardHandwheel: the handwheel at the pins of a board of Passo. It acts as a pendant.
//
//   BoardSession <- query, answer -> HandwheelReports -> PendantControl
//
// Position in the pipeline: outside it, beside the web server, in the same loop; it has no thread and no clock.
//
// Invariants: the board is not asked while a job or a homing cycle runs, so the wheel costs them no time of the link,
// and what is turned then moves nothing afterwards. A board that does not answer for `patience` counts as unplugged.
#pragma once

#include "passo/link/board_session.hpp"
#include "passo/machine_file/handwheel_description.hpp"
#include "passo/pendant/handwheel_reports.hpp"
#include "passo/pendant/pendant_control.hpp"

namespace passo {

class BoardHandwheel {
 public:
  static constexpr Seconds between_queries{0.015};
  static constexpr Seconds patience{0.1};

  // All must outlive this object.
  BoardHandwheel(const HandwheelDescription& wheel, BoardSession& board, const PendantMachine& machine,
                 PendantStatus& status);
  BoardHandwheel(const BoardHandwheel&) = delete;
  BoardHandwheel& operator=(const BoardHandwheel&) = delete;

  // Must be called often. `now`: any clock that goes on while the machine rests.
  void poll(Seconds now);

 private:
  bool may_turn() const;
  void read(Seconds now);
  void pause(Seconds now);
  void lose(Seconds now);

  BoardSession& board_;
  const MachineSession& session_;
  PendantStatus& status_;
  const PendantTable table_;
  HandwheelReports reports_;
  PendantControl control_;
  bool is_connected_ = false;
  bool drops_next_ = false;          // the next reading
  std::uint16_t missed_before_ = 0;  // edges that the board had missed when the wheel was connected
  Seconds asked_at_;
  Seconds heard_at_{0};
};

// Asks the board, which must be ready. Waits for the answer, at most for `most`. Empty: it does not answer.
std::optional<bool> has_handwheel(BoardSession& board, Seconds most);

}  // namespace passo
