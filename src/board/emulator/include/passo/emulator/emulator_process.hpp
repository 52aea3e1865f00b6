// EmulatorProcess: a chip with its firmware, emulated by a program of its own. The two run in lock-step: the emulator
// does nothing but what run() asks for, so the same calls give the same figures everywhere.
//
// Every emulator speaks the same protocol, which src/board/emulator/pico/emulated_pico.js describes: requests and
// answers on its standard input and output. So an emulator may have a licence that Passo's own program may not be bound
// by. The protocol knows 32 pins. Which of the chip's pins these are is agreed on when the emulator is started.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <sys/types.h>

namespace passo {

// The levels of all outputs from a cycle on, a bit for each pin.
struct PinChange {
  std::uint64_t cycle = 0;
  std::uint32_t levels = 0;
};

// What the spindle's output asks for while it is high all the time.
inline constexpr double full_rpm = 24'000;

class EmulatorProcess {
 public:
  // Starts the program with its arguments. `died`: the sentence to say if the program ends by itself.
  EmulatorProcess(const std::vector<std::string>& words, std::string died);
  EmulatorProcess(const EmulatorProcess&) = delete;
  ~EmulatorProcess();

  // When to stop before the time is over.
  struct Stops {
    bool at_byte = false;       // when the board has said one
    std::uint32_t watched = 0;  // bits of pins
    std::uint32_t rises = 0;    // after so many moments in which some of these rose (AVR: or fell); 0: never
  };
  // What the encoder at the spindle does in the next run(): it turns evenly to so many pulses in all, of so many a
  // turn.
  struct EncoderWay {
    double from = 0;
    double to = 0;
    std::uint32_t pulses_per_turn = 0;  // 0: there is none, or the emulator works out the spindle by itself
  };
  void set_encoder(const EncoderWay& way) { encoder_ = way; }
  // Runs until `cycle`. False if the emulator has died; then error() tells it. run(1, {}) shows whether it has started.
  bool run(std::uint64_t cycle, const Stops& stops);
  // Puts bytes on the board's other line at once (Pico: the UART, though its line is USB).
  bool send_by_other_line(std::span<const std::uint8_t> bytes);
  const std::string& error() const { return error_; }

  // Puts bytes on the line; they arrive one after the other while it runs.
  void send(std::span<const std::uint8_t> bytes);
  // Connects these pins to ground, and no others.
  void draw_low(std::uint32_t inputs) { drawn_low_ = inputs; }

  std::uint64_t cycle() const { return cycle_; }
  std::uint32_t levels() const { return levels_; }
  std::uint64_t lost_bytes() const { return lost_bytes_; }
  // How long the spindle's output is high, as a part of its period.
  double duty() const { return duty_; }
  // What came out in the last run().
  const std::vector<PinChange>& changes() const { return changes_; }
  const std::vector<std::uint8_t>& said() const { return said_; }

 private:
  bool request(std::uint64_t cycle, const Stops& stops, std::uint8_t flags, std::span<const std::uint8_t> bytes);
  bool read_answer();

  pid_t process_ = -1;
  int to_ = -1;
  int from_ = -1;
  std::string died_;
  std::string error_;
  std::uint64_t cycle_ = 0;
  std::uint32_t levels_ = 0;
  std::uint32_t drawn_low_ = 0;
  EncoderWay encoder_;
  std::uint64_t lost_bytes_ = 0;
  double duty_ = 0;
  std::vector<std::uint8_t> to_send_;
  std::vector<PinChange> changes_;
  std::vector<std::uint8_t> said_;
};

}  // namespace passo
