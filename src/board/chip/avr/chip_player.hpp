// ChipPlayer: the chip's counterpart of the host's Player. It makes events of segments ahead of time, for the step
// timer's interrupt.
//
// The main loop calls refill() again and again. Events are made until the ring is full or holds a few milliseconds of
// motion, whichever comes first. Everything in the ring is played, so the ring must not hold seconds of a slow motion.
// A segment counts as begun when it is loaded.
//
// Invariant: from the first event after a standstill, it makes the same steps at the same ticks as Player. There is
// only one player, and all of its data is static: data at a fixed address costs half as much as data behind a pointer.
#pragma once

#include "direction_change_queue.hpp"
#include "event_ring.hpp"
#include "output_actions.hpp"
#include "registers.hpp"
#include "serial_line.hpp"
#include "started_items.hpp"
#include "step_interrupt.hpp"

#include "passo/wire/board_segment.hpp"

namespace passo::chip {

class ChipPlayer {
 public:
  explicit ChipPlayer(uint8_t /*motors*/) {}

  // Interrupts playback at once. Motors without pins never move: the board refuses a host with more motors.
  static void restart(uint8_t motors) {
    halt();
    if (step_port_count > 1) SerialLine::breathe();
    if (!RingTimes::are_short) slow_end_ = 0;
    head_ = fetched_entry();
    flagged_byte(head_) = flag_special | flag_stop;
    if (step_port_count > 1 && motors != expansion.motors) {
      for (uint8_t i = ring_mask; i != 0; --i) {
        forget_toggles(i);
        SerialLine::breathe();
      }
      forget_toggles(0);
    }
    expansion.motors = motors;
    RingTimes::restart();
    OutputActions::clear();
    DirectionChangeQueue::clear();
    turns_ = left_ = 0;
    turning_ = fresh_ = slipped_ = false;
    made_ = 0;
    StartedItems::clear();
    // The last host may have driven more motors.
    _Pragma("clang loop unroll(disable)") for (uint8_t m = 0; m < pins.motors; ++m) {
      expansion.accumulators[m] = 0x8000;
      expansion.increments[m] = 0;
    }
    expansion.time = 0x8000;
    SerialLine::poll();
  }

  // Stops at once: no further event is played, and the pins determine the motors' positions.
  static void halt() {
    RingTimes::disable();
    running = 0;
    line_is_watched = 0;
    directions_ = MotorOutputs::directions();
  }
  // Call once, before anything moves.
  static void prepare() {
    prepare_ring();
    // The timers run freely at the full clock. The interrupt sets the time of the next event.
    RingTimes::prepare();
    fetch_entry(0);
  }

  // Whether the player can accept the next item.
  static bool ready() {
    if (left_ != 0 || StartedItems::count() >= most_begun || OutputActions::full()) return false;
    return StartedItems::count() < few_begun || waiting() < worth_more_begun;
  }
  // True if more short items can begin while the oldest ones wait to be counted.
  static constexpr bool begins_many() { return most_begun > few_begun; }
  // True when nothing is played and nothing waits to be played.
  static bool done() { return left_ == 0 && rests(); }

  using Segment = SegmentFor<pins.motors>;

