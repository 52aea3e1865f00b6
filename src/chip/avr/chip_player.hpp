// ChipPlayer: what Player is on the host. Makes events of segments ahead of time, for the step timer's interrupt.
//
// The main loop calls refill() again and again. Events are made until the ring is full or two milliseconds are ahead,
// whichever is less: what is in the ring will be played, so a slow motion must not have seconds in it. A segment counts
// as begun once it is loaded.
//
// Invariant: same steps at the same ticks as Player's, from the first event after a rest on. There is one, and all of
// it is static: what lies at a fixed address costs half of what lies behind a pointer.
#pragma once

#include "event_ring.hpp"
#include "registers.hpp"
#include "serial_line.hpp"
#include "step_interrupt.hpp"

#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/wire/board_segment.hpp"

namespace passo::chip {

class ChipPlayer {
 public:
  explicit ChipPlayer(uint8_t /*motors*/) {}

  // At once, whatever it played is broken off. Motors without pins stand still: the board refuses a host with more.
  static void restart(uint8_t /*motors*/) {
    Timsk1::write(0);
    running = 0;
    line_is_watched = 0;
    slow_end_ = 0;
    head_ = fetched();
    entry(head_).toggles = pins.flag_special | pins.flag_stop;
    turns_head_ = turns_tail;
    turns_ = left_ = 0;
    turning_ = fresh_ = slipped_ = false;
    made_ = 0;
    begun_ = finished_ = 0;
    for (uint16_t& accumulator : expansion.accumulators) accumulator = 0x8000;
    for (uint16_t& accumulator : at_start_) accumulator = 0x8000;
    expansion.time = 0x8000;
    // Where the pins are; a turn that was queued may not have been made.
    directions_ = 0;
    for (uint8_t m = 0; m < pins.motors; ++m) {
      if ((Register<0x2b>::read() & pins.motor[m].direction.mask()) != 0) {
        directions_ = static_cast<uint8_t>(directions_ | 1U << m);
      }
    }
  }

  // Once, before anything moves.
  static void prepare() {
    for (uint8_t i = 0; i < ring_entries; ++i) {
      const uint16_t next = ring_address + sizeof(EventEntry) * ((i + 1) & ring_mask);
      entry(i).next_page = static_cast<uint8_t>(next >> 8);
    }
    // Free running at the full clock: the interrupt tells when to come back.
    Tccr1a::write(0);
    Tccr1b::write(1);
    fetch_first(0);
  }

  // Can take the next item.
  static bool ready() { return left_ == 0 && static_cast<uint8_t>(begun_ - finished_) < most_begun; }
  // Nothing is played and nothing waits to be.
  static bool done() { return left_ == 0 && running == 0 && waiting() == 0; }

  using Segment = SegmentFor<uno_cnc_shield.motors>;

  static void load(const Segment& segment) {
    for (uint8_t m = 0; m < pins.motors; ++m) expansion.increments[m] = segment.increments[m];
    expansion.interval = segment.interval;
    expansion.change = segment.change;
    expansion.flips = motor_pins.steps[segment.flips];
    turns_ = motor_pins.directions[segment.directions ^ directions_];
    SerialLine::breathe();
    directions_ = segment.directions;
    if (running == 0 && waiting() == 0) start_clock();
    left_ = segment.events;
    // At its slowest, about: at its start or, if it slows down, at its end.
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
    most_ahead_ = most_ahead();
    SerialLine::breathe();
    remember(segment);
  }
  // An item that takes no time: it is finished with the event before it.
  static void pass() {
    Item& item = items_[begun_++ & items_mask];
    item.end = made_;
    item.events = 0;
  }

  [[gnu::noinline]] static void remember(const Segment& segment) {
    Item& item = items_[begun_++ & items_mask];
    item.end = static_cast<uint16_t>(made_ + left_);
    item.events = segment.events;
    item.directions = segment.directions;
    item.flips = segment.flips;
    for (uint8_t m = 0; m < pins.motors; ++m) item.increments[m] = segment.increments[m];
  }

