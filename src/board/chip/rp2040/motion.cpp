// The firmware `motion` for the RP2040: a Board on the chip. One loop; the state machine plays the steps; interrupts
// feed it and watch the switches.
#include "pico_line.hpp"
#include "pico_player.hpp"
#include "pico_wiring.hpp"

#include "passo/chip/input_filter.hpp"
#include "passo/chip/input_reader.hpp"
#include "passo/firmware/board.hpp"

namespace passo::chip {
namespace {

constexpr uint32_t cycles_a_second = 128'000'000;
constexpr uint32_t clock = cycles_a_second / StepStream::cycles_of_tick;
constexpr uint32_t baud = 1'000'000;
constexpr uint8_t queue_capacity = 250;
constexpr About about = {
    .firmware = PASSO_FIRMWARE_VERSION, .highest_event_rate = 1'000'000, .baud = baud, .name = PASSO_PICO_NAME};

struct Hardware {
  void step(uint8_t, uint8_t) {}
  // All motion before is played.
  void outputs(const BoardOutputs& outputs) { PicoWiring::switch_outputs(outputs); }
  static bool switch_off(uint8_t switches) { return PicoWiring::switch_off(switches); }
  void send(uint8_t byte) { line.send(byte); }
  uint8_t room() const { return line.room(); }
  void enable() { PicoWiring::enable_motors(true); }
  static bool has_encoder() { return SpindleCounter::exists(); }
  static SpindleCount spindle() { return SpindleCounter::count(); }
  static constexpr bool has_handwheel() { return HandwheelCounter::exists(); }
  static HandwheelCount handwheel() { return HandwheelCounter::count(); }
  void watch();
  static bool can_watch(uint8_t limits) { return PicoWiring::can_watch(limits); }
  static PinSetup set_up(const PinSetup& wanted);
  static uint8_t drivers_rest() { return PicoWiring::drivers_rest(); }
  static uint16_t alarms() { return PicoWiring::alarms(); }
  static void release() { PicoWiring::enable_motors(false); }

