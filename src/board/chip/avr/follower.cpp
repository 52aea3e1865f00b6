// The firmware `follower` for an Arduino Uno or Mega: Follower on the chip's pins. No interrupt; one loop.
//
// PASSO_FOLLOWER_PINS names the board (a FollowerPins), and PASSO_FOLLOWER_DRIVE how the motors are driven (a
// DriveMode).
#include "passo/firmware/follower.hpp"

#include "passo/chip/follower_pins.hpp"
#include "passo/firmware/winding_table.hpp"

namespace passo {
namespace {

constexpr const FollowerPins& pins = PASSO_FOLLOWER_PINS;
constexpr WindingTable table = winding_table(DriveMode::PASSO_FOLLOWER_DRIVE);
constexpr char ports[] = {'A', 'B', 'C', 'D', 'E', 'F', 'G', 'H', 'J', 'K', 'L'};

volatile uint8_t& data_register(uint16_t address) {
  return *reinterpret_cast<volatile uint8_t*>(address);
}
volatile uint8_t& levels(char port) {
  return data_register(port_registers(port));
}
volatile uint8_t& outputs(char port) {
  return data_register(static_cast<uint16_t>(port_registers(port) + 1));
}
volatile uint8_t& latches(char port) {
  return data_register(static_cast<uint16_t>(port_registers(port) + 2));
}
bool level(Pin pin) {
  return (levels(pin.port) & pin.mask()) != 0;
}
[[gnu::always_inline]] inline void set(Pin pin, bool high) {
  if (!pin.exists()) return;
  if (high) {
    latches(pin.port) = static_cast<uint8_t>(latches(pin.port) | pin.mask());
  } else {
    latches(pin.port) = static_cast<uint8_t>(latches(pin.port) & ~pin.mask());
  }
}

// A motor's windings on one port: the winding table in the port's own bits. It is in RAM, where reading takes two
// cycles.
template <uint8_t axis, char port>
struct PortTable {
  uint8_t bits[8] = {};

  static constexpr uint8_t all = pins.winding_bits(axis, port, 0x0f);
  constexpr PortTable() {
    for (uint8_t place = 0; place < 8; ++place) bits[place] = pins.winding_bits(axis, port, table.at(place));
  }
};
template <uint8_t axis, char port>
constinit PortTable<axis, port> port_table;

template <uint8_t axis, uint8_t port = 0>
[[gnu::always_inline]] inline void write_windings(uint8_t index) {
  if constexpr (port < sizeof(ports)) {
    if constexpr (constexpr char name = ports[port]; PortTable<axis, name>::all != 0) {
      const uint8_t others = static_cast<uint8_t>(latches(name) & ~PortTable<axis, name>::all);
      latches(name) = static_cast<uint8_t>(others | port_table<axis, name>.bits[index]);
    }
    write_windings<axis, port + 1>(index);
  }
}

template <uint8_t port = 0>
void prepare_ports() {
  if constexpr (port < sizeof(ports)) {
    constexpr char name = ports[port];
    if constexpr (pins.outputs_on(name) != 0) outputs(name) = pins.outputs_on(name);
    if constexpr (pins.pulled_up_on(name) != 0) latches(name) = pins.pulled_up_on(name);
    prepare_ports<port + 1>();
  }
}

// Timer 0 reaches its compare value every millisecond. The flag is polled; there is no interrupt.
constexpr uint16_t tifr0 = 0x35;
constexpr uint16_t tccr0a = 0x44;
constexpr uint16_t tccr0b = 0x45;
constexpr uint16_t ocr0a = 0x47;
constexpr uint8_t compare_match = 1 << 1;

constexpr uint16_t ucsr0b = 0xc1;
constexpr uint16_t mcusr = 0x54;
constexpr uint16_t wdtcsr = 0x60;

struct Hardware {
  static constexpr bool has_keypad = pins.has_keypad();

  static uint8_t lines() { return levels(pins.lines); }
  static bool relay_line() { return level(pins.relay_line); }
  static bool tool_button() { return !level(pins.tool_button); }

  [[gnu::always_inline]] static void windings(uint8_t axis, uint8_t place) {
    const uint8_t index = place & table.mask;
    if (axis == 0) write_windings<0>(index);
    if (axis == 1) write_windings<1>(index);
    if (axis == 2) write_windings<2>(index);
  }
  static void relay(bool on) {
    set(pins.relay, on);
    set(pins.relay_indicator, on);
  }
  static void indicators(bool automatic, bool manual) {
    set(pins.automatic_indicator, automatic);
    set(pins.manual_indicator, manual);
  }

  static uint8_t rows() {
    const uint8_t high = levels(pins.rows[0].port);
    uint8_t down = 0;
    for (uint8_t row = 0; row < keypad_rows; ++row) {
      if ((high & pins.rows[row].mask()) == 0) down = static_cast<uint8_t>(down | 1 << row);
    }
    return down;
  }
  static void draw_column(uint8_t column) {
    volatile uint8_t& drawn = outputs(pins.columns[0].port);
    uint8_t mask = drawn;
    for (uint8_t c = 0; c < keypad_columns; ++c) {
      const uint8_t bit = pins.columns[c].mask();
      mask = static_cast<uint8_t>(c == column ? mask | bit : mask & ~bit);
    }
    drawn = mask;
  }
  static bool millisecond() {
    if ((data_register(tifr0) & compare_match) == 0) return false;
    data_register(tifr0) = compare_match;
    return true;
  }

  // After a reset all pins float and all latches are low, so outputs begin low.
  static void prepare() {
    data_register(ucsr0b) = 0;  // old boot loaders leave the serial line on, and with it D0 and D1
    prepare_ports();
    // The watchdog resets after a quarter of a second; then all pins float. The two writes must follow each other.
    data_register(mcusr) = 0;
    data_register(wdtcsr) = 0x18;
    data_register(wdtcsr) = 0x0c;
    data_register(tccr0a) = 2;   // count to OCR0A, then begin again
    data_register(ocr0a) = 249;  // 16 MHz / 64 / 250
    data_register(tccr0b) = 3;   // divided by 64
  }
};

Hardware hardware;
constinit Follower<Hardware> follower(hardware);

}  // namespace
}  // namespace passo

extern "C" int main() {
  passo::Hardware::prepare();
  passo::follower.begin();
  for (;;) {
    asm volatile("wdr");
    passo::follower.poll();
  }
}
