#include "passo/emulator/emulated_timer.hpp"

#include <array>
#include <stdexcept>

#include <simavr/sim_avr.h>
#include <simavr/sim_cycle_timers.h>
#include <simavr/sim_interrupts.h>
#include <simavr/sim_io.h>

#include "passo/emulator/emulated_chip.hpp"

namespace passo {
namespace {

constexpr std::uint16_t tccr0a = 0x44;
constexpr std::uint16_t tccr0b = 0x45;
constexpr std::uint16_t tcnt0 = 0x46;
constexpr std::uint16_t ocr0a = 0x47;
constexpr std::uint16_t tccr1b = 0x81;
constexpr std::uint16_t tcnt1l = 0x84;
constexpr std::uint16_t tcnt1h = 0x85;
constexpr std::uint16_t ocr1al = 0x88;
constexpr std::uint16_t ocr1ah = 0x89;
constexpr std::uint8_t overflow = 1 << 0;
constexpr std::uint8_t compare_match_a = 1 << 1;

avr_int_vector_t* match_of(avr_t& avr, std::uint16_t flags) {
  for (int i = 0; i < avr.interrupts.vector_count; ++i) {
    avr_int_vector_t* const vector = avr.interrupts.vector[i];
    if (vector->raised.reg == flags && vector->raised.bit == 1) return vector;
  }
  throw std::runtime_error("simavr does not support compare match of this timer");
}

// The handlers are replaced, not extended: simavr's own timers never learn that they run.
void on_write(avr_t& avr, std::uint16_t address, void* self, avr_io_write_t write) {
  avr.io[AVR_DATA_TO_IO(address)].w = {.param = self, .c = write};
}
void on_read(avr_t& avr, std::uint16_t address, void* self, avr_io_read_t read) {
  avr.io[AVR_DATA_TO_IO(address)].r = {.param = self, .c = read};
}

}  // namespace

EmulatedTimer::EmulatedTimer(EmulatedChip& chip) : avr_(chip.avr()) {
  byte_.match = match_of(avr_, byte_.flags);
  word_.match = match_of(avr_, word_.flags);
  replace_timer_0();
  replace_timer_1();
}

void EmulatedTimer::replace_timer_0() {
  on_write(avr_, tccr0a, &byte_, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* counter) {
    auto& timer = *static_cast<Counter*>(counter);
    avr->data[tccr0a] = value;
    timer.clears_on_match = (value & 3) == 2;
    timer.set_alarm(*avr);
  });
  on_write(avr_, tccr0b, &byte_, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* counter) {
    avr->data[tccr0b] = value;
    static_cast<Counter*>(counter)->start(*avr, value);
  });
  on_write(avr_, tcnt0, &byte_, [](avr_t*, avr_io_addr_t, std::uint8_t, void*) {});
  on_read(avr_, tcnt0, &byte_, [](avr_t* avr, avr_io_addr_t, void* counter) {
    return static_cast<std::uint8_t>(static_cast<const Counter*>(counter)->count(*avr));
  });
  on_write(avr_, ocr0a, &byte_, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* counter) {
    auto& timer = *static_cast<Counter*>(counter);
    avr->data[ocr0a] = value;
    timer.compare = value;
    timer.set_alarm(*avr);
  });
  on_write(avr_, byte_.flags, &byte_, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* counter) {
    static_cast<const Counter*>(counter)->clear(*avr, value);
  });
  on_write(avr_, byte_.mask, &byte_, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* counter) {
    static_cast<const Counter*>(counter)->enable(*avr, value);
  });
}

