// The firmware `motion`: a Board on the chip. One loop; the step timer has the only interrupt.
#include "chip_player.hpp"
#include "keypad_wiring.hpp"
#include "output_actions.hpp"
#include "products.hpp"
#include "serial_line.hpp"
#include "spindle_counter.hpp"
#include "wiring.hpp"

#include "passo/chip/input_filter.hpp"
#include "passo/chip/input_reader.hpp"
#include "passo/firmware/board.hpp"
#include "passo/firmware/manual_mode.hpp"

#ifndef PASSO_BAUD
#define PASSO_BAUD 500000
#endif

namespace passo::chip {
namespace {

constexpr uint32_t clock = 16'000'000;
constexpr uint8_t ticks_a_tenth = (clock / 10 + 0x8000) >> 16;  // a tick has 65,536 cycles
constexpr uint32_t shortest = shortest_interval(clock, about.highest_event_rate);

struct Hardware {
  void step(uint8_t, uint8_t) {}
  void outputs(const BoardOutputs&) {}  // the player has switched them already, at their event
  uint8_t* space(uint8_t size) { return line.space(size); }
  void put(uint8_t size) { line.put(size); }
  uint8_t room() { return line.room(); }
  void enable() { Wiring::enable_motors(true); }
  bool switch_off(uint8_t switches) { return Wiring::switch_off(switches); }
  void watch();
  static void release_capture() { ChipPlayer::watch(false); }
  PinSetup set_up(const PinSetup& wanted);
  static uint8_t drivers_rest() { return Wiring::drivers_rest(); }
  static uint16_t alarms() { return Wiring::alarms(); }
  void release() { Wiring::enable_motors(false); }
  static bool can_watch(uint8_t limits) { return are_on_one_port(limits); }
  static constexpr bool has_encoder() { return SpindleCounter::exists(); }
  static SpindleCount spindle() { return SpindleCounter::count(); }
  static void breathe() { SerialLine::breathe(); }
  static void keep_up();
  [[gnu::always_inline]] static void slice() {
    if (ring_is_short) {
      make_a_slice();
    } else {
      SerialLine::breathe();
    }
  }
  static void make_a_slice();
  static int32_t high_product(int32_t a, int32_t b) { return chip::high_product(a, b); }

