// passo-emulate-avr MCU FIRMWARE.elf PINS [encoder=N,S,D,R,F,BIT]: an emulated ATmega in lock-step with the program
// that started it. The protocol is that of src/board/emulator/pico/emulated_pico.js; cycles are the chip's, of 16 MHz.
// A watched pin counts when it falls, too: windings do, and drivers whose pulses are low. The request's words about the
// encoder are not needed.
//
// This program is linked with libsimavr, which is under the GPL, version 3. So whoever gives it away does so under
// these terms. Passo's own program starts it, and is not linked with it.
//
//   PINS       the protocol's pins, bit 0 first, as B0,B1,!L3: what the chip drives high; of a pin with a ! what the
//   chip
//              draws low
//   encoder=   on a Mega: the spindle has an encoder of N counts a turn. A SpindleModel's numbers, and the protocol's
//   pin
//              that is high while the spindle turns back
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <unistd.h>

#include "passo/chip/pin.hpp"
#include "passo/emulator/emulated_chip.hpp"
#include "passo/emulator/emulated_encoder.hpp"
#include "passo/emulator/emulated_ports.hpp"
#include "passo/emulator/emulated_timer.hpp"
#include "passo/emulator/emulated_uart.hpp"
#include "passo/emulator/emulator_process.hpp"
#include "passo/plant/virtual_spindle.hpp"

namespace passo {
namespace {

constexpr std::uint32_t baud = 500'000;
constexpr double clock_rate = 16e6;
constexpr std::size_t most_pins = 32;

// The spindle's PWM of a Mega is timer 4's output C, which one bit connects to its pin.
constexpr std::uint16_t tccr4a = 0xa0;
constexpr std::uint16_t ocr4cl = 0xac;
constexpr std::uint8_t connected = 1 << 3;
constexpr std::uint8_t inverting = 1 << 2;
constexpr Pin output_c = {'H', 5};
constexpr double full_duty = 255;

struct Wire {
  Pin pin;
  bool when_drawn_low = false;
};

std::vector<std::string> parts_of(std::string_view text) {
  std::vector<std::string> parts(1);
  for (const char letter : text) {
    if (letter == ',') {
      parts.emplace_back();
    } else {
      parts.back() += letter;
    }
  }
  return parts;
}

std::vector<Wire> wires_of(std::string_view text) {
  std::vector<Wire> wires;
  for (const std::string& part : parts_of(text)) {
    const bool low = part.starts_with('!');
    const std::string name = part.substr(low ? 1 : 0);
    const bool known = name.size() == 2 && name[0] >= 'A' && name[0] <= 'L' && name[1] >= '0' && name[1] <= '7';
    if (!known || wires.size() == most_pins) throw std::runtime_error("expected up to 32 pins, e.g. B0,!L3: " + part);
    wires.push_back({{name[0], static_cast<std::uint8_t>(name[1] - '0')}, low});
  }
  return wires;
}

// The spindle as its encoder sees it. The other program's plant has the same one.
struct Shaft {
  VirtualSpindle spindle;
  std::uint32_t turns_back = 0;  // a bit of the pins
};

Shaft shaft_of(std::string_view text) {
  const std::vector<std::string> parts = parts_of(text);
  if (parts.size() != 6) throw std::runtime_error("encoder= needs six numbers");
  const auto number = [&](std::size_t at) { return std::strtod(parts[at].c_str(), nullptr); };
  const SpindleModel model{.counts_per_turn = static_cast<std::int32_t>(number(0)),
                           .run_up = number(1),
                           .droop = number(2),
                           .ripple = number(3),
                           .ripple_rate = number(4)};
  return {VirtualSpindle(model), std::uint32_t{1} << static_cast<unsigned>(number(5))};
}

void read_fully(void* to, std::size_t size) {
  for (std::size_t have = 0; have < size;) {
    const ssize_t got = ::read(STDIN_FILENO, static_cast<char*>(to) + have, size - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) std::exit(0);
    have += static_cast<std::size_t>(got);
  }
}

template <class Number>
void put(std::vector<std::uint8_t>& to, Number number) {
  const std::size_t at = to.size();
  to.resize(at + sizeof(number));
  std::memcpy(to.data() + at, &number, sizeof(number));
}
template <class Number>
Number get(const std::vector<std::uint8_t>& from, std::size_t at) {
  Number number;
  std::memcpy(&number, from.data() + at, sizeof(number));
  return number;
}

class Board {
 public:
  Board(const std::string& mcu, const std::string& program, std::vector<Wire> wires)
      : is_mega_(mcu == "atmega2560"),
        wires_(std::move(wires)),
        chip_(program, mcu),
        timer_(chip_),
        uart_(chip_, baud),
        ports_(chip_, is_mega_ ? "ABCDEFGHJKL" : "BCD") {
    uart_.on_byte = [this](std::uint8_t byte) {
      said_.push_back(byte);
      if (stops_at_byte_) stop();
    };
    ports_.on_change = [this](const PortChange& change) { look(change.cycle); };
    ports_.on_direction = [this] { look(chip_.cycles()); };
    if (is_mega_) watch_spindle();
  }

  void fit_encoder(const Shaft& shaft) {
    shaft_ = shaft;
    encoder_.emplace(chip_, shaft.spindle.counts_per_turn(),
                     [this](std::uint64_t cycle) { return std::abs(shaft_->spindle.turns_at(time_of(cycle))); });
  }

