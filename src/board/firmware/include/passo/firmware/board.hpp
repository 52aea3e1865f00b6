// Board: the program of the control board, without its hardware. It receives bytes and outputs steps.
//
// It reads frames from the link, keeps their items in a PlayList, and plays them in order through a player. It has two
// interfaces. The main loop calls receive(), settle() and report(). The timer calls idle(), ticks_to_next_event() and
// on_event(). A chip's player works ahead instead: it makes events before their time, and an interrupt plays them; then
// only the main loop's interface is used. Players have the interface of Player. board_hardware.hpp describes Hardware.
//
// Invariant: frames are accepted in the order of their sequence numbers, each once; none is accepted after a gap. Items
// are executed in the order of the list. Time passes only between events: outputs are switched at the event before
// them, and one segment follows another without delay. The queue always ends in a stop. Positions count from power-on,
// and are updated at each segment's end, so that an event needs no work for them. Portable: no heap, no virtual call.
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "passo/firmware/board_hardware.hpp"
#include "passo/firmware/board_identity.hpp"
#include "passo/firmware/drive_alarms.hpp"
#include "passo/firmware/host_timeout.hpp"
#include "passo/firmware/input_watch.hpp"
#include "passo/firmware/item_player.hpp"
#include "passo/firmware/player.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

// `most_motors` is the number of motors for which an item in the queue has room.
template <class Hardware, size_t queue_capacity = 32, class SegmentPlayer = Player, uint8_t most_motors = max_motors>
class Board : private ItemPlayer<Hardware, queue_capacity, SegmentPlayer, most_motors> {
  using Items = ItemPlayer<Hardware, queue_capacity, SegmentPlayer, most_motors>;
  using Items::begun_, Items::executed_, Items::from_rest_, Items::identity_, Items::list_, Items::motors_,
      Items::owed_;
  using Items::drop_all, Items::places, Items::played, Items::player_, Items::position, Items::positions_;
  using Items::hardware_, Items::has_room, Items::send, Items::send_for_motors;

 public:
  using Items::breathe, Items::feed, Items::has_more, Items::idle, Items::on_event, Items::player, Items::settle;
  using Items::slice, Items::ticks_to_next_event;
  using typename Items::Breath, typename Items::Segment;

  Board(Hardware& hardware, const BoardIdentity& identity) : Items(hardware, identity) { list_.clear(places()); }

  // For the main loop. Processes a received byte. It is split in two halves, of which the first can also process
  // several bytes (Decoder).
  void receive(uint8_t byte) {
    if (receive_payload(&byte, 1) == 0) receive_other(byte);
  }
  [[gnu::always_inline]] uint8_t receive_payload(const uint8_t* bytes, uint8_t count) {
    return decoder_.feed_payload(bytes, count);
  }
  void receive_other(uint8_t byte) {
    const Decoded decoded = decoder_.feed_other(byte);
    if (decoded == Decoded::frame) handle(decoder_.frame());
    if (decoded == Decoded::refused) complain(WireError::bad_frame);
  }
  // Whether some executed or replaced items were not yet reported to the host; owed() is their approximate number.
  bool owes_report() const { return owed_ != 0; }
  uint8_t owed() const { return owed_; }
  void report() {
    const bool can_send = has_room();
    owed_ = can_send ? uint8_t{0} : owed_ == 0 ? uint8_t{1} : owed_;
    if (can_send) send(progress());
  }
  // Call when the input pins have changed. Changes of inputs in `captured` are reported at once, with the position.
  void set_inputs(uint16_t inputs, uint16_t captured = 0) {
    captured = watch_.that_count(captured, inputs_, inputs);
    inputs_ = inputs;
    if (motors_ == 0) return;
    // The watched input is reported separately, because it may open while another is triggered. If several inputs are
    // watched, those that changed are reported.
    if ((captured & watched()) != 0) send_captured(captured & watched());
    captured &= static_cast<uint16_t>(~watched());
    if (captured != 0) send_captured(captured);
  }
  // Bits of BoardInput: watched() is the captured input, stopping() are the inputs that stop the motors when triggered.
  uint16_t watched() const { return watch_.input(); }
  uint16_t stopping() const { return static_cast<uint16_t>(watch_.stopping() | alarms_of(hardware_)); }
  // Stops without deceleration and drops all items. Steps may be lost, so no motion is executed until the next hello.
  // `inputs` are the triggered inputs: the host is informed which of them stop the motors.
  void stop_at_once(uint16_t inputs) {
    inputs &= stopping();
    const Fault fault{
        .reason = reason_of(inputs, alarms_of(hardware_)), .inputs = inputs, .event = played(), .executed = executed_};
    if (begun_ != 0) player_.add_steps(positions_);
    player_.restart(motors_);
    drop_all();
    trusted_ = false;
    send(fault);
  }

