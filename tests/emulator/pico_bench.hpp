// PicoBench: sends board segments over the serial line to the real firmware on the emulated Pico, and compares every
// edge of its step pins with the host's Player. What BoardBench is for the AVRs.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "emulator/streamed_run.hpp"

#include "passo/chip/pico_pins.hpp"
#include "passo/emulator/emulated_pico.hpp"
#include "passo/wire/decoder.hpp"
#include "passo/wire/message.hpp"

namespace passo {

inline constexpr std::uint64_t pico_cycles_of_tick = 8;
inline constexpr std::uint64_t pico_clock_rate = 128'000'000;

class PicoBench {
 public:
  // Why there is no emulator, if there is none; empty: there is.
  static std::string missing(const std::string& program);

  PicoBench(const std::string& program, std::uint8_t motors, const PicoPins& pins = pico_bare,
            PicoSocket socket = PicoSocket::uart);

  using Item = std::variant<BoardSegment, BoardOutputs>;
  // Plays the items from rest to rest. Times in the result are in cycles.
  EdgeCheck play(const std::vector<BoardSegment>& segments);
  // Says hello and sends the items, which begin when all have come: one less than the board takes at once.
  void start(const std::vector<Item>& items, std::uint8_t limit = 0);
  // Lets time pass, whatever the board says, or until so many edges of the pins in `watched` have come.
  void run(std::uint64_t cycles, std::uint32_t watched = 0, std::uint32_t rises = 0);
  void ask(const Ask& question = {});
  // If set, called at the cycle that its last call returned, at first soon: something happens at the pins.
  std::function<std::uint64_t(std::uint64_t cycle)> at_cycle;
  // Says what is connected to the board's pins, now and before each hello, and connects it: all switches are off. From
  // now on press(), levels(), duty() and changes() mean what is on, and usual levels.
  void set_up(const PinSetup& setup);
  // The switches at these pins are on, all others are off.
  void press(std::uint32_t gpios) { pico_->draw_low(gpios ^ on_when_high_); }
  std::uint32_t levels() const { return pico_->levels() ^ inverted_; }
  double duty() const { return (setup_.outputs & spindle_on) != 0 ? 1 - pico_->duty() : pico_->duty(); }
  // What comes after it is no run of its own: the changes are those from here on.
  void forget_changes() { changes_.clear(); }
  void send(std::span<const std::uint8_t> bytes) { pico_->send(bytes); }

  // Each motor's steps in the changes, in cycles.
  std::vector<SeenSteps> seen(EdgeCheck& result) const;
  const std::vector<PicoChange>& changes() const { return changes_; }
  EmulatedPico& pico() { return *pico_; }
  std::uint8_t capacity() const { return capacity_; }
  const std::optional<BoardStatus>& status() const { return status_; }
  const std::optional<ErrorReport>& error() const { return error_; }
  const std::optional<Fault>& fault() const { return fault_; }
  const std::optional<Captured>& captured() const { return captured_; }
  void forget_captured() { captured_.reset(); }
  const std::optional<Turned>& turned() const { return turned_; }
  // What the board has made of set_up().
  const std::optional<PinSetup>& made() const { return made_; }

 private:
  void hear(std::uint8_t byte);
  bool send_hello();
  void send_setup();
  void send_replace(std::span<const Item> items);
  void send_item(const Item& item);
  EdgeCheck check(const std::vector<BoardSegment>& segments) const;

  std::uint8_t motors_;
  const PicoPins& pins_;
  std::unique_ptr<EmulatedPico> pico_;
  PinSetup setup_;
  std::uint32_t on_when_high_ = 0;  // inputs
  std::uint32_t inverted_ = 0;      // outputs
  std::uint32_t levels_before_ = 0;
  std::vector<PicoChange> changes_;
  Decoder decoder_;
  bool greeted_ = false;
  std::uint8_t capacity_ = 0;
  std::uint8_t last_sent_ = 0;
  std::uint8_t last_executed_ = 0;
  std::uint64_t complaints_ = 0;
  std::optional<Fault> fault_;
  std::optional<Captured> captured_;
  std::optional<BoardStatus> status_;
  std::optional<Turned> turned_;
  std::optional<ErrorReport> error_;
  std::optional<PinSetup> made_;
  std::uint64_t next_call_ = 0;  // of at_cycle
};

}  // namespace passo
