// BoardSession: the counted frames on their way to the board, until the board has taken them.
#include <algorithm>
#include <utility>

#include "passo/link/board_session.hpp"

namespace passo {
namespace {

// So many frames tell how fast the board takes frames. The rate at which a slow burst is forgotten.
constexpr std::size_t long_burst = 8;
constexpr double patience_with_bursts = 0.95;

}  // namespace

// Sends the next frame that is counted.
void BoardSession::send_frame(const Frame& frame) {
  if (error_) return;
  begin_to_expect();
  sent_ = frame.number;
  rests_ = false;
  if (may_lose()) {
    if (kept_.empty()) burst_began_ = port_.elapsed();
    kept_.push_back(frame);
    ++burst_;
  }
  answered_ = false;
  unanswered_since_ = port_.elapsed();
  moved_on_ = port_.elapsed();
  if (may_lose()) return put_frames_on_wire();
  on_wire_ = sent_;
  put_on_wire(frame.bytes, frame.size);
}

// Puts frames on the wire as long as the board can keep all that is under way. A board that plays dense motion takes
// frames more slowly than the line brings them.
void BoardSession::put_frames_on_wire() {
  if (error_ || repeating_) return;
  std::size_t under_way = 0;
  for (const Frame& frame : kept_) {
    under_way += frame.size;
    if (later_by(frame.number, on_wire_) <= 0) continue;
    if (under_way > most_under_way && is_small()) return;
    on_wire_ = frame.number;
    put_on_wire(frame.bytes, frame.size);
  }
  if (std::exchange(question_waits_, false)) ask(usual_question_);
}

void BoardSession::put_on_wire(const std::uint8_t* frame, std::uint8_t size) {
  ++frames_sent_;
  bytes_sent_ += size;
  port_.receive({frame, size});
}

// `sequence`: the low byte of a number. A number that is not between the last frame known to be taken and the last
// frame sent is old, and ignored.
void BoardSession::note_taken(std::uint8_t sequence) {
  const auto more = static_cast<std::uint8_t>(sequence - static_cast<std::uint8_t>(taken_));
  if (more == 0 || more > later_by(sent_, taken_)) return;
  taken_ = static_cast<ItemNumber>(taken_ + more);
  progressed_ = moved_on_ = port_.elapsed();
  news_ = true;
  while (!kept_.empty() && later_by(kept_.front().number, taken_) <= 0) kept_.pop_front();
  if (kept_.empty()) note_end_of_burst();
  if (later_by(taken_, on_wire_) > 0) on_wire_ = taken_;
  put_frames_on_wire();
}

void BoardSession::note_end_of_burst() {
  const Seconds each = (port_.elapsed() - burst_began_) / static_cast<double>(burst_);
  if (burst_ >= long_burst) time_a_frame_ = std::max(each, time_a_frame_ * patience_with_bursts);
  burst_ = 0;
}

// Repeats the first of the frames that the board does not have, in order. A question after them tells whether they have
// arrived. Nothing else is sent meanwhile. Repeating all frames at each complaint would be worse: on a bad line, each
// of many frames would bring many more.
void BoardSession::repeat() {
  if (error_ || kept_.empty()) return;
  const ItemNumber behind = std::exchange(on_wire_, taken_);
  const bool question_waits = std::exchange(question_waits_, false);
  repeating_ = false;
  put_frames_on_wire();
  question_waits_ = question_waits && on_wire_ != sent_;
  frames_repeated_ += static_cast<std::uint64_t>(std::min(later_by(on_wire_, taken_), later_by(behind, taken_)));
  ask(usual_question_);
  repeating_ = session_ != 0;  // without a session no answer tells the progress
  repeated_before_ = question_;
}

}  // namespace passo