  PicoLine line;
};

ResetCause cause_of_reset() {
  if (WatchdogReason::read() != 0) return ResetCause::watchdog;
  return (ChipReset::read() & 1U << 8) != 0 ? ResetCause::power_on : ResetCause::button;
}

Hardware hardware;
Board<Hardware, queue_capacity, PicoPlayer, pins.motors>* board_there = nullptr;
InputReader reader;

using PicoBoard = Board<Hardware, queue_capacity, PicoPlayer, pins.motors>;
alignas(8) unsigned char board_memory[sizeof(PicoBoard)];

PicoBoard& board() {
  return *board_there;
}

// Waits for a change of the watched pin. A change that came already (a bounce) is found only by looking.
void watch_input() {
  const uint16_t watched = board().watched();
  const bool closed = (reader.inputs() & watched) != 0;
  PicoPlayer::watch(true);
  PicoWiring::watch(board().stopping(), watched, closed);
  if (((PicoWiring::inputs() & watched) != 0) != closed && !PicoPlayer::captured()) PicoPlayer::watch(false);
}

// Another input is watched; called at rest.
void Hardware::watch() {
  PicoPlayer::watch(false);
  watch_input();
}

// Called at rest. What the switches are under the new setup is known at once, because a hello may follow.
PinSetup Hardware::set_up(const PinSetup& wanted) {
  PinSetup done = PicoWiring::set_up(wanted);
  done.timing = PicoPlayer::set_timing(wanted.timing);
  reader.update(PicoWiring::inputs(), false, pressed_by_people(PicoWiring::alarms()));
  board().set_inputs(reader.inputs());
  hardware.watch();
  return done;
}

// `on`: inputs that were seen on.
void stop_at_once(uint16_t on = 0) {
  const uint16_t inputs = on | PicoWiring::inputs();
  PicoPlayer::halt();
  PicoWiring::switch_outputs({});
  if ((inputs & input_emergency_stop) != 0) PicoWiring::enable_motors(false);
  board().stop_at_once(inputs);
  watch_input();
}

// True once in so many microseconds.
template <uint32_t microseconds>
bool take_tick() {
  static uint32_t last = 0;
  const uint32_t now = TimerLow::read();
  if (now - last < microseconds) return false;
  last = now;
  return true;
}

void look_at_inputs() {
  const bool tick = take_tick<4'096>();
  if (PicoPlayer::halted()) return stop_at_once();
  const uint16_t watched = board().watched();
  const uint16_t by_people = pressed_by_people(PicoWiring::alarms());
  const uint16_t before = reader.inputs();
  bool changed = PicoPlayer::captured();
  uint16_t raw = settled_inputs<PicoWiring>(before, static_cast<uint16_t>(~by_people));
  if (changed && PicoWiring::filter() != 0 && ((raw ^ before) & watched) == 0) {
    changed = false;  // it was noise: the interrupt is to wait for the next change
    PicoPlayer::watch(false);
  }
  // A switch that was closed before the motion began has no edge that would tell the interrupt.
  const uint16_t stops = raw & PicoWiring::stopping();
  if (!board().idle() && stops != 0) return stop_at_once(stops);
  // During motion the interrupt reports changes of the watched input, and where. Several are one, which is on while any
  // of them is.
  if (changed || (!board().idle() && PicoPlayer::watches())) {
    const bool was_on = (before & watched) != 0;
    const bool is_on = (raw & watched) != 0;
    const uint16_t now = !changed ? (is_on == was_on ? raw : before) : was_on ? 0 : PicoWiring::captured_inputs();
    raw = static_cast<uint16_t>((raw & ~watched) | (now & watched));
  }
  const uint16_t on = reader.update(raw, tick, by_people);
  // During motion the interrupt has stopped already. At rest nobody else looks.
  if ((on & board().stopping()) != 0 && !board().idle()) return stop_at_once(on);
  if ((on & stopping_at_rest(PicoWiring::alarms())) != 0) return stop_at_once(on);
  uint16_t told = on & by_people;
  told |= (reader.inputs() ^ before) & watched;
  if (changed) board().settle();  // releases the items finished before that
  if (told != 0 || tick) board().set_inputs(reader.inputs(), told);
  if (changed || (board().idle() && (told & watched) != 0)) PicoPlayer::watch(false);
  if (!PicoPlayer::watches()) watch_input();
}

// One turn of the loop.
void run_once() {
  PicoLine& line = hardware.line;
  WatchdogLoad::write(2'000'000);  // a second; the chip counts each tick twice (errata RP2040-E1)
  line.poll();
  for (uint32_t taken = 0; line.has_byte() && taken < 16; ++taken) board().receive(line.take());
  // Before the first events of a motion are on their way.
  look_at_inputs();
  if (take_tick<100'000>()) board().count_silence();
  SpindleCounter::poll();
  HandwheelCounter::poll();
  board().settle();
  PicoPlayer::end();
  PicoPlayer::refill();
  if (board().owes_report() && line.can_send() && (board().owed() >= 3 || !line.has_byte())) board().report();
}

// Sleeps until something happens, at most a quarter of a millisecond: at that rate the UART holds every byte.
constexpr uint32_t cycles_of_sleep = 32'000;
void sleep_if_idle() {
  if (!PicoPlayer::is_ahead() || PicoPlayer::halted() || PicoPlayer::captured() || board().owes_report()) return;
  PicoLine::wake_on_news();
  if (hardware.line.has_byte() || UsbSerial::has_news()) return;
  asm volatile("wfi");
}
void start_sleep_timer() {
  SysTickReload::write(cycles_of_sleep - 1);
  SysTickCount::write(0);
  SysTickControl::write(7);
}

void leave_reset(uint32_t blocks) {
  Resets::clear(blocks);
  while ((ResetsDone::read() & blocks) != blocks) {
  }
}

template <class Pll>
void start_pll(uint32_t reset, uint32_t times, uint32_t first_divisor, uint32_t second_divisor) {
  leave_reset(reset);
  Pll::Cs::write(1);
  Pll::Fbdiv::write(times);
  Pll::Pwr::clear(1U << 0 | 1U << 5);
  while ((Pll::Cs::read() >> 31) == 0) {
  }
  Pll::Prim::write(first_divisor << 16 | second_divisor << 12);
  Pll::Pwr::clear(1U << 3);
}

// The chip at 128 MHz from its crystal of 12 MHz: 12 MHz * 128 / 6 / 2. So a tick of 16 MHz is eight cycles. USB has
// 48 MHz: 12 MHz * 100 / 5 / 5.
void start_clocks() {
  XoscCtrl::write(0xaa0);
  XoscStartup::write(47);
  XoscCtrl::write(0xfabaa0);
  while ((XoscStatus::read() >> 31) == 0) {
  }
  ClkRefCtrl::write(2);
  while ((ClkRefSelected::read() & 4) == 0) {
  }
  ClkSysCtrl::write(0);
  while ((ClkSysSelected::read() & 1) == 0) {
  }
  start_pll<PllSys>(reset_pll_sys, 128, 6, 2);
  ClkSysCtrl::write(1);
  while ((ClkSysSelected::read() & 2) == 0) {
  }
  ClkPeriCtrl::write(1U << 11);
  start_pll<PllUsb>(reset_pll_usb, 100, 5, 5);
  ClkUsbCtrl::write(1U << 11);
  WatchdogTick::write(1U << 9 | 12);  // a microsecond
}

void start_watchdog() {
  PsmWdsel::write(0x1fffc);  // resets everything but the oscillators
  WatchdogLoad::write(2'000'000);
  WatchdogCtrl::write(1U << 30);
}

}  // namespace
}  // namespace passo::chip

inline void* operator new(__SIZE_TYPE__ /*size*/, void* place) noexcept {
  return place;
}

extern "C" {

void passo_refill_done() {
  passo::chip::StepStream::refill_done();
}
void passo_wake() {}
// The loop does the work.
void passo_usb_moved() {
  passo::chip::UsbSerial::interrupt();
}
// The loop takes the byte.
void passo_byte_came() {
  passo::chip::UartImsc::write(0);
}
void passo_switch_moved() {
  passo::chip::PicoWiring::switch_moved();
}

[[noreturn]] void passo_main() {
  using namespace passo::chip;
  start_clocks();
  leave_reset(reset_dma | reset_io_bank0 | reset_pads_bank0 | reset_pio0 | reset_pwm | reset_timer | reset_uart0 |
              reset_usbctrl);
  PicoWiring::prepare();
  StepStream::prepare(pins.first, pins.motor_pins());
  board_there = new (board_memory)
      PicoBoard(hardware, {.motors = pins.motors,
                           .clock = clock,
                           .reset = cause_of_reset(),
                           .shortest_interval = passo::shortest_interval(clock, about.highest_event_rate),
                           .about = about});
  PicoPlayer::restart(0);
  hardware.line.open(cycles_a_second, baud);
  PicoWiring::enable_motors(true);
  NvicEnable::write(1U << irq_dma0 | 1U << irq_io_bank0 | 1U << irq_uart0);
  start_sleep_timer();
  start_watchdog();
  interrupts_on();
  watch_input();
  for (;;) {
    run_once();
    sleep_if_idle();
  }
}

// The compiler calls these for large copies.
void* memcpy(void* to, const void* from, __SIZE_TYPE__ size) {
  auto* out = static_cast<volatile unsigned char*>(to);
  const auto* in = static_cast<const unsigned char*>(from);
  for (; size != 0; --size) *out++ = *in++;
  return to;
}
void* memset(void* to, int value, __SIZE_TYPE__ size) {
  auto* out = static_cast<volatile unsigned char*>(to);
  for (; size != 0; --size) *out++ = static_cast<unsigned char>(value);
  return to;
}
void __aeabi_memcpy(void* to, const void* from, __SIZE_TYPE__ size) {
  memcpy(to, from, size);
}
void __aeabi_memcpy4(void* to, const void* from, __SIZE_TYPE__ size) {
  memcpy(to, from, size);
}
void __aeabi_memcpy8(void* to, const void* from, __SIZE_TYPE__ size) {
  memcpy(to, from, size);
}
void __aeabi_memset(void* to, __SIZE_TYPE__ size, int value) {
  memset(to, value, size);
}
void __aeabi_memclr(void* to, __SIZE_TYPE__ size) {
  memset(to, 0, size);
}
void __aeabi_memclr4(void* to, __SIZE_TYPE__ size) {
  memset(to, 0, size);
}
void __aeabi_memclr8(void* to, __SIZE_TYPE__ size) {
  memset(to, 0, size);
}
}