  // The motors are stopped before the next segment loaded, so an empty ring until then does not count as late.
  static void begin_from_rest() { fresh_ = true; }
  static void load(const Segment& segment) {
    for (uint8_t m = 0; m < StartedItems::motors(); ++m) expansion.increments[m] = segment.increments[m];
    expansion.interval = segment.interval;
    expansion.change = segment.change;
    MotorOutputs::load(segment.flips, segment.directions);
    turns_ = MotorOutputs::to_turn(directions_, segment.directions);
    SerialLine::breathe();
    directions_ = segment.directions;
    if (fresh_ && rests()) {
      start_clock();
    } else {
      fresh_ = false;
    }
    left_ = segment.events;
    RingTimes::load();
    if (RingTimes::are_short) {
      least_room_ = RingTimes::least_room(most_ahead_);
    } else {
      plan_watch(segment);
    }
    SerialLine::breathe();
    StartedItems::add(segment, static_cast<uint16_t>(made_ + left_));
    if (step_port_count > 1) SerialLine::breathe();
  }
  // Computes how far ahead events may be made, and whether the interrupt reads every received byte.
  static void plan_watch(const Segment& segment) {
    // Approximately the longest interval: at the start, or at the end of a decelerating segment.
    uint32_t slowest = segment.interval;
    if (segment.change > fine_change) {
      slowest = largest_interval;
    } else if (segment.change > 0 && static_cast<uint16_t>(slowest >> 16) < often) {
      slowest += static_cast<uint32_t>(segment.change) << 8;
    }
    if (static_cast<uint16_t>(slowest >> 16) >= often) {
      slow_end_ = static_cast<uint16_t>(made_ + left_);
      line_is_watched = 0;
    }
    SerialLine::breathe();
    most_ahead_ = RingTimes::most_ahead(static_cast<uint16_t>(expansion.interval >> 16));
    least_room_ = RingTimes::least_room(most_ahead_);
  }
  // Accepts an item that takes no time. The item is finished with the event before it.
  static void pass(const BoardOutputs& outputs) {
    SerialLine::breathe();
    OutputActions::put(outputs, rests);
    SerialLine::breathe();
    StartedItems::add_outputs(made_);
  }

  // Whether the oldest item is done.
  static bool finished() { return StartedItems::set_over(StartedItems::count() != 0 && is_over()); }
  // Drops the oldest item after its steps were counted.
  static void forget() {
    if (StartedItems::events() == 0) OutputActions::forget();
    StartedItems::forget();
    if (step_port_count > 1) SerialLine::breathe();
  }
  // For the oldest item: the events played, and the signed number of steps of a motor in these events.
  static uint8_t played() {
    const uint8_t events = StartedItems::events();
    if (StartedItems::is_over()) return events;
    const int16_t left = left_of_oldest();
    return left <= 0 ? events : left > events ? uint8_t{0} : static_cast<uint8_t>(events - left);
  }
  static int16_t steps(uint8_t motor) { return StartedItems::steps(played(), motor); }
  // Adds the steps of the oldest item to the motors' positions, and finishes the item.
  static void add_steps(int32_t* positions) { StartedItems::add_steps(played(), positions); }

  // Makes some events, and starts the timer if it is stopped. `follows`: another item, or part of one, is available.
  // After a standstill, the Uno first fills half of the ring; otherwise the ring would run empty again at once.
  static void refill(bool follows) {
    for (uint8_t pieces = most_pieces; pieces != 0; --pieces) {
      if (captured()) on_capture();
      if (left_ == 0 || !has_room() || !make_events()) break;
      if (RingTimes::are_short && running == 0 && waiting() >= enough_to_start && halted == 0) start();
      SerialLine::poll();
    }
    if (running != 0 || waiting() == 0 || halted != 0) return;
    // If no other item can begin until some of these events are played, the ring never becomes half full.
    if (!RingTimes::are_short || (left_ == 0 && (!follows || !ready()))) start();
  }

  // True if all events of the segment are made and another segment can be loaded.
  static bool wants_more() { return left_ == 0; }
  // True if there is room for enough events to be worth the work.
  static bool is_low() { return static_cast<uint8_t>(most_ahead_ - waiting()) >= least_room_; }
  // True if the interrupt could reach the end of the ring before the main loop has finished its other work.
  static bool is_short() { return running != 0 && waiting() < most_ahead_ / 4; }
  // True if the watched input has changed by an event at which the interrupt sampled it. Until watch() is called again,
  // all values reported for the oldest item are those at that event.
  static bool captured() { return watching_ && armed == 0; }
  static bool watches() { return watching_; }
  // Waits for the next change of the watched pins.
  static void watch(bool on) {
    armed = on ? 1 : 0;
    watching_ = on;
    noted_ = false;
  }

  // Whether the ring ran empty during a motion, so that the machine stopped for a moment.
  static bool slipped() { return slipped_; }

