#include "passo/pendant/board_handwheel.hpp"

namespace passo {

BoardHandwheel::BoardHandwheel(const HandwheelDescription& wheel, BoardSession& board, const PendantMachine& machine,
                               PendantStatus& status)
    : board_(board),
      session_(machine.session),
      status_(status),
      table_(handwheel_table(wheel)),
      reports_(wheel),
      control_(table_, machine, status),
      asked_at_(-between_queries) {}

// Whether the wheel could move the machine now. PendantControl and the API decide whether it does.
bool BoardHandwheel::may_turn() const {
  switch (session_.state()) {
    case MachineState::idle:
    case MachineState::jog:
    case MachineState::hold:
    case MachineState::tool_change:
    case MachineState::door:
    case MachineState::alarm: return true;
    default: return false;
  }
}

void BoardHandwheel::poll(Seconds now) {
  if (may_turn()) {
    read(now);
  } else {
    pause(now);
  }
  if (is_connected_ && now - heard_at_ > patience) lose(now);
  control_.poll(now);
}

// What the board has answered by now, and what it answers yet, is from before the pause.
void BoardHandwheel::pause(Seconds now) {
  static_cast<void>(board_.handwheel().take_reading());
  drops_next_ = board_.awaits_handwheel();
  reports_.forget();
  heard_at_ = now;
}

void BoardHandwheel::read(Seconds now) {
  auto reading = board_.handwheel().take_reading();
  if (drops_next_) {
    drops_next_ = !reading && board_.awaits_handwheel();
    reading.reset();
  }
  if (reading) {
    heard_at_ = now;
    if (!is_connected_) {
      control_.connect(now);
      missed_before_ = reading->jumps;
    }
    is_connected_ = true;
    status_.missed = static_cast<std::uint16_t>(reading->jumps - missed_before_);
    control_.receive(reports_.next(*reading), now);
  }
  if (now - asked_at_ < between_queries) return;
  asked_at_ = now;
  board_.ask_for_handwheel();
}

void BoardHandwheel::lose(Seconds now) {
  is_connected_ = false;
  reports_.forget();
  control_.disconnect(now);
}

std::optional<bool> has_handwheel(BoardSession& board, Seconds most) {
  const Seconds end = board.now() + most;
  do {
    board.ask_for_handwheel();
    static_cast<void>(board.poll(HandwheelQuery::answer_within));
    if (board.handwheel().take_reading()) return true;
    if (board.handwheel().is_missing()) return false;
  } while (!board.error() && board.now() < end);
  return {};
}

}  // namespace passo
