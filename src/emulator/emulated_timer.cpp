#include "passo/emulator/emulated_timer.hpp"

#include <stdexcept>

#include <simavr/sim_avr.h>
#include <simavr/sim_cycle_timers.h>
#include <simavr/sim_interrupts.h>
#include <simavr/sim_io.h>

#include "passo/emulator/emulated_chip.hpp"

namespace passo {
namespace {

constexpr std::uint16_t tifr1 = 0x36;
constexpr std::uint16_t timsk1 = 0x6f;
constexpr std::uint16_t tccr1b = 0x81;
constexpr std::uint16_t tcnt1l = 0x84;
constexpr std::uint16_t tcnt1h = 0x85;
constexpr std::uint16_t ocr1al = 0x88;
constexpr std::uint16_t ocr1ah = 0x89;
constexpr std::uint8_t overflow = 1 << 0;
constexpr std::uint8_t compare_match_a = 1 << 1;

}  // namespace

EmulatedTimer::EmulatedTimer(EmulatedChip& chip) : avr_(chip.avr()) {
  for (int i = 0; i < avr_.interrupts.vector_count; ++i) {
    avr_int_vector_t* const vector = avr_.interrupts.vector[i];
    if (vector->raised.reg == tifr1 && vector->raised.bit == 1) match_ = vector;
  }
  if (match_ == nullptr) throw std::runtime_error("simavr knows no compare match of timer 1");
  // The handlers are replaced, not extended: simavr's own timer never learns that it runs.
  const auto on_write = [this](std::uint16_t address, avr_io_write_t write) {
    avr_.io[AVR_DATA_TO_IO(address)].w = {.param = this, .c = write};
  };
  const auto on_read = [this](std::uint16_t address, avr_io_read_t read) {
    avr_.io[AVR_DATA_TO_IO(address)].r = {.param = this, .c = read};
  };
  on_write(tccr1b, [](avr_t* avr, avr_io_addr_t address, std::uint8_t value, void* self) {
    auto& timer = *static_cast<EmulatedTimer*>(self);
    avr->data[address] = value;
    timer.runs_ = (value & 7) == 1;
    timer.started_ = avr->cycle;
    timer.set_alarm();
  });
  on_read(tcnt1l, [](avr_t* avr, avr_io_addr_t, void* self) {
    (void)avr;
    auto& timer = *static_cast<EmulatedTimer*>(self);
    const std::uint16_t now = timer.count();
    timer.temp_ = static_cast<std::uint8_t>(now >> 8);
    return static_cast<std::uint8_t>(now);
  });
  on_read(tcnt1h, [](avr_t*, avr_io_addr_t, void* self) { return static_cast<EmulatedTimer*>(self)->temp_; });
  on_write(ocr1ah, [](avr_t*, avr_io_addr_t, std::uint8_t value, void* self) {
    static_cast<EmulatedTimer*>(self)->temp_ = value;
  });
  on_write(ocr1al, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* self) {
    auto& timer = *static_cast<EmulatedTimer*>(self);
    avr->data[ocr1al] = value;
    avr->data[ocr1ah] = timer.temp_;
    timer.compare_ = static_cast<std::uint16_t>(timer.temp_ << 8 | value);
    timer.set_alarm();
  });
  on_write(tifr1, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* self) {
    auto& timer = *static_cast<EmulatedTimer*>(self);
    if ((value & compare_match_a) != 0) avr_clear_interrupt(avr, timer.match_);
    if ((value & overflow) != 0) timer.overflows_cleared_ = timer.overflows();
  });
  on_read(tifr1, [](avr_t* avr, avr_io_addr_t, void* self) {
    const auto& timer = *static_cast<EmulatedTimer*>(self);
    return static_cast<std::uint8_t>((avr->data[tifr1] & compare_match_a) |
                                     (timer.overflows() > timer.overflows_cleared_ ? overflow : 0));
  });
  on_write(timsk1, [](avr_t* avr, avr_io_addr_t address, std::uint8_t value, void* self) {
    auto& timer = *static_cast<EmulatedTimer*>(self);
    avr->data[address] = value;
    if ((value & compare_match_a) != 0 && (avr->data[tifr1] & compare_match_a) != 0 && timer.match_->pending == 0) {
      avr_raise_interrupt(avr, timer.match_);
    }
  });
}

std::uint16_t EmulatedTimer::count() const {
  return runs_ ? static_cast<std::uint16_t>(avr_.cycle - started_) : std::uint16_t{0};
}

std::uint64_t EmulatedTimer::overflows() const {
  return runs_ ? (avr_.cycle - started_) / 65536 : 0;
}

void EmulatedTimer::set_alarm() {
  avr_cycle_timer_cancel(&avr_, on_match, this);
  if (!runs_) return;
  const auto ahead = static_cast<std::uint16_t>(compare_ - count());
  avr_cycle_timer_register(&avr_, ahead == 0 ? 65536 : ahead, on_match, this);
}

std::uint64_t EmulatedTimer::on_match(avr_t* avr, std::uint64_t when, void* self) {
  auto& timer = *static_cast<EmulatedTimer*>(self);
  if (timer.match_->pending == 0) avr_raise_interrupt(avr, timer.match_);
  return when + 65536;
}

}  // namespace passo
