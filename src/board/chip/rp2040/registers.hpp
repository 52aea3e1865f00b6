// The registers of the RP2040 that the firmware uses. Source: RP2040 datasheet, Raspberry Pi Ltd, which defines the
// names.
#pragma once

#include <stdint.h>

namespace passo::chip {

template <uint32_t address>
struct Register {
  static constexpr uint32_t where = address;
  [[gnu::always_inline]] static uint32_t read() { return *reinterpret_cast<volatile uint32_t*>(address); }
  [[gnu::always_inline]] static void write(uint32_t value) { *reinterpret_cast<volatile uint32_t*>(address) = value; }
  // Peripheral registers have aliases that set or clear the bits written (2.1.2).
  [[gnu::always_inline]] static void set(uint32_t bits) {
    *reinterpret_cast<volatile uint32_t*>(address + 0x2000) = bits;
  }
  [[gnu::always_inline]] static void clear(uint32_t bits) {
    *reinterpret_cast<volatile uint32_t*>(address + 0x3000) = bits;
  }
};

// 2.14 Subsystem resets
using Resets = Register<0x4000c000>;
using ResetsDone = Register<0x4000c008>;
inline constexpr uint32_t reset_dma = 1U << 2;
inline constexpr uint32_t reset_io_bank0 = 1U << 5;
inline constexpr uint32_t reset_pads_bank0 = 1U << 8;
inline constexpr uint32_t reset_pio0 = 1U << 10;
inline constexpr uint32_t reset_pll_sys = 1U << 12;
inline constexpr uint32_t reset_pll_usb = 1U << 13;
inline constexpr uint32_t reset_pwm = 1U << 14;
inline constexpr uint32_t reset_timer = 1U << 21;
inline constexpr uint32_t reset_uart0 = 1U << 22;
inline constexpr uint32_t reset_usbctrl = 1U << 24;

// 2.15 Clocks, 2.16 crystal oscillator, 2.18 PLL
using ClkRefCtrl = Register<0x40008030>;
using ClkRefSelected = Register<0x40008038>;
using ClkSysCtrl = Register<0x4000803c>;
using ClkSysSelected = Register<0x40008044>;
using ClkPeriCtrl = Register<0x40008048>;
using ClkUsbCtrl = Register<0x40008054>;
using XoscCtrl = Register<0x40024000>;
using XoscStatus = Register<0x40024004>;
using XoscStartup = Register<0x4002400c>;
template <uint32_t base>
struct Pll {
  using Cs = Register<base>;
  using Pwr = Register<base + 4>;
  using Fbdiv = Register<base + 8>;
  using Prim = Register<base + 12>;
};
using PllSys = Pll<0x40028000>;
using PllUsb = Pll<0x4002c000>;

// 2.13 Power-on state machine, 2.12 chip-level reset, 4.7 watchdog, 4.6 timer
using PsmWdsel = Register<0x40010008>;
using ChipReset = Register<0x40064008>;
using WatchdogCtrl = Register<0x40058000>;
using WatchdogLoad = Register<0x40058004>;
using WatchdogReason = Register<0x40058008>;
using WatchdogTick = Register<0x4005802c>;
using TimerLow = Register<0x40054028>;

// 2.19 GPIO: a function for each pin, the pad's pull-ups, edge interrupts (four bits per pin), 2.3.1.7 SIO
inline volatile uint32_t& gpio_ctrl(uint32_t gpio) {
  return *reinterpret_cast<volatile uint32_t*>(0x40014004 + 8 * gpio);
}
inline volatile uint32_t& gpio_pad(uint32_t gpio) {
  return *reinterpret_cast<volatile uint32_t*>(0x4001c004 + 4 * gpio);
}
inline volatile uint32_t& gpio_edges(uint32_t gpio) {
  return *reinterpret_cast<volatile uint32_t*>(0x400140f0 + 4 * (gpio / 8));
}
inline volatile uint32_t& gpio_interrupts(uint32_t gpio) {
  return *reinterpret_cast<volatile uint32_t*>(0x40014100 + 4 * (gpio / 8));
}
inline constexpr uint32_t edge_low = 4;
inline constexpr uint32_t edge_high = 8;
constexpr uint32_t edge_bits(uint32_t gpio, uint32_t edges) {
  return edges << 4 * (gpio % 8);
}
enum GpioFunction : uint32_t { function_uart = 2, function_pwm = 4, function_sio = 5, function_pio0 = 6 };
// In a pin's control register: the pad outputs the inverse of the peripheral's signal (OUTOVER).
inline constexpr uint32_t output_inverted = 1U << 8;
inline constexpr uint32_t pad_pull_up = 1U << 3;
inline constexpr uint32_t pad_input = 1U << 6;
inline constexpr uint32_t pad_schmitt = 1U << 1;
inline constexpr uint32_t pad_4_ma = 1U << 4;
using GpioIn = Register<0xd0000004>;
using GpioOut = Register<0xd0000010>;
using GpioOutSet = Register<0xd0000014>;
using GpioOutClear = Register<0xd0000018>;
using GpioEnableSet = Register<0xd0000024>;

// 3.7 PIO, block 0, state machine 0
using PioCtrl = Register<0x50200000>;
using PioFlevel = Register<0x5020000c>;
using PioTxf0 = Register<0x50200010>;
using PioClkdiv = Register<0x502000c8>;
using PioExecctrl = Register<0x502000cc>;
using PioShiftctrl = Register<0x502000d0>;
using PioAddr = Register<0x502000d4>;
using PioInstr = Register<0x502000d8>;
using PioPinctrl = Register<0x502000dc>;
inline volatile uint32_t& pio_program(uint32_t place) {
  return *reinterpret_cast<volatile uint32_t*>(0x50200048 + 4 * place);
}

// 2.5 DMA, channel 0
using DmaReadAddr = Register<0x50000000>;
using DmaWriteAddr = Register<0x50000004>;
using DmaCtrl = Register<0x50000010>;            // does not start the channel
using DmaTransCountTrig = Register<0x5000001c>;  // starts it
using DmaInte0 = Register<0x50000404>;
using DmaInts0 = Register<0x5000040c>;
using DmaAbort = Register<0x50000444>;

// 4.2 UART
using UartData = Register<0x40034000>;
using UartFlags = Register<0x40034018>;
using UartIbrd = Register<0x40034024>;
using UartFbrd = Register<0x40034028>;
using UartLcr = Register<0x4003402c>;
using UartCr = Register<0x40034030>;
using UartImsc = Register<0x40034038>;
inline constexpr uint32_t uart_received = 1U << 4 | 1U << 6;  // enough bytes, or a receive timeout
inline constexpr uint32_t uart_nothing_received = 1U << 4;
inline constexpr uint32_t uart_full = 1U << 5;

// 4.5 PWM: five registers per slice
inline volatile uint32_t& pwm(uint32_t slice, uint32_t which) {
  return *reinterpret_cast<volatile uint32_t*>(0x40050000 + 0x14 * slice + 4 * which);
}
enum PwmRegister : uint32_t { pwm_csr, pwm_div, pwm_ctr, pwm_cc, pwm_top };

// 4.1 USB device: its registers, and four kilobytes of memory that it shares with the processor. They hold the last
// setup packet, two words for each endpoint's directions, and the buffers (4.1.3.1).
using UsbAddress = Register<0x50110000>;
using UsbMain = Register<0x50110040>;
using UsbSieControl = Register<0x5011004c>;
using UsbSieStatus = Register<0x50110050>;
using UsbBuffers = Register<0x50110058>;  // one bit per endpoint and direction: the processor owns the buffer again
using UsbStallArm = Register<0x50110068>;
using UsbMuxing = Register<0x50110074>;
using UsbPower = Register<0x50110078>;
using UsbInterrupts = Register<0x50110090>;
inline constexpr uint32_t usb_interrupt_per_buffer = 1U << 29;
inline constexpr uint32_t usb_pull_up = 1U << 16;
inline constexpr uint32_t usb_setup_received = 1U << 17;
inline constexpr uint32_t usb_bus_reset = 1U << 19;
inline constexpr uint32_t usb_memory = 0x50100000;
inline constexpr uint32_t usb_memory_size = 4096;
inline volatile uint32_t& usb_word(uint32_t offset) {
  return *reinterpret_cast<volatile uint32_t*>(usb_memory + offset);
}
inline volatile uint8_t& usb_byte(uint32_t offset) {
  return *reinterpret_cast<volatile uint8_t*>(usb_memory + offset);
}

// ARMv6-M: interrupts
using NvicEnable = Register<0xe000e100>;
using NvicDisable = Register<0xe000e180>;
inline constexpr uint32_t irq_usb = 5;
inline constexpr uint32_t irq_dma0 = 11;
inline constexpr uint32_t irq_io_bank0 = 13;
inline constexpr uint32_t irq_uart0 = 20;
using SysTickControl = Register<0xe000e010>;
using SysTickReload = Register<0xe000e014>;
using SysTickCount = Register<0xe000e018>;

[[gnu::always_inline]] inline void interrupts_off() {
  asm volatile("cpsid i" ::: "memory");
}
[[gnu::always_inline]] inline void interrupts_on() {
  asm volatile("cpsie i" ::: "memory");
}

}  // namespace passo::chip
