// PicoPlayer: the RP2040's counterpart of the host's Player. It makes the events of segments ahead of time, as words
// for the StepStream.
//
// An event is two words: the step pins rise, and fall again. Before the first event of a segment that reverses a motor,
// a separate word sets the direction pins. Events are made up to two milliseconds ahead: everything in the ring is
// played, so the ring must not hold seconds of a slow motion.
//
// Invariant: from the first event after a standstill, it makes the same steps at the same ticks as Player.
#pragma once

#include "step_stream.hpp"

#include "passo/chip/pico_pins.hpp"
#include "passo/wire/board_segment.hpp"
#include "passo/wire/message.hpp"

namespace passo::chip {

// The board for which the image is built.
#ifndef PASSO_PICO_PINS
#error "PASSO_PICO_PINS: a pin map of pico_pins.hpp"
#endif
inline constexpr const PicoPins& pins = PASSO_PICO_PINS;

// The words' bits for each set of motors.
struct PicoPinTables {
  static constexpr uint32_t all = (1U << pins.motors) - 1;
  uint32_t steps[all + 1] = {};  // in the layout of a word
  uint16_t directions[all + 1] = {};
  constexpr PicoPinTables() {
    for (uint32_t set = 0; set <= all; ++set) {
      steps[set] = static_cast<uint32_t>(pins.steps_of(static_cast<uint8_t>(set))) << 16;
      directions[set] = pins.directions_of(static_cast<uint8_t>(set));
    }
  }
};
inline constexpr PicoPinTables pin_tables;

// The work of put_words.S: a run of events, from `carries` to `end`. It changes fraction and interval.
struct WordJob {
  uint32_t change;
  uint32_t offset;
  uint32_t fall;
  const uint8_t* end;
  uint32_t* to;
  uint32_t fraction;
  uint32_t interval;
  const uint32_t* table;
  uint32_t flips;
  const uint8_t* carries;
};
extern "C" void passo_put_words(WordJob* job);

class PicoPlayer {
 public:
  using Segment = SegmentFor<pins.motors>;

  explicit PicoPlayer(uint8_t /*motors*/) {}

  // Sets the pulse times. Returns the resulting times. Call only at standstill.
  static StepTiming set_timing(const StepTiming& wanted) {
    const uint32_t before_turn = StepStream::ticks_of_word;
    uint32_t pulse = wanted.hold > before_turn ? wanted.hold - before_turn : 0;
    if (pulse < wanted.pulse) pulse = wanted.pulse;
    if (pulse < shortest_pulse) pulse = shortest_pulse;
    longest_pulse_ = wanted.pulse == 0 && pulse < usual_pulse ? usual_pulse : pulse;
    // A pulse takes at most half of an interval.
    uint32_t ticks = 2 * pulse;
    if (ticks < pulse + before_turn + wanted.set_up) ticks = pulse + before_turn + wanted.set_up;
    const uint32_t set_up = ticks - pulse - before_turn;
    const uint32_t hold = pulse + before_turn;
    return {.pulse = static_cast<uint8_t>(pulse),
            .set_up = set_up > 0xff ? uint8_t{0xff} : static_cast<uint8_t>(set_up),
            .hold = hold > 0xff ? uint8_t{0xff} : static_cast<uint8_t>(hold),
            .event_ticks = static_cast<uint16_t>(ticks)};
  }

  // Interrupts playback at once.
  static void restart(uint8_t motors) {
    StepStream::restart(direction_pins_);
    motors_ = motors;
    begun_ = finished_ = left_ = 0;
    slipped_ = pending_ = whole_ = fresh_ = false;
    rest_ = 0;
    armed_ = false;
    captured_ = false;
    halted_ = false;
    fell_ = turned_ = 0;
    fraction_ = 0x8000;
    for (uint32_t& accumulator : accumulators_) accumulator = uint32_t{0x8000} << 16;
    for (uint16_t& accumulator : at_start_) accumulator = 0x8000;
  }

  static bool ready() { return left_ == 0 && begun_ - finished_ < most_begun; }
  static bool done() { return left_ == 0 && StepStream::dry(); }

