// EmulatedPico: a Raspberry Pi Pico, emulated by a program of its own (src/emulator/pico, rp2040js on node). The two
// run in lock-step: the emulator does nothing but what run() asks for, so the same calls give the same figures
// everywhere.
//
// Cycles are the chip's, of 128 MHz. Needs node, and `npm ci` in src/emulator/pico (scripts/install.sh).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/chip/pico_pins.hpp"

namespace passo {

class EmulatedBoard;

// The levels of all outputs from a cycle on, a bit for each GPIO.
struct PicoChange {
  std::uint64_t cycle = 0;
  std::uint32_t levels = 0;
};

// Where the line is plugged in.
enum class PicoSocket { usb, uart };

class EmulatedPico {
 public:
  // `program`: a UF2 file. The error is a sentence with the reason.
  static Result<std::unique_ptr<EmulatedPico>, std::string> start(const std::string& program, const PicoPins& pins,
                                                                  PicoSocket socket = PicoSocket::usb);
  EmulatedPico(const EmulatedPico&) = delete;
  ~EmulatedPico();

  // When to stop before the time is over.
  struct Stops {
    bool at_byte = false;       // when the board has said one
    std::uint32_t watched = 0;  // bits of GPIOs
    std::uint32_t rises = 0;    // after so many moments in which some of these rose; 0: never
  };
  // What the encoder at the spindle does in the next run(): it turns evenly to so many pulses in all, of so many a
  // turn.
  struct EncoderWay {
    double from = 0;
    double to = 0;
    std::uint32_t pulses_per_turn = 0;  // 0: there is none
  };
  void turn_encoder(const EncoderWay& way) { encoder_ = way; }
  // Runs until `cycle`. False if the emulator has died; then error() tells it.
  bool run(std::uint64_t cycle, const Stops& stops);
  const std::string& error() const { return error_; }

  // Puts bytes on the line; they arrive one after the other while it runs.
  void send(std::span<const std::uint8_t> bytes);
  // Puts them on the UART, even if the line is USB.
  bool send_by_uart(std::span<const std::uint8_t> bytes);
  // Connects these pins to ground, and no others. A bit for each GPIO.
  void draw_low(std::uint32_t inputs) { drawn_low_ = inputs; }

  std::uint64_t cycle() const { return cycle_; }
  std::uint32_t levels() const { return levels_; }
  std::uint64_t lost_bytes() const { return lost_bytes_; }
  // How long the spindle's output is high, as a part of its period.
  double duty() const { return duty_; }
  // What came out in the last run().
  const std::vector<PicoChange>& changes() const { return changes_; }
  const std::vector<std::uint8_t>& said() const { return said_; }

 private:
  EmulatedPico(int process, int to, int from) : process_(process), to_(to), from_(from) {}
  bool fail();
  bool request(std::uint64_t cycle, const Stops& stops, std::uint8_t flags, std::span<const std::uint8_t> bytes);
  bool read_answer();

  int process_;
  int to_;
  int from_;
  std::string error_;
  std::uint64_t cycle_ = 0;
  std::uint32_t levels_ = 0;
  std::uint32_t drawn_low_ = 0;
  EncoderWay encoder_;
  std::uint64_t lost_bytes_ = 0;
  double duty_ = 0;
  std::vector<std::uint8_t> to_send_;
  std::vector<PicoChange> changes_;
  std::vector<std::uint8_t> said_;
};

// As EmulatedBoard::start() for a kind that is one of pico_boards.
Result<std::unique_ptr<EmulatedBoard>, std::string> start_pico_board(std::string_view kind, const std::string& program);

}  // namespace passo
