#include "follower/avr_follower.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <simavr/sim_avr.h>
#include <simavr/sim_cycle_timers.h>
#include <simavr/sim_io.h>

#include "passo/emulator/emulated_chip.hpp"
#include "passo/emulator/emulated_ports.hpp"

namespace passo {
namespace {

constexpr Nanoseconds ns_of_cycles(std::uint64_t cycles) {
  return static_cast<Nanoseconds>(cycles * 125 / 2);
}
constexpr std::uint64_t cycles_of_ns(Nanoseconds time) {
  return static_cast<std::uint64_t>(time) * 2 / 125;
}

const std::string all_ports = "ABCDEFGHJKL";

class Run {
 public:
  Run(const AvrBoard& board, const FollowerVector& vector)
      : pins_(*board.pins),
        vector_(vector),
        chip_(board.images + "_" + vector.drive + ".elf", board.mcu),
        ports_(chip_, board.mcu == "atmega2560" ? all_ports : "BCD") {
    // All that nobody pulls up is low.
    for (std::uint8_t bit = 0; bit < 8; ++bit) ports_.set_input(pins_.lines, bit, false);
    ports_.set_input(pins_.relay_line.port, pins_.relay_line.bit, false);
    watch_samples();
    avr_cycle_timer_register(&chip_.avr(), 1, on_time, this);
  }

  FollowerRun play() {
    const std::uint64_t end = cycles_of_ns(vector_.end);
    while (chip_.cycles() < end) {
      if (const int state = avr_run(&chip_.avr()); state == cpu_Done || state == cpu_Crashed) {
        throw std::runtime_error("the follower died");
      }
      if (reset_asked_) reset();
    }
    return {seen(), longest_turn_};
  }

 private:
  // simavr calls this at the next change of a line, and often enough to see which column is drawn low.
  static avr_cycle_count_t on_time(avr_t* /*avr*/, avr_cycle_count_t when, void* run) {
    return static_cast<Run*>(run)->pass(when);
  }
  std::uint64_t pass(std::uint64_t now) {
    constexpr std::uint64_t tenth_of_a_millisecond = 1600;
    for (; next_ != vector_.lines.end() && cycles_of_ns(next_->at) <= now; ++next_) set(*next_);
    connect_keys();
    std::uint64_t then = now + tenth_of_a_millisecond;
    if (next_ != vector_.lines.end()) then = std::min(then, cycles_of_ns(next_->at));
    return then;
  }

  // Each reading of the lines' port is a sample; the port itself goes on as it was.
  void watch_samples() {
    auto& read = chip_.avr().io[AVR_DATA_TO_IO(port_registers(pins_.lines))].r;
    port_reader_ = read.c;
    port_ = read.param;
    read.param = this;
    read.c = [](avr_t* avr, avr_io_addr_t address, void* run) {
      auto& self = *static_cast<Run*>(run);
      if (self.sampled_ != 0) self.longest_turn_ = std::max(self.longest_turn_, avr->cycle - self.sampled_);
      self.sampled_ = avr->cycle;
      return self.port_reader_(avr, address, self.port_);
    };
  }

  // All pins float. simavr forgets who wanted to be called.
  void reset() {
    reset_asked_ = false;
    avr_t& avr = chip_.avr();
    for (const char port : all_ports) {
      const auto latches = static_cast<avr_io_addr_t>(port_registers(port) + 2);
      const auto& write = avr.io[AVR_DATA_TO_IO(latches)].w;
      if (write.c != nullptr) write.c(&avr, latches, 0, write.param);
    }
    avr_reset(&avr);
    avr_cycle_timer_register(&avr, 1, on_time, this);
  }

  void set(const LineChange& change) {
    const std::string& line = change.line;
    if (line == "reset") {
      reset_asked_ = true;
      return;
    }
    if (!pins_.has_keypad() && (line.starts_with("key.") || line == "button")) return;
    if (line.starts_with("key.")) {
      const KeyPlace place = key_place(line);
      connected_[place.row][place.column] = change.high;
      return;
    }
    if (line == "relay") return ports_.set_input(pins_.relay_line.port, pins_.relay_line.bit, change.high);
    if (line == "button") return ports_.set_input(pins_.tool_button.port, pins_.tool_button.bit, !change.high);
    const int axis = line.back() - 'x';
    ports_.set_input(pins_.lines, static_cast<std::uint8_t>(line.starts_with("clock.") ? axis : 3 + axis), change.high);
  }

  // A key pulls its row to what its column is drawn to; the pull-ups hold the rest.
  void connect_keys() {
    if (!pins_.has_keypad()) return;
    for (std::size_t row = 0; row < keypad_rows; ++row) {
      bool high = true;
      for (std::size_t column = 0; column < keypad_columns; ++column) {
        if (connected_[row][column] && drawn_low(pins_.columns[column])) high = false;
      }
      ports_.set_input(pins_.rows[row].port, pins_.rows[row].bit, high);
    }
  }
  bool drawn_low(Pin pin) {
    const std::uint8_t direction = chip_.avr().data[port_registers(pin.port) + 1];
    return (direction & pin.mask()) != 0 && (ports_.outputs(pin.port) & pin.mask()) == 0;
  }

  std::vector<OutputChange> seen() const {
    std::vector<OutputChange> changes;
    const auto bit_of = [](Pin pin, std::uint8_t levels) { return (levels & pin.mask()) != 0 ? 1U : 0U; };
    for (const PortChange& change : ports_.changes()) {
      const Nanoseconds at = ns_of_cycles(change.cycle);
      for (std::size_t axis = 0; axis < follower_axes; ++axis) {
        unsigned before = 0;
        unsigned now = 0;
        for (unsigned f = 0; f < 4; ++f) {
          const Pin pin = pins_.windings[axis][f];
          if (pin.port != change.port) continue;
          before |= bit_of(pin, change.before) << f;
          now |= bit_of(pin, change.now) << f;
        }
        if (before != now) changes.push_back({at, std::string("windings.") + "xyz"[axis], winding_text(now)});
      }
      const std::pair<const char*, Pin> single[] = {{"relay", pins_.relay},
                                                    {"indicator.relay", pins_.relay_indicator},
                                                    {"indicator.automatic", pins_.automatic_indicator},
                                                    {"indicator.manual", pins_.manual_indicator}};
      for (const auto& [name, pin] : single) {
        if (pin.port != change.port || bit_of(pin, change.before) == bit_of(pin, change.now)) continue;
        changes.push_back({at, name, bit_of(pin, change.now) != 0 ? "1" : "0"});
      }
    }
    return changes;
  }

  const FollowerPins& pins_;
  const FollowerVector& vector_;
  EmulatedChip chip_;
  EmulatedPorts ports_;
  std::vector<LineChange>::const_iterator next_ = vector_.lines.begin();
  avr_io_read_t port_reader_ = nullptr;
  void* port_ = nullptr;
  bool reset_asked_ = false;
  std::uint64_t sampled_ = 0;
  std::uint64_t longest_turn_ = 0;
  bool connected_[keypad_rows][keypad_columns] = {};
};

}  // namespace

FollowerRun run_on_avr(const AvrBoard& board, const FollowerVector& vector) {
  return Run(board, vector).play();
}

}  // namespace passo