  // The oldest item that it has is done.
  static bool finished() { return finished_ != begun_ && left_of_oldest() <= 0; }
  static void forget() {
    const Item& item = items_[finished_ & items_mask];
    if (item.events != 0) {
      for (uint8_t m = 0; m < pins.motors; ++m) {
        at_start_[m] = static_cast<uint16_t>(at_start_[m] + item.increments[m] * item.events);
      }
    }
    ++finished_;
  }
  // Of the oldest item: the events played, and the steps that a motor has made in them, down or up.
  static uint8_t played() {
    const uint8_t events = items_[finished_ & items_mask].events;
    const int16_t left = left_of_oldest();
    return left <= 0 ? events : left > events ? uint8_t{0} : static_cast<uint8_t>(events - left);
  }
  [[gnu::noinline]] static int16_t steps(uint8_t motor) {
    const Item& item = items_[finished_ & items_mask];
    const uint8_t bit = static_cast<uint8_t>(1U << motor);
    const uint8_t events = played();
    int16_t steps = carries(at_start_[motor], item.increments[motor], events);
    SerialLine::breathe();
    if ((item.flips & bit) != 0) steps = static_cast<int16_t>(events - steps);
    return (item.directions & bit) != 0 ? static_cast<int16_t>(-steps) : steps;
  }

  // Additions of `increment` to `accumulator` that overflow. A 16 by 8 bit product, for which LLVM calls one of 32
  // bits.
  static uint8_t carries(uint16_t accumulator, uint16_t increment, uint8_t events) {
    uint8_t count;
    asm volatile(
        "mul %A2, %3\n\t"
        "add %A1, r0\n\t"
        "adc %B1, r1\n\t"
        "clr %0\n\t"
        "adc %0, %0\n\t"
        "mul %B2, %3\n\t"
        "add %B1, r0\n\t"
        "adc %0, r1\n\t"
        "clr r1"
        : "=&r"(count), "+r"(accumulator)
        : "r"(increment), "r"(events)
        : "r0");
    return count;
  }

  // Some events, and a start of the timer where it stands still.
  static void refill() {
    note_capture();
    for (uint8_t pieces = most_pieces; pieces != 0 && left_ != 0 && make_events(); --pieces) {
      SerialLine::poll();
    }
    if (running == 0 && waiting() != 0 && halted == 0) start();
  }

  // What it has is made, and another segment can come.
  static bool wants_more() { return left_ == 0; }
  // The interrupt could come to the end of the ring if all else came first.
  static bool is_short() { return running != 0 && waiting() < most_ahead_ / 4; }
  // The probe touched, at an event at which the interrupt looked. Until watch_probe() all that is told of the oldest
  // item, and whether it is finished, is told as it was then.
  static bool captured() { return watching_ && probe_mask == 0; }
  static bool watches_probe() { return watching_; }
  static void watch_probe(uint8_t mask) {
    probe_mask = mask;
    watching_ = mask != 0;
    noted_ = false;
  }

  // The ring ran dry though there was something to play: the machine stood still for a moment.
  static bool slipped() { return slipped_; }

 private:
  static constexpr const PinMap<3>& pins = uno_cnc_shield;
  static constexpr char port = 'D';
  static constexpr MotorPinSets<pins.motors> motor_pins = motor_pin_sets(pins, port);
  static constexpr uint8_t items_mask = 3;
  static constexpr uint8_t most_begun = 4;
  // Made at a time. Many, because of the way in and out; but the line is not looked at meanwhile, unless the interrupt
  // comes so often that it sees every byte.
  static constexpr uint8_t most_at_once = 100;
  static constexpr uint8_t few_at_once = 8;
  static constexpr uint16_t often = 300;
  static constexpr uint8_t most_pieces = 8;
  // A motion from rest begins with some events of nothing: they give the time to fill the ring, and the interrupt looks
  // after the line meanwhile.
  static constexpr uint8_t blank_events = 24;
  static constexpr uint16_t blank_ticks = 250;
  static constexpr uint16_t start_ticks = 1500;
  // An alarm nearer than this may be missed.
  static constexpr uint16_t least_lead = 150;

  // What it has begun and not finished.
  struct Item {
    uint16_t end;  // `made_` with its last event
    uint8_t events;
    uint8_t directions;
    uint8_t flips;
    uint16_t increments[pins.motors];
  };

  // The entry that the interrupt has in its registers, or the one behind the last event.
  static uint8_t fetched() {
    uint16_t next;
    asm volatile("movw %0, r2" : "=r"(next));
    return entry_of(next);
  }
  static uint8_t entry_of(uint16_t next) {
    return static_cast<uint8_t>(((next - ring_address) / sizeof(EventEntry) - 1) & ring_mask);
  }
  // Events of the oldest item, and of none before it, that are not played yet.
  static int16_t left_of_oldest() {
    note_capture();
    const uint16_t played = noted_ ? captured_at_ : static_cast<uint16_t>(made_ - waiting());
    return static_cast<int16_t>(items_[finished_ & items_mask].end - played);
  }
  // Which event it was, told by the entry; in time, before the interrupt has been round the ring once more.
  [[gnu::noinline]] static void note_capture() {
    if (noted_ || !captured()) return;
    const uint8_t now = fetched();
    const uint8_t since = static_cast<uint8_t>((now - entry_of(probe_entry)) & ring_mask);
    captured_at_ = static_cast<uint16_t>(made_ - ((head_ - now) & ring_mask) - since);
    noted_ = true;
  }
  static uint8_t waiting() { return static_cast<uint8_t>((head_ - fetched()) & ring_mask); }

