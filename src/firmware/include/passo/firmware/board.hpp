// Board: the program of the control board, without its hardware. Bytes come in, steps go out.
//
// Takes frames off the wire, keeps what they bring in a bounded queue, and plays it in order through the Player. Two
// sides use it: receive() and report() belong to the main loop, idle(), ticks_to_next_event() and on_event() to the
// timer. On a chip the timer is an interrupt and receive() runs with it held back only where the board is idle.
//
// Hardware is a type with
//   void step(uint8_t stepped, uint8_t directions);   the motors in `stepped` make a step; those in `directions`, down
//   void outputs(const BoardOutputs&);
//   void send(uint8_t byte);                          to the host
//   bool probe();                                     whether the probe is touched; a board without one leaves it out
//
// Invariant: items are executed in the order of their sequence numbers, each once; none is taken after a gap. Time
// passes only between events: outputs are switched at the event before them, and a segment follows another without
// delay. An empty queue is no fault: what was sent ends at rest, and the board is idle there.
// Portable: integers, no heap, no virtual call.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "passo/base/ring.hpp"
#include "passo/firmware/player.hpp"
#include "passo/firmware/probe_watcher.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

template <class Hardware, size_t queue_capacity = 32>
class Board {
  // Sequence numbers are bytes: more items under way could not be told apart.
  static_assert(queue_capacity < 128);

 public:
  // `motors`: the most that this board can turn. `clock`: its ticks a second.
  Board(Hardware& hardware, uint8_t motors, uint32_t clock)
      : hardware_(hardware), most_motors_(motors), clock_(clock) {}

  // The main loop's side. One byte off the wire.
  void receive(uint8_t byte) {
    switch (decoder_.feed(byte)) {
      case Decoded::pending: break;
      case Decoded::frame: take(decoder_.frame()); break;
      case Decoded::refused: complain(WireError::bad_frame); break;
    }
  }
  // Items were executed that the host has not been told of, or the probe has something to say.
  bool owes_report() const { return reported_ != executed_ || probe_.owes_report(); }
  void report() {
    reported_ = executed_;
    send(Credit{.executed = reported_, .free = static_cast<uint8_t>(queue_capacity - queue_.size())});
    if (probe_.owes_report()) send(probe_.take_report(), motors_);
  }

  // The timer's side. Nothing to play: no event will come.
  bool idle() const { return player_.done(); }
  // From the event before to the next. Only when not idle, once for each event.
  uint32_t ticks_to_next_event() { return player_.wait(); }
  void on_event() {
    const uint8_t stepped = player_.play();
    if (stepped != 0) hardware_.step(stepped, player_.directions());
    if (probe_.watches()) probe_.on_event(stepped, player_.directions(), touched());
    if (player_.done()) {
      retire();
      advance();
    }
  }

 private:
  struct Entry {
    MessageType type = MessageType::segment;
    BoardSegment segment;
    BoardOutputs outputs;
    ProbeWatch watch;
  };

  void take(const WireFrame& frame) {
    switch (frame.type) {
      case MessageType::hello: return greet(frame);
      case MessageType::segment:
      case MessageType::outputs:
      case MessageType::watch_probe: return enqueue(frame);
      default: return complain(WireError::unexpected);
    }
  }

  void greet(const WireFrame& frame) {
    if (!idle()) return complain(WireError::unexpected);
    Hello hello;
    decode(frame, hello);
    // The host may not like the answer; then it will not go on. Until the two agree there are no segments.
    motors_ = hello.version == protocol_version && hello.motors <= most_motors_ ? hello.motors : uint8_t{0};
    decoder_.set_motors(motors_);
    // Both sides count steps and their fractions from the same start.
    player_ = Player(motors_);
    probe_ = ProbeWatcher();
    expected_ = static_cast<uint8_t>(frame.sequence + 1);
    executed_ = reported_ = frame.sequence;
    complained_ = false;
    send(HelloReply{.motors = most_motors_, .capacity = queue_capacity, .clock = clock_});
  }

  void enqueue(const WireFrame& frame) {
    const uint8_t missing = static_cast<uint8_t>(frame.sequence - expected_);
    // More than half round is behind: a repeated item, from a host that has not heard of the first one.
    if (missing > 127) return report();
    if (missing != 0) return complain(WireError::out_of_sequence);
    if (queue_.full()) return complain(WireError::queue_full);
    Entry entry;
    entry.type = frame.type;
    if (entry.type == MessageType::segment) {
      decode(frame, motors_, entry.segment);
      const uint8_t used = entry.segment.directions | entry.segment.flips;
      if (entry.segment.events == 0 || used >> motors_ != 0) return complain(WireError::bad_value);
    } else if (entry.type == MessageType::outputs) {
      decode(frame, entry.outputs);
    } else {
      decode(frame, entry.watch);
      if (entry.watch.until > ProbeUntil::released) return complain(WireError::bad_value);
    }
    ++expected_;
    complained_ = false;
    queue_.push(entry);
    if (idle()) advance();
  }

  // Loads the next segment, and does what comes before it.
  void advance() {
    for (; !queue_.empty(); retire()) {
      const Entry& entry = queue_.front();
      if (entry.type == MessageType::segment) return player_.load(entry.segment);
      if (entry.type == MessageType::outputs) {
        hardware_.outputs(entry.outputs);
      } else {
        probe_.begin(entry.watch, touched());
      }
    }
  }

  bool touched() {
    if constexpr (requires { hardware_.probe(); }) return hardware_.probe();
    return false;
  }

  void retire() {
    queue_.pop();
    ++executed_;
  }

  // Once for each gap: all that comes after a lost frame is out of sequence, and the host knows it from the first word.
  void complain(WireError reason) {
    if (complained_) return;
    complained_ = true;
    send(ErrorReport{.reason = reason, .expected = expected_});
  }

  template <class... Message>
  void send(const Message&... message) {
    uint8_t frame[largest_frame];
    const uint8_t size = encode(message..., sent_++, frame);
    for (uint8_t i = 0; i < size; ++i) hardware_.send(frame[i]);
  }

  Hardware& hardware_;
  Decoder decoder_;
  Player player_{0};
  ProbeWatcher probe_;
  Ring<Entry, queue_capacity> queue_;  // its front is what is being played
  uint8_t most_motors_;
  uint8_t motors_ = 0;  // agreed upon with the host
  uint32_t clock_;
  uint8_t expected_ = 0;  // sequence number of the next item
  uint8_t executed_ = 0;  // of the last one that is done
  uint8_t reported_ = 0;  // of the last one that the host knows to be done
  uint8_t sent_ = 0;      // the board's own sequence number
  bool complained_ = false;
};

}  // namespace passo
