#include "passo/emulator/emulated_encoder.hpp"

#include <cmath>
#include <utility>

#include <simavr/sim_avr.h>
#include <simavr/sim_io.h>

#include "passo/emulator/emulated_chip.hpp"

namespace passo {
namespace {

constexpr std::uint16_t tifr4 = 0x39;
constexpr std::uint16_t tccr5b = 0x121;
constexpr std::uint16_t tcnt5l = 0x124;
constexpr std::uint16_t tcnt5h = 0x125;
constexpr std::uint8_t captured = 1 << 5;
constexpr std::uint8_t rising_edges_of_t5 = 7;

}  // namespace

EmulatedEncoder::EmulatedEncoder(EmulatedChip& chip, int pulses_per_turn, Turns turns)
    : chip_(chip), pulses_per_turn_(pulses_per_turn), turns_(std::move(turns)) {
  avr_t& avr = chip.avr();
  set_clock(avr.data[tccr5b]);  // the program may already run
  // The handlers are replaced, not extended: simavr's own timers never learn of these writes.
  const auto on_write = [&](std::uint16_t address, avr_io_write_t write) {
    avr.io[AVR_DATA_TO_IO(address)].w = {.param = this, .c = write};
  };
  const auto on_read = [&](std::uint16_t address, avr_io_read_t read) {
    avr.io[AVR_DATA_TO_IO(address)].r = {.param = this, .c = read};
  };
  on_write(tccr5b, [](avr_t* chips, avr_io_addr_t address, std::uint8_t value, void* self) {
    chips->data[address] = value;
    static_cast<EmulatedEncoder*>(self)->set_clock(value);
  });
  on_read(tcnt5l, [](avr_t*, avr_io_addr_t, void* self) {
    auto& encoder = *static_cast<EmulatedEncoder*>(self);
    const std::uint16_t now = encoder.count();
    encoder.temp_ = static_cast<std::uint8_t>(now >> 8);
    return static_cast<std::uint8_t>(now);
  });
  on_read(tcnt5h, [](avr_t*, avr_io_addr_t, void* self) { return static_cast<EmulatedEncoder*>(self)->temp_; });
  on_read(tifr4, [](avr_t*, avr_io_addr_t, void* self) {
    const auto& encoder = *static_cast<EmulatedEncoder*>(self);
    return encoder.indexes() > encoder.seen_indexes_ ? captured : std::uint8_t{0};
  });
  on_write(tifr4, [](avr_t*, avr_io_addr_t, std::uint8_t value, void* self) {
    auto& encoder = *static_cast<EmulatedEncoder*>(self);
    if ((value & captured) != 0) encoder.seen_indexes_ = encoder.indexes();
  });
}

void EmulatedEncoder::set_clock(std::uint8_t control) {
  counts_ = (control & 7) == rising_edges_of_t5;
  counted_from_ = pulses_at(chip_.cycles());
}

std::uint64_t EmulatedEncoder::pulses_at(std::uint64_t cycle) const {
  return static_cast<std::uint64_t>(std::floor(turns_(cycle) * pulses_per_turn_));
}

std::uint16_t EmulatedEncoder::count() const {
  return counts_ ? static_cast<std::uint16_t>(pulses_at(chip_.cycles()) - counted_from_) : std::uint16_t{0};
}

std::uint64_t EmulatedEncoder::indexes() const {
  return static_cast<std::uint64_t>(std::floor(turns_(chip_.cycles())));
}

}  // namespace passo