  // Puts an entry into the interrupt's registers. Only while it does not run.
  static void fetch_first(uint8_t index) {
    const uint16_t next = ring_address + sizeof(EventEntry) * ((index + 1) & ring_mask);
    asm volatile("movw r2, %0\n\tmov r5, %1" ::"r"(next), "r"(entry(index).toggles));
  }
  static void set_alarm(uint8_t index) {
    Ocr1ah::write(entry(index).time_high);
    Ocr1al::write(entry(index).time_low);
  }
  static uint16_t now() {
    const uint8_t low = Tcnt1l::read();
    return static_cast<uint16_t>(low | Tcnt1h::read() << 8);
  }

  static void start_clock() {
    const uint16_t fraction = static_cast<uint16_t>(expansion.time);
    uint16_t time = static_cast<uint16_t>(now() + start_ticks);
    for (uint8_t left = blank_events; left != 0; --left) {
      time = static_cast<uint16_t>(time + blank_ticks);
      volatile EventEntry& blank = entry(head_);
      blank.time_high = static_cast<uint8_t>(time >> 8);
      blank.time_low = static_cast<uint8_t>(time);
      blank.toggles = 0;
      head_ = static_cast<uint8_t>((head_ + 1) & ring_mask);
      SerialLine::breathe();
    }
    entry(head_).toggles = pins.flag_special | pins.flag_stop;
    made_ = static_cast<uint16_t>(made_ + blank_events);
    expansion.time = static_cast<uint32_t>(time) << 16 | fraction;
    fresh_ = true;
    start();
  }

  // How many events two milliseconds have, in powers of two: 32,768 ticks.
  static uint8_t most_ahead() {
    uint8_t high = static_cast<uint8_t>(expansion.interval >> 24);
    uint8_t most = ring_entries - 2;
    if (high >= 1) most = 64;
    for (; high > 1; high >>= 1) most >>= 1;
    return most < 2 ? uint8_t{2} : most;
  }

  // The interrupt comes so often that it sees every byte off the line.
  [[gnu::noinline]] static bool is_watched(uint8_t ahead) {
    return running != 0 && static_cast<int16_t>(made_ - ahead - slow_end_) >= 0;
  }

  // False where there was nothing to do.
  static bool make_events() {
    const bool plays = running != 0;  // told first: it may stop at any moment
    const uint8_t ahead = waiting();
    const uint8_t most = most_ahead_;
    if (ahead >= most) return false;
    if (line_is_watched == 0) {
      line_is_watched = is_watched(ahead);
      if (running == 0) line_is_watched = 0;  // it has stopped in between
    }
    // What is being made counts only when it is done. At the highest rate an event takes 45 cycles to make, the
    // interrupt's included, and 114 to play: twice as many as are ahead, less a few for the way, will be done before
    // the interrupt stops and no longer looks after the line.
    uint8_t at_once = most_at_once;
    if (ahead < (most_at_once + few_at_once) / 2) at_once = static_cast<uint8_t>(2 * ahead - few_at_once);
    if (ahead < few_at_once) at_once = few_at_once;
    if (line_is_watched == 0) at_once = few_at_once;
    uint8_t count = left_ < at_once ? left_ : at_once;
    const uint8_t to_end = static_cast<uint8_t>(ring_entries - head_);
    if (count > to_end) count = to_end;
    const uint8_t room = static_cast<uint8_t>(most - ahead);
    if (count > room) {
      // Worth the way only if there is room for many, or if few are ahead.
      if (room < most / 3) return false;
      count = room;
    }
    if (turns_ != 0 && !queue_turn()) return false;

    // The interrupt may come to the end of the ring while these are made.
    if (plays || ahead == 0) gap_ = static_cast<uint16_t>(expansion.interval >> 16);
    const uint8_t first = head_;
    const uint8_t behind = static_cast<uint8_t>((first + count) & ring_mask);
    entry(behind).toggles = pins.flag_special | pins.flag_stop;
    expansion.address = ring_address + sizeof(EventEntry) * first;
    SerialLine::breathe();
    expand(count);
    SerialLine::breathe();
    left_ = static_cast<uint8_t>(left_ - count);
    made_ = static_cast<uint16_t>(made_ + count);
    head_ = behind;
    const uint8_t plain = static_cast<uint8_t>(entry(first).toggles & ~(pins.flag_special | pins.flag_stop));
    // From here on the interrupt may come to it.
    entry(first).toggles = turning_ ? static_cast<uint8_t>(plain | pins.flag_special) : plain;
    turning_ = false;
    return true;
  }