 private:
  // An item that has begun cannot be replaced, so a few are enough, except for short items, which may have only one
  // event.
  static constexpr uint8_t few_begun = 4;
  static constexpr uint8_t worth_more_begun = 80;
  // Events are made a few at a time, or `most_at_once` at a time. A large batch saves call overhead, but the serial
  // port is not read during the batch. So large batches are made only when the interrupt comes often enough to read
  // every byte.
  static constexpr uint8_t most_pieces = 8;
  // This number of entries lasts until the next ones are made.
  static constexpr uint8_t enough_to_start = most_events / 2;
  static constexpr uint8_t least_fast_behind = 16;
  // A motion from standstill begins with some empty events. They give time to fill the ring, and the interrupt reads
  // the serial port during them.
  static constexpr uint16_t blank_ticks = often - 50;
  static constexpr uint8_t blank_events = (RingTimes::are_short ? 12000 : 6000) / blank_ticks;
  static constexpr uint16_t start_ticks = 2500;  // approximately the time needed to write them
  // The interrupt may miss a compare match that is nearer than this.
  static constexpr uint16_t least_lead = 150;

  // Whether all events of the oldest item are played.
  static bool is_over() {
    const uint8_t ahead = waiting();
    if (captured()) on_capture();  // after reading the ring, because a capture may come at any time
    const uint16_t end = StartedItems::end();
    if (noted_) return static_cast<int16_t>(end - captured_at_) <= 0;
    const int16_t since = static_cast<int16_t>(made_ - end);
    return since >= 0 && StartedItems::last().is_played(ahead, static_cast<uint16_t>(since));
  }
  // Events of the oldest item that are not played yet.
  static int16_t left_of_oldest() {
    const uint8_t now = fetched_entry();
    uint16_t played = RingTimes::played(now, (head_ - now) & ring_mask, made_);
    if (captured()) on_capture();  // after reading the ring, because a capture may come at any time
    if (noted_) played = captured_at_;
    return static_cast<int16_t>(StartedItems::end() - played);
  }
  // Stores the event of a capture, which follows from the ring's entry. Call before the interrupt has passed once
  // through the whole ring.
  [[gnu::noinline]] static void on_capture() {
    if (noted_) return;
    const uint8_t then = entry_of(captured_entry);
    captured_at_ = RingTimes::played(then, (head_ - then) & ring_mask, made_);
    noted_ = true;
  }
  static bool rests() { return running == 0 && waiting() == 0; }
  static uint8_t waiting() { return static_cast<uint8_t>((head_ - fetched_entry()) & ring_mask); }

  static uint16_t now() {
    const uint8_t low = Tcnt1l::read();
    return static_cast<uint16_t>(low | Tcnt1h::read() << 8);
  }

  static void start_clock() {
    const uint16_t fraction = static_cast<uint16_t>(expansion.time);
    uint16_t time = static_cast<uint16_t>(now() + start_ticks);
    for (uint8_t left = blank_events; left != 0; --left) {
      time = static_cast<uint16_t>(time + blank_ticks);
      RingTimes::place(head_, time);
      clear_toggles(head_);
      head_ = static_cast<uint8_t>((head_ + 1) & ring_mask);
      SerialLine::breathe();
    }
    flagged_byte(head_) = flag_special | flag_stop;
    if (!RingTimes::are_short) slow_end_ = static_cast<uint16_t>(made_ + 1);  // the interrupt does not come before that
    made_ = static_cast<uint16_t>(made_ + blank_events);
    expansion.time = static_cast<uint32_t>(time) << 16 | fraction;
    fresh_ = true;
    start();
  }

  // True if the interrupt comes often enough to read every byte from the serial port.
  [[gnu::noinline]] static bool is_watched(uint8_t ahead) {
    return running != 0 && (RingTimes::are_short || static_cast<int16_t>(made_ - ahead - slow_end_) >= 0);
  }