void EmulatedTimer::replace_timer_1() {
  on_write(avr_, tccr1b, this, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* self) {
    avr->data[tccr1b] = value;
    static_cast<EmulatedTimer*>(self)->word_.start(*avr, value);
  });
  for (const std::uint16_t half : {tcnt1l, tcnt1h}) {
    on_write(avr_, half, this, [](avr_t*, avr_io_addr_t, std::uint8_t, void*) {});
  }
  on_read(avr_, tcnt1l, this, [](avr_t* avr, avr_io_addr_t, void* self) {
    auto& timer = *static_cast<EmulatedTimer*>(self);
    const std::uint64_t now = timer.word_.count(*avr);
    timer.temp_ = static_cast<std::uint8_t>(now >> 8);
    return static_cast<std::uint8_t>(now);
  });
  on_read(avr_, tcnt1h, this,
          [](avr_t*, avr_io_addr_t, void* self) { return static_cast<EmulatedTimer*>(self)->temp_; });
  on_write(avr_, ocr1ah, this, [](avr_t*, avr_io_addr_t, std::uint8_t value, void* self) {
    static_cast<EmulatedTimer*>(self)->temp_ = value;
  });
  on_write(avr_, ocr1al, this, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* self) {
    auto& timer = *static_cast<EmulatedTimer*>(self);
    avr->data[ocr1al] = value;
    avr->data[ocr1ah] = timer.temp_;
    timer.word_.compare = static_cast<std::uint16_t>(timer.temp_ << 8 | value);
    timer.word_.set_alarm(*avr);
  });
  on_write(avr_, word_.flags, this, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* self) {
    auto& timer = *static_cast<EmulatedTimer*>(self);
    timer.word_.clear(*avr, value);
    if ((value & overflow) != 0) timer.overflows_cleared_ = timer.overflows();
  });
  on_read(avr_, word_.flags, this, [](avr_t* avr, avr_io_addr_t, void* self) {
    const auto& timer = *static_cast<EmulatedTimer*>(self);
    return static_cast<std::uint8_t>((avr->data[timer.word_.flags] & compare_match_a) |
                                     (timer.overflows() > timer.overflows_cleared_ ? overflow : 0));
  });
  on_write(avr_, word_.mask, this, [](avr_t* avr, avr_io_addr_t, std::uint8_t value, void* self) {
    static_cast<const EmulatedTimer*>(self)->word_.enable(*avr, value);
  });
}

std::uint64_t EmulatedTimer::Counter::count(const avr_t& avr) const {
  return prescale > 0 ? (avr.cycle - started) / prescale % length() : 0;
}

void EmulatedTimer::Counter::start(avr_t& avr, std::uint8_t control) {
  constexpr std::array<std::uint64_t, 8> prescales = {0, 1, 8, 64, 256, 1024, 0, 0};
  prescale = prescales[control & 7];
  started = avr.cycle;
  set_alarm(avr);
}

void EmulatedTimer::Counter::set_alarm(avr_t& avr) {
  avr_cycle_timer_cancel(&avr, on_match, this);
  if (prescale == 0) return;
  const std::uint64_t ahead = (compare + length() - count(avr)) % length();
  const std::uint64_t since_count = (avr.cycle - started) % prescale;
  avr_cycle_timer_register(&avr, (ahead == 0 ? length() : ahead) * prescale - since_count, on_match, this);
}

void EmulatedTimer::Counter::clear(avr_t& avr, std::uint8_t flags_written) const {
  if ((flags_written & compare_match_a) != 0) avr_clear_interrupt(&avr, match);
}

void EmulatedTimer::Counter::enable(avr_t& avr, std::uint8_t mask_written) const {
  avr.data[mask] = mask_written;
  if ((mask_written & compare_match_a) != 0 && (avr.data[flags] & compare_match_a) != 0 && match->pending == 0) {
    avr_raise_interrupt(&avr, match);
  }
}

std::uint64_t EmulatedTimer::overflows() const {
  return word_.prescale > 0 ? (avr_.cycle - word_.started) / word_.prescale / word_.turn : 0;
}

std::uint64_t EmulatedTimer::on_match(avr_t* avr, std::uint64_t when, void* counter) {
  const auto& timer = *static_cast<const Counter*>(counter);
  if (timer.match->pending == 0) avr_raise_interrupt(avr, timer.match);
  return when + timer.length() * timer.prescale;
}

}  // namespace passo