  // Call ten times a second: counts the host's silence (HostTimeout). Outputs whose time is over are switched off while
  // the board is stopped, even during a queue update.
  void count_silence() {
    silence_.count();
    if (manual_ != Manual::off || !idle() || !list_.empty()) return;
    if (switch_off(hardware_, silence_.late())) silence_.set_off();
    if (trusted_ && lets_go(hardware_, silence_)) trusted_ = false;
  }

  // Starts manual mode: the operator moves the machine (ManualMode), and a host may only send queries. The session
  // ends, because the position changes. Call it only at standstill.
  void begin_manual() {
    motors_ = identity_.motors;
    watch(0);
    enable();
    player_.restart(motors_);
    breathe();
    drop_all();
    session_ = 0;
    complained_ = false;
    manual_ = Manual::on;
  }
  void end_manual() { manual_ = Manual::over; }
  bool manual() const { return manual_ == Manual::on; }
  // True if nothing is being played or waits to be played.
  bool rests() const { return idle() && list_.empty() && !list_.gathering(); }
  uint8_t size() const { return list_.size(); }
  uint16_t inputs() const { return inputs_; }
  // Adds a segment in manual mode, after everything in the list.
  void jog(const Segment& segment) {
    list_.space().segment = segment;
    append_by_hand();
  }
  void switch_outputs(const BoardOutputs& outputs) {
    list_.space().keep(outputs);
    append_by_hand();
  }

 private:
  // over: manual mode has ended, and no host knows the machine position until the next hello.
  enum class Manual : uint8_t { off, on, over };

  // A separate function, so that a byte inside a frame need not save all the registers that a whole frame needs.
  [[gnu::noinline]] void handle(const WireFrame& frame) {
    // A sender of a query for another number of motors is not the host.
    if (frame.type != MessageType::ask || frame.payload[1] == motors_) silence_.end();
    switch (frame.type) {
      case MessageType::hello: return greet(frame);
      case MessageType::session: return name_session(frame);
      case MessageType::pin_setup: return handle_setup(frame);
      case MessageType::ask: return answer(frame);
      case MessageType::segment:
      case MessageType::outputs:
      case MessageType::replace: return accept_in_order(frame);
      default: return complain(WireError::unexpected);
    }
  }

  // The item has no frame number, so the last executed item number remains that of the host.
  void append_by_hand() {
    breathe();
    list_.space().number = executed_;
    from_rest_ = static_cast<uint8_t>(executed_);
    list_.append();
    settle();
  }

  [[gnu::noinline]] void handle_setup(const WireFrame& frame) {
    if (!idle()) return complain(WireError::unexpected);
    PinSetup setup;
    decode(frame, setup);
    is_set_up_ = true;
    apply_setup(setup);
    send(setup);
  }
  // Reduces the setup to what the board supports.
  [[gnu::noinline]] void apply_setup(PinSetup& setup) {
    setup = set_up(hardware_, setup);
    const uint16_t ticks = setup.timing.event_ticks;
    if (ticks != 0) identity_.shortest_interval = uint32_t{static_cast<uint16_t>(ticks - 1)} << 16;
  }

  void greet(const WireFrame& frame) {
    if (!idle()) return complain(WireError::unexpected);
    Hello hello;
    decode(frame, hello);
    const bool agrees = hello.version == protocol_version;
    expected_ = static_cast<uint16_t>(frame.sequence + 1);
    complained_ = false;
    if (manual()) {
      decoder_.set_motors(agrees ? hello.motors : uint8_t{0});
      return send_hello_reply();
    }
    if (!is_set_up_) {
      PinSetup usual;
      apply_setup(usual);
    }
    is_set_up_ = false;
    // A host that does not accept the answer sends nothing more. The board accepts no segments until both agree.
    motors_ = agrees && hello.motors <= identity_.motors && hello.motors <= most_motors ? hello.motors : uint8_t{0};
    decoder_.set_motors(motors_);
    watch(0);
    // Both sides count fractions of steps from the same start. Whole steps continue from their last values.
    enable();
    player_.restart(motors_);
    breathe();
    drop_all();
    session_ = 0;
    executed_ = frame.sequence;
    owed_ = 0;
    trusted_ = true;
    silence_.begin();
    manual_ = Manual::off;
    send_hello_reply();
    // Manual mode cannot start while a stop button is pressed.
    if ((inputs_ & stopping_at_rest(alarms_of(hardware_))) != 0) stop_at_once(inputs_);
  }
  void enable() {
    if ((inputs_ & input_emergency_stop) == 0) passo::enable(hardware_);
  }
  void send_hello_reply() {
    send(HelloReply{.motors = identity_.motors, .capacity = places(), .clock = identity_.clock});
  }