  static void load(const Segment& segment) {
    if (pending_) end_pulse(((segment.interval >> 16) + 1) / 2);
    const bool rests = StepStream::dry();
    publish();
    if (rests) {
      rest_ = StepStream::published();
      fell_ = 0;  // in the distant past
      fresh_ = true;
    }
    segment_ = segment;
    left_ = segment.events;
    for (uint32_t m = 0; m < pins.motors; ++m) {
      increments_[m] = m < motors_ ? static_cast<uint32_t>(segment.increments[m]) << 16 : 0;
    }
    const uint32_t last = segment.interval + static_cast<uint32_t>(segment.change) * (left_ - 1);
    const uint32_t shortest = (segment.interval < last ? segment.interval : last) >> 16;
    const uint32_t longest = (segment.interval < last ? last : segment.interval) >> 16;
    const uint32_t half = (shortest + 1) / 2;
    pulse_ = half < longest_pulse_ ? half : longest_pulse_;
    // Events still in the ring may be closer together than the events of this segment.
    const uint32_t before = begun_ == finished_ ? 2 : most_ahead_;
    most_ahead_ = 1;
    for (uint32_t ticks = longest | 1; ticks < ticks_ahead; ticks <<= 1) most_ahead_ <<= 1;
    if (most_ahead_ < before) most_ahead_ = before;
    if (most_ahead_ > most_events_ahead) most_ahead_ = most_events_ahead;
    turned_ = 0;
    const uint16_t directions = pin_tables.directions[segment.directions & PicoPinTables::all];
    if (directions != direction_pins_) {
      direction_pins_ = directions;
      turned_ = StepStream::ticks_of_word;
      StepStream::push(turned_, directions);
    }
    Item& item = items_[begun_++ % most_begun];
    item.first = StepStream::pushed();
    item.events = static_cast<uint8_t>(left_);
    item.directions = segment.directions;
    item.flips = segment.flips;
    for (uint32_t m = 0; m < pins.motors; ++m) item.increments[m] = static_cast<uint16_t>(increments_[m] >> 16);
  }
  // Accepts outputs: the board switches them when all motion before them is played.
  static void pass(const BoardOutputs& /*outputs*/) {
    Item& item = items_[begun_++ % most_begun];
    item.first = StepStream::pushed() + (pending_ ? 1 : 0);
    item.events = 0;
  }

  // Whether the oldest item is done: its last step is made, or, for outputs, the last pulse before them is over.
  static bool finished() {
    if (begun_ == finished_) return false;
    const Item& item = items_[finished_ % most_begun];
    const uint32_t words = item.events == 0 ? 0 : 2U * item.events - 1;
    whole_ = static_cast<int32_t>(words_played() - item.first - words) >= 0;
    return whole_;
  }
  static void forget() {
    whole_ = false;
    const Item& item = items_[finished_++ % most_begun];
    for (uint32_t m = 0; m < pins.motors; ++m) {
      at_start_[m] = static_cast<uint16_t>(at_start_[m] + item.increments[m] * item.events);
    }
  }
  // For the oldest item: the events played, and the signed number of steps of a motor in these events.
  static uint8_t played() {
    if (begun_ == finished_) return 0;
    const Item& item = items_[finished_ % most_begun];
    const int32_t words = static_cast<int32_t>(words_played() - item.first);
    if (words <= 0) return 0;
    const uint32_t events = (static_cast<uint32_t>(words) + 1) / 2;
    return events < item.events ? static_cast<uint8_t>(events) : item.events;
  }
  static int16_t steps(uint8_t motor) {
    if (motor >= motors_) return 0;
    const Item& item = items_[finished_ % most_begun];
    const uint32_t bit = 1U << motor;
    const uint32_t events = whole_ ? item.events : played();
    const int32_t carries = static_cast<int32_t>((at_start_[motor] + item.increments[motor] * events) >> 16);
    const int32_t steps = (item.flips & bit) != 0 ? static_cast<int32_t>(events) - carries : carries;
    return static_cast<int16_t>((item.directions & bit) != 0 ? -steps : steps);
  }
  static void add_steps(int32_t* positions) {
    for (uint8_t m = 0; m < motors_; ++m) positions[m] += steps(m);
  }

  static bool slipped() { return slipped_; }

