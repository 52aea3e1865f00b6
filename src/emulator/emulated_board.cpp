#include "passo/emulator/emulated_board.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "passo/chip/mega_ramps.hpp"
#include "passo/chip/mega_windings.hpp"
#include "passo/chip/uno_cnc_shield.hpp"
#include "passo/chip/uno_windings.hpp"
#include "passo/emulator/emulated_chip.hpp"
#include "passo/emulator/emulated_encoder.hpp"
#include "passo/emulator/emulated_pico.hpp"
#include "passo/emulator/emulated_ports.hpp"
#include "passo/emulator/emulated_timer.hpp"
#include "passo/emulator/emulated_uart.hpp"
#include "passo/plant/ideal_plant.hpp"

namespace passo {
namespace {

constexpr double clock_rate = 16e6;
constexpr std::uint32_t baud = 500'000;
// How long, in seconds, an endless run() waits for a silent board.
constexpr double longest_silence = 10;

struct Kind {
  const char* mcu;
  const char* ports;
  std::vector<MotorPins> motors;
  std::map<BoardInput, Pin> switches;
  Pin spindle_speed = {};
  Pin spindle_direction = {};
  bool has_encoder = false;
};

// On the Mega, the spindle's PWM is timer 4's output C, which one bit connects to its pin. docs/boards.md has the PWM's
// speed.
constexpr Pin output_c = {'H', 5};
constexpr std::uint16_t tccr4a = 0xa0;
constexpr std::uint16_t ocr4cl = 0xac;
constexpr std::uint8_t connected = 1 << 3;
constexpr std::uint8_t inverting = 1 << 2;
constexpr double full_duty = 255;
constexpr double full_rpm = 24'000;

template <class Map>
Kind kind_of(const char* mcu, const char* ports, const Map& pins, DriveMode drive = {}) {
  Kind kind{.mcu = mcu,
            .ports = ports,
            .motors = {std::begin(pins.motor), std::end(pins.motor)},
            .switches = {{input_limit, pins.limits[0]},
                         {static_cast<BoardInput>(input_limit << 1U), pins.limits[1]},
                         {static_cast<BoardInput>(input_limit << 2U), pins.limits[2]},
                         {static_cast<BoardInput>(input_limit << 3U), pins.limits[3]},
                         {static_cast<BoardInput>(input_limit << 4U), pins.limits[4]},
                         {static_cast<BoardInput>(input_limit << 5U), pins.limits[5]},
                         {input_probe, pins.probe},
                         {input_emergency_stop, pins.emergency_stop},
                         {input_hold, pins.feed_hold},
                         {input_start, pins.cycle_start}},
            .spindle_speed = pins.spindle_pwm,
            .spindle_direction = pins.spindle_direction,
            .has_encoder = pins.encoder.exists()};
  for (MotorPins& motor : kind.motors) motor.drive = drive;
  return kind;
}

template <class Map>
Kind kind_of(bool is_mega, const Map& pins, DriveMode drive = {}) {
  return is_mega ? kind_of("atmega2560", "ABCDEFGHJKL", pins, drive) : kind_of("atmega328p", "BCD", pins, drive);
}

Kind kind_named(std::string_view name) {
  const bool is_mega = name.starts_with("mega");
  for (const auto& [ending, drive] : {std::pair{"_two_on", DriveMode::two_on}, std::pair{"_wave", DriveMode::wave},
                                      std::pair{"_half_step", DriveMode::half_step}}) {
    if (!name.ends_with(ending)) continue;
    return is_mega ? kind_of(is_mega, mega_windings, drive) : kind_of(is_mega, uno_windings, drive);
  }
  return is_mega ? kind_of(is_mega, mega_ramps) : kind_of(is_mega, uno_cnc_shield);
}

class AvrBoard final : public EmulatedBoard {
 public:
  AvrBoard(Kind kind, const std::string& program)
      : motors_(std::move(kind.motors)),
        switches_(std::move(kind.switches)),
        spindle_speed_(kind.spindle_speed),
        spindle_direction_(kind.spindle_direction),
        has_encoder_(kind.has_encoder),
        positions_(motors_.size(), 0),
        chip_(program, kind.mcu),
        timer_(chip_),
        uart_(chip_, baud),
        ports_(chip_, kind.ports) {
    uart_.on_byte = [this](std::uint8_t byte) {
      said_.push_back(byte);
      chip_.stop();
    };
    ports_.on_change = [this](const PortChange& change) { count_steps(change); };
  }

  void receive(std::span<const std::uint8_t> bytes) override { uart_.send(bytes); }

  bool run(Seconds most) override {
    const double seconds = std::min(most.value(), longest_silence);
    const std::uint64_t end = chip_.cycles() + static_cast<std::uint64_t>(std::max(seconds, 0.0) * clock_rate);
    look_at_plant(elapsed());
    while (said_.empty() && chip_.cycles() < end) {
      chip_.run_for(std::min<std::uint64_t>(end - chip_.cycles(), look_cycles));
    }
    return !said_.empty();
  }

  std::span<const std::uint8_t> replies() override {
    taken_ = std::exchange(said_, {});
    return taken_;
  }

  Seconds elapsed() const override { return time_of(chip_.cycles()); }
  std::vector<std::int64_t> positions() const override { return positions_; }
  void connect(Plant& plant) override {
    plant_ = &plant;
    if (has_encoder_ && plant.spindle().has_encoder()) fit_encoder();
    if (spindle_speed_ == output_c) watch_spindle();
    look_at_plant(elapsed());
  }
  void wire(const PinSetup& wiring) override {
    wiring_ = wiring;
    set_pins(plant_->inputs_at(elapsed()));
  }