  void name_session(const WireFrame& frame) {
    Session session;
    decode(frame, session);
    if (motors_ == 0 || manual_ != Manual::off) return;
    session_ = session.number;
    silence_.allow(session.silence);
  }

  // Separate functions for rare and large work: a chip has too few registers for all of it in one function.
  [[gnu::noinline]] void answer(const WireFrame& frame) {
    Ask ask;
    decode(frame, ask);
    if (ask.version != protocol_version || ask.motors == 0 || ask.motors > max_motors ||
        !can_watch(hardware_, ask.limit)) {
      return complain(WireError::bad_value);
    }
    breathe();
    const bool known = motors_ != 0 && manual_ == Manual::off;
    if (ask.question == Question::spindle && known && has_encoder(hardware_)) return send_spindle(frame.sequence);
    if (ask.question == Question::handwheel && has_handwheel(hardware_)) return send_handwheel(frame.sequence);
    const bool kept = ask.question == Question::kept;
    const MessageType answer = ask.question == Question::about ? MessageType::about
                               : kept                          ? MessageType::captured
                                                               : MessageType::status;
    // Any number of queries whose answers are not awaited must not displace other messages.
    const uint8_t motors = kept ? motors_ : ask.motors;
    if (!has_room(motors)) return;
    if (answer == MessageType::about) return send(identity_.about);
    if (kept) return send_kept();
    if (ask.question == Question::watch) begin_watch(ask.limit);
    send_status(ask.motors, frame.sequence);
  }

  // The watched input changes only at standstill, because motion in the queue was planned for the old one.
  void begin_watch(uint8_t limit) {
    if (rests() && !manual()) watch(limit);
    if (limit == watch_.limit()) watch_.forget();
  }
  void watch(uint8_t limit) {
    if (limit == watch_.limit()) return;
    watch_.watch(limit);
    if constexpr (requires { hardware_.watch(); }) hardware_.watch();
  }

  [[gnu::noinline]] void send_status(uint8_t motors, uint8_t question) {
    keep_up(hardware_);
    unsigned state = watch_.state();
    if (player_.slipped()) {
      state |= board_slipped;
    } else if (trusted_) {
      state |= board_trusted;
    }
    if (!idle()) state |= board_moves;
    if (list_.gathering()) state |= board_replaces;
    if (manual()) state |= board_manual;
    if (has_encoder(hardware_)) state |= board_encodes;
    BoardStatusFor<most_motors> status{.session = session_,
                                       .executed = executed_,
                                       .taken = taken(),
                                       .free = list_.free(),
                                       .event = played(),
                                       .state = static_cast<uint8_t>(state),
                                       .reset = identity_.reset,
                                       .motors = motors_,
                                       .inputs = static_cast<uint16_t>(inputs_ | silence_.bits()),
                                       .answers = question};
    for (uint8_t motor = 0; motor < motors && motor < most_motors; ++motor) {
      breathe();
      status.positions[motor] = position(motor);
    }
    keep_up(hardware_);
    send_for_motors(status, motors);
    keep_up(hardware_);
  }

  // The motion's position at the tick of the count: hardly any time passes between the two readings.
  [[gnu::noinline]] void send_spindle(uint8_t question) {
    if constexpr (requires { hardware_.spindle(); }) {
      if (!has_room()) return;
      breathe();
      send(Turned{.progress = progress(), .event = played(), .answers = question, .spindle = hardware_.spindle()});
    }
  }

  [[gnu::noinline]] void send_handwheel(uint8_t question) {
    if constexpr (requires { hardware_.handwheel(); }) {
      if (!has_room()) return;
      const SpindleCount fields = to_fields(hardware_.handwheel());
      send(Turned{.progress = progress(), .event = played(), .answers = question, .spindle = fields});
    }
  }

  [[gnu::noinline]] void send_captured(uint16_t captured) {
    if ((captured & inputs_) == 0) captured |= captured_released;
    CapturedFor<most_motors> message{.input = captured, .item = static_cast<uint8_t>(executed_ + 1), .event = played()};
    const bool keeps = watch_.keeps(captured);
    for (uint8_t motor = 0; motor < motors_; ++motor) {
      breathe();
      message.positions[motor] = position(motor);
      if (keeps) watch_.positions[motor] = message.positions[motor];
    }
    if ((captured & watched()) != 0) release_capture(hardware_);
    send_for_motors(message, motors_);
  }

