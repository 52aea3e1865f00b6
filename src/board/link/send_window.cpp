#include "passo/link/send_window.hpp"

#include <algorithm>
#include <utility>

#include "passo/base/ensure.hpp"

namespace passo {

void SendWindow::begin(ItemNumber number) {
  sent_ = on_wire_ = taken_ = number;
  kept_.clear();
  repeats_ = false;
  statistics_.forget_pace();
}

void SendWindow::push(const Frame& frame) {
  ensure(frame.number == next() && frame.size > 0 && frame.size <= largest_frame);
  sent_ = frame.number;
  if (!keeps_) return put_counted(frame);
  if (kept_.empty()) statistics_.begin_burst(port_.elapsed());
  kept_.push_back(frame);
  statistics_.record_in_burst();
}

// A board that plays dense motion takes frames more slowly than the line brings them.
bool SendWindow::fill(std::size_t most_bytes) {
  if (repeats_) return false;
  std::size_t under_way = 0;
  for (const Frame& frame : kept_) {
    under_way += frame.size;
    if (later_by(frame.number, on_wire_) <= 0) continue;
    if (under_way > most_bytes) return false;
    put_counted(frame);
  }
  return true;
}

// A number that is not between the last frame known to be taken and the last frame sent is old, and ignored.
bool SendWindow::on_accepted(std::uint8_t sequence) {
  const auto more = static_cast<std::uint8_t>(sequence - static_cast<std::uint8_t>(taken_));
  if (more == 0 || more > untaken()) return false;
  taken_ = static_cast<ItemNumber>(taken_ + more);
  while (!kept_.empty() && later_by(kept_.front().number, taken_) <= 0) kept_.pop_front();
  if (kept_.empty()) statistics_.end_burst(port_.elapsed());
  if (later_by(taken_, on_wire_) > 0) on_wire_ = taken_;
  return true;
}

// Repeating all frames at each complaint would be worse: on a bad line, each of many frames would bring many more.
void SendWindow::repeat(std::size_t most_bytes) {
  const ItemNumber behind = std::exchange(on_wire_, taken_);
  repeats_ = false;
  static_cast<void>(fill(most_bytes));
  statistics_.record_repeated(std::min(later_by(on_wire_, taken_), later_by(behind, taken_)));
}

void SendWindow::await_answer(std::uint8_t question) {
  repeats_ = true;
  question_ = question;
}

void SendWindow::put_counted(const Frame& frame) {
  on_wire_ = frame.number;
  put({frame.bytes, frame.size});
}

void SendWindow::put(std::span<const std::uint8_t> frame) {
  statistics_.record_sent(frame.size());
  port_.receive(frame);
}

}  // namespace passo