  // Reads a request, does what it says, and answers.
  void serve() {
    std::uint32_t size = 0;
    read_fully(&size, sizeof(size));
    std::vector<std::uint8_t> request(size);
    read_fully(request.data(), size);
    if (size < request_head) throw std::runtime_error("a request is too short");
    uart_.send({request.begin() + request_head, request.end()});
    draw_low(get<std::uint32_t>(request, 8));
    watched_ = get<std::uint32_t>(request, 12);
    rises_ = get<std::uint32_t>(request, 16);
    stops_at_byte_ = request[20] != 0;
    run(static_cast<std::uint64_t>(get<double>(request, 0)));
    answer();
  }

 private:
  static constexpr std::size_t request_head = 41;

  static Seconds time_of(std::uint64_t cycle) { return Seconds(static_cast<double>(cycle) / clock_rate); }

  void stop() {
    chip_.stop();
    stopped_ = true;
  }
  void run(std::uint64_t end) {
    stopped_ = stops_at_byte_ && !said_.empty();
    while (!stopped_ && chip_.cycles() < end) chip_.run_for(end - chip_.cycles());
  }

  void look(std::uint64_t cycle) {
    std::uint32_t levels = 0;
    for (std::size_t i = 0; i < wires_.size(); ++i) {
      const auto [pin, when_drawn_low] = wires_[i];
      const bool high = (ports_.outputs(pin.port) & pin.mask()) != 0;
      const bool on = when_drawn_low ? !high && (ports_.directions(pin.port) & pin.mask()) != 0 : high;
      if (on) levels |= std::uint32_t{1} << i;
    }
    if (levels == levels_) return;
    const std::uint32_t turned = levels ^ levels_;
    levels_ = levels;
    changes_.push_back({cycle, levels});
    if ((turned & watched_) != 0 && rises_ != 0 && --rises_ == 0) stop();
  }

  void draw_low(std::uint32_t pins) {
    const std::uint32_t turned = pins ^ drawn_low_;
    drawn_low_ = pins;
    for (std::size_t i = 0; i < wires_.size(); ++i) {
      const std::uint32_t bit = std::uint32_t{1} << i;
      if ((turned & bit) != 0) ports_.set_input(wires_[i].pin.port, wires_[i].pin.bit, (pins & bit) == 0);
    }
  }

  void watch_spindle() {
    chip_.on_write(ocr4cl, [this](std::uint8_t value) {
      compare_ = value;
      command_spindle();
    });
    chip_.on_write(tccr4a, [this](std::uint8_t value) {
      is_connected_ = (value & connected) != 0;
      is_inverting_ = (value & inverting) != 0;
      command_spindle();
    });
  }
  // The run ends here, so that the other program hears of it in time.
  void command_spindle() {
    const bool high = (ports_.outputs(output_c.port) & output_c.mask()) != 0;
    duty_ = is_connected_ ? compare_ / full_duty : high ? 1 : 0;
    if (is_connected_ && is_inverting_) duty_ = 1 - duty_;
    stop();
    if (!shaft_) return;
    const bool back = (levels_ & shaft_->turns_back) != 0;
    shaft_->spindle.command(time_of(chip_.cycles()), (back ? -1 : 1) * duty_ * full_rpm);
  }

  void answer() {
    std::vector<std::uint8_t> text;
    put(text, std::uint32_t{0});
    put(text, static_cast<double>(chip_.cycles()));
    put(text, static_cast<std::uint32_t>(changes_.size()));
    for (const PinChange& change : changes_) {
      put(text, static_cast<double>(change.cycle));
      put(text, change.levels);
    }
    put(text, duty_);
    put(text, static_cast<std::uint32_t>(uart_.overruns()));
    text.insert(text.end(), said_.begin(), said_.end());
    const auto size = static_cast<std::uint32_t>(text.size() - sizeof(std::uint32_t));
    std::memcpy(text.data(), &size, sizeof(size));
    changes_.clear();
    said_.clear();
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t wrote = ::write(STDOUT_FILENO, text.data() + sent, text.size() - sent);
      if (wrote < 0 && errno == EINTR) continue;
      if (wrote <= 0) std::exit(0);
      sent += static_cast<std::size_t>(wrote);
    }
  }

  bool is_mega_;
  std::vector<Wire> wires_;
  EmulatedChip chip_;
  EmulatedTimer timer_;
  EmulatedUart uart_;
  EmulatedPorts ports_;
  std::optional<Shaft> shaft_;
  std::optional<EmulatedEncoder> encoder_;
  std::uint32_t levels_ = 0;
  std::uint32_t drawn_low_ = 0;
  std::uint32_t watched_ = 0;
  std::uint32_t rises_ = 0;
  bool stops_at_byte_ = false;
  bool stopped_ = false;
  std::uint8_t compare_ = 0;
  bool is_connected_ = false;
  bool is_inverting_ = false;
  double duty_ = 0;
  std::vector<PinChange> changes_;
  std::vector<std::uint8_t> said_;
};

int serve(const std::vector<std::string>& words) {
  if (words.size() < 4) {
    std::fputs("usage: passo-emulate-avr MCU FIRMWARE.elf PINS [OPTION...]; passo starts it (docs/boards.md)\n",
               stderr);
    return 2;
  }
  Board board(words[1], words[2], wires_of(words[3]));
  for (std::size_t at = 4; at < words.size(); ++at) {
    if (words[at].starts_with("encoder=")) {
      board.fit_encoder(shaft_of(std::string_view(words[at]).substr(8)));
    } else {
      throw std::runtime_error("no such option: " + words[at]);
    }
  }
  for (;;) board.serve();
}

}  // namespace
}  // namespace passo

int main(int argc, char** argv) {
  try {
    return passo::serve({argv, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "passo-emulate-avr: %s\n", error.what());
    return 1;
  }
}