 private:
  static constexpr std::uint64_t look_cycles = 1'000'000;

  static Seconds time_of(std::uint64_t cycle) { return Seconds(static_cast<double>(cycle) / clock_rate); }

  void fit_encoder() {
    encoder_.emplace(chip_, plant_->spindle().counts_per_turn(),
                     [this](std::uint64_t cycle) { return std::abs(plant_->spindle().turns_at(time_of(cycle))); });
  }
  void watch_spindle() {
    chip_.on_write(ocr4cl, [this](std::uint8_t value) {
      duty_ = value;
      command_spindle();
    });
    chip_.on_write(tccr4a, [this](std::uint8_t value) {
      turns_ = (value & connected) != 0;
      inverts_ = (value & inverting) != 0;
      command_spindle();
    });
  }
  void command_spindle() {
    const bool back = is_high(spindle_direction_) != ((wiring_.outputs & spindle_reverse) != 0);
    const bool low_is_on = (wiring_.outputs & spindle_on) != 0;
    const double high = turns_ ? duty_ / full_duty : is_high(spindle_speed_) ? 1 : 0;
    const double rpm = (inverts_ != low_is_on ? 1 - high : high) * full_rpm;
    plant_->command_spindle(elapsed(), back ? -rpm : rpm);
  }
  void count_steps(const PortChange& change) {
    const unsigned turned_over = change.now ^ unsigned { change.before };
    levels_[static_cast<std::size_t>(change.port - 'A')] = change.now;
    pulses_ = {};
    bool stepped = false;
    for (std::size_t motor = 0; motor < motors_.size(); ++motor) {
      const MotorPins& pins = motors_[motor];
      const bool low_steps = (wiring_.steps >> motor & 1U) != 0;
      const bool edge = change.port == pins.step.port && (turned_over & pins.step.mask()) != 0;
      if (edge && is_high(pins.step) != low_steps && is_enabled(pins))
        count(change.cycle, motor, is_high(pins.direction));
      if ((turned_over & pins.winding_bits(change.port)) != 0) follow_windings(change.cycle, motor);
    }
    for (const std::int64_t pulses : pulses_) stepped = stepped || pulses != 0;
    if (!stepped) return;
    plant_->pulse(time_of(change.cycle), pulses_);
    look_at_plant(time_of(change.cycle));
  }
  void look_at_plant(Seconds time) {
    const std::uint16_t inputs = plant_->inputs_at(time);
    if (inputs != inputs_) set_pins(inputs);
  }
  void set_pins(std::uint16_t inputs) {
    inputs_ = inputs;
    for (const auto& [which, pin] : switches_) {
      if (pin.exists()) ports_.set_input(pin.port, pin.bit, ((inputs ^ wiring_.inputs) & which) == 0);
    }
  }
  bool is_high(Pin pin) const { return (levels_of(pin) & pin.mask()) != 0; }
  bool is_enabled(const MotorPins& pins) const {
    return !pins.enable.exists() || is_high(pins.enable) == ((wiring_.outputs & inverted_enable) != 0);
  }
  void count(std::uint64_t cycle, std::size_t motor, bool down) {
    positions_[motor] += down ? -1 : 1;
    pulses_[motor] += down ? -1 : 1;
    if (on_step) on_step(cycle, motor, down);
  }
  // If a motor's windings are on two ports, there is a moment between the two writes. The pattern of that moment is in
  // no table.
  void follow_windings(std::uint64_t cycle, std::size_t motor) {
    const WindingTable table = winding_table(motors_[motor].drive);
    unsigned pattern = 0;
    for (unsigned f = 0; f < winding_count; ++f) {
      const Pin pin = motors_[motor].windings[f];
      if ((levels_of(pin) & pin.mask()) != 0) pattern |= 1U << f;
    }
    const auto place = static_cast<std::uint8_t>(positions_[motor]);
    if (pattern == table.at(static_cast<std::uint8_t>(place + 1))) return count(cycle, motor, false);
    if (pattern == table.at(static_cast<std::uint8_t>(place - 1))) count(cycle, motor, true);
  }
  std::uint8_t levels_of(Pin pin) const { return levels_[static_cast<std::size_t>(pin.port - 'A')]; }

  std::vector<MotorPins> motors_;
  std::map<BoardInput, Pin> switches_;
  Pin spindle_speed_;
  Pin spindle_direction_;
  bool has_encoder_;
  IdealPlant own_plant_;
  Plant* plant_ = &own_plant_;
  std::uint16_t inputs_ = 0;  // the inputs that the plant told last
  PinSetup wiring_;           // how the plant is connected to the pins
  double duty_ = 0;
  bool turns_ = false;
  bool inverts_ = false;
  std::vector<std::int64_t> positions_;
  MotorSteps pulses_{};                       // the pulses of the current change
  std::array<std::uint8_t, 12> levels_ = {};  // each port's levels at the last count, A first
  EmulatedChip chip_;
  EmulatedTimer timer_;
  EmulatedUart uart_;
  EmulatedPorts ports_;
  std::optional<EmulatedEncoder> encoder_;
  std::vector<std::uint8_t> said_;
  std::vector<std::uint8_t> taken_;
};

}  // namespace

Result<std::unique_ptr<EmulatedBoard>, std::string> EmulatedBoard::start(std::string_view kind,
                                                                         const std::string& program) {
  if (kind == "pico") return start_pico_board(program);
  try {
    return std::unique_ptr<EmulatedBoard>(std::make_unique<AvrBoard>(kind_named(kind), program));
  } catch (const std::runtime_error& error) {
    return Failure<std::string>{error.what()};
  }
}

}  // namespace passo
