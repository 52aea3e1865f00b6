// EmulatorProcess: a chip with its firmware, emulated in a separate process. The two run in lock-step: the emulator
// does only what run() requests, so the same calls give the same results on every computer.
//
// All emulators use the same protocol, described in src/board/emulator/pico/emulated_pico.js: requests and answers on
// standard input and output. So an emulator may have a licence that Passo's own program must not be subject to. The
// protocol has 32 pins. Their mapping to the chip's pins is set when the emulator is started.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "passo/emulator/child_process.hpp"

namespace passo {

// The levels of all outputs from a cycle on, one bit per pin.
struct PinChange {
  std::uint64_t cycle = 0;
  std::uint32_t levels = 0;
};

// The spindle speed for a duty of 100 %.
inline constexpr double full_rpm = 24'000;

class EmulatorProcess {
 public:
  // Starts the program with its arguments. `died`: the error message if the program ends unexpectedly.
  EmulatorProcess(const std::vector<std::string>& words, std::string died);
  EmulatorProcess(const EmulatorProcess&) = delete;

  // Conditions that end a run before its time.
  struct Stops {
    bool at_byte = false;       // when the board has sent a byte
    std::uint32_t watched = 0;  // bits of pins
    std::uint32_t rises = 0;    // after this number of cycles in which at least one of these pins rose (AVR: rose or
                                // fell); 0: never
  };
  // The spindle encoder's motion in the next run(): it turns evenly up to this total number of pulses, with this number
  // of pulses per revolution.
  struct EncoderWay {
    double from = 0;
    double to = 0;
    std::uint32_t pulses_per_turn = 0;  // 0: there is no encoder, or the emulator computes the spindle itself
  };
  void set_encoder(const EncoderWay& way) { encoder_ = way; }
  // Runs until `cycle`. Returns false if the emulator has ended; error() then gives the reason. run(1, {}) checks
  // whether the emulator has started.
  bool run(std::uint64_t cycle, const Stops& stops);
  // Delivers bytes on the board's other port at once (Pico: the UART, if the host is connected by USB).
  bool send_by_other_line(std::span<const std::uint8_t> bytes);
  const std::string& error() const { return error_; }

  // Sends bytes to the board; they arrive one after the other during run().
  void send(std::span<const std::uint8_t> bytes);
  // Connects exactly these pins to ground.
  void draw_low(std::uint32_t inputs) { drawn_low_ = inputs; }

  std::uint64_t cycle() const { return cycle_; }
  std::uint32_t levels() const { return levels_; }
  std::uint64_t lost_bytes() const { return lost_bytes_; }
  // Returns the spindle PWM's duty, 0 to 1.
  double duty() const { return duty_; }
  // The output of the last run(): pin changes, and bytes sent by the board.
  const std::vector<PinChange>& changes() const { return changes_; }
  const std::vector<std::uint8_t>& said() const { return said_; }

 private:
  bool request(std::uint64_t cycle, const Stops& stops, std::uint8_t flags, std::span<const std::uint8_t> bytes);
  bool read_answer();

  ChildProcess child_;
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