  static bool queue_turn() {
    const uint8_t head = static_cast<uint8_t>((turns_head_ + 1) & (turns_address + turns_mask));
    if (head == turns_tail) return false;
    *reinterpret_cast<volatile uint8_t*>((turns_address & 0xff00) | turns_head_) = turns_;
    turns_head_ = head;
    turns_ = 0;
    turning_ = true;
    return true;
  }

  static void start() {
    const uint8_t first = fetched();
    if (!fresh_) catch_up(first);
    fresh_ = false;
    fetch_first(first);
    const uint8_t toggles = entry(first).toggles;
    if ((toggles & pins.flag_special) != 0) turn_now(toggles);
    set_alarm(first);
    Tifr1::write(compare_match_a);
    running = 1;
    Timsk1::write(compare_match_a);
  }
  static void turn_now(uint8_t toggles) {
    const uint8_t tail = turns_tail;
    Register<0x29>::write(*reinterpret_cast<volatile uint8_t*>((turns_address & 0xff00) | tail));
    turns_tail = static_cast<uint8_t>((tail + 1) & (turns_address + turns_mask));
    asm volatile("mov r5, %0" ::"r"(static_cast<uint8_t>(toggles & ~pins.flag_special)));
  }

  // Where the interrupt stopped before an event that now is late: that one and all behind it come later still.
  static void catch_up(uint8_t first) {
    const uint16_t due = static_cast<uint16_t>(entry(first).time_high << 8 | entry(first).time_low);
    const uint16_t ahead = static_cast<uint16_t>(due - now());
    // A fraction may have made it one tick longer.
    if (ahead > least_lead && static_cast<uint16_t>(ahead - 1) <= gap_) return;  // in time after all
    slipped_ = true;
    // Nobody looks after the line until it goes on.
    if (static_cast<int16_t>(made_ - slow_end_) > 0) slow_end_ = made_;
    const uint16_t later = static_cast<uint16_t>(now() + least_lead * 2 + 64 * waiting() - due);  // 64: the loop
    for (uint8_t i = first; i != head_; i = static_cast<uint8_t>((i + 1) & ring_mask)) {
      const uint16_t time = static_cast<uint16_t>((entry(i).time_high << 8 | entry(i).time_low) + later);
      entry(i).time_high = static_cast<uint8_t>(time >> 8);
      entry(i).time_low = static_cast<uint8_t>(time);
      SerialLine::breathe();
    }
    expansion.time += static_cast<uint32_t>(later) << 16;
  }

  static inline uint8_t head_ = 0;        // entry behind the last event
  static inline uint8_t most_ahead_ = 0;  // how many events may be in the ring, at the rate of the loaded segment
  static inline uint8_t left_ = 0;        // events of the loaded segment that are not made yet
  static inline uint8_t turns_ = 0;       // direction pins to turn over before its first event
  static inline bool turning_ = false;    // they are in the queue of turns, the event is not flagged yet
  static inline uint8_t directions_ = 0;
  static inline uint8_t turns_head_ = turns_address & 0xff;
  static inline bool fresh_ = false;  // the clock was set for what is in the ring
  static inline uint16_t gap_ = 0;    // whole ticks before the event at which the interrupt stopped
  static inline bool noted_ = false;  // a capture, with its event in `captured_at_`
  static inline uint16_t captured_at_ = 0;
  static inline bool watching_ = false;  // the probe
  static inline bool slipped_ = false;
  static inline uint16_t slow_end_ = 0;  // `made_` after the last events that were not fast
  static inline uint16_t made_ = 0;      // events, ever
  static inline uint8_t begun_ = 0;      // items, ever
  static inline uint8_t finished_ = 0;

  static inline Item items_[most_begun];
  static inline uint16_t at_start_[pins.motors] = {};  // the accumulators before the oldest item
};

}  // namespace passo::chip
