#include "passo/link/in_process_link.hpp"

#include <cassert>
#include <cstdlib>
#include <span>

namespace passo {

InProcessLink::InProcessLink(BoardPort& port, std::uint8_t motors) : port_(port), motors_(motors) {
  decoder_.set_motors(motors);
  say_hello();
}

void InProcessLink::say_hello() {
  std::uint8_t frame[largest_frame];
  put_on_wire(frame, encode(Hello{.motors = motors_}, last_sent_, frame));
  while (!board_ && listen()) {
  }
  if (error_) return;
  if (board_->version != protocol_version) {
    error_ = LinkError::wrong_version;
  } else if (board_->motors < motors_) {
    error_ = LinkError::too_few_motors;
  }
}

void InProcessLink::send(const BoardSegment& segment) {
  assert(segment.events > 0 && std::abs(segment.change) <= largest_change);
  if (!wait_for_credit()) return;
  std::uint8_t frame[largest_frame];
  put_on_wire(frame, encode(segment, motors_, ++last_sent_, frame));
}

void InProcessLink::send(const BoardOutputs& outputs) {
  if (!wait_for_credit()) return;
  std::uint8_t frame[largest_frame];
  put_on_wire(frame, encode(outputs, ++last_sent_, frame));
}

void InProcessLink::send(const ProbeWatch& watch) {
  if (!wait_for_credit()) return;
  probe_report_.reset();
  std::uint8_t frame[largest_frame];
  put_on_wire(frame, encode(watch, ++last_sent_, frame));
}

void InProcessLink::drain() {
  while (!error_ && busy() && listen()) {
  }
}

void InProcessLink::wait() {
  const std::uint8_t before = last_executed_;
  const auto touched = [this] { return probe_report_ && probe_report_->happened; };
  const bool touched_before = touched();
  while (!error_ && busy() && last_executed_ == before && touched() == touched_before && listen()) {
  }
}

bool InProcessLink::wait_for_credit() {
  while (!error_ && under_way() >= board_->capacity && listen()) {
  }
  return !error_;
}

// Hears what the board has to say; where that is nothing, lets it go on until it does. False when it stays silent.
bool InProcessLink::listen() {
  std::span<const std::uint8_t> bytes = port_.replies();
  if (bytes.empty() && port_.run()) bytes = port_.replies();
  if (bytes.empty()) error_ = LinkError::no_answer;
  for (const std::uint8_t byte : bytes) {
    if (decoder_.feed(byte) == Decoded::frame) take(decoder_.frame());
  }
  return !error_;
}

void InProcessLink::take(const WireFrame& frame) {
  switch (frame.type) {
    case MessageType::hello_reply: decode(frame, board_.emplace()); break;
    case MessageType::credit: {
      Credit credit;
      decode(frame, credit);
      last_executed_ = credit.executed;
      break;
    }
    case MessageType::probe_report: decode(frame, motors_, probe_report_.emplace()); break;
    default: error_ = LinkError::refused; break;
  }
}

void InProcessLink::put_on_wire(const std::uint8_t* frame, std::uint8_t size) {
  ++frames_sent_;
  bytes_sent_ += size;
  port_.receive({frame, size});
}

}  // namespace passo