  SerialLine line;
};

Hardware hardware;
ResetCause cause_of_reset() {
  const uint8_t flags = Mcusr::read();
  Mcusr::write(0);
  const auto has = [flags](uint8_t bit) { return static_cast<uint8_t>(flags & bit) != 0; };
  if (has(1 << 3)) return ResetCause::watchdog;
  if (has(1 << 0)) return ResetCause::power_on;
  if (has(1 << 2)) return ResetCause::brown_out;
  return ResetCause::button;
}

BoardIdentity identity() {
  return {
      .motors = pins.motors, .clock = clock, .reset = cause_of_reset(), .shortest_interval = shortest, .about = about};
}
Board<Hardware, queue_capacity, ChipPlayer, pins.motors> board(hardware, identity());
InputReader reader;

// Stands for the keypad if the pin map has none.
struct NoKeypad {
  void begin() {}
  void tick() {}
  void feed() {}
  void stopped() {}
};
template <const auto& map, bool there = map.keypad.exists()>
struct Manual {
  using Type = NoKeypad;
  static constexpr Type make() { return {}; }
};
template <const auto& map>
struct Manual<map, true> {
  using Type = ManualMode<KeypadWiring, decltype(board)>;
  static constexpr JogRamp ramp = jog_ramp(map.keypad.speeds, clock);
  static constexpr Type make() { return {board, ramp}; }
};
constinit auto manual = Manual<pins>::make();

// A second without a turn of the loop resets the chip. To change the watchdog, two writes must follow each other.
void start_watchdog() {
  asm volatile("wdr");
  Wdtcsr::write(1 << 4 | 1 << 3);
  Wdtcsr::write(1 << 3 | 6);
}

// Stops everything at once. Nothing moves again until a host says hello. `on`: inputs that were seen on.
[[gnu::noinline]] void stop_at_once(uint16_t on = 0) {
  const uint16_t inputs = on | Wiring::inputs();
  ChipPlayer::halt();
  OutputActions::make_safe();
  // From here on the interrupt reads no byte, and all of this is long.
  SerialLine::poll();
  if ((inputs & input_emergency_stop) != 0) Wiring::enable_motors(false);
  board.stop_at_once(inputs);
  SerialLine::poll();
  manual.stopped();
  halted = 0;
  Eecr::write(static_cast<uint8_t>(Eecr::read() & ~(1 << halted_bit)));
}

// Watches for the next change. A change that came already (a bounce) is found only by looking.
[[gnu::noinline]] void watch_input() {
  const uint16_t watched = board.watched();
  const bool closed = (reader.inputs() & watched) != 0;
  choose_watch(watched, closed);
  SerialLine::poll();
  ChipPlayer::watch(true);
  if (((Wiring::inputs() & watched) != 0) != closed && !ChipPlayer::captured()) ChipPlayer::watch(false);
}

// Another input is watched; called at rest.
[[gnu::noinline]] void Hardware::watch() {
  SerialLine::poll();
  ChipPlayer::watch(false);
  stop_on(board.watched(), Wiring::alarms());
  SerialLine::poll();
  watch_input();
  SerialLine::poll();
}

// Called at rest. What the switches are under the new setup is known at once, because a hello may follow.
[[gnu::noinline]] PinSetup Hardware::set_up(const PinSetup& wanted) {
  SerialLine::poll();
  PinSetup done = Wiring::set_up(wanted);
  SerialLine::poll();
  done.steps = MotorOutputs::set_idle(wanted.steps);
  done.timing = MotorOutputs::set_timing(wanted.timing);
  SerialLine::poll();
  reader.update(Wiring::inputs(), false, pressed_by_people(Wiring::alarms()));
  board.set_inputs(reader.inputs());
  watch();
  return done;
}

// Whether the timer has overflowed since the last call.
bool take_tick() {
  if (SpindleCounter::exists()) return SpindleCounter::take_tick();
  const bool tick = (Tifr1::read() & timer_overflow) != 0;
  if (tick) Tifr1::write(timer_overflow);
  return tick;
}

// Counts the host's silence, a tenth of a second at a time.
[[gnu::noinline]] void count_tick() {
  static uint8_t ticks = ticks_a_tenth;
  if (--ticks != 0) return;
  ticks = ticks_a_tenth;
  SerialLine::poll();
  board.count_silence();
  SerialLine::poll();
}

// The watched inputs while the motors turn. The interrupt tells a change, and which pins made it (`changed`). Several
// count as one input, which is on while any of them is: until the interrupt tells, that one has not changed.
[[gnu::noinline]] uint16_t watched_in_motion(uint16_t raw, uint16_t before, bool changed) {
  const uint16_t watched = board.watched();
  const bool was_on = (before & watched) != 0;
  if (changed) {
    const uint16_t moved = inputs_that_moved(watched);
    raw = static_cast<uint16_t>(was_on ? raw & ~moved : raw | moved);
  } else if (((raw & watched) != 0) != was_on) {
    raw = before;
  }
  return raw & watched;
}

[[gnu::noinline]] void look_at_inputs() {
  const bool tick = take_tick();
  if (tick) count_tick();
  if (halted != 0) {
    if (Wiring::filter() == 0) return stop_at_once();
    halted = 0;
  }
  const uint16_t before = reader.inputs();
  const uint16_t watched = board.watched();
  const uint16_t by_people = pressed_by_people(Wiring::alarms());
  SerialLine::breathe();
  bool changed = ChipPlayer::captured();
  uint16_t raw = settled_inputs<Wiring>(before, static_cast<uint16_t>(~by_people));
  SerialLine::breathe();
  if (changed && Wiring::filter() != 0 && ((raw ^ before) & watched) == 0) {
    changed = false;  // it was noise: the interrupt is to wait for the next change
    ChipPlayer::watch(false);
  }
  if (changed || (running != 0 && ChipPlayer::watches())) {
    raw = static_cast<uint16_t>((raw & ~watched) | watched_in_motion(raw, before, changed));
  }
  const uint16_t on = reader.update(raw, tick, by_people);
  // During motion the interrupt has stopped already. At rest nobody else looks.
  if ((on & board.stopping()) != 0 && !board.idle()) return stop_at_once(on);
  if ((on & stopping_at_rest(Wiring::alarms())) != 0) return stop_at_once(on);
  uint16_t told = on & by_people;
  told |= (reader.inputs() ^ before) & watched;
  if (changed) board.settle();  // releases the items finished before that
  SerialLine::breathe();
  if (told != 0 || tick) board.set_inputs(reader.inputs(), told);
  if (tick) manual.tick();
  if (changed || (running == 0 && (told & watched) != 0)) ChipPlayer::watch(false);
  SerialLine::breathe();
  if (!ChipPlayer::watches()) watch_input();
}

constexpr uint8_t most_bytes_a_turn = 32;
constexpr uint8_t most_bytes_at_once = 4;

// Takes some bytes of a payload, or one that is something else. In functions of their own: a loop around this would
// keep addresses in the interrupt's registers, and what takes a frame needs the stack.
[[gnu::noinline]] uint8_t receive_payload() {
  uint8_t count;
  const uint8_t* const bytes = SerialLine::next(count, most_bytes_at_once);
  const uint8_t taken = board.receive_payload(bytes, count);
  SerialLine::drop(taken);
  return taken;
}
[[gnu::noinline]] void receive_other() {
  board.receive_other(SerialLine::take());
}
uint8_t receive_some() {
  if (const uint8_t taken = receive_payload(); taken != 0) return taken;
  SerialLine::breathe();
  receive_other();
  return 1;
}

constexpr uint8_t most_parts = 3;

// Makes events, of the next item if need be. On the Uno also of those behind it, if it has only a few events: the next
// call may be far away.
[[gnu::noinline]] void keep_up() {
  ChipPlayer::refill(ring_is_short && board.has_more());
  uint8_t parts = most_parts;
#pragma clang loop unroll(disable)
  do {
    if (!ChipPlayer::wants_more() || !board.has_more()) return;
    if (ChipPlayer::begins_many()) {
      board.feed();
    } else {
      board.settle();
    }
    ChipPlayer::refill(ring_is_short && board.has_more());
  } while (ring_is_short && --parts != 0);
}

// An event of windings takes long to make, and so would the way to a switch. Their rings last longer than an answer
// takes.
void Hardware::keep_up() {
  SerialLine::breathe();
#ifndef PASSO_WINDINGS
  if (running != 0) chip::keep_up();
  SerialLine::breathe();
#endif
}

[[gnu::noinline]] void Hardware::make_a_slice() {
  SerialLine::breathe();
  if (running != 0 && ChipPlayer::is_low() && !ChipPlayer::captured()) chip::keep_up();
}

// One turn of the loop. Events come first: nothing else here may take longer than the events ahead of the interrupt.
[[gnu::noinline]] void run_once() {
  static uint8_t turns = 0;
  asm volatile("wdr");
  SerialLine& line = hardware.line;
  SpindleCounter::poll();
  line.poll();
  keep_up();
  // Some bytes at a time: events must not wait for a flood of them. Nor must a capture: until it is told, no item is
  // released and few can begin, so the ring would run dry.
  for (uint8_t taken = 0, looked = 0; line.has_byte() && taken < most_bytes_a_turn && !ChipPlayer::captured();) {
    taken = static_cast<uint8_t>(taken + receive_some());
    line.poll();
    if (static_cast<uint8_t>(taken - looked) < most_bytes_at_once) continue;
    looked = taken;
    SpindleCounter::poll();
    // A question's answer takes as long as several short parts.
#pragma clang loop unroll(disable)
    for (uint8_t parts = ChipPlayer::begins_many() ? 3 : 1; parts != 0 && ChipPlayer::is_low(); --parts) {
      keep_up();
      if (ChipPlayer::begins_many()) line.poll();
    }
  }
  manual.feed();
  keep_up();
  line.poll();
  // Inputs that the interrupt has seen are handled at once, and before the item with the capture is released. Others
  // can wait.
  if (halted != 0 || ChipPlayer::captured() || (++turns & 63) == 0) look_at_inputs();
  SerialLine::breathe();
  board.settle();
  line.poll();
  keep_up();
  line.poll();
  // A credit repeats what earlier ones told, so it can wait while there is more urgent work.
  if (!board.owes_report() || !line.can_send()) return;
  const bool can_wait = board.owed() < 3;
  if (can_wait && (line.has_byte() || ChipPlayer::is_short()) && (turns & 7) != 4) return;
  board.report();
}

}  // namespace
}  // namespace passo::chip

extern "C" int main() {
  using namespace passo::chip;
  Wiring::prepare();
  manual.begin();
  ChipPlayer::prepare();
  SpindleCounter::prepare();
  board.player().restart(0);
  SerialLine::open(clock, PASSO_BAUD);
  Wiring::enable_motors(true);
  start_watchdog();
  asm volatile("sei");
  for (;;) run_once();
}
