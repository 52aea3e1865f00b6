// Board: the program of the control board, without its hardware. Bytes come in, steps go out.
//
// Takes frames off the wire, keeps what they bring in a bounded queue, and plays it in order through a player. Two
// sides use it: receive(), settle() and report() belong to the main loop, idle(), ticks_to_next_event() and on_event()
// to the timer. A chip's player runs ahead: it makes events of the segments before their time and has an interrupt of
// its own that plays them; there only the main loop's side is used.
//
// A player is what Player is: ready(), load(), pass(), take_finished(), done().
//
// Hardware is a type with
//   void step(uint8_t stepped, uint8_t directions);   the motors in `stepped` make a step; those in `directions`, down
//   void outputs(const BoardOutputs&);
//   void send(uint8_t byte);                          to the host
//   void breathe();                                   may be left out: called between two pieces of work
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
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

template <class Hardware, size_t queue_capacity = 32, class SegmentPlayer = Player>
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
  // Items were executed that the host has not been told of.
  bool owes_report() const { return reported_ != executed_; }
  void report() {
    reported_ = executed_;
    send(Credit{.executed = reported_, .free = static_cast<uint8_t>(queue_capacity - queue_.size())});
  }

  // The timer's side. Nothing to play: no event will come.
  bool idle() const { return player_.done(); }
  // From the event before to the next. Only when not idle, once for each event.
  uint32_t ticks_to_next_event() { return player_.wait(); }
  void on_event() {
    const uint8_t stepped = player_.play();
    if (stepped != 0) hardware_.step(stepped, player_.directions());
    if (player_.done()) settle();
  }

  // Gives the player what it can take, and takes leave of what it has finished. On a chip the main loop calls it.
  void settle() {
    do {
      breathe();
      for (uint8_t finished = player_.take_finished(); finished != 0; --finished) retire();
      breathe();
      if (begun_ == queue_.size() || !player_.ready()) return;
      const Entry& entry = queue_.at(begun_++);
      if (entry.is_segment) {
        player_.load(entry.segment);
      } else {
        player_.pass();
      }
    } while (true);
  }
  SegmentPlayer& player() { return player_; }

 private:
  struct Entry {
    bool is_segment = false;
    BoardSegment segment;
    BoardOutputs outputs;
  };

  void take(const WireFrame& frame) {
    switch (frame.type) {
      case MessageType::hello: return greet(frame);
      case MessageType::segment:
      case MessageType::outputs: return enqueue(frame);
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
    player_ = SegmentPlayer(motors_);
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
    Entry& entry = queue_.space();
    entry.is_segment = frame.type == MessageType::segment;
    if (entry.is_segment) {
      breathe();
      decode(frame, motors_, entry.segment);
      breathe();
      const uint8_t used = entry.segment.directions | entry.segment.flips;
      if (entry.segment.events == 0 || used >> motors_ != 0) return complain(WireError::bad_value);
    } else {
      decode(frame, entry.outputs);
    }
    ++expected_;
    complained_ = false;
    queue_.push();
    settle();
  }

  // The oldest item is done. Outputs are switched here: at the event before them.
  void retire() {
    const Entry& entry = queue_.front();
    if (!entry.is_segment) hardware_.outputs(entry.outputs);
    queue_.pop();
    --begun_;
    ++executed_;
  }

  // Between two pieces of work: hardware with a small buffer looks at its line.
  void breathe() {
    if constexpr (requires { hardware_.breathe(); }) hardware_.breathe();
  }

  // Once for each gap: all that comes after a lost frame is out of sequence, and the host knows it from the first word.
  void complain(WireError reason) {
    if (complained_) return;
    complained_ = true;
    send(ErrorReport{.reason = reason, .expected = expected_});
  }

  template <class Message>
  void send(const Message& message) {
    uint8_t frame[largest_frame];
    const uint8_t size = encode(message, sent_++, frame);
    for (uint8_t i = 0; i < size; ++i) hardware_.send(frame[i]);
  }

  Hardware& hardware_;
  Decoder decoder_;
  SegmentPlayer player_{0};
  Ring<Entry, queue_capacity> queue_;  // its front is what is being played
  uint8_t begun_ = 0;                  // items at its front that the player has
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