  [[gnu::noinline]] void send_kept() {
    CapturedFor<most_motors> message{.input = watch_.kept_input()};
    for (uint8_t motor = 0; motor < motors_; ++motor) {
      breathe();
      message.positions[motor] = watch_.positions[motor];
    }
    send_for_motors(message, motors_);
  }

  void accept_in_order(const WireFrame& frame) {
    if (manual_ != Manual::off) return complain(WireError::manual);
    const uint8_t missing = static_cast<uint8_t>(frame.sequence - expected_);
    // A number more than half the range ahead is an old one: a repeated frame from a host that missed the answer to the
    // first.
    if (missing > 127) return report();
    if (missing != 0) return complain(WireError::out_of_sequence);
    complained_ = false;  // any gap has been reported to the host
    if (!trusted_) return complain(WireError::unexpected);
    if (frame.type == MessageType::replace) return begin_replacement(frame);
    enqueue(frame);
  }

  void begin_replacement(const WireFrame& frame) {
    Replace replace;
    decode(frame, replace);
    if (replace.count == 0) return complain(WireError::bad_value);
    if (replace.count > list_.free()) return complain(WireError::queue_full);
    list_.begin_replacement(replace.after, replace.count);
    sums_ = replace.sums;
    sums_.add_announcement(expected_, replace.after, replace.count);
    accept();
  }

  void enqueue(const WireFrame& frame) {
    // A host with a session number requires checked motion: it must not execute a segment without sums. Such a segment
    // follows a queue update that announced fewer items than were sent, and so was damaged. The next queue update
    // corrects this.
    if (session_ != 0 && frame.type == MessageType::segment && !list_.gathering()) {
      accept();
      ++owed_;
      return;
    }
    if (list_.free() == 0) return complain(WireError::queue_full);
    auto& item = list_.space();
    item.number = expected_;
    if (frame.type == MessageType::segment) {
      breathe();
      decode(frame, motors_, item.segment);
      breathe();
      if (!identity_.template can_play<Breath>(item.segment, motors_)) return complain(WireError::bad_value);
    } else {
      BoardOutputs outputs;
      decode(frame, outputs);
      item.keep(outputs);
      if (!list_.gathering()) silence_.forget_off();
    }
    accept();
    if (list_.gathering()) {
      add_to_sums(frame);
    } else if (list_.empty()) {
      from_rest_ = static_cast<uint8_t>(item.number);
    }
    list_.append();
    slice();
    if (list_.gathering()) return;
    if (list_.gathered()) {
      ++owed_;  // the number of free places is reported in either case
      const WireError wrong = complete();
      if (wrong != no_error) return send(ErrorReport{.reason = wrong, .expected = static_cast<uint8_t>(expected_)});
    }
    settle();
  }

  [[gnu::noinline]] void add_to_sums(const WireFrame& frame) {
    breathe();
    sums_.template add<Breath>(frame, motors_);
    owed_ = static_cast<uint8_t>(owed_ + (expected_ & 1));  // report more often: the host waits for acknowledgements
    breathe();
  }

  static constexpr WireError no_error = WireError{};
  // Puts the gathered items in place if they match the sums and arrive in time.
  WireError complete() {
    WireError wrong = (silence_.bits() & outputs_timed_out) != 0 ? WireError::silent_host : no_error;
    if (!sums_.is_nothing()) wrong = WireError::wrong_sums;
    if (wrong != no_error) {
      list_.drop_replacement();
      return wrong;
    }
    return list_.complete(executed_, begun_, from_rest_) ? no_error : WireError::too_late;
  }
  void accept() {
    ++expected_;
    complained_ = false;
  }

  uint8_t taken() const { return static_cast<uint8_t>(expected_ - 1); }
  Credit progress() const { return {.executed = executed_, .taken = taken(), .free = list_.free()}; }

  // Reports an error once for each gap. All frames after a lost one are out of sequence, so one message is enough.
  void complain(WireError reason) {
    if (complained_ || !has_room()) return;
    complained_ = true;
    send(ErrorReport{.reason = reason, .expected = static_cast<uint8_t>(expected_)});
  }

  Decoder decoder_;
  uint16_t session_ = 0;
  uint16_t expected_ = 0;  // number of the next frame; the link carries its low byte
  ItemSums sums_;          // sums over the queue update gathered so far
  HostTimeout silence_;
  // In one byte, because a chip has little memory.
  bool complained_ : 1 = false, trusted_ : 1 = true, is_set_up_ : 1 = false;
  Manual manual_ : 2 = Manual::off;
  uint16_t inputs_ = 0;
  InputWatch<most_motors> watch_;
};

}  // namespace passo