  // Whether there is room for enough events to be worth the work.
  static bool has_room() {
    const uint8_t ahead = waiting();
    if (ahead >= most_ahead_) return false;
    const uint8_t room = static_cast<uint8_t>(most_ahead_ - ahead);
    return room >= least_room_ || RingTimes::fit(left_, room);
  }
  // Call if there is room. Returns false if direction changes or actions must be made first.
  static bool make_events() {
    if ((turns_ != 0 || OutputActions::riding() != 0) && !queue_turn()) return false;
    const uint8_t ahead = waiting();
    if (RingTimes::are_near() && line_is_watched != 0 && ahead >= least_fast_behind) {
      make_fast(ahead);
    } else {
      make_piece(piece_behind(ahead));
    }
    return true;
  }
  // The same as make_piece(piece_behind(ahead)) for events at the highest rate, where each call costs an event some
  // cycles. An event takes 26 cycles to make, and the interrupt takes a third of the time meanwhile. So 2.5 times as
  // many events as are ahead are ready before the interrupt stops, less those played during the call overhead.
  [[gnu::noinline]] static void make_fast(uint8_t ahead) {
    const uint8_t first = head_;
    uint8_t count = static_cast<uint8_t>(most_ahead_ - ahead);
    const uint8_t in_time = static_cast<uint8_t>(2 * ahead + (RingTimes::are_short ? ahead / 2 : 0) - way_in_events);
    if (ahead < (most_at_once + way_in_events) / 2 && count > in_time) count = in_time;
    if (count > most_at_once) count = most_at_once;
    count = RingTimes::before_the_end(first, count);
    if (count >= left_) {
      count = left_;
      left_ = 0;
    } else {
      left_ = static_cast<uint8_t>(left_ - count);
    }
    expansion.address = entry_address(first);
    made_ = static_cast<uint16_t>(made_ + count);
    RingTimes::make_near(count);
    if (left_ == 0) StartedItems::record_last();
    finish_piece(first, count);
  }
  [[gnu::always_inline]] static void finish_piece(uint8_t first, uint8_t count) {
    const uint8_t behind = static_cast<uint8_t>((first + count) & ring_mask);
    flagged_byte(behind) = flag_special | flag_stop;
    head_ = behind;
    // From here on the interrupt may reach the first of these events.
    flagged_byte(first) = RingTimes::finished(flagged_byte(first), turning_);
    if (turning_) OutputActions::taken();
    turning_ = false;
  }
  // Returns how many entries to make in one batch after `ahead` waiting entries.
  [[gnu::noinline]] static uint8_t piece_behind(uint8_t ahead) {
    if (line_is_watched == 0) {
      SerialLine::breathe();  // from here on the interrupt may come up to `often` ticks later
      line_is_watched = is_watched(ahead);
      if (running == 0) line_is_watched = 0;  // the interrupt stopped in between
    }
    // Events become valid only when all of them are made. At the highest rate making an event takes half of its
    // interval, the interrupt's share included. So twice as many events as are ahead, less those played during the call
    // overhead, are ready before the interrupt stops and no longer reads the serial port.
    uint8_t count = most_at_once;
    const uint8_t way_in = RingTimes::way_in();
    if (RingTimes::are_slow()) {
      if (ahead < most_at_once) count = ahead;
    } else if (ahead < (most_at_once + way_in) / 2) {
      count = static_cast<uint8_t>(2 * ahead - way_in);
    }
    const uint8_t few = RingTimes::few();
    if (ahead < (few + way_in) / 2 || line_is_watched == 0) count = few;
    if (!RingTimes::are_short && count > left_) count = left_;
    count = RingTimes::before_the_end(head_, count);
    const uint8_t room = static_cast<uint8_t>(most_ahead_ - ahead);
    if (count > room) count = room;
    return RingTimes::at_once(count);
  }
  // The interrupt may reach the end of the ring during this call.
  [[gnu::noinline]] static void make_piece(uint8_t count) {
    const uint8_t first = head_;
    expansion.address = entry_address(first);
    SerialLine::breathe();
    made_ = static_cast<uint16_t>(made_ + left_);
    count = RingTimes::make(count, left_);
    SerialLine::breathe();
    made_ = static_cast<uint16_t>(made_ - left_);
    if (left_ == 0) StartedItems::record_last();
    finish_piece(first, count);
  }