  // Whether no events need to be made for a while: all are played, or as many as allowed are made.
  static bool is_ahead() {
    if (left_ == 0) return begun_ == finished_ && StepStream::dry();
    return (StepStream::pushed() - StepStream::played()) / 2 >= most_ahead_;
  }
  // Makes some events.
  static void refill() {
    if (halted_) return;
    if (left_ == 0) return;
    const uint32_t played = StepStream::played();
    const uint32_t ahead = (StepStream::pushed() - played) / 2;
    if (ahead >= most_ahead_) return begin();
    check_slip(played);
    uint32_t count = most_ahead_ - ahead;
    if (count > most_at_once) count = most_at_once;
    if (count > left_) count = left_;
    // A direction change waits until an event follows it: the pins follow each word as soon as it is available.
    const uint32_t last_words = turned_ != 0 && count == 1 ? 2 : 1;
    make(count);
    left_ -= count;
    pending_ = left_ == 0;
    publish(pending_ ? last_words : 0);
  }
  // Call when the board has passed on all available items: no event follows the last one soon, and the motors stop.
  static void end() {
    if (!pending_ || !ready()) return;
    end_pulse(longest_pulse_);
    fresh_ = false;
    publish();
    rest_ = StepStream::published();
  }

  // Waits for the first change of the watched pin. Until watch() is called again, all values reported for the oldest
  // item are those at that change.
  static void watch(bool on) {
    captured_ = false;
    armed_ = on;
  }
  static bool captured() { return captured_; }
  static bool watches() { return armed_ || captured_; }

  // Handles the switches' interrupt: the watched pin has changed, or a switch stops the motors. Returns whether this is
  // the first change.
  [[gnu::always_inline]] static bool capture() {
    if (!armed_) return false;
    captured_at_ = StepStream::played();
    armed_ = false;
    captured_ = true;
    return true;
  }
  [[gnu::always_inline]] static void halt() {
    StepStream::halt();
    halted_ = true;
  }
  static bool halted() { return halted_; }

 private:
  static constexpr uint32_t most_begun = 32;
  static constexpr uint32_t most_at_once = 128;
  static constexpr uint32_t ticks_ahead = 32'768;
  static constexpr uint32_t first_words = 16;  // two per event
  static constexpr uint32_t most_events_ahead = 2'048;

  // An item begun and not finished.
  struct Item {
    uint32_t first;  // the number of its first event's first word
    uint8_t events;
    uint8_t directions;
    uint8_t flips;
    uint16_t increments[pins.motors];
  };

  static uint32_t words_played() {
    const uint32_t played = StepStream::played();
    return captured_ ? captured_at_ : played;
  }

  // A motion begins when the ring holds some events, or is full: its first segments may have one event each, closer
  // together than the loop can make them.
  static void publish(uint32_t kept_back = 0) {
    if (fresh_ && StepStream::pushed() - rest_ < first_words) return;
    fresh_ = false;
    StepStream::publish(kept_back);
  }
  static void begin() {
    if (!fresh_) return;
    fresh_ = false;
    StepStream::publish();
  }

  // Detects a late event: all published words are played, and the same motion has more events.
  static void check_slip(uint32_t played) {
    if (played == StepStream::published() && played != rest_) slipped_ = true;
  }

  // Adds the falling edge after the last event of a segment. Its latest time depends on the next segment. Until then
  // the event itself is held back.
  static void end_pulse(uint32_t most) {
    check_slip(StepStream::played());
    fell_ = most < longest_pulse_ ? most : longest_pulse_;
    StepStream::push(fell_, direction_pins_);
    pending_ = false;
  }

