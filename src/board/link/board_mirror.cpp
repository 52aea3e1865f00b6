#include "passo/link/board_mirror.hpp"

namespace passo {
namespace {

// Limit switches and the emergency stop.
constexpr std::uint16_t stopping_inputs = 0xFF | input_emergency_stop;

}  // namespace

bool BoardMirror::update(const BoardStatus& status, Seconds now) {
  const bool played = status_ && status.event != status_->event;
  status_ = status;
  status_time_ = now;
  return played;
}

void BoardMirror::update_items(ItemNumber executed, int free) {
  executed_ = executed;
  free_ = free;
}

bool BoardMirror::update_inputs(const BoardStatus& status, std::uint16_t ignored) {
  const auto inputs = static_cast<std::uint16_t>(status.inputs & ~(passo::outputs_timed_out | drivers_timed_out));
  const auto pressed = static_cast<std::uint16_t>(inputs & ~inputs_ & ~unsigned{ignored});
  pressed_ |= pressed;
  inputs_ = inputs;
  return pressed != 0;
}

bool BoardMirror::record_pressed(std::uint16_t inputs) {
  pressed_ |= inputs;
  inputs_ |= inputs;
  return inputs != 0;
}

void BoardMirror::record_stop(std::uint16_t inputs) {
  stopped_by_ = inputs;
  inputs_ |= inputs;
}

void BoardMirror::record_stop() {
  stopped_by_ = inputs_ & stopping_inputs;
}

// A status from before the last outputs says nothing of now.
void BoardMirror::on_timeout(const BoardStatus& status, ItemNumber sent) {
  if (status.taken != static_cast<std::uint8_t>(sent)) return;
  outputs_timed_out_ = (status.inputs & passo::outputs_timed_out) != 0;
}

void BoardMirror::forget_events() {
  standstill_.reset();
  rests_ = outputs_timed_out_ = false;
  free_ = 0;
  pressed_ = stopped_by_ = 0;
}

}  // namespace passo