  static bool queue_turn() {
    if (!DirectionChangeQueue::put(turns_)) return false;
    turns_ = 0;
    turning_ = true;
    return true;
  }
  [[gnu::noinline]] static void reverse_now(uint8_t toggles) {
    DirectionChangeQueue::make_next();
    set_fetched_toggles(RingTimes::toggles_of(toggles));
  }

  static void start() {
    uint8_t first = fetched_entry();
    uint16_t due = RingTimes::due(first, head_);
    uint16_t gap = fresh_ ? uint16_t{start_ticks + blank_ticks} : RingTimes::gap(first);
    while (RingTimes::is_only_a_wait(first) && !is_in_time(due, gap)) {
      const uint8_t next = static_cast<uint8_t>((first + 1) & ring_mask);
      if (next == head_) break;  // its event is not made yet
      if ((flagged_byte(first) & flag_special) != 0) reverse_now(flagged_byte(first));
      // All waits of the ring may be late, and the interrupt does not read the serial port.
      SerialLine::breathe();
      first = next;
      const uint16_t more = RingTimes::gap(first);
      due = static_cast<uint16_t>(due + more);
      gap = static_cast<uint16_t>(gap + more);
    }
    if (!is_in_time(due, gap)) due = catch_up(first, due);
    fresh_ = false;
    SerialLine::breathe();
    fetch_entry(first);
    const uint8_t toggles = flagged_byte(first);
    if ((toggles & flag_special) != 0) reverse_now(toggles);
    SerialLine::breathe();
    // An 8-bit time wraps around.
    while (RingTimes::are_short && static_cast<uint16_t>(due - now()) > 240) SerialLine::breathe();
    RingTimes::enable(first);
  }
  // Whether an entry at which the interrupt stopped is still in the future. `gap`: ticks from the entry before.
  static bool is_in_time(uint16_t due, uint16_t gap) {
    const uint16_t ahead = static_cast<uint16_t>(due - now());
    // Reading the times costs a tick.
    return ahead > least_lead && static_cast<uint16_t>(ahead - 1) <= gap;
  }
  // Call when the interrupt stopped before an event that is late now. This event and all later ones are delayed by the
  // same time. Returns the new time of the event.
  static uint16_t catch_up(uint8_t first, uint16_t due) {
    if (!fresh_) slipped_ = true;
    // The interrupt does not read the serial port until the motion continues.
    if (!RingTimes::are_short && static_cast<int16_t>(made_ - slow_end_) > 0) slow_end_ = made_;
    // 64: ticks per pass of the loop below
    const uint16_t later = static_cast<uint16_t>(now() + least_lead * 2 + 64 * waiting() - due);
    for (uint8_t i = first; i != head_; i = static_cast<uint8_t>((i + 1) & ring_mask)) {
      RingTimes::delay(i, later);
      SerialLine::breathe();
    }
    expansion.time += static_cast<uint32_t>(later) << 16;
    RingTimes::delay_next(later);
    return static_cast<uint16_t>(due + later);
  }

  static inline uint8_t head_ = 0;  // the entry after the last event
  static inline uint8_t most_ahead_ =
      most_events;  // how many entries may be in the ring, at the rate of the loaded segment
  static inline uint8_t least_room_ = most_events;  // the smallest room in the ring for which making events is worth
                                                    // the work
  static inline uint8_t left_ = 0;                  // events of the loaded segment that are not made yet
  static inline uint8_t turns_ = 0;                 // motors that reverse before its first event
  static inline bool turning_ = false;  // the reversals are in the queue of direction changes, but the event is not
                                        // flagged yet
  static inline uint8_t directions_ = 0;
  static inline bool fresh_ = false;  // the clock was set for the events in the ring
  static inline bool noted_ = false;  // a capture was stored, with its event in `captured_at_`
  static inline uint16_t captured_at_ = 0;
  static inline bool watching_ = false;
  static inline bool slipped_ = false;
  static inline uint16_t slow_end_ = 0;  // `made_` after the last slow events
  static inline uint16_t made_ = 0;      // total number of events made
};

}  // namespace passo::chip
