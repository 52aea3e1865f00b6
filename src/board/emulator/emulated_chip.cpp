#include "passo/emulator/emulated_chip.hpp"

#include <algorithm>
#include <cstdarg>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <simavr/avr_extint.h>
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_hex.h>
#include <simavr/sim_interrupts.h>

namespace passo {
namespace {

// Real memory is not empty when the power comes on.
constexpr std::uint8_t never_written = 0xC7;

// simavr logs every section that it loads. Its results tell of errors too, so the log is not needed.
void keep_silent(avr_t* /*avr*/, int /*level*/, const char* /*format*/, std::va_list /*values*/) {}

// An ELF file, or what is flashed: a file whose name ends in .hex. Throws if it is neither.
elf_firmware_t firmware_in(const std::string& program) {
  elf_firmware_t firmware = {};
  bool good = false;
  if (program.ends_with(".hex")) {
    firmware.flash = read_ihex_file(program.c_str(), &firmware.flashsize, &firmware.flashbase);
    good = firmware.flash != nullptr;
  } else {
    good = elf_read_firmware(program.c_str(), &firmware) == 0;
  }
  if (!good || firmware.flashsize == 0) throw std::runtime_error("not an AVR program: " + program);
  return firmware;
}

}  // namespace

void EmulatedChip::Deleter::operator()(avr_t* avr) const {
  avr_terminate(avr);
  std::free(avr);
}

EmulatedChip::EmulatedChip(const std::string& program, const std::string& mcu) {
  avr_global_logger_set(keep_silent);
  elf_firmware_t firmware = firmware_in(program);
  avr_.reset(avr_make_mcu_by_name(mcu.c_str()));
  if (avr_ == nullptr) throw std::runtime_error("simavr does not support " + mcu);
  avr_init(avr_.get());
  firmware.frequency = 16'000'000;
  avr_load_firmware(avr_.get(), &firmware);
  std::free(firmware.flash);
  std::fill(avr_->data + avr_->ioend + 1, avr_->data + avr_->ramend + 1, never_written);

  // The default is 1: one instruction a call, which is six times slower.
  avr_->run_cycle_limit = 1000;
  // The emulation skips sleep instead of waiting.
  avr_->sleep = [](avr_t*, avr_cycle_count_t) {};
  // Otherwise simavr would check INT0 and INT1 for a low level at every cycle, whether interrupts are enabled or not.
  for (std::uint8_t pin = 0; pin < 8; ++pin) avr_extint_set_strict_lvl_trig(avr_.get(), pin, 0);
  if (avr_->address_size == 3) entry_cycles_ = 5;
  mend_interrupts();
}

void EmulatedChip::mend_interrupts() {
  for (std::uint8_t vector = 1; vector < 64; ++vector) {
    avr_irq_t* const irq = avr_get_interrupt_irq(avr_.get(), vector);
    if (irq == nullptr) continue;
    avr_irq_register_notify(
        irq + AVR_INT_IRQ_RUNNING,
        [](avr_irq_t*, std::uint32_t entered, void* chip) {
          auto* const self = static_cast<EmulatedChip*>(chip);
          if (entered != 0) self->avr_->cycle += self->entry_cycles_;
        },
        this);
  }
}

std::size_t EmulatedChip::longest_untouched() const {
  std::size_t longest = 0;
  std::size_t here = 0;
  for (const std::uint8_t* at = avr_->data + avr_->ioend + 1; at <= avr_->data + avr_->ramend; ++at) {
    here = *at == never_written ? here + 1 : 0;
    longest = std::max(longest, here);
  }
  return longest;
}

void EmulatedChip::step() {
  const int state = avr_run(avr_.get());
  if (avr_->interrupt_state == -1) {
    avr_->interrupt_state = avr_has_pending_interrupts(avr_.get()) != 0 ? std::int8_t{1} : std::int8_t{0};
  }
  if (state == cpu_Done || state == cpu_Crashed)
    throw std::runtime_error("the emulated program crashed at " + std::to_string(avr_->pc) + " cycle " +
                             std::to_string(avr_->cycle));
}

void EmulatedChip::stop() {
  stopped_ = true;
  avr_->run_cycle_count = 0;
}

void EmulatedChip::run_for(std::uint64_t cycles) {
  const std::uint64_t end = avr_->cycle + cycles;
  // simavr runs on until something is due, so something is made due here.
  avr_cycle_timer_register(
      avr_.get(), cycles, [](avr_t*, avr_cycle_count_t, void*) { return avr_cycle_count_t{0}; }, this);
  stopped_ = false;
  while (!stopped_ && avr_->cycle < end) step();
}

void EmulatedChip::on_write(std::uint16_t address, std::function<void(std::uint8_t)> watcher) {
  watchers_.push_back(std::move(watcher));
  avr_register_io_write(
      avr_.get(), address,
      [](avr_t* avr, avr_io_addr_t where, std::uint8_t value, void* watch) {
        avr->data[where] = value;
        (*static_cast<std::function<void(std::uint8_t)>*>(watch))(value);
      },
      &watchers_.back());
}

void EmulatedChip::on_read(std::uint16_t address, std::function<std::uint8_t()> source) {
  sources_.push_back(std::move(source));
  avr_register_io_read(
      avr_.get(), address,
      [](avr_t* avr, avr_io_addr_t where, void* feed) {
        return avr->data[where] = (*static_cast<std::function<std::uint8_t()>*>(feed))();
      },
      &sources_.back());
}

void EmulatedChip::run(std::uint64_t most_cycles) {
  const std::uint64_t end = avr_->cycle + most_cycles;
  stopped_ = false;
  while (!stopped_) {
    step();
    if (avr_->cycle > end) throw std::runtime_error("the emulated program does not end");
  }
}

std::uint64_t EmulatedChip::cycles() const {
  return avr_->cycle;
}

}  // namespace passo