  // First makes all carries, then the words: a million events a second leave 128 cycles for each.
  [[gnu::noinline]] static void make(uint32_t count) {
    for (uint32_t i = 0; i < count; i += 4) carries_[i / 4] = 0;
    // Starts with the last motors, because each carry is shifted in at the lowest bit.
    for (uint32_t pair = (motors_ + 1U) / 2; pair-- > 0;) carry(2 * pair, count);
    const uint8_t* carries = reinterpret_cast<const uint8_t*>(carries_);
    const uint32_t directions = static_cast<uint32_t>(direction_pins_) << 16;
    const uint32_t fall = StepStream::word(pulse_, direction_pins_);
    // The pins fell this many ticks after the event before, and a direction change took its ticks.
    uint32_t gone = fell_ + turned_;
    // A new motion may be due before the long pulse at the end of the previous one is over. Then it begins later.
    const uint32_t first = (segment_.interval >> 16) + (((segment_.interval & 0xffff) + fraction_) >> 16);
    if (gone + StepStream::ticks_of_word > first) gone = first - StepStream::ticks_of_word;
    for (uint32_t done = 0; done < count;) {
      // A run ends at the ring's end. The first event is a run of its own.
      uint32_t run = done == 0 ? 1 : count - done;
      uint32_t* const to = StepStream::space(run);
      WordJob job{.change = static_cast<uint32_t>(segment_.change),
                  .offset = directions - gone - StepStream::ticks_of_word,
                  .fall = fall,
                  .end = carries + done + run,
                  .to = to,
                  .fraction = fraction_,
                  .interval = segment_.interval,
                  .table = pin_tables.steps,
                  .flips = segment_.flips & PicoPinTables::all,
                  .carries = carries + done};
      passo_put_words(&job);
      fraction_ = job.fraction;
      segment_.interval = job.interval;
      StepStream::keep(run);
      done += run;
      gone = pulse_;
    }
    if (count == left_) StepStream::drop();
    turned_ = 0;
    fell_ = pulse_;
  }

  // Adds the increments of two motors, `count` times, and shifts their carries into `carries_`.
  static void carry(uint32_t motor, uint32_t count) {
    uint32_t first = accumulators_[motor];
    uint32_t second = accumulators_[motor + 1];
    const uint32_t by_first = increments_[motor];
    const uint32_t by_second = increments_[motor + 1];
    uint8_t* at = reinterpret_cast<uint8_t*>(carries_);
    uint8_t* const end = at + count;
#pragma clang loop unroll_count(4)
    for (; at != end; ++at) {
      uint32_t bits = *at;
      asm("adds %[second], %[by_second]\n adcs %[bits], %[bits]\n adds %[first], %[by_first]\n adcs %[bits], %[bits]"
          : [first] "+l"(first), [second] "+l"(second), [bits] "+l"(bits)
          : [by_first] "l"(by_first), [by_second] "l"(by_second)
          : "cc");
      *at = static_cast<uint8_t>(bits);
    }
    accumulators_[motor] = first;
    accumulators_[motor + 1] = second;
  }

  // In ticks. At a million events a second pulses take half of the interval.
  static constexpr uint32_t shortest_pulse = 8;
  static constexpr uint32_t usual_pulse = 32;  // until a host sets its own times; long enough for most drivers
  static inline uint32_t longest_pulse_ = usual_pulse;

  static inline Segment segment_;
  static inline uint32_t left_ = 0;  // events of the loaded segment that are not made yet
  static inline uint8_t motors_ = 0;
  // In the upper half, so that the overflow sets the processor's carry flag. One more entry, so that they form pairs.
  static inline uint32_t accumulators_[pins.motors + 1] = {};
  static inline uint32_t increments_[pins.motors + 1] = {};
  static inline uint32_t carries_[most_at_once / 4] = {};  // bytes, of the events that are being made
  static inline uint32_t fraction_ = 0x8000;
  static inline uint32_t pulse_ = 0;
  static inline uint32_t fell_ = 0;    // ticks from the last event to the falling edge
  static inline uint32_t turned_ = 0;  // ticks of the word that set the directions since then
  static inline uint32_t most_ahead_ = 0;
  static inline bool pending_ = false;  // the last event's pulse has no end yet
  static inline bool fresh_ = false;    // the motors are stopped before the newest events
  static inline uint16_t direction_pins_ = 0;
  static inline uint32_t rest_ = 0;  // words published when the motors last stopped
  static inline bool slipped_ = false;
  static inline Item items_[most_begun];
  static inline uint32_t begun_ = 0;  // total number of items begun
  static inline uint32_t finished_ = 0;
  static inline bool whole_ = false;                   // the oldest item is done, and not dropped yet
  static inline uint16_t at_start_[pins.motors] = {};  // the accumulators at the start of the oldest item
  static inline volatile bool armed_ = false;
  static inline volatile bool captured_ = false;
  static inline volatile uint32_t captured_at_ = 0;
  static inline volatile bool halted_ = false;
};

}  // namespace passo::chip
