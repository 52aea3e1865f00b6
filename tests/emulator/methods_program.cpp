// On the chip: plays one order after the other, for ever. Each call of next() stands between two marks, with what an
// interrupt would do around it: the walk lies in RAM, the result goes to ports.
//
// Wires to the host, in registers that mean nothing to the chip's hardware:
//   reading GPIOR0    the next byte of an order
//   writing GPIOR0    a mark: begin and end of what is measured, in turns
//   writing GPIOR1, 2 a pulse's steps and directions; the bytes of an interval, lowest first
// Portable.
#include "emulator/methods.hpp"

namespace {

using namespace passo;

volatile uint8_t& gpior(uint8_t number) {
  constexpr uint8_t addresses[] = {0x3e, 0x4a, 0x4b};
  return *reinterpret_cast<volatile uint8_t*>(addresses[number]);
}

// One cycle. The compiler moves no work across it.
void mark() {
  asm volatile("out 0x1e, r1" ::: "memory");
}

uint32_t read_bytes(uint8_t count) {
  uint32_t value = 0;
  for (uint8_t i = 0; i < count; ++i) value |= static_cast<uint32_t>(gpior(0)) << (8 * i);
  return value;
}

Order read_order() {
  Order order;
  while (order.method == no_order) order.method = static_cast<uint8_t>(read_bytes(1));
  order.most = static_cast<uint16_t>(read_bytes(2));
  for (int32_t& value : order.values) value = static_cast<int32_t>(read_bytes(4));
  return order;
}

void put(Pulse pulse) {
  gpior(1) = pulse.steps;
  gpior(2) = pulse.directions;
}
void put(uint16_t interval) {
  gpior(1) = static_cast<uint8_t>(interval);
  gpior(1) = static_cast<uint8_t>(interval >> 8);
}
void put(uint32_t interval) {
  put(static_cast<uint16_t>(interval));
  put(static_cast<uint16_t>(interval >> 16));
}

// The ramp's factors in flash, where they take no RAM: 3 cycles a byte instead of 2.
[[gnu::section(".progmem.data")]] constexpr RampTable<ramp_table_size> flash_table;

// In C++ the product alone would take 80 cycles: LLVM multiplies 32 by 32 bits there, by a call.
struct FlashTable {
  static constexpr uint16_t size() { return ramp_table_size; }
  uint16_t scaled(uint16_t first, uint16_t n) const {
    uint16_t address = static_cast<uint16_t>(reinterpret_cast<uintptr_t>(&flash_table) + 2 * n);
    uint16_t factor;
    uint16_t product;
    uint8_t zero;
    asm("lpm %A[factor], Z+  \n\t"
        "lpm %B[factor], Z   \n\t"
        "clr %[zero]         \n\t"
        "mul %A[first], %A[factor] \n\t"
        "mov %A[address], r1 \n\t"  // what the lowest column carries
        "mul %B[first], %B[factor] \n\t"
        "movw %[product], r0 \n\t"
        "mul %A[first], %B[factor] \n\t"
        "add %A[address], r0 \n\t"
        "adc %A[product], r1 \n\t"
        "adc %B[product], %[zero] \n\t"
        "mul %B[first], %A[factor] \n\t"
        "add %A[address], r0 \n\t"
        "adc %A[product], r1 \n\t"
        "adc %B[product], %[zero] \n\t"
        "clr r1"
        : [factor] "=&r"(factor), [product] "=&r"(product), [zero] "=&r"(zero), [address] "+z"(address)
        : [first] "r"(first)
        : "r0");
    return product;
  }
};

// A walk at a known address, as an interrupt's state does, without a constructor that runs before main.
template <class Walk>
union Room {
  uint8_t nothing = 0;
  Walk walk;
};
template <class Walk>
constinit Room<Walk> room{};

template <class Walk>
[[gnu::noinline]] void begin(const Order& order) {
  room<Walk>.walk = Walk(order);
}
template <class Walk>
[[gnu::noinline]] void beat() {
  put(room<Walk>.walk.next());
}

template <class Walk>
[[gnu::noinline]] void play(const Order& order) {
  mark();
  begin<Walk>(order);
  mark();
  for (uint16_t left = order.most; left != 0 && !room<Walk>.walk.done(); --left) {
    mark();
    beat<Walk>();
    mark();
  }
}

}  // namespace

// Freestanding: to the compiler main is a function like others.
extern "C" int main() {
  mark();  // what two marks cost
  mark();
  for (;;) {
    const Order order = read_order();
    visit_method<FlashTable>(order.method, [&](auto method) { play<typename decltype(method)::Walk>(order); });
  }
}
